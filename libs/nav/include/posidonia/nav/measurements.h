#pragma once

#include <posidonia/nav/navigation_state.h>

/** What a sensor says about the state: z = h(x) + noise, up to three rows. One class a kind of sensor. */
namespace posidonia
{
/** Rows beyond rows() are padding: z and h are 0, the derivative is 0, the noise is 1, so they change
 * nothing. */
class CMeasurement
{
   public:
	static constexpr int kSize = 3;
	using Jacobian = Eigen::Matrix<double, kSize, kNavigationSize>;

	virtual ~CMeasurement() = default;
	/** Degrees of freedom of the innovation, for the gate. */
	virtual int degreesOfFreedom() const = 0;
	virtual Eigen::Vector3d predicted(const TNavigationState& x) const = 0;
	virtual Jacobian jacobian(const TNavigationState& x) const = 0;
	/** First of the three rows of the state that the sensor is there for. */
	virtual ENavigationRow block() const = 0;
	const Eigen::Vector3d& value() const { return m_z; }
	const Eigen::Matrix3d& noise() const { return m_noise; }

   protected:
	CMeasurement(const Eigen::Vector3d& z, const Eigen::Matrix3d& noise) : m_z(z), m_noise(noise) {}

   private:
	Eigen::Vector3d m_z;
	Eigen::Matrix3d m_noise;
};

/** The body's rate as a gyro reads it now, with the variance of one reading's axis. */
struct TBodyRate
{
	Eigen::Vector3d rate{0, 0, 0};	///< Body axes, bias included [rad/s]
	double variance{0};				///< [rad^2/s^2]
};

/** Velocity over ground in the instrument's frame: z = R_dvl_body (v + (w - b) x lever). */
class CDvlMeasurement : public CMeasurement
{
   public:
	CDvlMeasurement(
		const Eigen::Vector3d& velocity, const Eigen::Matrix3d& cov, const Eigen::Isometry3d& T_body_dvl,
		const TBodyRate& rate);
	int degreesOfFreedom() const override { return 3; }
	Eigen::Vector3d predicted(const TNavigationState& x) const override;
	Jacobian jacobian(const TNavigationState& x) const override;
	ENavigationRow block() const override { return kVelocity; }

   private:
	Eigen::Matrix3d m_R_dvl_body;
	Eigen::Vector3d m_lever, m_rate;
};

/** Depth of a sensor at `lever` on the body: z = down of (p + R lever). */
class CDepthMeasurement : public CMeasurement
{
   public:
	CDepthMeasurement(double depth, double sigma, const Eigen::Vector3d& lever);
	int degreesOfFreedom() const override { return 1; }
	Eigen::Vector3d predicted(const TNavigationState& x) const override;
	Jacobian jacobian(const TNavigationState& x) const override;
	ENavigationRow block() const override { return kPosition; }

   private:
	Eigen::Vector3d m_lever;
};

/** North and east of an antenna at `lever` on the body. */
class CHorizontalMeasurement : public CMeasurement
{
   public:
	CHorizontalMeasurement(const Eigen::Vector2d& north_east, double sigma, const Eigen::Vector3d& lever);
	int degreesOfFreedom() const override { return 2; }
	Eigen::Vector3d predicted(const TNavigationState& x) const override;
	Jacobian jacobian(const TNavigationState& x) const override;
	ENavigationRow block() const override { return kPosition; }

   private:
	Eigen::Vector3d m_lever;
};

/** Roll, pitch and heading together: 0 = Log(R_measured^T R) + noise. */
class CAttitudeMeasurement : public CMeasurement
{
   public:
	CAttitudeMeasurement(const Eigen::Matrix3d& R_map_body, double sigma_roll_pitch, double sigma_heading);
	int degreesOfFreedom() const override { return 3; }
	Eigen::Vector3d predicted(const TNavigationState& x) const override;
	Jacobian jacobian(const TNavigationState& x) const override;
	ENavigationRow block() const override { return kAttitude; }

   private:
	Eigen::Matrix3d m_R_map_body;
};

/** Roll and pitch alone: the direction of down in body axes, z = R^T (0, 0, 1). */
class CGravityMeasurement : public CMeasurement
{
   public:
	CGravityMeasurement(const Eigen::Matrix3d& R_map_body, double sigma_roll_pitch);
	int degreesOfFreedom() const override { return 2; }
	Eigen::Vector3d predicted(const TNavigationState& x) const override;
	Jacobian jacobian(const TNavigationState& x) const override;
	ENavigationRow block() const override { return kAttitude; }
};

/** Covariance in body axes of an attitude error given by sigmas about map axes. */
Eigen::Matrix3d attitudeNoise(
	const Eigen::Matrix3d& R_map_body, double sigma_roll_pitch, double sigma_heading);
}  // namespace posidonia
