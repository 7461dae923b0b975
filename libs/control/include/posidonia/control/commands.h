#pragma once

namespace posidonia
{
/** Velocities that the vehicle can be asked for: over ground, in body axes. */
struct TVelocityCommand
{
	double surge{0}, heave{0};	///< [m/s]
	double yaw_rate{0};			///< [rad/s]
};

/** Forces that the three thrusters can make, in body axes. */
struct TWrench
{
	double X{0}, Z{0};	///< Surge, heave [N]
	double N{0};		///< Yaw [N m]
};
}  // namespace posidonia
