#include <mrpt/core/format.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/stl_serialization.h>
#include <posidonia/obs/CObservationDVL.h>

#include <limits>

IMPLEMENTS_SERIALIZABLE(CObservationDVL, mrpt::obs::CObservation, posidonia)

namespace posidonia
{
uint8_t CObservationDVL::serializeGetVersion() const
{
	return 0;
}

void CObservationDVL::serializeTo(mrpt::serialization::CArchive& out) const
{
	out << sensorLabel << timestamp << sensorPose;
	out << velocity.x << velocity.y << velocity.z << velocity_valid;
	for (int r = 0; r < 3; r++)
		for (int c = 0; c < 3; c++)
			out << velocity_covariance(r, c);
	out << altitude << altitude_valid << beam_velocities << beam_ranges;
}

void CObservationDVL::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version)
{
	if (version > 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
	in >> sensorLabel >> timestamp >> sensorPose;
	in >> velocity.x >> velocity.y >> velocity.z >> velocity_valid;
	for (int r = 0; r < 3; r++)
		for (int c = 0; c < 3; c++)
			in >> velocity_covariance(r, c);
	in >> altitude >> altitude_valid >> beam_velocities >> beam_ranges;
}

void CObservationDVL::getDescriptionAsText(std::ostream& o) const
{
	CObservation::getDescriptionAsText(o);
	o << "DVL velocity over ground, instrument frame [m/s]: " << velocity.x << " " << velocity.y << " "
	  << velocity.z << (velocity_valid ? " (valid)\n" : " (no bottom lock)\n");
	o << "altitude [m]: " << altitude << (altitude_valid ? " (valid)\n" : " (invalid)\n");
	for (size_t i = 0; i < beam_velocities.size(); i++)
		o << "beam " << i + 1 << ": " << beam_velocities[i] << " m/s\n";
	for (size_t i = 0; i < beam_ranges.size(); i++)
		o << "beam " << i + 1 << ": range " << beam_ranges[i] << " m\n";
	o << "sensor pose on the vehicle: " << sensorPose << "\n";
}

std::string CObservationDVL::exportTxtHeader() const
{
	return mrpt::format(
		"%16s %16s %16s %6s %16s %6s %16s %16s %16s %16s", "v_x", "v_y", "v_z", "valid", "altitude", "valid",
		"b_1", "b_2", "b_3", "b_4");
}

std::string CObservationDVL::exportTxtDataRow() const
{
	std::string row = mrpt::format(
		"%16.9f %16.9f %16.9f %6d %16.9f %6d", velocity.x, velocity.y, velocity.z, velocity_valid ? 1 : 0,
		altitude, altitude_valid ? 1 : 0);
	for (size_t i = 0; i < 4; i++)
		row += mrpt::format(
			" %16.9f",
			i < beam_velocities.size() ? beam_velocities[i] : std::numeric_limits<double>::quiet_NaN());
	return row;
}
}  // namespace posidonia
