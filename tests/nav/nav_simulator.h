#pragma once

#include <mrpt/obs/CObservationGPS.h>
#include <posidonia/nav/ekf_odometry.h>
#include <posidonia/obs/frames.h>
#include <posidonia/obs/observations.h>

#include <functional>
#include <memory>
#include <random>

namespace posidonia::testing
{
inline constexpr double kT0 = 1.6e9;  ///< Stamp of the simulation's start [s]

struct TNavTruth
{
	double t{0};  ///< [s] since the start
	Eigen::Isometry3d T_map_body{Eigen::Isometry3d::Identity()};
	Eigen::Vector3d velocity{0, 0, 0}, rate{0, 0, 0};  ///< Body axes
};

struct TNavScene
{
	TSensorSuite sensors{TSensorSuite::sparus2()};
	TWorldOptions datum;
	double duration{60};
	unsigned seed{1};
	/** Random walk of the body velocity, for mode = gyro: the accelerometers don't tell of it. */
	double acceleration_density{0};
	Eigen::Vector3d velocity{0.3, 0, 0};  ///< At the start
	Eigen::Isometry3d start{Eigen::Isometry3d::Identity()};
	Eigen::Vector3d gyro_bias{0, 0, 0}, accel_bias{0, 0, 0};  ///< At the start
	double dvl_scale{0};									  ///< Measured / true - 1
	double gps_until{0};									  ///< Fixes up to this time [s]
	double noise{1};										  ///< Scale of every sensor's noise
	/** Body rate at a time; default: a vehicle that sways and turns. */
	std::function<Eigen::Vector3d(double)> rate = [](double t) {
		return Eigen::Vector3d(0.05 * std::sin(1.3 * t), 0.04 * std::cos(0.9 * t), 0.15 * std::sin(0.2 * t));
	};
};

/** IMU 50 Hz, AHRS 20 Hz, DVL and pressure 5 Hz, GPS 1 Hz, stereo 2.5 Hz, all with the noise of sensors.ini.
 */
class CNavSimulator
{
   public:
	using Sink = std::function<void(const mrpt::obs::CObservation&, const TNavTruth&)>;

	explicit CNavSimulator(const TNavScene& scene) : m_scene(scene), m_rng(scene.seed)
	{
		m_truth.T_map_body = scene.start;
		m_truth.velocity = scene.velocity;
		m_bias = scene.gyro_bias;
		m_accel_bias = scene.accel_bias;
	}

	void run(const Sink& sink)
	{
		const int ticks = static_cast<int>(std::lround(m_scene.duration / kTick));
		for (int k = 0; k <= ticks; k++) {
			m_truth.t = k * kTick;
			m_truth.rate = m_scene.rate(m_truth.t);
			emit(k, sink);
			step();
		}
	}

   private:
	static constexpr double kTick = 0.01;

	double normal() { return m_scene.noise * m_normal(m_rng); }
	Eigen::Vector3d normal3()
	{
		const double x = normal(), y = normal(), z = normal();
		return {x, y, z};
	}

	void emit(int k, const Sink& sink)
	{
		if (k % 2 == 0) sink(*imu(), m_truth);
		if (k % 5 == 1) sink(*ahrs(), m_truth);
		if (k % 20 == 3) sink(*dvl(), m_truth);
		if (k % 20 == 7) sink(*pressure(), m_truth);
		if (k % 100 == 9 && m_truth.t < m_scene.gps_until) sink(*gps(), m_truth);
		if (k % 40 == 11) sink(*stereo(), m_truth);
	}

	/** Four midpoint steps; the velocity's random walk is drawn at each. */
	void step()
	{
		constexpr int kParts = 4;
		const double dt = kTick / kParts;
		for (int i = 0; i < kParts; i++) {
			const Eigen::Vector3d w = m_scene.rate(m_truth.t + (i + 0.5) * dt);
			const Eigen::Vector3d kick = m_scene.acceleration_density * std::sqrt(dt) * walk();
			m_truth.T_map_body.translation() +=
				m_truth.T_map_body.linear() * expSO3(w * dt / 2) * (m_truth.velocity + kick / 2) * dt;
			m_truth.T_map_body.linear() = m_truth.T_map_body.linear() * expSO3(w * dt);
			m_truth.velocity += kick;
		}
		m_bias += gyro().gyro_random_walk * std::sqrt(kTick) * normal3();
		m_accel_bias += gyro().accel_random_walk * std::sqrt(kTick) * normal3();
	}
	Eigen::Vector3d walk()
	{
		const double x = m_normal(m_rng), y = m_normal(m_rng), z = m_normal(m_rng);
		return {x, y, z};
	}

	const TImuSpec& gyro() const { return m_scene.sensors.imu.begin()->second; }
	double stamp() const { return kT0 + m_truth.t; }
	template <class SPEC>
	Eigen::Vector3d sensorPosition(const SPEC& spec) const
	{
		return m_truth.T_map_body * spec.T_body_sensor().translation();
	}

