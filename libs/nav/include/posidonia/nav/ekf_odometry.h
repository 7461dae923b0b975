#pragma once

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <posidonia/nav/ekf_options.h>
#include <posidonia/nav/nav_statistics.h>
#include <posidonia/nav/navigation_ekf.h>
#include <posidonia/nav/pose_initializer.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/CObservationPressure.h>
#include <posidonia/obs/geodesy.h>
#include <posidonia/obs/sensor_suite.h>

namespace posidonia
{
/** Odometry from gyro, DVL, pressure, AHRS and GPS. Two filters: the navigation filter fuses everything and
 * gives now(); the edge filter fuses gyro, DVL and pressure only and gives sinceClone(). See README. */
class CEkfOdometry : public COdometrySource
{
   public:
	/** Throws CError when `sensors` has no gyro. The first gyro by label drives the filters, others stay
	 * idle. */
	CEkfOdometry(
		const TEkfOptions& options, const TInitialPoseOptions& start, const TSensorSuite& sensors,
		const TWorldOptions& datum);

	void add(const mrpt::obs::CObservation& observation) override;
	/** From the first gyro reading on (known pose), or after the fixes, the AHRS and the pressure as well. */
	bool ready() const override { return m_ready; }
	double stamp() const override { return m_stamp; }
	void clone() override;
	TPoseEstimate sinceClone() const override;
	TPoseEstimate now() const override;
	TUnaryMeasurements unary() const override;

	/** Velocity over ground in body axes [m/s] and rate without bias [rad/s], for controllers. */
	Eigen::Vector3d velocity() const { return m_nav.state().velocity; }
	Eigen::Vector3d rate() const { return m_rate.rate - m_nav.state().gyro_bias; }
	const CNavigationEKF& navigationFilter() const { return m_nav; }
	const CNavigationEKF& edgeFilter() const { return m_edge; }
	const TNavStatistics& statistics() const { return m_statistics; }

   private:
	/** A reading kept for unary(): with the pose it was taken at. */
	struct TReading
	{
		double stamp{-std::numeric_limits<double>::infinity()};
		Eigen::Isometry3d T_dr_body{Eigen::Isometry3d::Identity()};
		Eigen::Matrix3d R_map_body{Eigen::Matrix3d::Identity()};
	};

	void addImu(const mrpt::obs::CObservationIMU& imu, double t);
	void addRate(const mrpt::obs::CObservationIMU& imu, double t, TSensorCount& count);
	void addAttitude(const mrpt::obs::CObservationIMU& imu, double t, TSensorCount& count);
	void addDvl(const CObservationDVL& dvl, double t);
	void addPressure(const CObservationPressure& pressure, double t);
	void addGps(const mrpt::obs::CObservationGPS& gps, double t);

	bool isLate(double t, TSensorCount& count) const;
	void predictTo(double t, const Eigen::Vector3d& rate);
	void startIfComplete();
	/** Fuses and counts; an increments' sensor goes to the edge filter too. False: refused. */
	bool fuse(const CMeasurement& measurement, bool increments, TSensorCount& count);
	/** Has the sensor contradicted the filter steadily for too long? Called at each refusal. */
	bool isContradictedForTooLong(const CMeasurement& refused, const TSensorCount& count);
	TReading reading(double t) const;
	Eigen::Isometry3d T_dr_body() const;
	bool isFresh(const TReading& r) const;
	/** Variance that the present attitude's uncertainty gives R lever, each map axis [m^2]. */
	Eigen::Vector3d leverVariance(const Eigen::Vector3d& lever) const;

	TEkfOptions m_options;
	TSensorSuite m_sensors;
	TWorldOptions m_datum;
	std::string m_gyro_label;
	CNavigationEKF m_nav, m_edge;
	CPoseInitializer m_initializer;
	TNavStatistics m_statistics;
	/** A sensor's refusals in a row that agree with each other. */
	struct TContradiction
	{
		int count{0};
		double since{0};  ///< Stamp of the first [s]
		Eigen::Vector3d innovation{0, 0, 0};
	};
	std::map<const TSensorCount*, TContradiction> m_contradictions;

	bool m_ready{false}, m_has_rate{false};
	double m_stamp{std::numeric_limits<double>::quiet_NaN()};
	TBodyRate m_rate;
	double m_path{0}, m_path_at_clone{0};
	double m_clone_stamp{-std::numeric_limits<double>::infinity()};
	double m_previous_clone_stamp{-std::numeric_limits<double>::infinity()};
	Eigen::Isometry3d m_T_dr_clone{Eigen::Isometry3d::Identity()};	///< Edges composed: dead reckoning

	struct : TReading
	{
		TScalarMeasurement body_depth;
	} m_last_depth;
	struct : TReading
	{
		TAttitudeMeasurement attitude;
	} m_last_attitude;
	struct : TReading
	{
		THorizontalMeasurement body_position;
	} m_last_fix;
};
}  // namespace posidonia
