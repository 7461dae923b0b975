#include <posidonia/vision/pnp_ransac.h>

#include <opencv2/calib3d.hpp>

namespace posidonia
{
namespace
{
/** A P3P sample and three points that confirm it. */
constexpr int LEAST_CONSENSUS = 6;

cv::UsacParams usacParams(const TRansacOptions& o)
{
	cv::UsacParams p;
	p.confidence = o.confidence;
	p.isParallel = false;
	p.loIterations = 5;
	p.loMethod = cv::LOCAL_OPTIM_INNER_LO;
	p.loSampleSize = 14;
	p.maxIterations = o.max_iterations;
	p.randomGeneratorState = static_cast<int>(o.seed & 0x7fffffff);
	p.sampler = cv::SAMPLING_UNIFORM;
	p.score = o.method == "USAC_MAGSAC" ? cv::SCORE_METHOD_MAGSAC : cv::SCORE_METHOD_MSAC;
	p.threshold = o.threshold;
	return p;
}

Eigen::Isometry3d poseOf(const cv::Mat& rvec, const cv::Mat& tvec)
{
	const auto vector = [](const cv::Mat& m) {
		return Eigen::Vector3d(m.at<double>(0), m.at<double>(1), m.at<double>(2));
	};
	Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
	const Eigen::Vector3d r = vector(rvec);
	if (r.norm() > 0) T.linear() = Eigen::AngleAxisd(r.norm(), r.normalized()).toRotationMatrix();
	T.translation() = vector(tvec);
	return T;
}
}  // namespace

std::optional<Eigen::Isometry3d> ransacPnP(
	const TStereoCamera& camera, const TKeyFrame& a, const TKeyFrame& b,
	const std::vector<std::pair<int, int>>& matches, const TRansacOptions& options)
{
	if (static_cast<int>(matches.size()) < LEAST_CONSENSUS) return {};
	std::vector<cv::Point3d> points;
	std::vector<cv::Point2d> pixels;
	for (const auto& [i, j] : matches) {
		const Eigen::Vector3d &p = a.points[i].point, &q = b.points[j].uvr;
		points.emplace_back(p.x(), p.y(), p.z());
		pixels.emplace_back(q.x(), q.y());
	}
	cv::Mat K = (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
	cv::Mat rvec, tvec;
	std::vector<int> consensus;
	bool found = false;
	try {
		found =
			cv::solvePnPRansac(points, pixels, K, cv::noArray(), rvec, tvec, consensus, usacParams(options));
	}
	catch (const cv::Exception&) {
		return {};	// USAC throws instead of answering when no sample of it gives a model.
	}
	if (!found || static_cast<int>(consensus.size()) < LEAST_CONSENSUS) return {};
	if (!cv::checkRange(rvec) || !cv::checkRange(tvec)) return {};
	return poseOf(rvec, tvec).inverse();
}
}  // namespace posidonia
