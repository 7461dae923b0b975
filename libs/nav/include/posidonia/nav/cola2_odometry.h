#pragma once

#include <posidonia/nav/cola2_ekf.h>
#include <posidonia/nav/odometry_source.h>
#include <posidonia/nav/pose_initializer.h>
#include <posidonia/nav/reading_decoder.h>

namespace posidonia
{
/** [Ekf] mode = cola2: the paper's own odometry. A CCola2EKF for the pose and a second one, of DVL alone, for
 * the edges; the attitude is the AHRS' last reading. Readings must come in order: late ones are dropped.
 * Covariances are those of that filter, which knows nothing of the attitude's errors but their white noise at
 * an edge's ends.
 */
class CCola2Odometry : public COdometrySource
{
   public:
	/** Throws CError when `sensors` has no AHRS. */
	CCola2Odometry(
		const TEkfOptions& options, const TInitialPoseOptions& start, const TSensorSuite& sensors,
		const TWorldOptions& datum);

	/** Throws CError near 90 degrees of pitch. */
	void add(const mrpt::obs::CObservation& observation) override;
	/** From the first attitude on (known pose), or after the fixes and the pressure as well. */
	bool ready() const override { return m_ready; }
	double stamp() const override { return m_stamp; }
	void clone() override;
	TPoseEstimate sinceClone() const override;
	TPoseEstimate now() const override;

	TBodyMotion motion() const override { return {m_nav.state().tail<3>(), m_rate}; }
	const CCola2EKF& navigationFilter() const { return m_nav; }
	TNavStatistics statistics() const;

   private:
	void take(const TSensorReading& reading);
	void apply(const TSensorReading& reading, const TTick&);
	void apply(const TSensorReading& reading, const TInertialReading& imu);
	void apply(const TSensorReading& reading, const TAttitudeReading& attitude);
	void apply(const TSensorReading& reading, const TDvlReading& dvl);
	void apply(const TSensorReading& reading, const TDepthReading& depth);
	void apply(const TSensorReading& reading, const TFixReading& fix);
	void apply(const TSensorReading&, const TCloneMark&) {}	 // nobody sends one

	void predictTo(double t);
	void startIfComplete();
	void fuse(const TCola2Measurement& measurement, bool increments, const TSensorReading& reading);
	/** Position of a sensor at `lever`: rows `first` to `first + rows` of it. */
	TCola2Measurement positionOf(
		const Eigen::Vector3d& z, int first, int rows, double sigma, const Eigen::Vector3d& lever) const;
	Eigen::Matrix3d attitudeCovariance(const Eigen::Matrix3d& R) const;
	const TNavigatorSetup::TSensor& specOf(const TSensorReading& reading) const
	{
		return m_setup->sensor[static_cast<size_t>(reading.sensor)];
	}
	TSensorCount& countOf(const TSensorReading& reading)
	{
		return m_counts[static_cast<size_t>(reading.sensor)];
	}

	std::shared_ptr<const TNavigatorSetup> m_setup;
	CReadingDecoder m_decoder;
	CCola2EKF m_nav, m_edge;
	CPoseInitializer m_initializer;
	std::vector<TSensorCount> m_counts;
	bool m_ready{false}, m_has_attitude{false};
	double m_stamp{std::numeric_limits<double>::quiet_NaN()};
	Eigen::Matrix3d m_R_map_body{Eigen::Matrix3d::Identity()}, m_R_map_clone{Eigen::Matrix3d::Identity()};
	Eigen::Vector3d m_rate{0, 0, 0};
	double m_path{0}, m_path_at_clone{0};
};
}  // namespace posidonia
