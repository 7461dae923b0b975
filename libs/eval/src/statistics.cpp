#include <posidonia/eval/statistics.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace posidonia
{
TStatistics statistics(std::vector<double> values)
{
	TStatistics s;
	s.count = values.size();
	if (values.empty()) return s;
	const double n = static_cast<double>(s.count);
	s.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
	double squares_about_mean = 0;
	for (double v : values) {
		s.sse += v * v;
		squares_about_mean += (v - s.mean) * (v - s.mean);
	}
	s.rmse = std::sqrt(s.sse / n);
	s.std = std::sqrt(squares_about_mean / n);
	std::sort(values.begin(), values.end());
	s.min = values.front();
	s.max = values.back();
	s.median = (values[(s.count - 1) / 2] + values[s.count / 2]) / 2;
	return s;
}
}  // namespace posidonia
