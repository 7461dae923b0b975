#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/sim/sensor_models.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
template <class OBSERVATION>
typename OBSERVATION::Ptr makeObservation(
	const std::string& label, double stamp, const Isometry3d& T_body_sensor)
{
	auto observation = OBSERVATION::Create();
	observation->sensorLabel = label;
	observation->timestamp = stampFrom(stamp);
	observation->sensorPose = toMrpt(T_body_sensor);
	return observation;
}
}  // namespace

CSimulatedDvl::CSimulatedDvl(
	const std::string& label, const TDvlSpec& nominal, const TSimulatedDvlOptions& options,
	const TCalibrationErrorOptions& errors, double floor_depth, uint64_t seed)
	: m_label(label),
	  m_nominal(nominal),
	  m_options(options),
	  m_T_body_dvl(trueDvlPose(nominal, errors)),
	  m_scale(1 + errors.dvl_scale),
	  m_floor_depth(floor_depth),
	  m_beams(nominal.beams()),
	  m_noise(seedOf(seed, label))
{
}

mrpt::obs::CObservation::Ptr CSimulatedDvl::measure(const TVehicleState& state, double stamp)
{
	auto dvl = makeObservation<CObservationDVL>(m_label, stamp, m_nominal.T_body_sensor());
	measureVelocity(state, *dvl);
	const double altitude = m_floor_depth - (state.T_map_body * m_T_body_dvl.translation()).z();
	measureRanges(state, altitude, *dvl);
	if (altitude < m_options.min_altitude || altitude > m_options.max_altitude) {
		dvl->velocity = {0, 0, 0};
		dvl->velocity_valid = dvl->altitude_valid = false;
		dvl->altitude = 0;
		dvl->beam_velocities.assign(4, std::nan(""));
		dvl->beam_ranges.assign(4, std::nan(""));
	}
	return dvl;
}

void CSimulatedDvl::measureVelocity(const TVehicleState& state, CObservationDVL& dvl)
{
	const Vector3d lever = m_T_body_dvl.translation();
	const Vector3d truth = m_T_body_dvl.linear().transpose() * (state.v_body + state.omega_body.cross(lever));
	Vector3d v;
	for (int i = 0; i < 3; i++)
		v[i] = m_scale * truth[i] + m_nominal.sigma_velocity * m_noise.normal();
	dvl.velocity = {v.x(), v.y(), v.z()};
	dvl.velocity_valid = true;
	// The fourth degree of freedom of a Janus head, the "error velocity", which the three axes do not see.
	const double error_velocity = m_nominal.sigma_velocity * m_noise.normal() / 2;
	dvl.beam_velocities.resize(4);
	for (int i = 0; i < 4; i++)
		dvl.beam_velocities[i] = m_beams.col(i).dot(v) + (i % 2 == 0 ? error_velocity : -error_velocity);
}

void CSimulatedDvl::measureRanges(const TVehicleState& state, double true_altitude, CObservationDVL& dvl)
{
	const Matrix3d R_map_dvl = state.T_map_body.linear() * m_T_body_dvl.linear();
	dvl.beam_ranges.resize(4);
	for (int i = 0; i < 4; i++) {
		const double slope = (R_map_dvl * m_beams.col(i)).z(),
					 noise = m_options.sigma_altitude * m_noise.normal();
		dvl.beam_ranges[i] = slope > 0.05 ? true_altitude / slope + noise : std::nan("");
	}
	dvl.altitude = true_altitude + m_options.sigma_altitude * m_noise.normal();
	dvl.altitude_valid = true;
}

CSimulatedPressure::CSimulatedPressure(const std::string& label, const TPressureSpec& spec, uint64_t seed)
	: m_label(label), m_spec(spec), m_noise(seedOf(seed, label))
{
}

mrpt::obs::CObservation::Ptr CSimulatedPressure::measure(const TVehicleState& state, double stamp)
{
	const Isometry3d T_body_sensor = m_spec.T_body_sensor();
	auto pressure = makeObservation<CObservationPressure>(m_label, stamp, T_body_sensor);
	const double depth = (state.T_map_body * T_body_sensor.translation()).z();
	pressure->pressure = m_spec.pressureAt(depth) + m_spec.sigma * m_noise.normal();
	return pressure;
}

CSimulatedGps::CSimulatedGps(
	const std::string& label, const TGpsSpec& spec, const TSimulatedGpsOptions& options,
	const TWorldOptions& datum, uint64_t seed)
	: m_label(label), m_spec(spec), m_options(options), m_datum(datum), m_noise(seedOf(seed, label))
{
}

mrpt::obs::CObservation::Ptr CSimulatedGps::measure(const TVehicleState& state, double stamp)
{
	const double north = m_noise.normal(),
				 east = m_noise.normal();  // drawn under water too: one pair an instant
	if (state.T_map_body.translation().z() >= m_options.max_depth) return {};
	const Isometry3d T_body_sensor = m_spec.T_body_sensor();
	auto gps = makeObservation<mrpt::obs::CObservationGPS>(m_label, stamp, T_body_sensor);
	const Vector3d antenna = state.T_map_body * T_body_sensor.translation();
	const TGeodetic fix =
		geodeticFromNed(antenna + m_spec.sigma_horizontal * Vector3d(north, east, 0), m_datum);
	mrpt::obs::gnss::Message_NMEA_GGA gga;
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
	gps->setMsg(gga);
	return gps;
}
}  // namespace posidonia
