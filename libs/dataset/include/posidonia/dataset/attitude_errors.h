#pragma once

#include <Eigen/Dense>
#include <random>

namespace posidonia
{
/** Errors put on a logged attitude, to try filters with a poorer AHRS than the log's. */
struct TAttitudeErrors
{
	double noise{0};		///< White, of roll, pitch and heading each [rad]
	double bias{0};			///< Slow: Gauss-Markov about north, east and down each, stationary sigma [rad]
	double bias_time{600};	///< Its correlation time [s]
	unsigned seed{1};
};

/** Degrades attitudes one after the other:
 *
 *   R' = Exp(b) Rz(yaw + n_1) Ry(pitch + n_2) Rx(roll + n_3),   n ~ N(0, noise^2)
 *   b_0 ~ N(0, bias^2 I),   b_k = a b_{k-1} + sqrt(1 - a^2) N(0, bias^2 I),   a = exp(-dt / bias_time)
 *
 * so that b is stationary from the first attitude on. The same numbers are drawn whatever the sigmas are:
 * for one seed the noise does not change when the bias is switched off. */
class CAttitudeErrors
{
   public:
	explicit CAttitudeErrors(const TAttitudeErrors& errors);

	/** The attitude with errors. `stamp` [s] must not go backwards. With sigmas of 0: `R_map_body` itself. */
	Eigen::Matrix3d degraded(double stamp, const Eigen::Matrix3d& R_map_body);
	/** The slow error of the last attitude, a rotation vector in map axes [rad]. */
	Eigen::Vector3d bias() const { return m_errors.bias * m_unit_bias; }

   private:
	Eigen::Vector3d normal3();
	void advanceBias(double stamp);

	TAttitudeErrors m_errors;
	std::mt19937_64 m_generator;
	std::normal_distribution<double> m_normal;
	bool m_started{false};
	double m_stamp{0};
	Eigen::Vector3d m_unit_bias{0, 0, 0};  ///< Of sigma 1
};
}  // namespace posidonia
