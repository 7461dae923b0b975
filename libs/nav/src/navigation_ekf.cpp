#include <posidonia/nav/navigation_ekf.h>

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
/** Chi-square distribution function for 1, 2 or 3 degrees of freedom, closed forms. */
double chiSquareCdf(double x, unsigned dof)
{
	const double one = std::erf(std::sqrt(x / 2));
	if (dof == 1) return one;
	if (dof == 2) return 1 - std::exp(-x / 2);
	return one - std::sqrt(2 * x / M_PI) * std::exp(-x / 2);
}

/** Its quantile, by bisection: mrpt::math::chi2inv approximates, 2 to 3 % too high at 99.9 %. */
double chiSquareQuantile(double p, unsigned dof)
{
	double low = 0, high = 100;
	for (int i = 0; i < 60; i++)
		(chiSquareCdf((low + high) / 2, dof) < p ? low : high) = (low + high) / 2;
	return (low + high) / 2;
}

TMotionInput inputOf(const CNavigationEKF::KFArray_ACT& u)
{
	return {{u[0], u[1], u[2]}, u[3]};
}
}  // namespace

CNavigationEKF::CNavigationEKF(const TMotionNoise& noise, double gate_probability) : m_noise(noise)
{
	for (unsigned dof = 1; dof <= CMeasurement::kSize; dof++)
		m_gate[dof] = chiSquareQuantile(gate_probability, dof);
	m_gate[0] = 0;
	initialize({}, MatrixMoving::Identity());
}

void CNavigationEKF::initialize(const TNavigationState& x, const MatrixMoving& cov)
{
	m_nominal = m_nominal_next = x;
	m_xkk.setZero(kNavigationSize);
	m_pkk.setZero(kNavigationSize, kNavigationSize);
	P().topLeftCorner<kMovingSize, kMovingSize>() = cov;
	clone();
}

void CNavigationEKF::predict(const TMotionInput& u)
{
	m_input = u;
	m_nominal_next = propagated(m_nominal, u);
	m_measurement = nullptr;
	runOneKalmanIteration();
}

bool CNavigationEKF::update(const CMeasurement& measurement)
{
	fuse(measurement, true);
	return m_accepted;
}

void CNavigationEKF::updateUngated(const CMeasurement& measurement)
{
	fuse(measurement, false);
}

void CNavigationEKF::giveWay(const CMeasurement& measurement)
{
	const int row = measurement.block();
	const Matrix3d seen = measurement.jacobian(m_nominal).middleCols<3>(row);
	P().block<3, 3>(row, row) += innovation(measurement).squaredNorm() * seen.transpose() * seen;
	updateUngated(measurement);
}

void CNavigationEKF::fuse(const CMeasurement& measurement, bool gated)
{
	m_input.dt = 0;
	m_measurement = &measurement;
	m_gated = gated;
	runOneKalmanIteration();
	m_measurement = nullptr;
}

void CNavigationEKF::clone()
{
	m_nominal.clone_position = m_nominal.position;
	m_nominal.R_odom_clone = m_nominal.R_odom_body;
	m_nominal_next = m_nominal;
	// The clone's rows are those of position and attitude, which are the first six.
	auto cov = P();
	cov.block<6, kMovingSize>(kClonePosition, 0) = cov.block<6, kMovingSize>(0, 0).eval();
	cov.block<kNavigationSize, 6>(0, kClonePosition) = cov.block<kNavigationSize, 6>(0, 0).eval();
}

void CNavigationEKF::anchor(const CNavigationEKF& reference)
{
	const MatrixNav own = covariance(), other = reference.covariance();
	auto cov = P();
	cov.setZero();
	for (int r : {kPosition + 2, kVelocity + 0, kVelocity + 1, kVelocity + 2})
		for (int c : {kPosition + 2, kVelocity + 0, kVelocity + 1, kVelocity + 2})
			cov(r, c) = own(r, c);
	for (int r : {kAttitude, kGyroBias})
		for (int c : {kAttitude, kGyroBias})
			cov.block<3, 3>(r, c) = other.block<3, 3>(r, c);
	m_nominal.position.head<2>().setZero();
	m_nominal.R_odom_body = reference.m_nominal.R_odom_body;
	m_nominal.gyro_bias = reference.m_nominal.gyro_bias;
	clone();
}

MatrixNav CNavigationEKF::covariance() const
{
	return Eigen::Map<const Eigen::Matrix<double, kNavigationSize, kNavigationSize, Eigen::RowMajor>>(
		m_pkk.data());
}

