#pragma once

#include <mrpt/obs/CObservation.h>
#include <posidonia/control/autopilot.h>
#include <posidonia/geometry/trajectory.h>
#include <posidonia/obs/observations.h>
#include <posidonia/obs/rawlog_writer.h>

#include <future>
#include <string>

namespace posidonia
{
/** Writes what a mission measured and did: <prefix>.rawlog with <prefix>_Images/, <prefix>.sensors.ini and
 * <prefix>.gt.tum. Pictures are compressed on another thread, the bytes do not depend on it. */
class CMissionRecorder
{
   public:
	CMissionRecorder(const std::string& prefix, const TSensorSuite& sensors);
	~CMissionRecorder();

	/** An observation as the log holds it, and as it comes back out of the log. */
	mrpt::obs::CObservation::Ptr write(const mrpt::obs::CObservation& observation);
	/** The pictures of a stereo pair that was written. */
	void write(const mrpt::obs::CObservationStereoImages& pair, const TGreyPair& pictures);
	/** True depths of its left picture [m], as a picture beside it. */
	void writeDepths(const mrpt::obs::CObservationStereoImages& pair, const cv::Mat1f& depths) const;
	/** Set-points as CObservationRawDAQ, the controllers' pose as CObservationRobotPose, events as
	 * CObservationComment. */
	void write(const TAutopilotOutput& output, const TControlState& navigation);
	void writeTruth(double stamp, const Eigen::Isometry3d& T_map_body);
	/** Until then, nothing has its name. */
	void finish();

	const std::string& rawlog() const { return m_rawlog; }
	const TTrajectory& truth() const { return m_truth; }

   private:
	std::string m_prefix, m_rawlog, m_images;
	TSensorSuite m_sensors;
	CRawlogWriter m_writer;
	TTrajectory m_truth;
	std::future<void> m_compressing;
};
}  // namespace posidonia
