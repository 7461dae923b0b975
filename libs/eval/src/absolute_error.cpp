#include <posidonia/eval/absolute_error.h>
#include <posidonia/eval/path.h>
#include <posidonia/geometry/se3.h>

namespace posidonia
{
namespace
{
TPoseError poseError(const TAssociatedPose& pose, const Eigen::Isometry3d& T_truth_est, double distance)
{
	const Eigen::Isometry3d T_estimated = T_truth_est * pose.T_est_body;
	TPoseError e;
	e.stamp = pose.stamp;
	e.distance = distance;
	e.error = T_estimated.translation() - pose.T_truth_body.translation();
	e.translation = e.error.norm();
	e.rotation = logSO3(pose.T_truth_body.linear().transpose() * T_estimated.linear()).norm();
	return e;
}
}  // namespace

TAbsoluteError absoluteError(const TAssociation& poses, EAlignment kind)
{
	TAbsoluteError result;
	result.alignment = kind;
	result.T_truth_est = align(kind, poses);
	const std::vector<double> distances = travelled(truePositions(poses));
	std::vector<double> translations, rotations;
	for (size_t i = 0; i < poses.size(); i++) {
		result.poses.push_back(poseError(poses[i], result.T_truth_est, distances[i]));
		translations.push_back(result.poses.back().translation);
		rotations.push_back(result.poses.back().rotation);
	}
	result.translation = statistics(translations);
	result.rotation = statistics(rotations);
	return result;
}
}  // namespace posidonia
