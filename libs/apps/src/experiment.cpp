#include <posidonia/apps/experiment.h>
#include <posidonia/nav/cola2_odometry.h>
#include <posidonia/nav/ekf_odometry.h>

#include <filesystem>

namespace posidonia
{
TExperiment TExperiment::load(CIniFile& ini, TSensorSuite& sensors)
{
	TExperiment e;
	const auto section = [&](const char* name, auto& options) { ini.loadOnto(options, name); };
	e.simulation.forEachSection(section);
	section("Ekf", e.ekf);
	section("Drag", e.drag);
	section("InitialPose", e.initial_pose);
	section("Odometry", e.odometry);
	section("RecordedOdometry", e.recorded);
	section("OdometryCorruption", e.corruption);
	e.slam.forEachSection(section);
	section("Evaluation", e.evaluation);
	section("Evaluation", e.loop_evaluation);
	section("Report", e.report);
	section("ClosedLoop", e.closed_loop);
	section("Slam", e.latency);
	section("ForcedCorrection", e.forced_correction);
	section("ControllerPose", e.controller_pose);
	e.autopilot.forEachSection(section);
	e.faults = loadFaults(ini);
	overrideSensors(sensors, ini);
	ini.refuseUnknown();
	return e;
}

std::unique_ptr<COdometrySource> TExperiment::makeCleanOdometry(const TSensorSuite& sensors) const
{
	if (odometry.source == "recorded") return std::make_unique<CRecordedOdometry>(recorded);
	if (ekf.mode == "cola2")
		return std::make_unique<CCola2Odometry>(ekf, initial_pose, sensors, simulation.world);
	return std::make_unique<CEkfOdometry>(ekf, initial_pose, sensors, simulation.world, drag);
}

std::unique_ptr<COdometrySource> TExperiment::makeOdometry(const TSensorSuite& sensors) const
{
	return std::make_unique<COdometryCorruptor>(makeCleanOdometry(sensors), corruption);
}

namespace
{
const COdometrySource& behindCorruptor(const COdometrySource& odometry)
{
	const auto* corruptor = dynamic_cast<const COdometryCorruptor*>(&odometry);
	return corruptor ? corruptor->source() : odometry;
}
}  // namespace

Eigen::Isometry3d uncorruptedPose(const COdometrySource& odometry)
{
	return behindCorruptor(odometry).now().T;
}

namespace
{
TNavStatistics statisticsOf(const COdometrySource& odometry)
{
	const COdometrySource& source = behindCorruptor(odometry);
	if (const auto* ekf = dynamic_cast<const CEkfOdometry*>(&source)) return ekf->statistics();
	if (const auto* cola2 = dynamic_cast<const CCola2Odometry*>(&source)) return cola2->statistics();
	return {};
}
}  // namespace

std::map<std::string, TSensorCount> navigationCounts(const COdometrySource& odometry)
{
	return statisticsOf(odometry).sensors;
}

std::string navigationText(const COdometrySource& odometry)
{
	return statisticsOf(odometry).text();
}

TSensorSuite sensorsOfRawlog(const std::string& rawlog, bool assume_defaults)
{
	const std::string path = sensorsPathOf(rawlog);
	if (assume_defaults && !std::filesystem::exists(path)) return TSensorSuite::sparus2();
	return readSensors(path);
}
}  // namespace posidonia
