#include <mrpt/topography/conversions.h>
#include <posidonia/obs/geodesy.h>

namespace posidonia
{
using Eigen::Vector3d;
namespace topo = mrpt::topography;

Vector3d nedFromGeodetic(const TGeodetic& p, const TWorldOptions& datum)
{
	mrpt::math::TPoint3D enu;
	topo::geodeticToENU_WGS84(
		topo::TGeodeticCoords(p.latitude, p.longitude, p.height), enu,
		topo::TGeodeticCoords(datum.latitude, datum.longitude, 0));
	return {enu.y, enu.x, -enu.z};
}

TGeodetic geodeticFromNed(const Vector3d& ned, const TWorldOptions& datum)
{
	// MRPT's ENUToGeocentric uses the geocentric radius instead of the ellipsoid's normal (0.37 m of height
	// at 111 m), so the rotation is done here.
	const double lat = datum.latitude * M_PI / 180, lon = datum.longitude * M_PI / 180;
	mrpt::math::TPoint3D origin;
	topo::geodeticToGeocentric_WGS84(topo::TGeodeticCoords(datum.latitude, datum.longitude, 0), origin);
	const Vector3d north(-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat));
	const Vector3d east(-std::sin(lon), std::cos(lon), 0);
	const Vector3d up(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat));
	const Vector3d p =
		Vector3d(origin.x, origin.y, origin.z) + north * ned.x() + east * ned.y() - up * ned.z();
	topo::TGeodeticCoords g;
	topo::geocentricToGeodetic({p.x(), p.y(), p.z()}, g);
	return {g.lat.decimal_value, g.lon.decimal_value, g.height};
}
}  // namespace posidonia
