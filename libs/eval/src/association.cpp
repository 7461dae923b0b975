#include <posidonia/base/error.h>
#include <posidonia/eval/association.h>
#include <posidonia/eval/number_text.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace posidonia
{
using Eigen::Isometry3d;

Isometry3d interpolate(const Isometry3d& A, const Isometry3d& B, double s)
{
	const Eigen::Quaterniond qa(A.linear()), qb(B.linear());
	Isometry3d T = Isometry3d::Identity();
	T.linear() = qa.slerp(s, qb).normalized().toRotationMatrix();
	T.translation() = (1 - s) * A.translation() + s * B.translation();
	return T;
}

namespace
{
void requireOrder(const TTrajectory& trajectory, const std::string& name)
{
	for (size_t i = 1; i < trajectory.size(); i++)
		if (trajectory[i].stamp < trajectory[i - 1].stamp)
			throw CError(
				name + ", pose " + std::to_string(i), "its stamp is before the previous one's",
				"sort the poses by time");
}

std::string span(const TTrajectory& trajectory)
{
	if (trajectory.empty()) return "nothing";
	return fixedText(trajectory.front().stamp, 3) + " ... " + fixedText(trajectory.back().stamp, 3) + " s";
}

/** The truth as a function of time. */
class CTruthAtTime
{
   public:
	CTruthAtTime(const TTrajectory& truth, const TAssociationOptions& options)
		: m_truth(truth), m_options(options)
	{
	}

	std::optional<Isometry3d> at(double stamp) const
	{
		const auto after = std::lower_bound(
			m_truth.begin(), m_truth.end(), stamp,
			[](const TStampedPose& p, double t) { return p.stamp < t; });
		if (m_options.method == "interpolate")
			if (const auto T = between(after, stamp)) return T;
		return nearest(after, stamp);
	}

   private:
	using TIterator = TTrajectory::const_iterator;

	/** `after`: the first true pose not before the stamp. */
	std::optional<Isometry3d> between(TIterator after, double stamp) const
	{
		if (after == m_truth.end()) return {};
		if (after->stamp == stamp) return after->T;
		if (after == m_truth.begin()) return {};
		const auto before = std::prev(after);
		const double gap = after->stamp - before->stamp;
		if (gap > m_options.max_gap) return {};
		return interpolate(before->T, after->T, (stamp - before->stamp) / gap);
	}

	std::optional<Isometry3d> nearest(TIterator after, double stamp) const
	{
		const TStampedPose* best = after == m_truth.end() ? nullptr : &*after;
		if (after != m_truth.begin()) {
			const auto before = std::prev(after);
			if (!best || stamp - before->stamp < best->stamp - stamp) best = &*before;
		}
		if (!best || std::abs(best->stamp - stamp) > m_options.max_dt) return {};
		return best->T;
	}

	const TTrajectory& m_truth;
	const TAssociationOptions& m_options;
};
}  // namespace

TAssociation associate(
	const TTrajectory& estimate, const TTrajectory& truth, const TAssociationOptions& options)
{
	requireOrder(estimate, "estimate");
	requireOrder(truth, "truth");
	const CTruthAtTime truth_at(truth, options);
	TAssociation poses;
	for (size_t i = 0; i < estimate.size(); i++)
		if (const auto T_truth_body = truth_at.at(estimate[i].stamp))
			poses.push_back({estimate[i].stamp, i, *T_truth_body, estimate[i].T});
	if (poses.empty())
		throw CError(
			"association",
			"no pose of the estimate (" + span(estimate) + ") has a true one (" + span(truth) + ")",
			"are both of the same run and on the same clock? else raise association_max_gap or "
			"association_max_dt");
	return poses;
}
}  // namespace posidonia
