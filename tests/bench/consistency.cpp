// Statistics of the navigation filter over simulated surveys: scripts/bench consistency.
#include <consistency.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <cstdlib>
#include <future>
#include <iostream>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
double median(std::vector<double> v)
{
	std::sort(v.begin(), v.end());
	return v.size() % 2 ? v[v.size() / 2] : 0.5 * (v[v.size() / 2 - 1] + v[v.size() / 2]);
}

/** Runs both halves of the seeds at once; the results are independent of that. */
template <class RUN>
void forEachSeed(unsigned first, unsigned count, const RUN& run)
{
	std::vector<std::future<void>> waiting;
	for (unsigned half = 0; half < 2; half++)
		waiting.push_back(std::async(std::launch::async, [&, half] {
			for (unsigned i = half; i < count; i += 2)
				run(i, first + i);
		}));
	for (auto& w : waiting)
		w.get();
}

void printEnds(
	const char* what, unsigned first, unsigned count, double duration,
	const std::function<void(TSurveyScene&)>& change)
{
	std::vector<double> share(count), error(count), way(count);
	forEachSeed(first, count, [&](unsigned i, unsigned seed) {
		TSurveyScene scene = deadReckoningHour(duration, seed);
		change(scene);
		const TEnd end = endOf(scene);
		share[i] = end.share(), error[i] = end.error, way[i] = end.way;
	});
	std::cout << mrpt::format(
		"%-45s median %.3f %% of the way, worst %.3f %%; %.2f m after %.0f m\n", what, 100 * median(share),
		100 * *std::max_element(share.begin(), share.end()), median(error), median(way));
}
}  // namespace

/** consistency [seeds = 20] [first seed = 101] [seconds = 3600] */
int main(int argc, char** argv)
{
	const auto number = [&](int i, int other) { return argc > i ? std::atoi(argv[i]) : other; };
	const auto count = static_cast<unsigned>(number(1, 20)), first = static_cast<unsigned>(number(2, 101));
	const double duration = number(3, 3600);
	std::cout << "seeds " << first << " to " << first + count - 1 << ", " << duration << " s each\n\n";
	std::vector<TConsistency> runs(count);
	forEachSeed(
		first, count, [&](unsigned i, unsigned seed) { addRun(runs[i], surfaceHour(duration + 1, seed)); });
	TConsistency all;
	for (const TConsistency& run : runs)
		all += run;
	std::cout << text(all) << "\ndead reckoning below the surface, end error\n";
	printEnds("as it is", first, count, duration, [](TSurveyScene&) {});
	printEnds("bottom lock lost once for 60 s", first, count, duration, [&](TSurveyScene& s) {
		s.world.dvl.lock_loss_start = duration / 2;
		s.world.dvl.lock_loss_duration = 60;
	});
	printEnds("1 % of the pings wrong by 1.5 m/s", first, count, duration, [](TSurveyScene& s) {
		s.world.dvl.outlier_rate = 0.01;
	});
	return 0;
}
