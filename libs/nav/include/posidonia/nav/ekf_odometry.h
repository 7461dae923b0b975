#pragma once

#include <posidonia/nav/reading_decoder.h>
#include <posidonia/nav/reading_history.h>
#include <posidonia/nav/stamp_guard.h>

namespace posidonia
{
/** Odometry from IMU, DVL, pressure, AHRS and GPS: a CNavigator whose observations may come late, twice or
 * with wrong stamps. After a stereo pair that came late, the present is that of the pair, until the next
 * observation: nodes are where the pictures were taken, whatever the camera's delay. */
class CEkfOdometry : public COdometrySource
{
   public:
	/** Throws CError when `sensors` has no gyro and the mode needs one. The first IMU by label drives the
	 * filters, others stay idle. */
	CEkfOdometry(
		const TEkfOptions& options, const TInitialPoseOptions& start, const TSensorSuite& sensors,
		const TWorldOptions& datum, const TDragOptions& drag = {});

	void add(const mrpt::obs::CObservation& observation) override;
	/** From the first gyro reading on (known pose), or after the fixes, the AHRS and the pressure as well. */
	bool ready() const override { return present().ready(); }
	double stamp() const override { return present().stamp(); }
	void clone() override;
	TPoseEstimate sinceClone() const override { return present().sinceClone(); }
	TPoseEstimate now() const override { return present().now(); }
	TUnaryMeasurements unary() const override { return present().unary(); }
	/** The DVL's scale, as uncertain as the filter still is about it. */
	TDeclaredDrift declaredDrift() const override;
	std::vector<TRevisedEdge> takeRevisedEdges() override;

	/** The rate is without bias. */
	TBodyMotion motion() const override { return {present().velocity(), present().rate()}; }
	const CNavigator& navigator() const { return m_navigator; }
	const CNavigationEKF& navigationFilter() const { return m_navigator.navigationFilter(); }
	const CNavigationEKF& edgeFilter() const { return m_navigator.edgeFilter(); }
	const TNavigatorSetup& setup() const { return *m_setup; }
	std::shared_ptr<const TNavigatorSetup> sharedSetup() const { return m_setup; }
	TNavStatistics statistics() const;
	/** For runs without nodes, at half the cost: sinceClone() and clone() may not be called. */
	void withoutEdges() { m_navigator.withoutEdges(); }
	/** From now on appends every reading that is believed by its stamp to `to`, which must live longer. */
	void keepReadings(std::vector<TSensorReading>& to) { m_kept = &to; }

   private:
	const CNavigator& present() const { return m_in_past ? m_past : m_navigator; }
	void take(const TSensorReading& reading);
	void append(const TSensorReading& reading);
	void replay(const TSensorReading& late);
	void resetClock(const TSensorReading& reading);
	/** Before a clone mark is replayed: the edge that ends there, as it is now. */
	void reviseEdge(double stamp, const TCloneMark& mark, double newest);

	std::shared_ptr<const TNavigatorSetup> m_setup;
	CReadingDecoder m_decoder;
	CNavigator m_navigator;
	CNavigator m_past;	///< At a stereo pair that came late
	bool m_in_past{false};
	CReadingHistory m_history;
	CStampGuard m_guard;
	size_t m_clones{0};
	std::vector<TRevisedEdge> m_revised;
	std::vector<TSensorReading>* m_kept{nullptr};
	TNavStatistics m_counts;  ///< Of the whole, not by sensor
};
}  // namespace posidonia
