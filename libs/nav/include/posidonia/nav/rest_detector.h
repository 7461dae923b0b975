#pragma once

#include <Eigen/Dense>

namespace posidonia
{
/** Is the vehicle at rest? It is when, over a window, neither gyro nor accelerometers show more than their
 * own white noise. Water never leaves a vehicle so still; a rack on deck does. */
class CRestDetector
{
   public:
	/** Sigmas of one reading's white noise: [rad/s], [m/s^2]. */
	CRestDetector(double sigma_rate, double sigma_force)
		: m_sigma_rate(sigma_rate), m_sigma_force(sigma_force)
	{
	}
	/** True at the end of a window in which the vehicle was at rest. */
	bool add(double stamp, const Eigen::Vector3d& rate, const Eigen::Vector3d& force);

   private:
	static constexpr double kWindow = 2;  ///< [s]
	bool still() const;
	double m_sigma_rate, m_sigma_force;
	double m_since{-1e300};
	int m_count{0};
	Eigen::Matrix<double, 6, 1> m_first, m_sum, m_squares;
};
}  // namespace posidonia
