#pragma once

#include <posidonia/control/control_state.h>
#include <posidonia/control/guidance_command.h>
#include <posidonia/control/leg_progress.h>
#include <posidonia/control/line_of_sight.h>
#include <posidonia/control/station_keeping.h>

namespace posidonia
{
/** A straight leg: turn on the spot, run along the line, and approach the point if its line was crossed too
 * far off. */
class CLegGuidance
{
   public:
	explicit CLegGuidance(const TGuidanceOptions& options)
		: m_options(options), m_los(options), m_station(options)
	{
	}

	/** From `start` to `end` [m]; `heading`: the heading reference now [rad]. */
	void begin(
		const Eigen::Vector2d& start, const Eigen::Vector2d& end, double speed,
		const TControlState& navigation, const Eigen::Vector2d& current, double heading);

	/** Heading reference and wished surge (not yet ramped); `dt` [s]. */
	TReference update(const TControlState& navigation, const Eigen::Vector2d& current, double dt);
	double surge() const { return m_surge; }
	const TLegProgress& progress() const { return m_progress; }

   private:
	void locate(const Eigen::Vector2d& position);
	/** Of the cross-track error, from the velocity: a correction of the pose is not in it [m/s]. */
	double crossRate(const TControlState& navigation) const;
	/** Velocity over ground [m/s] at an angle off the line, map. */
	Eigen::Vector2d along(double course_offset, double speed) const;
	/** Speed that still stops at the end of the leg [m/s]. */
	double speed() const;
	TReference turn(const TControlState& navigation);
	TReference run(const TControlState& navigation, const Eigen::Vector2d& current, double dt);
	TReference approach(const TControlState& navigation, const Eigen::Vector2d& current, double dt);
	/** Bow, off the line, for a course off the line: with the crab angle for the leg's full speed, so that it
	 * does not swing up-current while the vehicle slows down [rad]. */
	double crabbed(double course_offset, const Eigen::Vector2d& current) const;
	/** The rate of the line of sight is fed forward while running at speed, with no step at the ends. */
	double rateWeight(double now) const;

	TGuidanceOptions m_options;
	CLineOfSight m_los;
	CStationKeeping m_station;
	CTurnProfile m_turn;
	TLegProgress m_progress;
	double m_length{0}, m_course{0}, m_speed{0};  ///< [m], [rad], [m/s]
	double m_begun{0}, m_running_since{0};		  ///< [s]
	double m_heading{0};						  ///< Reference [rad], not wrapped
	double m_blend{0};							  ///< Of the heading reference [rad]
	double m_rate{0};							  ///< Of the line of sight, filtered [rad/s]
	double m_surge{0};							  ///< [m/s]
};
}  // namespace posidonia
