#pragma once

#include <Eigen/Dense>

namespace posidonia
{
/** The datum: where the origin of `map` lies. Section [World] of the ini; never "the first fix". */
struct TWorldOptions
{
	double latitude{41.7777};  ///< [deg] (COLA2's default origin, off Sant Feliu de Guixols)
	double longitude{3.0333};  ///< [deg]

	template <class VISITOR>
	void visit(VISITOR& v);
};

/** A position on the WGS-84 ellipsoid. */
struct TGeodetic
{
	double latitude{0}, longitude{0};  ///< [deg]
	double height{0};				   ///< Above the ellipsoid [m]
};

/** North, east, down [m] of a geodetic position from the datum (at height 0). */
Eigen::Vector3d nedFromGeodetic(const TGeodetic& position, const TWorldOptions& datum);
/** The inverse, along the ellipsoid's normal at the datum. */
TGeodetic geodeticFromNed(const Eigen::Vector3d& ned, const TWorldOptions& datum);
}  // namespace posidonia

#include <posidonia/base/options.h>

template <class VISITOR>
void posidonia::TWorldOptions::visit(VISITOR& v)
{
	v.number("latitude", latitude, between(-89.9, 89.9), "Latitude of the origin of map [deg]");
	v.number("longitude", longitude, between(-180, 180), "Longitude of the origin of map [deg]");
}
