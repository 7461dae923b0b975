// Two logs of a real AUV (1 Hz, no IMU: they test DVL and attitude handling, not inertial navigation).
#include <mrpt/obs/CObservationRobotPose.h>
#include <posidonia/apps/CEkfApp.h>
#include <posidonia/dataset/dead_reckoning.h>
#include <posidonia/dataset/import_dataset.h>
#include <posidonia/eval/trajectory_io.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/observations.h>

#include "apps_testing.h"

namespace fs = std::filesystem;
using namespace posidonia;
using namespace posidonia::testing;

namespace
{
std::string logFolder(const std::string& name)
{
	const char* set = std::getenv("POSIDONIA_DATA");
	return (set ? std::string(set) : POSIDONIA_SOURCE_DIR "/../shared/data") + "/auv-logs/snapir/" + name;
}

struct TOutcome
{
	double end{0}, dead_reckoning_end{0};  ///< 3D [m]
	double squares{0}, sigmas{0};		   ///< Sums over poses: squared error, 3 sigma (horizontal)
	int poses{0}, inside{0};			   ///< ... of which north and east are both within 3 sigma
};

/** The log with 0.5 degrees of noise and a slow bias of 1 degree on its attitude. */
TOutcome replayDegraded(const std::string& log, unsigned seed)
{
	constexpr double kDegree = M_PI / 180;
	const CTempFolder folder;
	TDatasetOptions options;
	options.format = EDatasetFormat::DVL_GT_CSV;
	options.input = logFolder(log);
	options.output = folder / "auv.rawlog";
	options.attitude_errors = {0.5 * kDegree, 1 * kDegree, 600, seed};
	const TDatasetReport report = importDataset(options);
	CEkfApp app;
	runApp(
		app, {"-c", POSIDONIA_SOURCE_DIR "/ini/logged-dvl.ini", "-r", options.output, "-o", folder / "run",
			  "--set", mrpt::format("World.latitude=%.10f", report.datum->latitude), "--set",
			  mrpt::format("World.longitude=%.10f", report.datum->longitude)});
	const TTrajectory truth = readTum(folder / "auv.gt.tum");
	const TTrajectory dr = deadReckoning(options.output, truth.front().T.translation());
	TOutcome o;
	o.dead_reckoning_end = (dr.back().T.translation() - truth.back().T.translation()).norm();
	CRawlogReader reader(app.results().rawlog);
	size_t k = 0;
	while (const auto observation = reader.next()) {
		const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(observation.get());
		if (!pose) continue;
		while (k + 1 < truth.size() && truth[k].stamp < stampOf(*pose) - 1e-3)
			k++;
		const Eigen::Vector3d e = fromMrpt(pose->pose.mean).translation() - truth[k].T.translation();
		const double north = 3 * std::sqrt(pose->pose.cov(0, 0)), east = 3 * std::sqrt(pose->pose.cov(1, 1));
		o.poses++;
		o.inside += std::abs(e.x()) < north && std::abs(e.y()) < east;
		o.squares += e.squaredNorm();
		o.sigmas += std::hypot(north, east);
		o.end = e.norm();
	}
	return o;
}
}  // namespace

TEST(RealLogs, TheFilterBeatsDeadReckoningAndKnowsItsError)
{
	for (const char* log : {"Trajectory1", "Trajectory6"}) {
		if (!fs::is_directory(logFolder(log)))
			GTEST_SKIP() << "no " << logFolder(log) << " (set POSIDONIA_DATA)";
		TOutcome all;
		for (unsigned seed = 1; seed <= 6; seed++) {
			const TOutcome o = replayDegraded(log, seed);
			std::cout << log << " seed " << seed << ": ends " << o.end << " m off, dead reckoning "
					  << o.dead_reckoning_end << " m; " << 100 * o.inside / o.poses << " % within 3 sigma of "
					  << o.sigmas / o.poses << " m, rms " << std::sqrt(o.squares / o.poses) << " m\n";
			EXPECT_GE(o.poses, 399) << log << " seed " << seed;
			EXPECT_LT(o.end, 1.1 * o.dead_reckoning_end) << log << " seed " << seed;
			EXPECT_GE(o.inside, 0.95 * o.poses) << log << " seed " << seed;
			all.squares += o.squares, all.sigmas += o.sigmas, all.poses += o.poses;
		}
		EXPECT_LT(all.sigmas / all.poses, 5 * std::sqrt(all.squares / all.poses)) << log;
	}
}
