#pragma once

#include <posidonia/nav/navigator.h>

namespace posidonia
{
struct TStampedEstimate
{
	double stamp{0};  ///< UTC [s]
	TPoseEstimate pose;
};

/** The navigation filter over a whole log, then back again, so that each pose knows what came after it
 * (Rauch, Tung, Striebel 1965; in the error state, so on the manifold to first order). The way back works by
 * segments: each is filtered anew from a snapshot, so memory holds the readings and one segment's steps. */
class CRtsSmoother : private CStepObserver
{
   public:
	explicit CRtsSmoother(std::shared_ptr<const TNavigatorSetup> setup);

	/** @param readings of the whole log, in any order (CEkfOdometry::keepReadings() gives those it believed)
	 * @return T_odom_body with covariance from the filter's start on, one each `period` [s]; path_length is
	 * left 0; empty when the filter never started */
	std::vector<TStampedEstimate> smooth(std::vector<TSensorReading> readings, double period);

   private:
	/** A prediction: the filter's state before, its derivative, and what it led to. */
	struct TStep
	{
		TNavigationState x, x_predicted;
		MatrixMoving P, F, P_predicted;
		double end;	 ///< Stamp [s]
	};
	struct TSegment
	{
		CNavigator::CSnapshot from;
		size_t begin;  ///< First reading that is not in it
	};
	void predicted(
		const TNavigationState& x, const MatrixMoving& P, const MatrixMoving& F,
		const TNavigationState& x_predicted, const MatrixMoving& P_predicted) override;
	std::vector<TSegment> filterForward(const std::vector<TSensorReading>& readings);
	/** Filters the readings of a segment, up to `end`, again; their steps go to m_steps. */
	void replay(const TSegment& segment, const std::vector<TSensorReading>& readings, size_t end);
	void stepBack(const TStep& step);
	TStampedEstimate estimate(double stamp) const;

	std::shared_ptr<const TNavigatorSetup> m_setup;
	CNavigator m_navigator;
	std::vector<TStep> m_steps;
	TNavigationState m_x;  ///< Smoothed, on the way back
	MatrixMoving m_P;
};
}  // namespace posidonia
