#pragma once

#include <posidonia/geometry/se3.h>

#include <variant>

/** Observations as the navigation filter sees them: decoded, checked, turned into body axes. Plain values, so
 * that a history of them can be kept and replayed. */
namespace posidonia
{
struct TInertialReading
{
	Eigen::Vector3d rate, force;  ///< Body axes [rad/s], [m/s^2]
};
struct TAttitudeReading
{
	Eigen::Matrix3d R_map_body;	 ///< Declination applied
};
struct TDvlReading
{
	bool has_velocity{false};
	Eigen::Vector3d velocity;  ///< Instrument frame [m/s]
	Eigen::Matrix3d cov;	   ///< [(m/s)^2]
	Eigen::Vector4d beams;	   ///< Radial velocities [m/s]; NaN: lost or not known
};
struct TDepthReading
{
	double depth;  ///< Of the sensor [m]
};
struct TFixReading
{
	Eigen::Vector2d north_east;	 ///< Of the antenna, map [m]
};
/** Moves the present, says nothing (a stereo pair). */
struct TTick
{
};
/** A node was made here: the filters cloned their pose. */
struct TCloneMark
{
	size_t index;  ///< How many clones came before
};

struct TSensorReading
{
	double stamp{0};  ///< UTC [s]
	int sensor{-1};	  ///< Index of the label in the navigator's setup; -1: none (a clone mark)
	/** Readings of one stamp belong in this order. */
	std::variant<
		TInertialReading, TAttitudeReading, TDvlReading, TDepthReading, TFixReading, TTick, TCloneMark>
		what;

	bool isBefore(const TSensorReading& other) const
	{
		return stamp != other.stamp ? stamp < other.stamp : what.index() < other.what.index();
	}
};
}  // namespace posidonia
