#include <posidonia/sim/simulated_gps.h>

#include "make_observation.h"

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using mrpt::obs::gnss::Message_NMEA_GGA;

CSimulatedGps::CSimulatedGps(
	const std::string& label, const TGpsSpec& spec, const TSimulatedGpsOptions& options,
	const TWorldOptions& datum, uint64_t seed)
	: m_label(label),
	  m_spec(spec),
	  m_options(options),
	  m_datum(datum),
	  m_noise(seedOf(seed, label)),
	  m_wander(
		  Vector2d::Constant(spec.sigma_bias), spec.bias_time, 1 / spec.rate, seedOf(seed, label + " wander"))
{
}

mrpt::obs::CObservation::Ptr CSimulatedGps::measure(const TVehicleState& state, double stamp)
{
	if (m_started) m_wander.advance();
	m_started = true;
	const Vector2d noise = m_noise.normals<2>();
	if (state.T_map_body.translation().z() >= m_options.max_depth) return {};
	const Isometry3d T_body_sensor = m_spec.T_body_sensor();
	auto gps = makeObservation<mrpt::obs::CObservationGPS>(m_label, stamp, T_body_sensor);
	Vector3d measured = state.T_map_body * T_body_sensor.translation();
	measured.head<2>() += m_spec.sigma_horizontal * noise;
	measured.head<2>() += bias();
	gps->setMsg(makeGga(geodeticFromNed(measured, m_datum), stamp));
	return gps;
}

Message_NMEA_GGA CSimulatedGps::makeGga(const TGeodetic& fix, double stamp) const
{
	Message_NMEA_GGA gga;
	gga.fields.latitude_degrees = fix.latitude;
	gga.fields.longitude_degrees = fix.longitude;
	gga.fields.altitude_meters = fix.height;
	gga.fields.fix_quality = 1;
	gga.fields.satellitesUsed = 8;
	gga.fields.HDOP = static_cast<float>(m_options.hdop);
	gga.fields.thereis_HDOP = true;
	const double day = std::fmod(stamp, 86400.0);
	gga.fields.UTCTime.hour = static_cast<uint8_t>(day / 3600);
	gga.fields.UTCTime.minute = static_cast<uint8_t>(std::fmod(day / 60, 60.0));
	gga.fields.UTCTime.sec = std::fmod(day, 60.0);
	return gga;
}
}  // namespace posidonia
