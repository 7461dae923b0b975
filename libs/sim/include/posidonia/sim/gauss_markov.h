#pragma once

#include <posidonia/sim/random.h>

#include <cmath>

namespace posidonia
{
/** N independent first-order Gauss-Markov processes, dx = -x / T dt + dw, stationary with standard deviations
 * `sigma` from the first value on and autocorrelation exp(-|dt| / T). Sampled exactly, each `step`:
 *
 *   x' = phi x + n,   phi = exp(-step / T),   sigma(n)^2 = sigma^2 (1 - phi^2)
 *
 * (Gelb 1974, Applied Optimal Estimation, sec. 3.8). */
template <int N>
class CGaussMarkov
{
   public:
	using vector_t = Eigen::Matrix<double, N, 1>;

	/** T = `correlation_time` [s] > 0, `step` [s] > 0. */
	CGaussMarkov(const vector_t& sigma, double correlation_time, double step, uint64_t seed)
		: m_noise(seed),
		  m_phi(std::exp(-step / correlation_time)),
		  m_sigma_step(sigma * std::sqrt(-std::expm1(-2 * step / correlation_time))),
		  m_value(sigma.cwiseProduct(m_noise.template normals<N>()))
	{
	}
	const vector_t& value() const { return m_value; }
	/** One step on. */
	void advance() { m_value = m_phi * m_value + m_sigma_step.cwiseProduct(m_noise.template normals<N>()); }

   private:
	CNoise m_noise;
	double m_phi;
	vector_t m_sigma_step, m_value;
};
}  // namespace posidonia
