#pragma once

#include <mrpt/bayes/CKalmanFilterCapable.h>
#include <posidonia/nav/measurements.h>
#include <posidonia/nav/motion_model.h>
#include <posidonia/nav/odometry_source.h>

namespace mrpt::bayes
{
/** The stock iteration compiles for up to 7 states only; this one serves all of ours (see README), without
 * any allocation. */
template <>
void CKalmanFilterCapable<
	posidonia::kNavigationSize, posidonia::CMeasurement::kSize, 0, 8>::runOneKalmanIteration();
}  // namespace mrpt::bayes

namespace posidonia
{
/** Who wants to see each step of a filter, for smoothing. */
class CStepObserver
{
   public:
	virtual ~CStepObserver() = default;
	/** x, P (moving rows) went to x_predicted, P_predicted by a step with Jacobian F. */
	virtual void predicted(
		const TNavigationState& x, const MatrixMoving& P, const MatrixMoving& F,
		const TNavigationState& x_predicted, const MatrixMoving& P_predicted) = 0;
};

/** Mean and covariance: everything that a filter remembers. */
struct TFilterState
{
	TNavigationState x;
	MatrixNav P{MatrixNav::Identity()};
};

/** Error-state Kalman filter over the rows of ENavigationRow. m_xkk holds the error, zero between iterations,
 * m_pkk its covariance; the nominal state with its rotation matrix stands beside them, so no attitude is
 * singular. */
class CNavigationEKF : public mrpt::bayes::CKalmanFilterCapable<kNavigationSize, CMeasurement::kSize, 0, 8>
{
   public:
	/** `gate_probability`: part of the good measurements that the chi-square gate lets pass, in (0, 1). */
	CNavigationEKF(const TMotionNoise& noise, double gate_probability);

	/** Starts at `x` with the covariance of its moving rows; the clone is put at the same pose. */
	void initialize(const TNavigationState& x, const MatrixMoving& cov);
	/** Moves the present by u.dt > 0 [s]. */
	void predict(const TMotionInput& u);
	/** Fuses a measurement of the present; false: the gate refused it and nothing changed. */
	bool update(const CMeasurement& measurement);
	/** As update(), without the gate. */
	void updateUngated(const CMeasurement& measurement);
	/** Gives way to a sensor that the filter has contradicted for too long: the part of the sensor's block
	 * that it sees becomes as uncertain as the disagreement is large, then the measurement is fused without
	 * the gate.
	 */
	void giveWay(const CMeasurement& measurement);
	/** What the sensor reads over what the filter expects. */
	CMeasurement::Value innovation(const CMeasurement& measurement) const
	{
		return measurement.value() - measurement.predicted(m_nominal);
	}
	/** Copies the present pose and its correlations into the clone. */
	void clone();
	/** Starts an edge: what `reference` knows, but for the horizontal position, which becomes zero and exact;
	 * then clone(). See README, "Edges". */
	void anchor(const CNavigationEKF& reference);

	const TNavigationState& state() const { return m_nominal; }
	MatrixNav covariance() const;
	double variance(int row) const { return m_pkk(row, row); }
	/** T_odom_nav and T_clone_nav with covariance (path_length is not kept here). */
	TPoseEstimate pose() const;
	TPoseEstimate sinceClone() const;
	/** Squared Mahalanobis distance of the last measurement's innovation, before the gate. */
	double lastDistance() const { return m_last_distance; }
	/** Chi-square quantile of the gate [0 to CMeasurement::kSize degrees of freedom]. */
	double gate(int degrees_of_freedom) const { return m_gate[degrees_of_freedom]; }

	/** For snapshots: allocates nothing. */
	void save(TFilterState& to) const;
	void restore(const TFilterState& from);
	/** `observer` may be null; not owned. */
	void observe(CStepObserver* observer) { m_observer = observer; }

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
	void OnNormalizeStateVector() override;

   private:
	/** Symmetric, so its storage order does not matter. */
	using MapNav = Eigen::Map<MatrixNav>;
	MapNav P() { return MapNav(m_pkk.data()); }
	void fuse(const CMeasurement& measurement, bool gated);
	void resetCovariance(const Eigen::Vector3d& attitude_error, int rows);
	void predictObserved();

	TMotionNoise m_noise;
	double m_gate[CMeasurement::kSize + 1];	 ///< Chi-square quantile by degrees of freedom
	TNavigationState m_nominal, m_nominal_next;
	TMotionInput m_input;
	mutable MatrixDriven m_driven;	///< OnTransitionJacobian()'s, for OnTransitionNoise() right after it
	const CMeasurement* m_measurement{nullptr};	 ///< During an update only
	CStepObserver* m_observer{nullptr};
	bool m_gated{true}, m_accepted{false};
	double m_last_distance{0};
};
}  // namespace posidonia
