#include <posidonia/nav/motion_model.h>
#include <posidonia/obs/frames.h>

#include <cmath>

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
/** A step seen from its beginning: attitude half way and at the end, acceleration in the axes of the
 * beginning. */
struct TStep
{
	Vector3d half_turn;
	Matrix3d E_half, E;	 ///< R_begin_half, R_begin_end
	Vector3d gravity;	 ///< Of the earth, axes of the beginning [m/s^2]
	Vector3d force;		 ///< Specific force without bias, axes of the beginning [m/s^2]
};
TStep stepOf(const TNavigationState& x, const TMotionInput& u)
{
	TStep s;
	s.half_turn =
		u.drive == EDrive::KINEMATIC ? Vector3d::Zero() : Vector3d((u.rate - x.gyro_bias) * (u.dt / 2));
	s.E_half = expSO3(s.half_turn);
	s.E = s.E_half * s.E_half;
	s.gravity = kGravity * x.R_odom_body.row(2).transpose();
	s.force = s.E_half * (u.force - x.accel_bias);
	return s;
}

double decay(double dt, const TGaussMarkov& process)
{
	return process.sigma > 0 ? std::exp(-dt / process.time) : 1;
}
double refill(double dt, const TGaussMarkov& process)
{
	const double kept = decay(dt, process);
	return process.sigma * process.sigma * (1 - kept * kept);
}
}  // namespace

TNavigationState propagated(const TNavigationState& x, const TMotionInput& u, const TMotionNoise& noise)
{
	const double dt = u.dt;
	const TStep s = stepOf(x, u);
	TNavigationState y = x;
	y.R_odom_body = x.R_odom_body * s.E;
	if (u.drive == EDrive::INERTIAL) {
		const Vector3d a = s.force + s.gravity;
		y.position += x.R_odom_body * (x.velocity * dt + a * (dt * dt / 2)) / (1 + x.dvl_scale);
		y.velocity = s.E.transpose() * (x.velocity + a * dt);
	}
	else
		// The velocity turns with the body: use the attitude half way.
		y.position += x.R_odom_body * (s.E_half * x.velocity) * (dt / (1 + x.dvl_scale));
	const auto keep = gaussMarkovDecay(dt, noise);
	y.ahrs_bias = keep.head<3>().cwiseProduct(x.ahrs_bias);
	y.gps_bias = keep.tail<2>().cwiseProduct(x.gps_bias);
	return y;
}

namespace
{
void inertialRows(MatrixDriven& F, const TNavigationState& x, const TStep& s, double dt)
{
	const Matrix3d& R = x.R_odom_body;
	const Matrix3d Et = s.E.transpose();
	// d force / d gyro bias: the half turn that the bias makes.
	const Matrix3d dforce = skew(s.force) * s.E_half * rightJacobianSO3(s.half_turn) * (dt / 2);
	const Vector3d velocity = Et * (x.velocity + (s.force + s.gravity) * dt);
	F.block<3, 3>(kPosition, kAttitude) = R * skew(x.velocity * dt + s.force * (dt * dt / 2)) * -1;
	F.block<3, 3>(kPosition, kVelocity) = R * dt;
	F.block<3, 1>(kPosition, kDvlScale) =
		R * (x.velocity * dt + (s.force + s.gravity) * (dt * dt / 2)) / -(1 + x.dvl_scale);
	F.block<3, 3>(kPosition, kGyroBias) = R * dforce * (dt * dt / 2);
	F.block<3, 3>(kPosition, kAccelBias) = R * s.E_half * (-dt * dt / 2);
	F.block<3, 3>(kVelocity, kAttitude) = Et * skew(s.gravity) * dt;
	F.block<3, 3>(kVelocity, kVelocity) = Et;
	F.block<3, 3>(kVelocity, kGyroBias) =
		Et * dforce * dt - skew(velocity) * rightJacobianSO3(2 * s.half_turn) * dt;
	F.block<3, 3>(kVelocity, kAccelBias) = Et * s.E_half * -dt;
}

void walkingRows(MatrixDriven& F, const TNavigationState& x, const TStep& s, double dt)
{
	const Matrix3d R_mid = x.R_odom_body * s.E_half;
	F.block<3, 3>(kPosition, kAttitude) = x.R_odom_body * skew(s.E_half * x.velocity) * -dt;
	F.block<3, 3>(kPosition, kVelocity) = R_mid * dt;
	F.block<3, 1>(kPosition, kDvlScale) = R_mid * x.velocity * (-dt / (1 + x.dvl_scale));
	F.block<3, 3>(kPosition, kGyroBias) =
		R_mid * skew(x.velocity) * rightJacobianSO3(s.half_turn) * (dt * dt / 2);
	F.block<3, 3>(kVelocity, kVelocity).setIdentity();
}
}  // namespace

