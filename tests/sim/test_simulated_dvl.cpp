#include <gtest/gtest.h>
#include <posidonia/geometry/mrpt_pose.h>

#include "sensor_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

TEST(SimulatedDvl, OnASpotTurnReadsItsLeverArm)
{
	TVehicleState state;
	state.T_map_body.translation().z() = 3.5;
	state.omega_body = {0, 0, 0.3};
	auto sensor = makeQuietDvl();
	const auto o = sensor.measure(state, 1);
	// 0.4145 m aft of the turning point: 0.3 rad/s to starboard moves it to port, 0.124 m/s
	const Vector3d in_body = quietDvl().T_body_sensor().linear() * velocityOf(asDvl(o));
	EXPECT_LT((in_body - Vector3d(0, -0.3 * 0.4145, 0)).norm(), kTiny);
}

TEST(SimulatedDvl, VelocityIsThatOfTheInstrumentInItsOwnAxes)
{
	auto sensor = makeQuietDvl();
	const Isometry3d T_body_dvl = quietDvl().T_body_sensor();
	const auto pose = [&](double t) -> Isometry3d { return livelyMotion().at(t).T_map_body * T_body_dvl; };
	for (double t = 10; t < 200; t += 7.9) {
		const Vector3d v = pose(t).linear().transpose() *
						   (pose(t + 1e-4).translation() - pose(t - 1e-4).translation()) / 2e-4;
		const auto o = sensor.measure(livelyMotion().at(t), t);
		EXPECT_LT((velocityOf(asDvl(o)) - v).norm(), 1e-7) << "t=" << t;
	}
}

TEST(SimulatedDvl, BeamsHoldTheVelocityAndEndOnTheFloor)
{
	TDvlSpec spec = TSensorSuite::sparus2().dvl.at("DVL");
	CSimulatedDvl sensor("DVL", spec, quietRanges(), {}, flatFloor(), 1);
	const Eigen::Matrix<double, 3, 4> beams = spec.beams();
	for (double t = 20; t < 100; t += 3) {
		const auto state = livelyMotion().at(t);
		const auto o = sensor.measure(state, t);
		const CObservationDVL& dvl = asDvl(o);
		const Eigen::Map<const Eigen::Vector4d> along(dvl.beam_velocities.data());
		const Vector3d solved = (beams * beams.transpose()).ldlt().solve(beams * along);
		EXPECT_LT((solved - velocityOf(dvl)).norm(), kTiny) << "t=" << t;
		const Isometry3d T_map_dvl = state.T_map_body * spec.T_body_sensor();
		for (int i = 0; i < 4; i++)
			EXPECT_NEAR((T_map_dvl * (dvl.beam_ranges[i] * beams.col(i))).z(), kFloor, 1e-9) << "beam " << i;
		EXPECT_NEAR(dvl.altitude, kFloor - T_map_dvl.translation().z(), kTiny);
	}
}

TEST(SimulatedDvl, NoiseHasTheStatedSigma)
{
	TDvlSpec spec;
	spec.sigma_velocity = 0.02;
	CSimulatedDvl sensor("DVL", spec, TSimulatedDvlOptions(), {}, flatFloor(), 11);
	std::vector<double> x, z, altitude;
	for (int i = 0; i < 3000; i++) {
		const auto o = sensor.measure(TVehicleState(), i);
		x.push_back(asDvl(o).velocity.x);
		z.push_back(asDvl(o).velocity.z);
		altitude.push_back(asDvl(o).altitude - kFloor);
	}
	expectWhite(x, 0.02, "x");
	expectWhite(z, spec.sigmaAlong(), "z");
	expectWhite(altitude, 0.01, "altitude");
}

TEST(SimulatedDvl, LosesTheBottomOutsideItsRange)
{
	auto sensor = makeQuietDvl();
	TVehicleState state;
	state.T_map_body.translation().z() = kFloor - 0.11 - 0.49;
	const auto low = sensor.measure(state, 1);
	EXPECT_FALSE(asDvl(low).velocity_valid || asDvl(low).altitude_valid);
	EXPECT_TRUE(std::isnan(asDvl(low).beam_velocities[2]) && std::isnan(asDvl(low).beam_ranges[2]));
	state.T_map_body.translation().z() -= 0.02;
	const auto high_enough = sensor.measure(state, 2);
	EXPECT_TRUE(asDvl(high_enough).velocity_valid && asDvl(high_enough).altitude_valid);
}

