#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/base/error.h>
#include <posidonia/nav/reading_decoder.h>
#include <posidonia/obs/observations.h>

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace mrpt::obs;

CReadingDecoder::CReadingDecoder(std::shared_ptr<const TNavigatorSetup> setup)
	: m_setup(std::move(setup)), m_counts(m_setup->sensor.size())
{
}

void CReadingDecoder::decode(const CObservation& o)
{
	if (const auto* imu = dynamic_cast<const CObservationIMU*>(&o))
		decodeImu(*imu);
	else if (const auto* dvl = dynamic_cast<const CObservationDVL*>(&o))
		decodeDvl(*dvl);
	else if (const auto* pressure = dynamic_cast<const CObservationPressure*>(&o))
		decodePressure(*pressure);
	else if (const auto* gps = dynamic_cast<const CObservationGPS*>(&o))
		decodeGps(*gps);
	else if (dynamic_cast<const CObservationStereoImages*>(&o))
		push(stampOf(o), m_setup->indexOf(o.sensorLabel), TTick{});
}

template <class WHAT>
void CReadingDecoder::push(double stamp, int sensor, const WHAT& what)
{
	m_readings[m_count++] = {stamp, sensor, what};
}

template <class SPEC>
int CReadingDecoder::entryOf(const CObservation& o, const std::map<std::string, SPEC>& entries) const
{
	specOf(entries, o.sensorLabel);
	return m_setup->indexOf(o.sensorLabel);
}

void CReadingDecoder::decodeImu(const CObservationIMU& imu)
{
	const int i = m_setup->indexOf(imu.sensorLabel);
	const TNavigatorSetup::TSensor* sensor = i < 0 ? nullptr : &m_setup->sensor[static_cast<size_t>(i)];
	if (!sensor || (!sensor->imu && !sensor->ahrs))
		throw CError(
			"sensor '" + imu.sensorLabel + "'", "has no entry of kind imu or ahrs in the sensors.ini",
			"add a section [" + imu.sensorLabel + "], or give --assume-defaults");
	if (sensor->imu) {
		const auto reading = imuReadingOf(imu);
		const Matrix3d R_body_sensor = sensor->imu->T_body_sensor().linear();
		if (reading && reading->rate.allFinite() && reading->force.allFinite())
			push(
				stampOf(imu), i,
				TInertialReading{R_body_sensor * reading->rate, R_body_sensor * reading->force});
		else
			count(i).invalid++;
	}
	if (sensor->ahrs) {
		const auto R_map_sensor = attitudeOf(imu);
		const Matrix3d R_map_magnetic = rotationFromYawPitchRoll(sensor->ahrs->declination, 0, 0);
		if (R_map_sensor && R_map_sensor->allFinite())
			push(
				stampOf(imu), i,
				TAttitudeReading{
					R_map_magnetic * *R_map_sensor * sensor->ahrs->T_body_sensor().linear().transpose()});
		else
			count(i).invalid++;
	}
}

namespace
{
/** The observation's own covariance, or that of sensors.ini where it states none: in the instrument's axes,
 * its z along the axis of the beams. */
Matrix3d velocityCovariance(const CObservationDVL& dvl, const TDvlSpec& spec)
{
	const Matrix3d stated = dvl.velocity_covariance.asEigen();
	if (!stated.isZero(0)) return stated;
	return Vector3d(spec.sigma_velocity, spec.sigma_velocity, spec.sigmaAlong()).cwiseAbs2().asDiagonal();
}

/** The beams that were received; NaN for the others. */
Eigen::Vector4d beamsOf(const CObservationDVL& dvl, double max_speed)
{
	Eigen::Vector4d beams = Eigen::Vector4d::Constant(std::nan(""));
	if (dvl.beam_velocities.size() == 4)
		for (int i = 0; i < 4; i++) {
			const double v = dvl.beam_velocities[static_cast<size_t>(i)];
			if (std::abs(v) <= max_speed) beams[i] = v;
		}
	return beams;
}
}  // namespace

void CReadingDecoder::decodeDvl(const CObservationDVL& dvl)
{
	const int i = entryOf(dvl, m_setup->sensors.dvl);
	const TEkfOptions& o = m_setup->options;
	TDvlReading r;
	r.velocity = {dvl.velocity.x, dvl.velocity.y, dvl.velocity.z};
	r.has_velocity =
		dvl.velocity_valid && r.velocity.allFinite() && r.velocity.cwiseAbs().maxCoeff() <= o.max_dvl_speed;
	r.cov = velocityCovariance(dvl, *m_setup->sensor[static_cast<size_t>(i)].dvl);
	r.beams = beamsOf(dvl, o.max_dvl_speed);
	const bool any_beam = !(r.beams.array() != r.beams.array()).all();
	if (o.dvl == "beams" ? any_beam : r.has_velocity || (o.dvl == "auto" && any_beam && !dvl.velocity_valid))
		push(stampOf(dvl), i, r);
	else
		count(i).invalid++;
}

void CReadingDecoder::decodePressure(const CObservationPressure& pressure)
{
	const int i = entryOf(pressure, m_setup->sensors.pressure);
	const double depth = m_setup->sensor[static_cast<size_t>(i)].pressure->depth(pressure.pressure);
	if (std::isfinite(depth))
		push(stampOf(pressure), i, TDepthReading{depth});
	else
		count(i).invalid++;
}

namespace
{
/** Latitude and longitude of a fix; height is left at 0: depth never passes through GPS. */
std::optional<TGeodetic> fixOf(const CObservationGPS& gps)
{
	if (!gps.has_GGA_datum()) return {};
	const auto& gga = gps.getMsgByClass<gnss::Message_NMEA_GGA>().fields;
	const TGeodetic fix{gga.latitude_degrees, gga.longitude_degrees, 0};
	if (gga.fix_quality == 0 || !std::isfinite(fix.latitude) || !std::isfinite(fix.longitude)) return {};
	return fix;
}
}  // namespace

void CReadingDecoder::decodeGps(const CObservationGPS& gps)
{
	const int i = entryOf(gps, m_setup->sensors.gps);
	if (const auto fix = fixOf(gps))
		push(stampOf(gps), i, TFixReading{nedFromGeodetic(*fix, m_setup->datum).head<2>()});
	else
		count(i).invalid++;
}
}  // namespace posidonia
