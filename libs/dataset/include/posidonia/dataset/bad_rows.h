#pragma once

#include <string>
#include <vector>

namespace posidonia
{
/** What happens to a row (or image) that is bad: an error, or with `skip` a counted warning. */
class CBadRows
{
   public:
	explicit CBadRows(bool skip) : m_skip(skip) {}
	/** Throws CError "<where>: <problem>; ..." unless bad rows are skipped, then counts it. */
	void add(const std::string& where, const std::string& problem);

	bool skips() const { return m_skip; }
	size_t count() const { return m_count; }
	/** The first ones, in words. */
	const std::vector<std::string>& messages() const { return m_messages; }

   private:
	bool m_skip;
	size_t m_count{0};
	std::vector<std::string> m_messages;
};
}  // namespace posidonia
