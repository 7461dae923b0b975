#include <posidonia/base/chi_square.h>
#include <posidonia/base/error.h>
#include <posidonia/geometry/se3.h>
#include <posidonia/nav/cola2_ekf.h>
#include <posidonia/nav/kalman_steps.h>

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

CCola2EKF::CCola2EKF(double acceleration_density, double gate_probability, EIteration iteration)
	: m_acceleration_density(acceleration_density), m_iteration(iteration)
{
	m_gate[0] = 0;
	for (int dof = 1; dof <= 3; dof++)
		m_gate[dof] = chiSquareQuantile(gate_probability, dof);
	initialize(Vector6::Zero(), Matrix6::Identity());
}

void CCola2EKF::initialize(const Vector6& x, const Matrix6& cov)
{
	m_xkk.setZero(6);
	m_xkk.asEigen() = x;
	m_pkk.setZero(6, 6);
	m_pkk.asEigen() = cov;
}

void CCola2EKF::predict(const Matrix3d& R_map_body, double dt)
{
	const Vector3d ypr = yawPitchRoll(R_map_body);
	constexpr double kEnd = 85 * M_PI / 180;
	if (!(std::abs(ypr[1]) < kEnd))
		throw CError(
			"[Ekf] mode = cola2",
			"the pitch is " + std::to_string(ypr[1] * 180 / M_PI) +
				" deg, and yaw and roll, by which this mode knows the attitude, end at 90",
			"use mode = ins, which has no such end");
	for (int i = 0; i < 3; i++)
		m_yaw_pitch_roll[i] = ypr[i];
	m_dt = dt;
	m_measured = false;
	iterate();
}

bool CCola2EKF::update(const TCola2Measurement& measurement)
{
	const Matrix3d S = measurement.H * covariance() * measurement.H.transpose() + measurement.noise;
	const Vector3d innovation = measurement.z - measurement.H * state() - measurement.offset;
	if (innovation.dot(S.llt().solve(innovation)) > m_gate[measurement.rows]) return false;
	updateUngated(measurement);
	return true;
}

void CCola2EKF::updateUngated(const TCola2Measurement& measurement)
{
	m_dt = 0;
	m_measured = true;
	m_measurement = measurement;
	iterate();
}

CCola2EKF::Vector6 CCola2EKF::state() const
{
	return m_xkk.asEigen();
}
CCola2EKF::Matrix6 CCola2EKF::covariance() const
{
	return m_pkk.asEigen();
}

void CCola2EKF::anchor()
{
	Vector6 x = state();
	x.head<3>().setZero();
	Matrix6 P = Matrix6::Zero();
	P.bottomRightCorner<3, 3>() = covariance().bottomRightCorner<3, 3>();
	initialize(x, P);
}

void CCola2EKF::OnGetAction(KFArray_ACT& u) const
{
	for (int i = 0; i < 3; i++)
		u[i] = m_yaw_pitch_roll[i];
	u[3] = m_dt;
}

void CCola2EKF::OnTransitionModel(const KFArray_ACT& u, KFArray_VEH& x, bool& skip) const
{
	const Vector3d step = rotationFromYawPitchRoll(u[0], u[1], u[2]) * Vector3d(x[3], x[4], x[5]) * u[3];
	for (int i = 0; i < 3; i++)
		x[i] += step[i];
	skip = u[3] == 0;
}

void CCola2EKF::OnTransitionJacobian(KFMatrix_VxV& F) const
{
	F.asEigen().setIdentity();
	F.asEigen().topRightCorner<3, 3>() =
		m_dt * rotationFromYawPitchRoll(m_yaw_pitch_roll[0], m_yaw_pitch_roll[1], m_yaw_pitch_roll[2]);
}

/** W diag(q) W^T with W = (R dt^2 / 2; I dt), and q such that the walk does not depend on the rate of steps.
 */
void CCola2EKF::OnTransitionNoise(KFMatrix_VxV& Q) const
{
	const double q = m_acceleration_density * m_acceleration_density / m_dt;
	Eigen::Matrix<double, 6, 3> W;
	W.topRows<3>() = m_dt * m_dt / 2 *
					 rotationFromYawPitchRoll(m_yaw_pitch_roll[0], m_yaw_pitch_roll[1], m_yaw_pitch_roll[2]);
	W.bottomRows<3>() = m_dt * Matrix3d::Identity();
	Q.asEigen() = q * W * W.transpose();
}

void CCola2EKF::OnGetObservationNoise(KFMatrix_OxO& R) const
{
	R.asEigen() = m_measurement.noise;
}

void CCola2EKF::OnGetObservationsAndDataAssociation(
	vector_KFArray_OBS& z, std::vector<int>& association, const vector_KFArray_OBS&, const KFMatrix&,
	const std::vector<size_t>&, const KFMatrix_OxO&)
{
	association.clear();
	z.clear();
	if (!m_measured) return;
	z.emplace_back();
	z.back().asEigen() = m_measurement.z;
}

void CCola2EKF::OnObservationModel(const std::vector<size_t>&, vector_KFArray_OBS& predictions) const
{
	predictions.resize(1);	// the stock iteration leaves it empty where there are no landmarks
	predictions[0].asEigen() = m_measurement.H * state() + m_measurement.offset;
}

void CCola2EKF::OnObservationJacobians(size_t, KFMatrix_OxV& Hx, KFMatrix_OxF&) const
{
	Hx.asEigen() = m_measurement.H;
}

void CCola2EKF::runOwnIteration()
{
	Matrix6 P = covariance();
	KFArray_ACT u;
	OnGetAction(u);
	KFArray_VEH x;
	x.asEigen() = state();
	bool skip = false;
	OnTransitionModel(u, x, skip);
	if (!skip) {
		KFMatrix_VxV F, Q;
		OnTransitionJacobian(F);
		OnTransitionNoise(Q);
		const Matrix6 FP = F.asEigen() * P;
		P = FP * F.asEigen().transpose() + Q.asEigen();
		m_xkk.asEigen() = x.asEigen();
	}
	if (m_measured) {
		const TInnovationCovariance<6, 3> c(P, m_measurement.H, m_measurement.noise);
		const auto K = c.gain();
		m_xkk.asEigen() += K * (m_measurement.z - m_measurement.H * state() - m_measurement.offset);
		josephUpdate(P, K, c);
	}
	m_pkk.asEigen() = P;
}
}  // namespace posidonia