TPoseEstimate CNavigationEKF::pose() const
{
	TPoseEstimate estimate;
	estimate.T = m_nominal.T_odom_body();
	Matrix6d J = Matrix6d::Identity();	// odom axes to the pose's own
	J.topLeftCorner<3, 3>() = m_nominal.R_odom_body.transpose();
	estimate.cov = J * covariance().topLeftCorner<6, 6>() * J.transpose();
	return estimate;
}

TPoseEstimate CNavigationEKF::sinceClone() const
{
	TPoseEstimate estimate;
	estimate.T = displacement(m_nominal);
	const auto J = displacementJacobian(m_nominal);
	const Matrix6d cov = J * covariance() * J.transpose();
	estimate.cov = 0.5 * (cov + cov.transpose());
	return estimate;
}

void CNavigationEKF::OnGetAction(KFArray_ACT& u) const
{
	for (int i = 0; i < 3; i++)
		u[i] = m_input.rate[i];
	u[3] = m_input.dt;
}

void CNavigationEKF::OnTransitionModel(const KFArray_ACT& u, KFArray_VEH& x, bool& skip) const
{
	const TMotionInput input = inputOf(u);
	const TNavigationState moved = propagated(retract(m_nominal, x.asEigen()), input);
	x.asEigen() = localCoordinates(propagated(m_nominal, input), moved);
	skip = input.dt == 0;
}

void CNavigationEKF::OnTransitionJacobian(KFMatrix_VxV& F) const
{
	F.asEigen().setIdentity();
	F.asEigen().topLeftCorner<kMovingSize, kMovingSize>() = transitionJacobian(m_nominal, m_input);
}

void CNavigationEKF::OnTransitionNoise(KFMatrix_VxV& Q) const
{
	Q.asEigen().setZero();
	Q.asEigen().topLeftCorner<kMovingSize, kMovingSize>() = transitionNoise(m_nominal, m_input, m_noise);
}

void CNavigationEKF::OnGetObservationNoise(KFMatrix_OxO& R) const
{
	R.asEigen() = m_measurement->noise();
}

void CNavigationEKF::OnGetObservationsAndDataAssociation(
	vector_KFArray_OBS& z, std::vector<int>& association, const vector_KFArray_OBS& predictions,
	const KFMatrix& S, const std::vector<size_t>&, const KFMatrix_OxO&)
{
	association.clear();
	const Vector3d innovation = m_measurement->value() - Vector3d(predictions[0].asEigen());
	const Matrix3d S3 = S.asEigen().topLeftCorner<3, 3>();
	m_last_distance = innovation.dot(S3.llt().solve(innovation));
	m_accepted = !m_gated || m_last_distance < m_gate[m_measurement->degreesOfFreedom()];
	z.clear();
	if (!m_accepted) return;
	z.emplace_back();
	z.back().asEigen() = m_measurement->value();
}

void CNavigationEKF::OnObservationModel(const std::vector<size_t>&, vector_KFArray_OBS& predictions) const
{
	predictions.clear();
	if (!m_measurement) return;
	predictions.emplace_back();
	predictions.back().asEigen() = m_measurement->predicted(m_nominal);
}

void CNavigationEKF::OnObservationJacobians(size_t, KFMatrix_OxV& Hx, KFMatrix_OxF&) const
{
	Hx.asEigen() = m_measurement->jacobian(m_nominal);
}

/** Moves the error into the nominal state and sets it to zero; after a prediction the nominal is the
 * predicted one. */
void CNavigationEKF::OnNormalizeStateVector()
{
	const VectorNav error = Eigen::Map<const VectorNav>(&m_xkk[0]);
	m_nominal = retract(m_nominal_next, error);
	m_nominal_next = m_nominal;
	m_xkk.fill(0);
	if (!m_measurement) return;
	resetCovariance(error.segment<3>(kAttitude), kAttitude);
	resetCovariance(error.segment<3>(kCloneAttitude), kCloneAttitude);
}

/** After the error e moved into R, what is left of it is seen from the new frame: G = Jr(e) (Sola 2017, eq.
 * 287). */
void CNavigationEKF::resetCovariance(const Vector3d& attitude_error, int rows)
{
	const Matrix3d G = rightJacobianSO3(attitude_error);
	auto cov = P();
	cov.middleRows<3>(rows) = (G * cov.middleRows<3>(rows)).eval();
	cov.middleCols<3>(rows) = (cov.middleCols<3>(rows) * G.transpose()).eval();
}
}  // namespace posidonia
