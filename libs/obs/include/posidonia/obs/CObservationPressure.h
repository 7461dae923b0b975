#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

namespace posidonia
{
/** Absolute water pressure at the sensor. Depth = (pressure - surface pressure) / (density * g). */
class CObservationPressure : public mrpt::obs::CObservation
{
	DEFINE_SERIALIZABLE(CObservationPressure, posidonia)

   public:
	double pressure{0};				  ///< Absolute [Pa]
	mrpt::poses::CPose3D sensorPose;  ///< T_body_pressure

	void getSensorPose(mrpt::poses::CPose3D& out) const override { out = sensorPose; }
	void setSensorPose(const mrpt::poses::CPose3D& pose) override { sensorPose = pose; }
	void getDescriptionAsText(std::ostream& o) const override;
	bool exportTxtSupported() const override { return true; }
	std::string exportTxtHeader() const override;
	std::string exportTxtDataRow() const override;
};
}  // namespace posidonia
