#include <posidonia/apps/report_files.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/trajectory_io.h>
#include <posidonia/graphslam/loop_candidates.h>
#include <posidonia/report/run_report.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

namespace posidonia
{
namespace
{
constexpr const char* kPictures = "loops";	///< Folder of the nodes' pictures
}

CNodePictures::CNodePictures(const CRunFolder& folder, bool wanted)
	: m_folder(folder.path()), m_wanted(wanted)
{
	std::filesystem::remove_all(folder.file(kPictures));  // no picture of an earlier run stays behind
	if (wanted) makeFolder(folder.file(kPictures));
}

CNodePictures::~CNodePictures()
{
	if (m_writing.valid()) m_writing.wait();
}

void CNodePictures::add(const CStereoSlam& slam)
{
	if (!m_wanted || !slam.addedNode()) return;
	m_files.resize(static_cast<size_t>(slam.map().nodeCount()));
	const cv::Mat left = slam.lastPictures().left;
	if (left.empty() || !slam.map().node(slam.map().lastNode()).key_frame) return;
	if (m_writing.valid()) m_writing.get();
	m_files.back() = mrpt::format("%s/%06d.jpg", kPictures, slam.map().lastNode());
	m_writing = std::async(std::launch::async, [left, path = m_folder + "/" + m_files.back()] {
		if (!cv::imwrite(path, left, {cv::IMWRITE_JPEG_QUALITY, 85}))
			throw CError(path, "can't be written", "is the disk full?");
	});
}

const std::vector<std::string>& CNodePictures::files()
{
	if (m_writing.valid()) m_writing.get();
	return m_files;
}

namespace
{
std::vector<TNodeRow> nodeRows(const CStereoSlam& slam, const std::vector<std::string>& pictures)
{
	const CSlamMap& map = slam.map();
	const std::vector<Matrix6d> covariances = slam.nodeCovariances();
	std::vector<TNodeRow> rows;
	for (int i = 0; i < map.nodeCount(); i++) {
		TNodeRow row;
		row.node = i;
		row.stamp = map.node(i).stamp;
		row.T_map_body = map.pose(i);
		row.covariance = covarianceInMap(row.T_map_body, covariances[static_cast<size_t>(i)]);
		if (const auto& frame = map.node(i).key_frame) {
			row.points = static_cast<int>(frame->size());
			row.altitude = medianDepth(*frame);
		}
		if (static_cast<size_t>(i) < pictures.size()) row.picture = pictures[static_cast<size_t>(i)];
		rows.push_back(row);
	}
	return rows;
}

/** An edge's part of the chi-square, by the poses of now. */
double chi2Of(const TSlamEdge& edge, const CSlamMap& map)
{
	const Vector6d e = localCoordinates(edge.T_from_to, map.relativePose(edge.from, edge.to));
	return edge.share * e.dot(edge.information * e);
}

TMatchesRow matchesOf(const TSlamEdge& edge, const CSlamMap& map)
{
	constexpr size_t kMost = 48;  // enough to see them; all of them would be as large as the pictures
	TMatchesRow row{edge.from, edge.to, chi2Of(edge, map), {}};
	const auto at = [&](int node, int point) {
		return Eigen::Vector2d(map.node(node).key_frame->points[static_cast<size_t>(point)].uvr.head<2>());
	};
	const size_t step = std::max<size_t>(1, (edge.points.size() + kMost - 1) / kMost);
	for (size_t k = 0; k < edge.points.size(); k += step)
		row.points.emplace_back(at(edge.from, edge.points[k].first), at(edge.to, edge.points[k].second));
	return row;
}
}  // namespace

void writeMapFiles(
	const CRunFolder& folder, const CStereoSlam& slam, const std::vector<std::string>& pictures)
{
	folder.write("poses.csv", nodesCsv(nodeRows(slam, pictures)));
	std::vector<TMatchesRow> matches;
	for (const TSlamEdge& edge : slam.map().edges())
		if (edge.kind != EEdgeKind::ODOMETRY) matches.push_back(matchesOf(edge, slam.map()));
	folder.write("matches.csv", matchesCsv(matches));
}

void writeSensorCounts(const CRunFolder& folder, const COdometrySource& odometry, double duration)
{
	std::vector<TSensorRow> rows;
	for (const auto& [label, n] : navigationCounts(odometry)) {
		TSensorRow row{
			label, n.used, duration > 0 ? static_cast<double>(n.used) / duration : 0, n.longest_gap, {}};
		const auto count = [&](const char* reason, size_t times) {
			if (times > 0) row.rejected[reason] = times;
		};
		count("gated", n.gated);
		count("inconsistent beams", n.inconsistent);
		count("invalid", n.invalid);
		count("duplicate stamps", n.duplicate);
		count("jumped stamps", n.jumped);
		count("too late", n.late);
		count("idle", n.idle);
		rows.push_back(row);
	}
	folder.write("sensors.csv", sensorsCsv(rows));
}

void writeRunInfo(const CRunFolder& folder, const TRunInfo& info)
{
	folder.write("run.json", runInfoJson(info));
}

std::string copyTruth(const CRunFolder& folder, const std::string& truth_file, double start, double end)
{
	if (truth_file.empty()) return {};
	constexpr double kMargin = 1;  // [s]: interpolation needs a pose on either side
	TTrajectory during;
	for (const TStampedPose& pose : readTum(truth_file))
		if (pose.stamp >= start - kMargin && pose.stamp <= end + kMargin) during.push_back(pose);
	if (during.empty()) return {};
	writeTum(folder.file("truth.tum"), during);
	return "truth.tum";
}

void finishReport(CRunFolder& folder, const TReportOptions& options, int verbosity)
{
	folder.finish();
	if (!options.page) return;
	folder.log("report: " + writeReport(readRun(folder.path()), folder.path()), verbosity);
	folder.finish();
}
}  // namespace posidonia
