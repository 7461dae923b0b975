#pragma once

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPoint3D.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include <vector>

namespace posidonia
{
/** One ping of a Doppler velocity log in bottom track.
 * Velocities are those of the instrument over the ground, in the instrument's own frame. */
class CObservationDVL : public mrpt::obs::CObservation
{
	DEFINE_SERIALIZABLE(CObservationDVL, posidonia)

   public:
	mrpt::math::TVector3D velocity{0, 0, 0};  ///< Over ground, instrument frame [m/s]
	bool velocity_valid{false};				  ///< Bottom lock?
	/** Covariance of `velocity` [(m/s)^2]; all zero: not known, take that of sensors.ini. */
	mrpt::math::CMatrixDouble33 velocity_covariance;
	double altitude{0};	 ///< Height of the instrument over the ground [m]
	bool altitude_valid{false};
	/** Velocity along each beam, positive towards the ground [m/s]; NaN: beam lost; empty: not known. */
	std::vector<double> beam_velocities;
	/** Slant range of each beam [m]; NaN: beam lost; empty: not known. */
	std::vector<double> beam_ranges;
	mrpt::poses::CPose3D sensorPose;  ///< T_body_dvl

	void getSensorPose(mrpt::poses::CPose3D& out) const override { out = sensorPose; }
	void setSensorPose(const mrpt::poses::CPose3D& pose) override { sensorPose = pose; }
	void getDescriptionAsText(std::ostream& o) const override;
	bool exportTxtSupported() const override { return true; }
	std::string exportTxtHeader() const override;
	std::string exportTxtDataRow() const override;
};
}  // namespace posidonia
