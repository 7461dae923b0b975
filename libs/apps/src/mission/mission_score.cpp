#include <mrpt/core/format.h>
#include <posidonia/apps/mission/mission_plots.h>
#include <posidonia/apps/mission/mission_score.h>
#include <posidonia/eval/path.h>
#include <posidonia/eval/statistics.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace posidonia
{
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
Vector3d truePosition(const TControlStep& step)
{
	return step.truth.T_map_body.translation();
}

/** `q` of 1 of the values are not above it. */
double quantile(std::vector<double> values, double q)
{
	if (values.empty()) return 0;
	const auto nth = values.begin() + static_cast<long>(q * static_cast<double>(values.size() - 1));
	std::nth_element(values.begin(), nth, values.end());
	return *nth;
}

/** Largest minus smallest value in the window of +- `half` steps round each. */
std::vector<double> ranges(const std::vector<double>& values, size_t half)
{
	std::vector<double> out;
	for (size_t k = half; k + half < values.size(); k++) {
		const auto [low, high] =
			std::minmax_element(values.begin() + long(k - half), values.begin() + long(k + half) + 1);
		out.push_back(*high - *low);
	}
	return out;
}

/** How much each value differs from the one before. */
std::vector<double> stepsOf(const std::vector<double>& values)
{
	std::vector<double> out;
	for (size_t k = 1; k < values.size(); k++)
		out.push_back(std::abs(values[k] - values[k - 1]));
	return out;
}

template <class F>
std::vector<double> valuesOf(const std::vector<TControlStep>& steps, const F& value)
{
	std::vector<double> out;
	for (const TControlStep& step : steps)
		out.push_back(value(step));
	return out;
}

void addErrors(TMetrics& rows, const std::string& name, const std::vector<double>& values)
{
	const TStatistics s = statistics(values);
	rows.push_back({"mission." + name + ".mean", "m", s.mean});
	rows.push_back({"mission." + name + ".max", "m", s.max});
}

void addChanges(
	TMetrics& rows, const std::string& name, const std::string& unit, const std::vector<double>& values)
{
	rows.push_back({"mission." + name + ".p99", unit, quantile(values, 0.99)});
	rows.push_back({"mission." + name + ".max", unit, quantile(values, 1)});
}

double wayOf(const std::vector<TControlStep>& steps)
{
	std::vector<Vector3d> positions;
	for (const TControlStep& step : steps)
		positions.push_back(truePosition(step));
	return travelled(positions).back();
}

/** The last point that the mission names. */
std::optional<Vector2d> lastPoint(const TMission& mission)
{
	for (auto step = mission.steps.rbegin(); step != mission.steps.rend(); ++step)
		if (step->has_end) return step->end;
	return std::nullopt;
}
}  // namespace

TMetrics missionMetrics(const std::vector<TControlStep>& steps, const TMission& mission)
{
	const std::optional<Vector2d> point = lastPoint(mission);
	std::vector<double> cross, depth, end, speed, altitude;
	for (const TControlStep& step : steps) {
		if (const double off = trueCrossTrack(step); std::isfinite(off)) {
			cross.push_back(std::abs(off));
			speed.push_back(step.truth.v_map.head<2>().norm());
			altitude.push_back(step.true_altitude);
			depth.push_back(std::abs(step.output.depth_reference - truePosition(step).z()));
		}
		const bool last = step.output.step + 1 == mission.steps.size();
		if (point && last && mission.steps.back().kind == EStepKind::HOLD)
			end.push_back((truePosition(step).head<2>() - *point).norm());
	}
	TMetrics rows;
	rows.push_back({"mission.duration", "s", steps.back().t});
	rows.push_back({"mission.path_length", "m", wayOf(steps)});
	rows.push_back({"mission.leg_speed", "m/s", statistics(speed).median});
	rows.push_back({"mission.leg_altitude", "m", statistics(altitude).mean});
	addErrors(rows, "cross_track", cross);
	addErrors(rows, "depth_error", depth);
	addErrors(rows, "end_error", end);
	const double period = steps.size() > 1 ? steps[1].t - steps[0].t : 1;
	const auto half = static_cast<size_t>(std::lround(2 / period));
	const auto yaw_rates = valuesOf(steps, [](const auto& s) { return s.output.unlimited.yaw_rate; });
	const auto surges = valuesOf(steps, [](const auto& s) { return s.output.unlimited.surge; });
	addChanges(rows, "yaw_rate_step", "rad/s", stepsOf(yaw_rates));
	addChanges(rows, "surge_step", "m/s", stepsOf(surges));
	addChanges(rows, "yaw_rate_range", "rad/s", ranges(yaw_rates, half));
	addChanges(rows, "surge_range", "m/s", ranges(surges, half));
	return rows;
}