namespace
{
constexpr double kStart = 1420070400;

TVehicleState cruising()
{
	TVehicleState state;
	state.v_body = {0.5, -0.1, 0.05};
	return state;
}
Vector3d trueVelocity(const TVehicleState& state, const TDvlSpec& spec)
{
	return spec.T_body_sensor().linear().transpose() * state.v_body;
}
Vector4d beamsOf(const CObservationDVL& dvl)
{
	return Eigen::Map<const Vector4d>(dvl.beam_velocities.data());
}
int beamsLeft(const CObservationDVL& dvl)
{
	int left = 0;
	for (int i = 0; i < 4; i++) {
		EXPECT_EQ(std::isnan(dvl.beam_velocities[i]), std::isnan(dvl.beam_ranges[i])) << "beam " << i;
		left += !std::isnan(dvl.beam_velocities[i]);
	}
	return left;
}
TDvlSpec noisyDvl()
{
	TDvlSpec spec = TSensorSuite::sparus2().dvl.at("DVL");
	spec.sigma_velocity = 0.02;
	return spec;
}
CSimulatedDvl makeDvl(const TSimulatedDvlOptions& options, unsigned seed = 1)
{
	return {"DVL", noisyDvl(), options, {}, flatFloor(), seed};
}
/** Binomial count within 4.5 sigma? */
void expectCount(int count, int n, double p, const std::string& what)
{
	EXPECT_NEAR(count, n * p, 4.5 * std::sqrt(n * p * (1 - p))) << what;
}

/** Does `dvl` hold those numbers of `whole`, the same ping with nothing lost, that its beams can know? */
void expectSurvivorsOf(const CObservationDVL& dvl, const CObservationDVL& whole, const std::string& what)
{
	const int left = beamsLeft(dvl);
	for (int k = 0; k < 4; k++)
		if (!std::isnan(dvl.beam_velocities[k])) {
			EXPECT_EQ(dvl.beam_velocities[k], whole.beam_velocities[k]) << what << ", beam " << k;
			EXPECT_EQ(dvl.beam_ranges[k], whole.beam_ranges[k]) << what << ", beam " << k;
		}
	EXPECT_EQ(dvl.velocity_valid, left >= 3) << what;
	EXPECT_EQ(dvl.altitude_valid, left > 0) << what;
	EXPECT_EQ(dvl.altitude, left > 0 ? whole.altitude : 0) << what;
	EXPECT_TRUE(left == 3 || dvl.velocity_covariance.asEigen().isZero(0)) << what;
	EXPECT_TRUE(left != 4 || velocityOf(dvl) == velocityOf(whole)) << what;
	EXPECT_TRUE(left >= 3 || velocityOf(dvl).isZero(0)) << what;
}
}  // namespace

TEST(SimulatedDvl, BeamsHaveIndependentNoiseOfOneSize)
{
	for (const double azimuth : {0.0, 0.3, M_PI_4})
		for (const double angle : {0.35, M_PI / 6}) {
			TDvlSpec spec = noisyDvl();
			spec.beam_azimuth = azimuth, spec.beam_angle = angle;
			CSimulatedDvl sensor("DVL", spec, {}, {}, flatFloor(), 3);
			const Vector4d truth = spec.beams().transpose() * trueVelocity(cruising(), spec);
			Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
			const int n = 4000;
			for (int i = 0; i < n; i++) {
				const Vector4d noise = beamsOf(asDvl(sensor.measure(cruising(), kStart + i))) - truth;
				covariance += noise * noise.transpose() / n;
			}
			covariance /= spec.sigmaBeam() * spec.sigmaBeam();
			for (int r = 0; r < 4; r++)
				for (int c = 0; c < 4; c++)
					EXPECT_NEAR(covariance(r, c), r == c, 4.5 * std::sqrt((r == c ? 2.0 : 1.0) / n))
						<< "azimuth " << azimuth << " angle " << angle << " beams " << r << c;
		}
}

