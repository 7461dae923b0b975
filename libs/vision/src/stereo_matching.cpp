#include <posidonia/vision/descriptor_matching.h>
#include <posidonia/vision/stereo_matching.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
namespace
{
/** Key points of one place differ by less than this in log2 size. */
constexpr double MAX_OCTAVE_DIFFERENCE = 0.7;

/** The two smallest distances met, and where the smallest was. */
struct TBest
{
	int index{-1};
	int first{std::numeric_limits<int>::max()}, second{std::numeric_limits<int>::max()};
	void offer(int candidate, int distance)
	{
		if (distance < first)
			second = first, first = distance, index = candidate;
		else if (distance < second)
			second = distance;
	}
};

/** Right key points by whole row; features are sorted by row already. */
std::vector<int> firstOfRow(const std::vector<cv::KeyPoint>& sorted, int rows)
{
	std::vector<int> first(rows + 1);
	for (int row = 0, i = 0; row <= rows; row++) {
		while (i < static_cast<int>(sorted.size()) && sorted[i].pt.y < static_cast<float>(row))
			i++;
		first[row] = i;
	}
	return first;
}

bool compatible(
	const TFeatures& left, int i, const TFeatures& right, int j, double tolerance, double min_d, double max_d)
{
	const double d = left.key_points[i].pt.x - right.key_points[j].pt.x;
	return d >= min_d && d <= max_d &&
		   std::abs(left.key_points[i].pt.y - right.key_points[j].pt.y) <= tolerance &&
		   std::abs(left.octaves[i] - right.octaves[j]) <= MAX_OCTAVE_DIFFERENCE;
}
}  // namespace

std::vector<std::pair<int, int>> matchRows(
	const TFeatures& left, const TFeatures& right, const TFeatureOptions& o, double min_disparity,
	double max_disparity)
{
	if (left.key_points.empty() || right.key_points.empty()) return {};
	const int rows = static_cast<int>(right.key_points.back().pt.y) + 1;
	const auto first = firstOfRow(right.key_points, rows);
	const CDescriptorDistance distance(left.descriptors, right.descriptors, isBinaryDetector(o.detector));
	std::vector<TBest> of_left(left.key_points.size()), of_right(right.key_points.size());
	for (int i = 0; i < static_cast<int>(left.key_points.size()); i++) {
		const double v = left.key_points[i].pt.y, tolerance = o.row_tolerance * std::exp2(left.octaves[i]);
		const int from = first[std::clamp(static_cast<int>(v - tolerance), 0, rows)];
		const int to = first[std::clamp(static_cast<int>(v + tolerance) + 1, 0, rows)];
		for (int j = from; j < to; j++) {
			if (!compatible(left, i, right, j, tolerance, min_disparity, max_disparity)) continue;
			const int d = distance(i, j);
			of_left[i].offer(j, d);
			of_right[j].offer(i, d);
		}
	}

	std::vector<std::pair<int, int>> matches;
	for (int i = 0; i < static_cast<int>(of_left.size()); i++) {
		const TBest& best = of_left[i];
		if (best.index >= 0 && of_right[best.index].index == i &&
			distance.passesRatio(best.first, best.second, o.stereo_ratio))
			matches.emplace_back(i, best.index);
	}
	return matches;
}
}  // namespace posidonia
