#pragma once

#include <posidonia/control/references.h>

#include <Eigen/Dense>

namespace posidonia
{
/** What guidance asks of the pose controller. */
struct TGuidanceCommand
{
	TReference heading;	   ///< [rad]
	TReference depth;	   ///< [m], down
	double surge{0};	   ///< Over ground, body axis [m/s]
	double surge_rate{0};  ///< [m/s^2]
};

/** Heading and surge for a wished velocity over ground. */
struct TSteering
{
	double heading{0};	///< [rad]
	double surge{0};	///< [m/s]
};

/** There is no sway thruster: to move over ground with `wish` in a current, the bow points along wish -
 * current, and the surge over ground is the part of the wish along the bow as it is now. `heading`: now
 * [rad]; map vectors [m/s]. On legs the same law gives the crab angle asin(current across / speed through the
 * water). */
TSteering steer(const Eigen::Vector2d& wish, const Eigen::Vector2d& current, double heading);

/** 1 near the wanted heading, falling to 0 at 1.3 rad: surge waits for the bow (COLA2's section). */
double alignment(double heading_error);
}  // namespace posidonia
