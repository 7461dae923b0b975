#include <mrpt/core/format.h>
#include <mrpt/serialization/CArchive.h>
#include <posidonia/obs/CObservationPressure.h>

IMPLEMENTS_SERIALIZABLE(CObservationPressure, mrpt::obs::CObservation, posidonia)

namespace posidonia
{
uint8_t CObservationPressure::serializeGetVersion() const
{
	return 0;
}

void CObservationPressure::serializeTo(mrpt::serialization::CArchive& out) const
{
	out << sensorLabel << timestamp << sensorPose << pressure;
}

void CObservationPressure::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version)
{
	if (version > 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
	in >> sensorLabel >> timestamp >> sensorPose >> pressure;
}

void CObservationPressure::getDescriptionAsText(std::ostream& o) const
{
	CObservation::getDescriptionAsText(o);
	o << "absolute pressure [Pa]: " << pressure << "\n";
	o << "sensor pose on the vehicle: " << sensorPose << "\n";
}

std::string CObservationPressure::exportTxtHeader() const
{
	return mrpt::format("%18s", "pressure");
}
std::string CObservationPressure::exportTxtDataRow() const
{
	return mrpt::format("%18.6f", pressure);
}
}  // namespace posidonia
