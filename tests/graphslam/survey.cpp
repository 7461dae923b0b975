#include "survey.h"

#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/nav/ekf_odometry.h>
#include <posidonia/obs/rawlog_reader.h>
#include <posidonia/obs/register_observations.h>
#include <unistd.h>

#include <filesystem>

namespace posidonia::testing
{
using Eigen::Isometry3d;
using mrpt::obs::CObservationStereoImages;

namespace
{
/** A folder of the program, not of one test. */
class CProgramFolder
{
   public:
	CProgramFolder()
		: m_path(std::filesystem::temp_directory_path() / ("posidonia-graphslam-" + std::to_string(getpid())))
	{
		std::filesystem::create_directories(m_path);
	}
	~CProgramFolder()
	{
		std::error_code ignored;
		std::filesystem::remove_all(m_path, ignored);
	}
	std::string file(const std::string& name) const { return m_path / name; }

   private:
	std::filesystem::path m_path;
};

TSimulationOptions simulationOptions()
{
	TSimulationOptions o;
	o.run.seed = 5;
	o.run.save_images = "all";
	o.route.start = {-1.5, -1.5, 3.5, 0};
	o.route.way_points = {1.5, -1.5, 1.5, 1.5, -1.5, 1.5, -1.5, -1.5, 1.5, -1.5, 1.5, -0.9};
	o.route.dwell = 1;
	o.floor.texture = "rock";
	o.floor.extent_north = o.floor.extent_east = 12;
	o.floor.resolution = 0.01;
	return o;
}

TSensorSuite smallPictures()
{
	TSensorSuite sensors = TSensorSuite::sparus2();
	TStereoSpec& stereo = sensors.stereo.begin()->second;
	stereo.rate = 4;
	stereo.camera = {320, 240, 141.5, 141.5, 159.5, 119.5, 0.12};
	return sensors;
}

TSurvey simulate(const CProgramFolder& folder)
{
	registerObservations();
	TSurvey s;
	s.simulation = simulationOptions();
	s.sensors = smallPictures();
	s.rawlog = folder.file("survey.rawlog");
	CSurveySimulator(s.simulation, s.sensors).run(folder.file("survey"));
	CRawlogReader reader(s.rawlog);
	while (const auto observation = reader.next()) {
		s.observations.push_back(observation);
		if (IS_CLASS(*observation, CObservationStereoImages)) s.pair_stamps.push_back(stampOf(*observation));
	}
	return s;
}
}  // namespace

Isometry3d TSurvey::truth(double stamp) const
{
	const CVehicleMotion motion(simulation.route, simulation.motion, simulation.run.seed);
	return motion.at(stamp - simulation.run.start_time).T_map_body;
}

std::unique_ptr<COdometrySource> TSurvey::ekf() const
{
	TInitialPoseOptions start;
	start.position = {-1.5, -1.5, 3.5};
	start.sigma_xy = start.sigma_z = 0.01;
	return std::make_unique<CEkfOdometry>(TEkfOptions{}, start, sensors, simulation.world);
}

const TSurvey& survey()
{
	static const CProgramFolder folder;
	static const TSurvey made = simulate(folder);
	return made;
}

TSetup secondExperiment()
{
	TSetup setup;
	setup.corruption.drift_xy = 0.012;
	setup.corruption.drift_z = 0.004;
	return setup;
}

std::unique_ptr<CStereoSlam> run(const TSetup& setup)
{
	const TSurvey& s = survey();
	auto slam = std::make_unique<CStereoSlam>(
		setup.slam, s.sensors, std::make_unique<COdometryCorruptor>(s.ekf(), setup.corruption),
		std::make_unique<CStereoImageLoader>(s.rawlog), setup.config_file);
	for (const auto& observation : s.observations) {
		if (slam->map().nodeCount() >= setup.stop_at_nodes) break;
		slam->add(observation);
	}
	return slam;
}

const CStereoSlam& defaultRun()
{
	static const auto slam = run(secondExperiment());
	return *slam;
}

double meanNodeError(const CStereoSlam& slam)
{
	double sum = 0;
	for (const auto& node : slam.nodes())
		sum += (node.T.translation() - survey().truth(node.stamp).translation()).norm();
	return sum / slam.map().nodeCount();
}

double meanOdometryError(const CStereoSlam& slam)
{
	double sum = 0;
	for (const auto& node : slam.map().nodes())
		sum += (node.T_odom_body.translation() - survey().truth(node.stamp).translation()).norm();
	return sum / slam.map().nodeCount();
}

TPairError errorOfPair(const CStereoSlam& slam, int i, int j, const Isometry3d& T_i_j)
{
	const Isometry3d T_map_i = survey().truth(slam.map().node(i).stamp);
	const Isometry3d T_map_j = survey().truth(slam.map().node(j).stamp);
	const Vector6d d = localCoordinates(T_map_i.inverse() * T_map_j, T_i_j);
	return {d.head<3>().norm(), d.tail<3>().norm()};
}

int edgesOf(const CStereoSlam& slam, EEdgeKind kind)
{
	int count = 0;
	for (const auto& edge : slam.map().edges())
		count += edge.kind == kind;
	return count;
}

std::string fingerprint(const CStereoSlam& slam)
{
	std::string bytes;
	const auto append = [&](const Isometry3d& T) {
		bytes.append(reinterpret_cast<const char*>(T.matrix().data()), 16 * sizeof(double));
	};
	for (int i = 0; i < slam.map().nodeCount(); i++)
		append(slam.map().pose(i));
	for (const auto& pose : slam.causal())
		append(pose.T_map_body);
	return bytes + candidatesCsv(slam.map().candidates);
}
}  // namespace posidonia::testing
