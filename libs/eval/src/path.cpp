#include <posidonia/eval/path.h>

namespace posidonia
{
using Eigen::Vector3d;

std::vector<double> travelled(const std::vector<Vector3d>& positions)
{
	std::vector<double> distances(positions.size(), 0.0);
	for (size_t i = 1; i < positions.size(); i++)
		distances[i] = distances[i - 1] + (positions[i] - positions[i - 1]).norm();
	return distances;
}

double pathLength(const TTrajectory& trajectory)
{
	if (trajectory.empty()) return 0;
	return pathLength(trajectory, trajectory.front().stamp, trajectory.back().stamp);
}

double pathLength(const TTrajectory& trajectory, double from, double to)
{
	double length = 0;
	for (size_t i = 1; i < trajectory.size(); i++)
		if (trajectory[i - 1].stamp >= from && trajectory[i].stamp <= to)
			length += (trajectory[i].T.translation() - trajectory[i - 1].T.translation()).norm();
	return length;
}

std::vector<Vector3d> truePositions(const TAssociation& poses)
{
	std::vector<Vector3d> positions;
	for (const auto& p : poses)
		positions.push_back(p.T_truth_body.translation());
	return positions;
}

std::vector<Vector3d> estimatedPositions(const TAssociation& poses)
{
	std::vector<Vector3d> positions;
	for (const auto& p : poses)
		positions.push_back(p.T_est_body.translation());
	return positions;
}
}  // namespace posidonia
