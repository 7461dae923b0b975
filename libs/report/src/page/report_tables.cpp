#include <posidonia/eval/number_text.h>
#include <posidonia/report/paper_table.h>

#include <algorithm>

#include "report_parts.h"

namespace posidonia
{
namespace
{
/** The metric, where the run has it and it is a number. */
std::optional<double> found(const TRunData& run, const std::string& what)
{
	for (const TMetric& m : run.metrics)
		if (m.what == what && std::isfinite(m.value)) return m.value;
	return {};
}

/** A tile: a metric under a label. */
void addTile(
	TJson& tiles, const TRunData& run, const char* label, const std::string& what, int decimals,
	const std::string& unit, const char* hint)
{
	if (const auto value = found(run, what))
		tiles.push_back({{"label", label}, {"value", fixedText(*value, decimals) + unit}, {"hint", hint}});
}
}  // namespace

TJson headlineJson(const TRunData& run)
{
	TJson tiles = TJson::array();
	addTile(tiles, run, "mean error, final", "nodes.ate.unaligned.mean", 4, " m", "3D, unaligned, all nodes");
	addTile(
		tiles, run, "mean error, causal", "slam.ate.unaligned.mean", 4, " m",
		"poses when they were handed out");
	addTile(tiles, run, "odometry", "odom.ate.unaligned.mean", 3, " m", "mean 3D error without SLAM");
	addTile(tiles, run, "navigation filter", "ekf.ate.unaligned.mean", 3, " m", "mean 3D error");
	addTile(
		tiles, run, "pose in control", "control.ate.unaligned.mean", 4, " m",
		"mean 3D error of what steered");
	addTile(
		tiles, run, "true end error", "mission.end_error.mean", 3, " m",
		"from the last point, keeping station");
	addTile(tiles, run, "true cross-track", "mission.cross_track.mean", 4, " m", "mean over the legs");
	addTile(tiles, run, "way", "nodes.length", 1, " m", "along the final nodes");
	addTile(tiles, run, "nodes", "graph.nodes", 0, "", "key frames of the graph");
	addTile(tiles, run, "loops accepted", "graph.roi_edges", 0, "", "edges to places seen before");
	addTile(tiles, run, "false loops", "loops.false", 0, "", "accepted and wrong, by the truth");
	return tiles;
}

TJson metricsJson(const TRunData& run)
{
	TJson rows = TJson::array();
	for (const TMetric& m : run.metrics)
		rows.push_back(
			{{"what", m.what},
			 {"value", std::isfinite(m.value) ? TJson(m.value) : TJson(nullptr)},
			 {"unit", m.unit}});
	return rows;
}

TJson paperTableJson(const TRunData& run)
{
	if (run.paper_experiment == 0 || !found(run, "odom.length")) return nullptr;
	const TTextRows table = paperTableRows(run.paper_experiment, paperRows(run.metrics));
	return {{"title", table.title}, {"header", table.header}, {"rows", table.rows}};
}

TJson refusedJson(const TRunData& run)
{
	std::map<std::pair<std::string, std::string>, int> counts;
	for (const TLoopRow& row : run.loops)
		if (!row.accepted()) counts[{row.kind, row.status}]++;
	std::vector<std::pair<std::pair<std::string, std::string>, int>> ordered(counts.begin(), counts.end());
	std::stable_sort(
		ordered.begin(), ordered.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
	TJson out = TJson::array();
	for (const auto& [reason, count] : ordered)
		out.push_back({{"kind", reason.first}, {"status", reason.second}, {"count", count}});
	return out;
}

TJson timingsJson(const TRunData& run)
{
	TJson out = TJson::array();
	for (const auto& [group, rows] : run.timings)
		for (const TTimingRow& row : rows)
			out.push_back(
				{{"group", group},
				 {"stage", row.stage},
				 {"calls", row.calls},
				 {"mean_ms", rounded(row.mean_ms, 4)},
				 {"max_ms", rounded(row.max_ms, 3)},
				 {"total_s", rounded(row.total_s, 3)}});
	return out;
}

TJson sensorsJson(const TRunData& run)
{
	TJson out = TJson::array();
	for (const TSensorRow& row : run.sensors)
		out.push_back(
			{{"name", row.name},
			 {"used", row.used},
			 {"rate_hz", rounded(row.rate, 2)},
			 {"longest_gap_s", rounded(row.longest_gap, 3)},
			 {"rejected", row.rejected}});
	return out;
}

TJson eventsJson(const TRunData& run)
{
	TJson out = TJson::array();
	for (const TEventRow& row : run.events)
		out.push_back({{"t", rounded(row.t, 2)}, {"kind", row.kind}, {"text", row.text}});
	return out;
}
}  // namespace posidonia
