#pragma once

#include <posidonia/nav/navigation_state.h>

/** What a sensor says about the state: z = h(x) + noise, up to four rows. One class a kind of sensor. Levers
 * run from the navigated point to the sensor, in body axes [m]. */
namespace posidonia
{
/** Rows beyond degreesOfFreedom() are padding: z and h are 0, the derivative is 0, the noise is 1, so they
 * change nothing. (CGravityMeasurement has a row more than it has degrees of freedom.) */
class CMeasurement
{
   public:
	static constexpr int kSize = 4;
	using Value = Eigen::Matrix<double, kSize, 1>;
	using Noise = Eigen::Matrix<double, kSize, kSize>;
	using Jacobian = Eigen::Matrix<double, kSize, kNavigationSize>;

	virtual ~CMeasurement() = default;
	/** Degrees of freedom of the innovation, for the gate. */
	virtual int degreesOfFreedom() const = 0;
	virtual Value predicted(const TNavigationState& x) const = 0;
	virtual Jacobian jacobian(const TNavigationState& x) const = 0;
	/** First of the three rows of the state that the sensor is there for. */
	virtual ENavigationRow block() const = 0;
	const Value& value() const { return m_z; }
	const Noise& noise() const { return m_noise; }

   protected:
	CMeasurement(const Value& z, const Noise& noise) : m_z(z), m_noise(noise) {}

   private:
	Value m_z;
	Noise m_noise;
};

/** The body's rate as a gyro reads it now, with the variance of one reading's axis. */
struct TBodyRate
{
	Eigen::Vector3d rate{0, 0, 0};	///< Body axes, bias included [rad/s]
	double variance{0};				///< [rad^2/s^2]
};

/** A DVL on the body: its axes and its place. */
struct TDvlMount
{
	Eigen::Matrix3d R_dvl_body{Eigen::Matrix3d::Identity()};
	Eigen::Vector3d lever{0, 0, 0};
};

/** Velocities over ground along some directions of the instrument: its three axes, or 1 to 4 beams.
 * z = D^T R_dvl_body (v + (w - b) x lever), D the directions (columns); v is the state's velocity, which has
 * the instrument's scale. */
class CDvlMeasurement : public CMeasurement
{
   public:
	/** All three axes [m/s] with their covariance. */
	static CDvlMeasurement axes(
		const Eigen::Vector3d& velocity, const Eigen::Matrix3d& cov, const TDvlMount& mount,
		const TBodyRate& rate);
	/** Radial velocities of the beams that are not NaN (one at least), white noise of `sigma` each;
	 * `directions`: unit vectors, instrument's frame. */
	static CDvlMeasurement beams(
		const Eigen::Vector4d& radial, double sigma, const Eigen::Matrix<double, 3, 4>& directions,
		const TDvlMount& mount, const TBodyRate& rate);

	int degreesOfFreedom() const override { return m_rows; }
	Value predicted(const TNavigationState& x) const override;
	Jacobian jacobian(const TNavigationState& x) const override;
	ENavigationRow block() const override { return kVelocity; }

   private:
	using Directions = Eigen::Matrix<double, kSize, 3>;	 ///< D^T R_dvl_body, zero rows are padding
	CDvlMeasurement(
		const Value& z, const Noise& cov, int rows, const Directions& along_body,
		const Eigen::Vector3d& lever, const TBodyRate& rate);
	Directions m_along_body;
	Eigen::Vector3d m_lever, m_rate;
	int m_rows;
};

/** A velocity of the body's origin, that of a vehicle at rest or of its drag model, in body axes. */
class CBodyVelocityMeasurement : public CMeasurement
{
   public:
	/** `origin`: from the navigated point to the point that is meant. */
	CBodyVelocityMeasurement(
		const Eigen::Vector3d& velocity, const Eigen::Vector3d& sigma, const Eigen::Vector3d& origin,
		const TBodyRate& rate);
	int degreesOfFreedom() const override { return 3; }
	Value predicted(const TNavigationState& x) const override;
	Jacobian jacobian(const TNavigationState& x) const override;
	ENavigationRow block() const override { return kVelocity; }

   private:
	Eigen::Vector3d m_origin, m_rate;
};

/** Depth of a sensor: z = down of (p + R lever) + offset. */
class CDepthMeasurement : public CMeasurement
{
   public:
	CDepthMeasurement(double depth, double sigma, const Eigen::Vector3d& lever);
	int degreesOfFreedom() const override { return 1; }
	Value predicted(const TNavigationState& x) const override;
	Jacobian jacobian(const TNavigationState& x) const override;
	ENavigationRow block() const override { return kPosition; }

   private:
	Eigen::Vector3d m_lever;
};

/** North and east of an antenna: z = those of (p + R lever) + bias. */
class CHorizontalMeasurement : public CMeasurement
{
   public:
	CHorizontalMeasurement(const Eigen::Vector2d& north_east, double sigma, const Eigen::Vector3d& lever);
	int degreesOfFreedom() const override { return 2; }
	Value predicted(const TNavigationState& x) const override;
	Jacobian jacobian(const TNavigationState& x) const override;
	ENavigationRow block() const override { return kPosition; }

   private:
	Eigen::Vector3d m_lever;
};

/** Roll, pitch and heading together: 0 = Log(R_measured^T Exp(bias) R) + noise. */
class CAttitudeMeasurement : public CMeasurement
{
   public:
	CAttitudeMeasurement(const Eigen::Matrix3d& R_map_body, double sigma_roll_pitch, double sigma_heading);
	int degreesOfFreedom() const override { return 3; }
	Value predicted(const TNavigationState& x) const override;
	Jacobian jacobian(const TNavigationState& x) const override;
	ENavigationRow block() const override { return kAttitude; }

   private:
	Eigen::Matrix3d m_R_map_body;
};

/** Roll and pitch alone: the direction of down in body axes, z = (Exp(bias) R)^T (0, 0, 1). */
class CGravityMeasurement : public CMeasurement
{
   public:
	CGravityMeasurement(const Eigen::Matrix3d& R_map_body, double sigma_roll_pitch);
	int degreesOfFreedom() const override { return 2; }
	Value predicted(const TNavigationState& x) const override;
	Jacobian jacobian(const TNavigationState& x) const override;
	ENavigationRow block() const override { return kAttitude; }
};

/** Covariance in body axes of an attitude error given by sigmas about map axes. */
Eigen::Matrix3d attitudeNoise(
	const Eigen::Matrix3d& R_map_body, double sigma_roll_pitch, double sigma_heading);
}  // namespace posidonia
