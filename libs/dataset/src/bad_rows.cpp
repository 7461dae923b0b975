#include <posidonia/base/error.h>
#include <posidonia/dataset/bad_rows.h>

namespace posidonia
{
void CBadRows::add(const std::string& where, const std::string& problem)
{
	if (!m_skip) throw CError(where, problem, "mend it, or leave bad rows out with --skip-bad");
	constexpr size_t kMessages = 20;  // enough to see what is wrong
	if (m_count++ < kMessages) m_messages.push_back(where + ": " + problem);
}
}  // namespace posidonia