TMetrics jumpMetrics(const std::vector<TControlStep>& steps, double time)
{
	const auto jump = std::find_if(steps.begin(), steps.end(), [&](const auto& s) { return s.t >= time; });
	if (time <= 0 || jump == steps.end()) return {};
	const auto apart = [](const TControlStep& s) {
		return Eigen::Isometry3d(s.feedback.navigation.T_map_body.inverse() * s.feedback.T_map_body);
	};
	const auto settled =
		std::find_if(jump + 1, steps.end(), [](const auto& s) { return !s.feedback.correcting; });
	const double until = settled == steps.end() ? std::numeric_limits<double>::infinity() : settled->t;
	return {
		{"jump.distance", "m", apart(*jump).translation().norm()},
		{"jump.angle", "rad", logSO3(apart(*jump).linear()).norm()},
		{"jump.settled_after", "s", until - jump->t}};
}

std::string controlCsv(const std::vector<TControlStep>& steps)
{
	std::string csv =
		"t,true_n,true_e,true_d,true_yaw,n,e,d,yaw,correcting,odom_n,odom_e,odom_d,step,phase,cross_track,"
		"heading_ref,depth_ref,surge_cmd,heave_cmd,yaw_rate_cmd,surge_lim,heave_lim,yaw_rate_lim,X,Z,N,"
		"starboard,port,heave,level\n";
	for (const TControlStep& s : steps) {
		const Vector3d p = truePosition(s), e = s.feedback.navigation.T_map_body.translation(),
					   o = s.T_odom_body.translation();
		const TAutopilotOutput& out = s.output;
		csv += mrpt::format(
			"%.2f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%d,%.4f,%.4f,%.4f,%zu,%d,%.4f,", s.t, p.x(), p.y(),
			p.z(), yawPitchRoll(s.truth.T_map_body.linear())[0], e.x(), e.y(), e.z(),
			s.feedback.navigation.heading(), int(s.feedback.correcting), o.x(), o.y(), o.z(), out.step,
			int(out.leg.phase), trueCrossTrack(s));
		csv += mrpt::format(
			"%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.3f,%.3f,%.3f,%.4f,%.4f,%.4f,%s\n",
			out.heading_reference, out.depth_reference, out.unlimited.surge, out.unlimited.heave,
			out.unlimited.yaw_rate, out.limited.surge, out.limited.heave, out.limited.yaw_rate,
			out.achieved.X, out.achieved.Z, out.achieved.N, out.set_points.starboard, out.set_points.port,
			out.set_points.heave, toString(out.level).c_str());
	}
	return csv;
}

namespace
{
/** Those of `names` that are not among `others` (null: none). */
std::vector<std::string> without(
	const std::vector<std::string>& names, const std::vector<std::string>* others)
{
	std::vector<std::string> left;
	for (const std::string& name : names)
		if (!others || std::find(others->begin(), others->end(), name) == others->end()) left.push_back(name);
	return left;
}
}  // namespace

std::string eventsCsv(const std::vector<TControlStep>& steps, double start_time)
{
	std::string csv = "t,kind,text\n";
	const auto add = [&](double t, const std::string& kind, const std::string& text) {
		csv += mrpt::format("%.2f,%s,\"%s\"\n", t, kind.c_str(), text.c_str());
	};
	const std::vector<std::string>* before = nullptr;
	for (const TControlStep& step : steps) {
		for (const std::string& name : without(step.faults, before))
			add(step.t, "fault begins", name);
		if (before)
			for (const std::string& name : without(*before, &step.faults))
				add(step.t, "fault ends", name);
		before = &step.faults;
		for (const TMissionEvent& event : step.output.events)
			add(event.stamp - start_time, toString(event.kind), event.text);
	}
	return csv;
}

std::string missionSummary(const TMetrics& rows)
{
	const auto value = [&](const char* name) { return metric(rows, std::string("mission.") + name); };
	return mrpt::format(
		"mission: %.0f s, %.1f m, legs at %.2f m/s and %.2f m above the floor\n"
		"true cross-track error: mean %.4f m, worst %.4f m; depth: mean %.4f m\n"
		"true distance from the last point, keeping station: mean %.4f m, worst %.4f m",
		value("duration"), value("path_length"), value("leg_speed"), value("leg_altitude"),
		value("cross_track.mean"), value("cross_track.max"), value("depth_error.mean"),
		value("end_error.mean"), value("end_error.max"));
}
}  // namespace posidonia
