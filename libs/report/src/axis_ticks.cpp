#include <posidonia/eval/number_text.h>
#include <posidonia/report/axis_ticks.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
namespace
{
/** The closest of 1, 2, 5 x 10^k to `raw`, by ratio. */
double roundStep(double raw)
{
	const double power = std::pow(10.0, std::floor(std::log10(raw)));
	const double factor = raw / power;	// 1 ... 10
	if (factor < std::sqrt(2.0)) return power;
	if (factor < std::sqrt(10.0)) return 2 * power;
	return (factor < std::sqrt(50.0) ? 5 : 10) * power;
}
}  // namespace

std::string TTicks::label(double value) const
{
	const int decimals = static_cast<int>(std::max(0.0, -std::floor(std::log10(step) + 1e-9)));
	return fixedText(value, decimals);
}

TTicks roundTicks(double min, double max, int wanted)
{
	TTicks ticks;
	ticks.step = roundStep((max - min) / wanted);
	const double slack = 1e-9 * ticks.step;
	const long long first = std::llround(std::ceil((min - slack) / ticks.step));
	const long long last = std::llround(std::floor((max + slack) / ticks.step));
	for (long long i = first; i <= last; i++)
		ticks.values.push_back(static_cast<double>(i) * ticks.step);
	return ticks;
}
}  // namespace posidonia
