#include <amd.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/elimination_order.h>

namespace posidonia
{
namespace
{
void check(int status)
{
	if (status >= AMD_OK) return;
	throw CError(
		"elimination order", "AMD failed with status " + std::to_string(status),
		status == AMD_OUT_OF_MEMORY ? "the graph needs more memory" : "report this");
}
}  // namespace

std::vector<int> minimumDegreeOrder(int n, const std::vector<std::array<int, 2>>& pairs)
{
	std::vector<int> starts(size_t(n) + 1, 0), rows, order(n);
	rows.reserve(pairs.size());
	auto next = pairs.begin();
	for (int c = 0; c < n; c++) {
		for (; next != pairs.end() && (*next)[0] == c; ++next)
			rows.push_back((*next)[1]);
		starts[c + 1] = int(rows.size());
	}
	if (n > 0) check(amd_order(n, starts.data(), rows.data(), order.data(), nullptr, nullptr));
	return order;
}
}  // namespace posidonia
