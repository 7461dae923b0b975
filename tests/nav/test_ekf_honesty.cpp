#include <gtest/gtest.h>
#include <random_pose.h>

#include "nav_simulator.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
struct TMean
{
	double sum{0};
	int n{0};
	void add(double x) { sum += x, n++; }
	double value() const { return sum / n; }
};

/** Turn-on bias and start error drawn from what the options declare; the filter is told the start without
 * them. */
struct TRun
{
	TNavScene scene;
	TEkfOptions options;
	TInitialPoseOptions start;
};
TRun randomRun(unsigned seed)
{
	TRun run;
	run.scene.seed = seed;
	run.scene.acceleration_density = 0.03;
	run.options.mode = "gyro";
	std::mt19937 rng(1000 + seed);
	std::normal_distribution<double> n;
	const auto normal3 = [&](double x, double y, double z) {
		const double a = n(rng), b = n(rng), c = n(rng);
		return Vector3d(a * x, b * y, c * z);
	};
	Isometry3d told = randomPose(rng, 5, 0);
	told.translation().z() = 0.5;
	told.linear() = rotationFromYawPitchRoll(0.7 * seed, 0.02, -0.03);
	run.start = knownStart(told);
	const double s = run.start.sigma_xy, rp = run.start.sigma_roll_pitch;
	run.scene.start = told;
	run.scene.start.translation() += normal3(s, s, run.start.sigma_z);
	run.scene.start.linear() = expSO3(normal3(rp, rp, run.start.sigma_heading)) * told.linear();
	run.options.sigma_initial_gyro_bias = 1e-3;
	run.scene.gyro_bias = normal3(1e-3, 1e-3, 1e-3);
	run.scene.dvl_scale = run.scene.sensors.dvl.at("DVL").sigma_scale * n(rng);
	return run;
}

/** Mean NEES / 6 of the edges (a node every `seconds`) and of now(), over `seeds` runs. */
struct THonesty
{
	TMean edge, now;
	Eigen::Matrix<double, 6, 1> edge_axes{Vector6d::Zero()};  ///< Mean squared normalised error of each axis
	double consecutive_correlation{0};						  ///< Of yaw errors of neighbouring edges
};
THonesty measure(
	int seeds, double seconds, const std::function<void(TRun&)>& change = [](TRun&) {})
{
	THonesty h;
	double cross = 0, square = 0;
	for (int seed = 1; seed <= seeds; seed++) {
		TRun run = randomRun(seed);
		change(run);
		CEkfOdometry odometry(run.options, run.start, run.scene.sensors, run.scene.datum);
		Isometry3d T_map_clone = run.scene.start;
		double next = seconds, previous_yaw = 0;
		CNavSimulator(run.scene).run([&](const mrpt::obs::CObservation& o, const TNavTruth& truth) {
			odometry.add(o);
			if (!dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&o) || truth.t < next) return;
			next += seconds;
			const Isometry3d true_edge = T_map_clone.inverse() * truth.T_map_body;
			const TPoseEstimate edge = odometry.sinceClone();
			h.edge.add(nees(edge, true_edge) / 6);
			h.now.add(nees(odometry.now(), truth.T_map_body) / 6);
			const Vector6d e = localCoordinates(edge.T, true_edge);
			h.edge_axes += e.cwiseAbs2().cwiseQuotient(edge.cov.diagonal());
			const double yaw = e[5] / std::sqrt(edge.cov(5, 5));
			cross += yaw * previous_yaw;
			square += yaw * yaw;
			previous_yaw = yaw;
			odometry.clone();
			T_map_clone = truth.T_map_body;
		});
	}
	h.edge_axes /= h.edge.n;
	h.consecutive_correlation = cross / square;
	std::cout << "edges " << h.edge.n << ": NEES/6 edge " << h.edge.value() << ", now " << h.now.value()
			  << ", axes " << h.edge_axes.transpose() << ", yaw correlation of neighbours "
			  << h.consecutive_correlation << "\n";
	return h;
}
}  // namespace

TEST(EkfHonesty, EdgeCovarianceIsThatOfTheDisplacement)
{
	const THonesty h = measure(30, 1.6);
	EXPECT_GT(h.edge.value(), 0.9);
	EXPECT_LT(h.edge.value(), 1.1);
	for (int axis = 0; axis < 6; axis++) {
		EXPECT_GT(h.edge_axes[axis], 0.8) << "axis=" << axis;
		EXPECT_LT(h.edge_axes[axis], 1.2) << "axis=" << axis;
	}
}

TEST(EkfHonesty, LongEdgesAreHonestToo)
{
	const THonesty h = measure(25, 10);
	EXPECT_GT(h.edge.value(), 0.8);
	EXPECT_LT(h.edge.value(), 1.2);
}

TEST(EkfHonesty, NavigationPoseIsInItsBand)
{
	const THonesty h = measure(30, 5);
	EXPECT_GT(h.now.value(), 0.85);
	EXPECT_LT(h.now.value(), 1.15);
}

TEST(EkfHonesty, NavigationPoseWithGpsIsInItsBand)
{
	const THonesty h = measure(25, 5, [](TRun& run) { run.scene.gps_until = 60; });
	EXPECT_GT(h.now.value(), 0.85);
	EXPECT_LT(h.now.value(), 1.15);
}

TEST(EkfHonesty, WithoutHeadingTheGyroCarriesItAndTheBandHolds)
{
	const THonesty h = measure(20, 5, [](TRun& run) { run.options.use_heading = false; });
	EXPECT_GT(h.now.value(), 0.8);
	EXPECT_LT(h.now.value(), 1.2);
	EXPECT_GT(h.edge.value(), 0.8);
	EXPECT_LT(h.edge.value(), 1.2);
}

TEST(EkfHonesty, SmoothMotionIsNeverWorseThanDeclared)
{
	// A steady vehicle changes its speed less than the declared random walk: the covariance may only be wide.
	const THonesty h = measure(12, 1.6, [](TRun& run) { run.scene.acceleration_density = 0; });
	EXPECT_LT(h.edge.value(), 1.05);
	EXPECT_GT(h.edge.value(), 0.3);
}
