#include <amd.h>
#include <camd.h>
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
		"elimination order", "AMD or CAMD failed with status " + std::to_string(status),
		status == AMD_OUT_OF_MEMORY ? "the graph needs more memory" : "report this");
}
/** The pattern of the pairs, column by column (one row more: AMD refuses null pointers). */
struct TPattern
{
	std::vector<int> starts, rows;

	TPattern(int n, const std::vector<std::array<int, 2>>& pairs)
		: starts(size_t(n) + 1, 0), rows(pairs.size() + 1)
	{
		for (const auto& pair : pairs)
			starts[size_t(pair[0]) + 1]++;
		for (int c = 0; c < n; c++)
			starts[c + 1] += starts[c];
		std::vector<int> next(starts.begin(), starts.end() - 1);
		for (const auto& pair : pairs)
			rows[next[pair[0]]++] = pair[1];
	}
};
}  // namespace

std::vector<int> minimumDegreeOrder(int n, const std::vector<std::array<int, 2>>& pairs)
{
	const TPattern pattern(n, pairs);
	std::vector<int> order(n);
	if (n > 0)
		check(amd_order(n, pattern.starts.data(), pattern.rows.data(), order.data(), nullptr, nullptr));
	return order;
}

std::vector<int> constrainedMinimumDegreeOrder(
	int n, const std::vector<std::array<int, 2>>& pairs, const std::vector<int>& groups)
{
	static_assert(AMD_OUT_OF_MEMORY == CAMD_OUT_OF_MEMORY && AMD_OK == CAMD_OK);
	const TPattern pattern(n, pairs);
	std::vector<int> order(n);
	if (n > 0)
		check(camd_order(
			n, pattern.starts.data(), pattern.rows.data(), order.data(), nullptr, nullptr, groups.data()));
	return order;
}
}  // namespace posidonia
