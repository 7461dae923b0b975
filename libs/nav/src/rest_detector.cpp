#include <posidonia/nav/rest_detector.h>

namespace posidonia
{
bool CRestDetector::add(double stamp, const Eigen::Vector3d& rate, const Eigen::Vector3d& force)
{
	Eigen::Matrix<double, 6, 1> reading;
	reading << rate, force;
	const bool full = stamp - m_since >= kWindow, at_rest = full && still();
	if (full) {
		m_since = stamp;
		m_count = 0;
		m_first = reading;
		m_sum.setZero();
		m_squares.setZero();
	}
	reading -= m_first;	 // small numbers keep their digits
	m_count++;
	m_sum += reading;
	m_squares += reading.cwiseAbs2();
	return at_rest;
}

bool CRestDetector::still() const
{
	constexpr int kEnough = 20;		 // readings
	constexpr double kMargin = 1.5;	 // of a sigma: beyond any chance with that many
	if (m_count < kEnough) return false;
	const Eigen::Matrix<double, 6, 1> mean = m_sum / m_count,
									  variance = m_squares / m_count - mean.cwiseAbs2();
	const double rate = kMargin * m_sigma_rate, force = kMargin * m_sigma_force;
	return variance.head<3>().maxCoeff() < rate * rate && variance.tail<3>().maxCoeff() < force * force;
}
}  // namespace posidonia
