#include <gtest/gtest.h>
#include <posidonia/obs/geodesy.h>

using namespace posidonia;
using Eigen::Vector3d;

namespace
{
const TWorldOptions kDatum;

/** Earth-centred coordinates, textbook formula (an independent path to nedFromGeodetic). */
Vector3d ecef(const TGeodetic& g)
{
	const double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f);
	const double lat = g.latitude * M_PI / 180, lon = g.longitude * M_PI / 180;
	const double n = a / std::sqrt(1 - e2 * std::sin(lat) * std::sin(lat));
	return {
		(n + g.height) * std::cos(lat) * std::cos(lon), (n + g.height) * std::cos(lat) * std::sin(lon),
		(n * (1 - e2) + g.height) * std::sin(lat)};
}

Vector3d nedByRotation(const TGeodetic& g, const TWorldOptions& datum)
{
	const double lat = datum.latitude * M_PI / 180, lon = datum.longitude * M_PI / 180;
	const Eigen::Matrix3d R =
		(Eigen::AngleAxisd(lon, Vector3d::UnitZ()) * Eigen::AngleAxisd(-lat - M_PI / 2, Vector3d::UnitY()))
			.toRotationMatrix();  // columns: north, east, down
	return R.transpose() * (ecef(g) - ecef({datum.latitude, datum.longitude, 0}));
}
}  // namespace

TEST(Geodesy, TheDatumIsTheOrigin)
{
	EXPECT_LT(nedFromGeodetic({kDatum.latitude, kDatum.longitude, 0}, kDatum).norm(), 1e-6);
}

TEST(Geodesy, RoundTripBelowAMillimetre)
{
	for (const Vector3d& ned :
		 {Vector3d(111.069, 83.137, 3.50), Vector3d(-2000, 1500, 200), Vector3d(5, -7, -2),
		  Vector3d(0, 0, 10)})
	{
		const Vector3d back = nedFromGeodetic(geodeticFromNed(ned, kDatum), kDatum);
		EXPECT_LT((back - ned).norm(), 1e-3) << ned.transpose();
	}
}

TEST(Geodesy, AgreesWithTheTextbook)
{
	for (const TGeodetic& g :
		 {TGeodetic{41.7787, 3.0343, 0}, TGeodetic{41.7777, 3.0333, -50}, TGeodetic{41.76, 3.06, 12.5}})
		EXPECT_LT((nedFromGeodetic(g, kDatum) - nedByRotation(g, kDatum)).norm(), 1e-4)
			<< g.latitude << " " << g.longitude;
	const TGeodetic g = geodeticFromNed({111.069, 83.137, 3.50}, kDatum);
	EXPECT_LT((nedByRotation(g, kDatum) - Vector3d(111.069, 83.137, 3.50)).norm(), 1e-3);
}

TEST(Geodesy, TheAxesPointNorthEastDown)
{
	EXPECT_NEAR(nedFromGeodetic({kDatum.latitude + 0.001, kDatum.longitude, 0}, kDatum).x(), 111.07, 0.05);
	EXPECT_NEAR(nedFromGeodetic({kDatum.latitude, kDatum.longitude + 0.001, 0}, kDatum).y(), 83.1, 0.1);
	EXPECT_NEAR(nedFromGeodetic({kDatum.latitude, kDatum.longitude, -3}, kDatum).z(), 3, 1e-6);
}