	/** Specific force at `lever`, body axes, of a body velocity that is constant but for its walk. */
	Eigen::Vector3d trueForce(const Eigen::Vector3d& lever) const
	{
		constexpr double h = 1e-4;
		const Eigen::Vector3d w = m_truth.rate,
							  alpha = (m_scene.rate(m_truth.t + h) - m_scene.rate(m_truth.t - h)) / (2 * h);
		return w.cross(m_truth.velocity) - kGravity * m_truth.T_map_body.linear().row(2).transpose() +
			   alpha.cross(lever) + w.cross(w.cross(lever));
	}

	mrpt::obs::CObservation::Ptr imu()
	{
		const auto& [label, spec] = *m_scene.sensors.imu.begin();
		const Eigen::Isometry3d T = spec.T_body_sensor();
		const Eigen::Vector3d noise = spec.gyro_noise_density * std::sqrt(spec.rate) * normal3();
		TImuReading reading;
		reading.rate = T.linear().transpose() * (m_truth.rate + m_bias + noise);
		const Eigen::Vector3d force_noise = spec.accel_noise_density * std::sqrt(spec.rate) * normal3();
		reading.force = T.linear().transpose() * (trueForce(T.translation()) + m_accel_bias + force_noise);
		return makeImu(label, stamp(), T, reading);
	}
	mrpt::obs::CObservation::Ptr ahrs()
	{
		const auto& [label, spec] = *m_scene.sensors.ahrs.begin();
		const Eigen::Vector3d e = normal3().cwiseProduct(
			Eigen::Vector3d(spec.sigma_roll_pitch, spec.sigma_roll_pitch, spec.sigma_heading));
		const Eigen::Isometry3d T = spec.T_body_sensor();
		return makeAhrs(label, stamp(), T, expSO3(e) * m_truth.T_map_body.linear() * T.linear());
	}
	mrpt::obs::CObservation::Ptr dvl()
	{
		const auto& [label, spec] = *m_scene.sensors.dvl.begin();
		const Eigen::Isometry3d T = spec.T_body_sensor();
		const Eigen::Vector3d v = (1 + m_scene.dvl_scale) * T.linear().transpose() *
									  (m_truth.velocity + m_truth.rate.cross(T.translation())) +
								  normal3().cwiseProduct(Eigen::Vector3d(
									  spec.sigma_velocity, spec.sigma_velocity, spec.sigmaAlong()));
		auto o = std::make_shared<CObservationDVL>();
		o->sensorLabel = label;
		o->timestamp = stampFrom(stamp());
		o->velocity = {v.x(), v.y(), v.z()};
		o->velocity_valid = true;
		o->velocity_covariance.setZero();
		return o;
	}
	mrpt::obs::CObservation::Ptr pressure()
	{
		const auto& [label, spec] = *m_scene.sensors.pressure.begin();
		auto o = std::make_shared<CObservationPressure>();
		o->sensorLabel = label;
		o->timestamp = stampFrom(stamp());
		o->pressure = spec.pressureAt(sensorPosition(spec).z()) + spec.sigma * normal();
		return o;
	}
	mrpt::obs::CObservation::Ptr gps()
	{
		const auto& [label, spec] = *m_scene.sensors.gps.begin();
		const double north = spec.sigma_horizontal * normal(), east = spec.sigma_horizontal * normal();
		const TGeodetic g =
			geodeticFromNed(sensorPosition(spec) + Eigen::Vector3d(north, east, 0), m_scene.datum);
		mrpt::obs::gnss::Message_NMEA_GGA gga;
		gga.fields.latitude_degrees = g.latitude;
		gga.fields.longitude_degrees = g.longitude;
		gga.fields.fix_quality = 1;
		auto o = mrpt::obs::CObservationGPS::Create();
		o->sensorLabel = label;
		o->timestamp = stampFrom(stamp());
		o->setMsg(gga);
		return o;
	}
	mrpt::obs::CObservation::Ptr stereo()
	{
		auto o = mrpt::obs::CObservationStereoImages::Create();
		o->sensorLabel = "STEREO";
		o->timestamp = stampFrom(stamp());
		return o;
	}

	TNavScene m_scene;
	std::mt19937 m_rng;
	std::normal_distribution<double> m_normal;
	TNavTruth m_truth;
	Eigen::Vector3d m_bias{0, 0, 0}, m_accel_bias{0, 0, 0};
};

/** Start options that say the scene's start with the given sigmas (the truth is drawn elsewhere). */
inline TInitialPoseOptions knownStart(const Eigen::Isometry3d& T)
{
	TInitialPoseOptions o;
	const Eigen::Vector3d ypr = yawPitchRoll(T.linear());
	o.position = {T.translation().x(), T.translation().y(), T.translation().z()};
	o.yaw = ypr[0], o.pitch = ypr[1], o.roll = ypr[2];
	return o;
}

/** e^T cov^-1 e of an estimate against the truth. */
inline double nees(const TPoseEstimate& estimate, const Eigen::Isometry3d& truth)
{
	const Vector6d e = localCoordinates(estimate.T, truth);
	return e.dot(estimate.cov.ldlt().solve(e));
}
}  // namespace posidonia::testing
