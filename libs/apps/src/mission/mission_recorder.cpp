#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationRawDAQ.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/serialization/CArchive.h>
#include <posidonia/apps/mission/mission_recorder.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/trajectory_io.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/register_observations.h>
#include <posidonia/sim/pair_files.h>

#include <filesystem>

namespace posidonia
{
using namespace mrpt::obs;

CMissionRecorder::CMissionRecorder(const std::string& prefix, const TSensorSuite& sensors)
	: m_prefix(prefix),
	  m_rawlog(prefix + ".rawlog"),
	  m_images(imagesFolderOf(m_rawlog)),
	  m_sensors(sensors),
	  m_writer((registerObservations(), m_rawlog))
{
	std::filesystem::remove_all(m_images);	// no picture of an earlier run stays behind
	makeFolder(m_images);
}

CMissionRecorder::~CMissionRecorder()
{
	if (m_compressing.valid()) m_compressing.wait();
}

CObservation::Ptr CMissionRecorder::write(const CObservation& observation)
{
	m_writer.write(observation);
	// What is read back differs in the last bits of its angles: live and replayed runs get the same.
	mrpt::io::CMemoryStream memory;
	auto archive = mrpt::serialization::archiveFrom(memory);
	archive << observation;
	memory.Seek(0);
	return archive.ReadObject<CObservation>();
}

void CMissionRecorder::write(const CObservationStereoImages& pair, const TGreyPair& pictures)
{
	if (m_compressing.valid()) m_compressing.get();
	m_compressing = std::async(
		std::launch::async, [pictures, pair, folder = m_images] { writePictures(pictures, pair, folder); });
}

void CMissionRecorder::writeDepths(const CObservationStereoImages& pair, const cv::Mat1f& depths) const
{
	posidonia::writeDepths(depths, pair, m_images);
}

namespace
{
template <class OBSERVATION>
OBSERVATION labelled(const char* label, double stamp)
{
	OBSERVATION o;
	o.sensorLabel = label;
	o.timestamp = stampFrom(stamp);
	return o;
}
}  // namespace

void CMissionRecorder::write(const TAutopilotOutput& output, const TControlState& navigation)
{
	auto set_points = labelled<CObservationRawDAQ>("THRUSTERS", output.stamp);
	set_points.AOUT_double = {output.set_points.starboard, output.set_points.port, output.set_points.heave};
	m_writer.write(set_points);
	if (navigation.valid) {
		auto pose = labelled<CObservationRobotPose>("CONTROLLER_POSE", output.stamp);
		pose.pose = toMrptGaussian(navigation.T_map_body, navigation.cov);
		m_writer.write(pose);
	}
	for (const TMissionEvent& event : output.events) {
		auto comment = labelled<CObservationComment>("MISSION", event.stamp);
		comment.text = toString(event.kind) + ": " + event.text;
		m_writer.write(comment);
	}
}

void CMissionRecorder::writeTruth(double stamp, const Eigen::Isometry3d& T_map_body)
{
	m_truth.push_back({stamp, T_map_body});
}

void CMissionRecorder::finish()
{
	if (m_compressing.valid()) m_compressing.get();
	writeSensors(sensorsPathOf(m_rawlog), m_sensors);
	writeTum(m_prefix + ".gt.tum", m_truth);
	m_writer.finish();
}
}  // namespace posidonia
