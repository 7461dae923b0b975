#pragma once

#include <posidonia/control/depth_guidance.h>
#include <posidonia/control/leg_guidance.h>

#include <optional>

namespace posidonia
{
/** Guidance of one step after the other: what the mission's step asks for becomes references of heading and
 * depth, and a surge. The references are continuous from step to step. */
class CStepGuidance
{
   public:
	explicit CStepGuidance(const TGuidanceOptions& options)
		: m_options(options), m_leg(options), m_station(options), m_depth(options)
	{
	}

	/** `before`: end of the step before, if it had one, north east [m]. */
	void begin(
		const TStep& step, const std::optional<Eigen::Vector2d>& before, const TControlState& navigation,
		const Eigen::Vector2d& current);

	TGuidanceCommand update(const TControlState& navigation, const Eigen::Vector2d& current, double dt);

	/** Is the step's end reached? For HOLD: has its time passed? */
	bool reached(const TControlState& navigation) const;

	/** NONE when the step is no leg. */
	TLegProgress progress() const;
	/** Where the step ends, north east [m]. */
	const Eigen::Vector2d& end() const { return m_end; }
	/** Vertical distance to the step's depth when it began [m]. */
	double climb() const { return m_climb; }

   private:
	void keepStation(const TControlState& navigation, const Eigen::Vector2d& current, double dt);
	void rampSurge(double wanted, double dt);

	TGuidanceOptions m_options;
	CLegGuidance m_leg;
	CStationKeeping m_station;
	CDepthGuidance m_depth;
	TStep m_step;
	Eigen::Vector2d m_end{0, 0};
	CSmoothReference m_depth_reference;
	TGuidanceCommand m_command;
	double m_begun{0}, m_depth_target{0}, m_climb{0};
	bool m_started{false};
};
}  // namespace posidonia
