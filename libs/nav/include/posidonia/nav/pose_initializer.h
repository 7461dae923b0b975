#pragma once

#include <posidonia/nav/ekf_options.h>
#include <posidonia/nav/odometry_source.h>

namespace posidonia
{
/** Where the vehicle starts: the known pose at once, or from the mean of the first GPS fixes, the AHRS and
 * the pressure. */
class CPoseInitializer
{
   public:
	/** Levers of add...() run from a point on the body, `origin` from the same to the body's origin [m]. */
	explicit CPoseInitializer(
		const TInitialPoseOptions& options, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

	void addAttitude(const TAttitudeMeasurement& attitude);
	void addDepth(double depth, double sigma, const Eigen::Vector3d& lever);
	/** Counts once the attitude is known (its lever arm needs it). The mean supposes a vehicle nearly at
	 * rest; the fixes' spread beyond `sigma` widens the covariance where it is not. */
	void addFix(double stamp, const Eigen::Vector2d& north_east, double sigma, const Eigen::Vector3d& lever);

	bool complete() const;
	/** T_map_body with covariance over (rho, phi); only when complete(). */
	TPoseEstimate pose() const;

   private:
	TPoseEstimate knownPose() const;
	TPoseEstimate measuredPose() const;

	TInitialPoseOptions m_options;
	Eigen::Vector3d m_origin;
	std::optional<TAttitudeMeasurement> m_attitude;
	std::optional<TScalarMeasurement> m_depth;
	Eigen::Vector3d m_depth_lever{0, 0, 0};
	int m_fixes{0};
	double m_last_fix{0}, m_fix_sigma{0};
	Eigen::Vector2d m_sum{0, 0}, m_sum_squares{0, 0};
};
}  // namespace posidonia