TEST(SimulatedDvl, DrawnScaleIsThatOfTheVelocity)
{
	TSimulatedDvlOptions options = quietRanges();
	TCalibrationErrorOptions errors;
	errors.dvl_scale = 0.01;
	EXPECT_EQ(CSimulatedDvl("DVL", quietDvl(), options, errors, flatFloor(), 1).scale(), 1.01) << "not drawn";
	options.random_scale = true;
	std::vector<double> drawn;
	for (unsigned seed = 1; seed <= 1000; seed++) {
		CSimulatedDvl sensor("DVL", quietDvl(), options, errors, flatFloor(), seed);
		const Vector3d measured = velocityOf(asDvl(sensor.measure(cruising(), kStart)));
		EXPECT_LT((measured - sensor.scale() * trueVelocity(cruising(), quietDvl())).norm(), kTiny) << seed;
		drawn.push_back(sensor.scale() - 1.01);
	}
	expectWhite(drawn, quietDvl().sigma_scale, "scale");
}

TEST(SimulatedDvl, OutliersHaveTheirRateLengthAndNoDirection)
{
	TSimulatedDvlOptions options;
	options.outlier_rate = 0.1;
	CSimulatedDvl with = makeDvl(options), without = makeDvl({});
	const int n = 10000;
	std::vector<Vector3d> directions;
	for (int i = 0; i < n; i++) {
		const auto a = with.measure(cruising(), kStart + i), b = without.measure(cruising(), kStart + i);
		const Vector3d error = velocityOf(asDvl(a)) - velocityOf(asDvl(b));
		EXPECT_TRUE(asDvl(a).velocity_valid) << i;
		EXPECT_EQ(asDvl(a).beam_ranges, asDvl(b).beam_ranges) << i;
		const Vector4d of_beams = beamsOf(asDvl(a)) - beamsOf(asDvl(b));
		EXPECT_LT((of_beams - noisyDvl().beams().transpose() * error).norm(), kTiny) << i;
		if (error.isZero(0)) continue;
		EXPECT_NEAR(error.norm(), options.outlier_speed, kTiny) << i;
		directions.push_back(error / error.norm());
	}
	const double m = static_cast<double>(directions.size());
	expectCount(static_cast<int>(m), n, options.outlier_rate, "outliers");
	Vector3d mean = Vector3d::Zero();
	Matrix3d second = Matrix3d::Zero();
	for (const auto& d : directions)
		mean += d / m, second += d * d.transpose() / m;
	EXPECT_LT(mean.cwiseAbs().maxCoeff(), 4.5 / std::sqrt(3 * m)) << "towards one side";
	EXPECT_LT((3 * second - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 4.5 / std::sqrt(m))
		<< "along one axis";
}

TEST(SimulatedDvl, LostBeamsLeaveTheOthersAlone)
{
	TSimulatedDvlOptions options;
	options.beam_loss = 0.25;
	CSimulatedDvl with = makeDvl(options), without = makeDvl({});
	const int n = 5000;
	int lost = 0, valid = 0;
	for (int i = 0; i < n; i++) {
		const auto a = with.measure(cruising(), kStart + i), b = without.measure(cruising(), kStart + i);
		expectSurvivorsOf(asDvl(a), asDvl(b), "ping " + std::to_string(i));
		lost += 4 - beamsLeft(asDvl(a));
		valid += asDvl(a).velocity_valid;
	}
	expectCount(lost, 4 * n, 0.25, "beams lost");
	expectCount(valid, n, std::pow(0.75, 4) + 4 * 0.25 * std::pow(0.75, 3), "pings with three beams or four");
	options.beam_loss = 1;
	auto blind = makeDvl(options);
	EXPECT_EQ(beamsLeft(asDvl(blind.measure(cruising(), kStart))), 0);
}

TEST(SimulatedDvl, ThreeBeamsStateTheCovarianceOfTheirVelocity)
{
	TSimulatedDvlOptions options;
	options.beam_loss = 0.25;
	auto sensor = makeDvl(options);
	const Vector3d truth = trueVelocity(cruising(), noisyDvl());
	double sum = 0;
	int n = 0;
	for (int i = 0; i < 8000; i++) {
		const auto o = sensor.measure(cruising(), kStart + i);
		if (beamsLeft(asDvl(o)) != 3) continue;
		const Vector3d error = velocityOf(asDvl(o)) - truth;
		const Matrix3d covariance = asDvl(o).velocity_covariance.asEigen();
		sum += error.dot(covariance.inverse() * error);
		n++;
		for (int k = 0; k < 4; k++) {
			const double along = asDvl(o).beam_velocities[k];
			if (std::isnan(along)) continue;
			EXPECT_NEAR(noisyDvl().beams().col(k).dot(velocityOf(asDvl(o))), along, kTiny) << "met exactly";
		}
	}
	ASSERT_GT(n, 2000);
	EXPECT_NEAR(sum / n, 3, 4.5 * std::sqrt(6.0 / n)) << "NEES of 3 degrees of freedom";
}

TEST(SimulatedDvl, BeamsEndAtTheirLongestSlantRange)
{
	auto sensor = makeQuietDvl();
	const double longest = 81 * std::cos(noisyDvl().beam_angle), mounting = 0.11;
	TVehicleState state;
	state.T_map_body.translation().z() = kFloor - mounting - longest + 0.01;
	EXPECT_EQ(beamsLeft(asDvl(sensor.measure(state, kStart))), 4) << "just near enough";
	state.T_map_body.translation().z() -= 0.02;
	const auto o = sensor.measure(state, kStart + 1);
	EXPECT_EQ(beamsLeft(asDvl(o)), 0) << "just too far";
	EXPECT_FALSE(asDvl(o).velocity_valid || asDvl(o).altitude_valid);
}

TEST(SimulatedDvl, TiltLosesTheBeamsThatDoNotReachTheFloor)
{
	const Isometry3d T_body_dvl = noisyDvl().T_body_sensor();
	const Eigen::Matrix<double, 3, 4> beams = noisyDvl().beams();
	auto sensor = makeDvl({}), whole = makeDvl({});
	std::map<int, int> pings_with;
	for (int i = 0; i < 500; i++) {
		TVehicleState state = cruising();
		state.T_map_body.translation().z() = kFloor - 40;
		const double roll = 1.5 * std::sin(0.11 * i), pitch = 0.8 * std::sin(0.37 * i);
		state.T_map_body.linear() = rotationFromYawPitchRoll(0.05 * i, pitch, roll);
		const auto o = sensor.measure(state, kStart + i);
		const Isometry3d T_map_dvl = state.T_map_body * T_body_dvl;
		for (int k = 0; k < 4; k++) {
			const double slope = (T_map_dvl.linear() * beams.col(k)).z();
			const bool reaches = slope > 0 && (kFloor - T_map_dvl.translation().z()) / slope <= 81;
			EXPECT_EQ(!std::isnan(asDvl(o).beam_velocities[k]), reaches) << "ping " << i << " beam " << k;
		}
		EXPECT_EQ(asDvl(o).velocity_valid, beamsLeft(asDvl(o)) >= 3) << i;
		pings_with[beamsLeft(asDvl(o))]++;
	}
	for (const int left : {0, 1, 2, 3, 4})
		EXPECT_GT(pings_with[left], 5) << left << " beams: not tried";
}

TEST(SimulatedDvl, LosesItsLockForTheTimeStated)
{
	TSimulatedDvlOptions options;
	options.lock_loss_start = 3, options.lock_loss_duration = 2;
	CSimulatedDvl with = makeDvl(options), without = makeDvl({});
	for (int i = 0; i < 50; i++) {
		const double t = i / 5.0;
		const auto a = with.measure(cruising(), kStart + t), b = without.measure(cruising(), kStart + t);
		EXPECT_EQ(beamsLeft(asDvl(a)), i >= 15 && i < 25 ? 0 : 4) << "t = " << t;
		expectSurvivorsOf(asDvl(a), asDvl(b), "t = " + std::to_string(t));
	}
}
