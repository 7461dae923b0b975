#include <ctime>

#include "report_parts.h"

namespace posidonia
{
namespace
{
std::string isoTime(double stamp)
{
	const auto seconds = static_cast<std::time_t>(stamp);
	char text[32];
	std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&seconds));
	return text;
}

TJson nodesJson(const TRunData& run)
{
	return {
		{"altitude", column(run.nodes, 3, [](const TNodeRow& n) { return n.altitude; })},
		{"points", column(run.nodes, 0, [](const TNodeRow& n) { return double(n.points); })}};
}
}  // namespace

std::string runReportJson(
	const TRunData& run, const std::optional<TFloorMosaic>& floor, const TReportLimits& limits)
{
	TJson notes = TJson::array();
	const auto shown = loopsShown(run, limits, notes);
	TJson page{{"schema", 1}};
	page["title"] = run.info.title;
	page["app"] = run.info.app;
	page["app_versions"] = run.info.versions;
	page["start_utc"] = isoTime(run.info.start);
	page["start_stamp"] = run.info.start;
	page["duration"] = rounded(run.info.duration, 3);
	page["interrupted"] = run.info.interrupted;
	page["headline"] = headlineJson(run);
	page["metrics"] = metricsJson(run);
	page["paper_table"] = paperTableJson(run);
	page["trajectories"] = trajectoriesJson(run, limits, notes);
	page["errors"] = errorsJson(run, limits);
	page["nodes"] = nodesJson(run);
	page["consistency"] = consistencyJson(run, limits);
	page["camera"] = cameraJson(run);
	page["floor"] = floorJson(floor);
	page["loops"] = loopsJson(run, shown, limits);
	page["refused"] = refusedJson(run);
	page["key_frames"] = keyFramesJson(run, shown, limits, notes);
	page["timings"] = timingsJson(run);
	page["sensors"] = sensorsJson(run);
	page["events"] = eventsJson(run);
	page["plots"] = plotsJson(run, limits);
	page["config"] = run.config;
	page["mission"] = run.mission.empty() ? TJson(nullptr) : TJson(run.mission);
	page["log"] = run.log;
	page["notes"] = notes;
	return page.dump(-1, ' ', false, TJson::error_handler_t::replace);
}
}  // namespace posidonia
