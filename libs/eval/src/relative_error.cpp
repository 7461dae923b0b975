#include <posidonia/eval/path.h>
#include <posidonia/eval/relative_error.h>
#include <posidonia/geometry/se3.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
using Eigen::Isometry3d;

namespace
{
/** Where pieces are cut: metres along the truth, or the index. */
std::vector<double> measure(const std::vector<double>& distances, const std::string& unit)
{
	if (unit == "m") return distances;
	std::vector<double> frames(distances.size());
	for (size_t i = 0; i < frames.size(); i++)
		frames[i] = static_cast<double>(i);
	return frames;
}

Isometry3d pieceError(const TAssociatedPose& i, const TAssociatedPose& j)
{
	const Isometry3d T_i_j_truth = i.T_truth_body.inverse() * j.T_truth_body;
	const Isometry3d T_i_j_est = i.T_est_body.inverse() * j.T_est_body;
	return T_i_j_truth.inverse() * T_i_j_est;
}
}  // namespace

TRelativeError relativeError(const TAssociation& poses, const TRelativeErrorOptions& options)
{
	const std::vector<double> distances = travelled(truePositions(poses));
	const std::vector<double> along = measure(distances, options.unit);
	// Half a frame or a micrometre less: sums of steps that end on delta must reach it.
	const double delta =
		options.unit == "m" ? options.delta - 1e-6 : std::max(0.5, std::round(options.delta) - 0.5);
	std::vector<double> translations, rotations, drifts;
	for (size_t i = 0; i < poses.size(); i++) {
		const auto end =
			std::lower_bound(along.begin() + static_cast<long>(i), along.end(), along[i] + delta);
		if (end == along.end()) break;
		const size_t j = static_cast<size_t>(end - along.begin());
		const Isometry3d E = pieceError(poses[i], poses[j]);
		translations.push_back(E.translation().norm());
		rotations.push_back(logSO3(E.linear()).norm());
		if (distances[j] > distances[i])
			drifts.push_back(translations.back() / (distances[j] - distances[i]));
	}
	return {statistics(translations), statistics(rotations), statistics(drifts)};
}
}  // namespace posidonia
