#pragma once

#include <mrpt/bayes/CKalmanFilterCapable.h>

#include <Eigen/Dense>

namespace posidonia
{
enum class EIteration
{
	OWN,   ///< Fixed sizes, Cholesky, Joseph's form
	STOCK  ///< mrpt::bayes' runOneKalmanIteration()
};

/** A measurement of the six states: z = H x + offset + noise; rows beyond `rows` are padding (z and H zero,
 * noise one). */
struct TCola2Measurement
{
	int rows{3};
	Eigen::Vector3d z{0, 0, 0}, offset{0, 0, 0};
	Eigen::Matrix<double, 3, 6> H{Eigen::Matrix<double, 3, 6>::Zero()};
	Eigen::Matrix3d noise{Eigen::Matrix3d::Identity()};
};

/** COLA2's navigation filter (ekf_position_velocity), which the paper's vehicle ran: state (north, east,
 * down; u, v, w), body velocity constant but for its random walk, attitude and rates taken from the AHRS as
 * they are. */
class CCola2EKF : public mrpt::bayes::CKalmanFilterCapable<6, 3, 0, 4>
{
   public:
	using Vector6 = Eigen::Matrix<double, 6, 1>;
	using Matrix6 = Eigen::Matrix<double, 6, 6>;

	/** `acceleration_density` [m/s^2/sqrt(Hz)]; COLA2's 0.02 (m/s^2)^2 a step of 20 Hz is 0.032. */
	CCola2EKF(double acceleration_density, double gate_probability, EIteration iteration);

	void initialize(const Vector6& x, const Matrix6& cov);
	/** p += R(yaw, pitch, roll) v dt, dt > 0 [s]. Throws CError where pitch nears 90 degrees: yaw and roll
	 * end there. */
	void predict(const Eigen::Matrix3d& R_map_body, double dt);
	/** False: the chi-square gate refused it and nothing changed. */
	bool update(const TCola2Measurement& measurement);
	void updateUngated(const TCola2Measurement& measurement);

	Vector6 state() const;
	Matrix6 covariance() const;
	/** Starts an edge: position zero and exact, velocity as it is. */
	void anchor();

   protected:
	void OnGetAction(KFArray_ACT& u) const override;
	void OnTransitionModel(const KFArray_ACT& u, KFArray_VEH& x, bool& skip) const override;
	void OnTransitionJacobian(KFMatrix_VxV& F) const override;
	void OnTransitionNoise(KFMatrix_VxV& Q) const override;
	void OnGetObservationNoise(KFMatrix_OxO& R) const override;
	void OnGetObservationsAndDataAssociation(
		vector_KFArray_OBS& z, std::vector<int>& association, const vector_KFArray_OBS& predictions,
		const KFMatrix& S, const std::vector<size_t>& indices, const KFMatrix_OxO& R) override;
	void OnObservationModel(
		const std::vector<size_t>& indices, vector_KFArray_OBS& predictions) const override;
	void OnObservationJacobians(size_t index, KFMatrix_OxV& Hx, KFMatrix_OxF& Hy) const override;

   private:
	void iterate() { m_iteration == EIteration::STOCK ? runOneKalmanIteration() : runOwnIteration(); }
	void runOwnIteration();

	double m_acceleration_density, m_gate[4];
	EIteration m_iteration;
	double m_yaw_pitch_roll[3]{0, 0, 0}, m_dt{0};
	TCola2Measurement m_measurement;
	bool m_measured{false};
};
}  // namespace posidonia
