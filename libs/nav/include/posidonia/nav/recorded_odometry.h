#pragma once

#include <posidonia/base/options.h>
#include <posidonia/geometry/trajectory.h>
#include <posidonia/nav/odometry_source.h>

#include <deque>
#include <limits>

namespace posidonia
{
/** Section [RecordedOdometry]. */
struct TRecordedOdometryOptions
{
	std::string label{"ODOMETRY"};
	std::string covariance{"per_metre"};
	double sigma_translation{0.01};
	double sigma_rotation{0.005};
	double sigma_floor{0.001};
	double max_extrapolation{0.5};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.text("label", label, "sensorLabel of the CObservationRobotPose to follow");
		v.choice(
			"covariance", covariance, {"per_metre", "observation"},
			"per_metre: the sigmas below; observation: the two poses' own covariances, taken as independent");
		v.number(
			"sigma_translation", sigma_translation, above(0), "Grows with the root of the way [m/sqrt(m)]");
		v.number("sigma_rotation", sigma_rotation, above(0), "Grows with the root of the way [rad/sqrt(m)]");
		v.number(
			"sigma_floor", sigma_floor, above(0),
			"Added to each axis, so that a short edge has some [m, rad]");
		v.number(
			"max_extrapolation", max_extrapolation, atLeast(0), "Beyond the last pose, at its velocity [s]");
	}
};

/** Replays the poses of CObservationRobotPose with one label (robot poses: T_odom_body). The present is the
 * stamp of the newest such pose or stereo pair; a pair between two poses that have arrived gets the
 * interpolated pose, a later one the pose extrapolated at the last velocity for up to max_extrapolation, then
 * held. */
class CRecordedOdometry : public COdometrySource
{
   public:
	explicit CRecordedOdometry(const TRecordedOdometryOptions& options);

	void add(const mrpt::obs::CObservation& observation) override;
	bool ready() const override { return !m_history.empty(); }
	double stamp() const override { return m_stamp; }
	void clone() override;
	TPoseEstimate sinceClone() const override;
	TPoseEstimate now() const override;
	/** Between the last two poses; zero before the second. */
	TBodyMotion motion() const override;

	/** Poses dropped because their stamp was not after the last one, and pairs from before the history. */
	size_t late() const { return m_late; }
	/** Pairs further than max_extrapolation from the last pose. */
	size_t stale() const { return m_stale; }

   private:
	struct TRecord
	{
		double stamp;
		Eigen::Isometry3d T_odom_body;
		Matrix6d cov;
		double path;
	};
	void addPose(double t, const Eigen::Isometry3d& T, const Matrix6d& cov);
	void moveTo(double t);
	TRecord at(double t) const;
	Matrix6d perMetre(double path) const;

	TRecordedOdometryOptions m_options;
	std::deque<TRecord> m_history;
	double m_stamp{std::numeric_limits<double>::quiet_NaN()};
	TRecord m_now{}, m_clone{};
	bool m_started{false};
	size_t m_late{0}, m_stale{0};
};
}  // namespace posidonia
