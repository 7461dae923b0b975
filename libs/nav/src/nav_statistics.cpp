#include <mrpt/core/format.h>
#include <posidonia/nav/nav_statistics.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
void TSensorCount::use(double stamp, double time_out)
{
	used++;
	gated_in_row = 0;
	const double gap = used > 1 ? stamp - last_used : 0;
	longest_gap = std::max(longest_gap, gap);
	if (time_out > 0 && gap > time_out) {
		outages++;
		outage_time += gap;
	}
	last_used = stamp;
}

TSensorCount TSensorCount::plus(const TSensorCount& on_arrival) const
{
	TSensorCount sum = *this;
	sum.invalid += on_arrival.invalid;
	sum.duplicate += on_arrival.duplicate;
	sum.jumped += on_arrival.jumped;
	sum.replayed += on_arrival.replayed;
	sum.late += on_arrival.late;
	sum.idle += on_arrival.idle;
	return sum;
}

std::string TSensorCount::text() const
{
	std::string out = mrpt::format("used %zu", used);
	const auto count = [&](const char* what, size_t n) {
		if (n > 0) out += mrpt::format(", %s %zu", what, n);
	};
	count("gated", gated);
	count("gated in a row now", gated_in_row);
	count("gave way", gave_way);
	count("inconsistent beams", inconsistent);
	count("invalid", invalid);
	count("duplicate stamps", duplicate);
	count("jumped stamps", jumped);
	count("late but replayed", replayed);
	count("too late", late);
	count("idle", idle);
	if (outages > 0) out += mrpt::format(", %zu outages of %.2f s", outages, outage_time);
	return out + mrpt::format(", longest gap %.2f s", longest_gap);
}

std::string TNavStatistics::text() const
{
	std::string out;
	for (const auto& [label, n] : sensors)
		out += label + ": " + n.text() + "\n";
	if (replays > 0)
		out += mrpt::format(
			"late readings: %zu replays, %zu edges revised, %zu final edges kept\n", replays, edges_revised,
			edges_kept);
	if (clock_resets > 0) out += mrpt::format("the clock went back %zu times\n", clock_resets);
	if (drag_time > 0) out += mrpt::format("no bottom lock: %.1f s bridged by the drag model\n", drag_time);
	return out;
}
}  // namespace posidonia