MatrixDriven drivenJacobian(const TNavigationState& x, const TMotionInput& u)
{
	const TStep s = stepOf(x, u);
	MatrixDriven F = MatrixDriven::Zero();
	F.block<3, 3>(kPosition, kPosition).setIdentity();
	F.block<3, 3>(kAttitude, kAttitude) = s.E.transpose();
	F.block<3, 3>(kAttitude, kGyroBias) = rightJacobianSO3(2 * s.half_turn) * -u.dt;
	u.drive == EDrive::INERTIAL ? inertialRows(F, x, s, u.dt) : walkingRows(F, x, s, u.dt);
	// Metres of the DVL to those of the world.
	F.block<3, kDriving - 3>(kPosition, 3) /= 1 + x.dvl_scale;
	// Nothing is measured, so no bias takes part.
	if (u.drive == EDrive::KINEMATIC) F.middleCols<3>(kGyroBias).setZero();
	return F;
}

Eigen::Matrix<double, 5, 1> gaussMarkovDecay(double dt, const TMotionNoise& noise)
{
	const double tilt = decay(dt, noise.tilt_bias), heading = decay(dt, noise.heading_bias),
				 gps = decay(dt, noise.gps_bias);
	return (Eigen::Matrix<double, 5, 1>() << tilt, tilt, heading, gps, gps).finished();
}

namespace
{
/** A reading's white noise acts as a bias of the step does: density^2 / dt through the bias' columns. */
template <int COLUMN>
Eigen::Matrix<double, kDriven, kDriven> readingNoise(const MatrixDriven& F, double density, double dt)
{
	const Eigen::Matrix<double, kDriven, 3> G = F.middleCols<3>(COLUMN) * (density / std::sqrt(dt));
	return G.lazyProduct(G.transpose());
}

void addVelocityWalk(
	Eigen::Matrix<double, kDriven, kDriven>& Q, const Matrix3d& R_odom_body, double density, double dt)
{
	const double q = density * density;
	const Matrix3d cross = q * dt * dt / 2 * R_odom_body;
	Q.block<3, 3>(kPosition, kPosition).diagonal().array() += q * dt * dt * dt / 3;
	Q.block<3, 3>(kPosition, kVelocity) += cross;
	Q.block<3, 3>(kVelocity, kPosition) += cross.transpose();
	Q.block<3, 3>(kVelocity, kVelocity).diagonal().array() += q * dt;
}

/** The attitude walks and turns the velocity with it: exact moments of a walk over the step. */
void addTurnWalk(
	Eigen::Matrix<double, kDriven, kDriven>& Q, const TNavigationState& x, double density, double dt)
{
	const double q = density * density;
	const Matrix3d G = x.R_odom_body * skew(x.velocity) * -1;  // d position rate / d attitude
	Q.block<3, 3>(kAttitude, kAttitude).diagonal().array() += q * dt;
	Q.block<3, 3>(kPosition, kAttitude) += q * dt * dt / 2 * G;
	Q.block<3, 3>(kAttitude, kPosition) += q * dt * dt / 2 * G.transpose();
	Q.block<3, 3>(kPosition, kPosition) += q * dt * dt * dt / 3 * G * G.transpose();
}
}  // namespace

Eigen::Matrix<double, kDriven, kDriven> drivenNoise(
	const TNavigationState& x, const TMotionInput& u, const MatrixDriven& F, const TMotionNoise& noise)
{
	Eigen::Matrix<double, kDriven, kDriven> Q = Eigen::Matrix<double, kDriven, kDriven>::Zero();
	if (u.drive == EDrive::KINEMATIC)
		addTurnWalk(Q, x, noise.turn, u.dt);
	else
		Q += readingNoise<kGyroBias>(F, noise.gyro, u.dt);
	if (u.drive == EDrive::INERTIAL)
		Q += readingNoise<kAccelBias>(F, noise.accel, u.dt);
	else
		addVelocityWalk(Q, x.R_odom_body, noise.acceleration, u.dt);
	return Q;
}

Eigen::Matrix<double, kMovingSize - kDriven, 1> walkingNoise(double dt, const TMotionNoise& noise)
{
	Eigen::Matrix<double, kMovingSize - kDriven, 1> q;
	q.segment<3>(kGyroBias - kDriven).setConstant(noise.gyro_walk * noise.gyro_walk * dt);
	q.segment<3>(kAccelBias - kDriven).setConstant(noise.accel_walk * noise.accel_walk * dt);
	q[kDvlScale - kDriven] = 0;	 // a constant
	q[kPressureOffset - kDriven] = noise.offset_walk * noise.offset_walk * dt;
	q.segment<2>(kAhrsBias - kDriven).setConstant(refill(dt, noise.tilt_bias));
	q[kAhrsBias + 2 - kDriven] = refill(dt, noise.heading_bias);
	q.segment<2>(kGpsBias - kDriven).setConstant(refill(dt, noise.gps_bias));
	return q;
}
}  // namespace posidonia
