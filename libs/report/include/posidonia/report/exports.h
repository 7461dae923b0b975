#pragma once

#include <posidonia/report/floor_mosaic.h>
#include <posidonia/report/run_data.h>

#include <string>

/** A run as files of other programs. */
namespace posidonia
{
/** The final nodes (and the truth) as lines for Google Earth and the like: WGS-84, altitude clamped to depth
 * below the surface. Throws CError for a run without poses. */
std::string kmlOf(const TRunData& run);
/** The same as a GeoJSON FeatureCollection (RFC 7946): longitude, latitude, height [m, negative below the
 * surface]. */
std::string geoJsonOf(const TRunData& run);
/** For photogrammetry packages: image,lat,lon,depth,roll,pitch,yaw of the CAMERA's body axes at each picture
 * [deg, m, deg]; roll, pitch, yaw are the vehicle's. Empty but for its header without pictures. */
std::string photoPositionsCsv(const TRunData& run);

/** A CSimpleMap of MRPT: at each node its pose with covariance and its picture (CObservationImage, external).
 * Whole or not at all. */
void writeSimpleMap(const TRunData& run, const std::string& path);
/** A COpenGLScene for MRPT's SceneViewer3D: trajectories, loops, and the floor as it was seen. It hangs under
 * one root turned by 180 degrees of roll, so that depth points downwards. Whole or not at all. */
void writeScene(const TRunData& run, const std::string& path, const std::optional<TFloorMosaic>& floor);

/** trajectory.kml, trajectory.geojson, photos.csv, map.simplemap and scene.3Dscene, into `folder`, which is
 * made. Runs without nodes (auv-ekf) have trajectories alone. */
void writeExports(const TRunData& run, const std::string& folder, const std::optional<TFloorMosaic>& floor);
}  // namespace posidonia
