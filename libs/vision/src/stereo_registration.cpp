#include <posidonia/base/error.h>
#include <posidonia/vision/descriptor_matching.h>
#include <posidonia/vision/pnp_ransac.h>
#include <posidonia/vision/stereo_registration.h>
#include <posidonia/vision/two_view_refinement.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace posidonia
{
namespace
{
/** Degrees of freedom of a point's residual: 6 measurements less its 3 coordinates. */
constexpr int POINT_DOF = 3;

/** An order of key frames by content, so that both directions of a pair solve the same problem. */
bool before(const TKeyFrame& a, const TKeyFrame& b)
{
	return std::lexicographical_compare(
		a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
		[](const TStereoPoint& p, const TStereoPoint& q) {
			return std::lexicographical_compare(
				p.uvr.data(), p.uvr.data() + 3, q.uvr.data(), q.uvr.data() + 3);
		});
}

TRegistration inverted(TRegistration r)
{
	// Information of the inverse: cov' = Ad(T) cov Ad(T)^T.
	const Matrix6d A = adjoint(r.T_a_b.inverse());
	const Matrix6d I = A.transpose() * r.information * A;
	r.information = 0.5 * (I + I.transpose());
	r.T_a_b = r.T_a_b.inverse();
	for (auto& [i, j] : r.inlier_pairs)
		std::swap(i, j);
	std::sort(r.inlier_pairs.begin(), r.inlier_pairs.end());
	return r;
}

/** Standard deviation of pixels along their narrower axis. */
double narrowSpread(const std::vector<Eigen::Vector2d>& pixels)
{
	if (pixels.empty()) return 0;
	const double n = static_cast<double>(pixels.size());
	Eigen::Vector2d mean = Eigen::Vector2d::Zero();
	for (const auto& p : pixels)
		mean += p / n;
	Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
	for (const auto& p : pixels)
		second += (p - mean) * (p - mean).transpose() / n;
	const double half = 0.5 * second.trace(),
				 root = std::hypot(0.5 * (second(0, 0) - second(1, 1)), second(0, 1));
	return std::sqrt(std::max(0.0, half - root));
}

double spread(const TKeyFrame& a, const TKeyFrame& b, const std::vector<std::pair<int, int>>& pairs)
{
	std::vector<Eigen::Vector2d> in_a, in_b;
	for (const auto& [i, j] : pairs) {
		in_a.emplace_back(a.points[i].uvr.head<2>());
		in_b.emplace_back(b.points[j].uvr.head<2>());
	}
	return std::min(narrowSpread(in_a), narrowSpread(in_b));
}
}  // namespace

std::string toString(ERegistrationStatus status)
{
	static const std::map<ERegistrationStatus, std::string> TEXT{
		{ERegistrationStatus::ACCEPTED, "accepted"},
		{ERegistrationStatus::TOO_FEW_POINTS, "too few points"},
		{ERegistrationStatus::TOO_FEW_MATCHES, "too few matches"},
		{ERegistrationStatus::RANSAC_FAILED, "RANSAC failed"},
		{ERegistrationStatus::REFINEMENT_FAILED, "refinement failed"},
		{ERegistrationStatus::TOO_FEW_INLIERS, "too few inliers"},
		{ERegistrationStatus::RMSE_TOO_LARGE, "RMSE too large"},
		{ERegistrationStatus::CLUSTERED, "inliers clustered"},
		{ERegistrationStatus::DEGENERATE, "degenerate"}};
	return TEXT.at(status);
}

const std::vector<ERegistrationStatus>& allRegistrationStatuses()
{
	static const std::vector<ERegistrationStatus> ALL{
		ERegistrationStatus::ACCEPTED,			ERegistrationStatus::TOO_FEW_POINTS,
		ERegistrationStatus::TOO_FEW_MATCHES,	ERegistrationStatus::RANSAC_FAILED,
		ERegistrationStatus::REFINEMENT_FAILED, ERegistrationStatus::TOO_FEW_INLIERS,
		ERegistrationStatus::RMSE_TOO_LARGE,	ERegistrationStatus::CLUSTERED,
		ERegistrationStatus::DEGENERATE};
	return ALL;
}

CStereoRegistration::CStereoRegistration(const TRegistrationOptions& options, const TStereoCamera& camera)
	: m_options(options),
	  m_camera(camera),
	  m_efficiency(TTukeyLoss{options.point_cutoff}.efficiency(POINT_DOF))
{
}

std::vector<std::pair<int, int>> CStereoRegistration::match(const TKeyFrame& a, const TKeyFrame& b) const
{
	if (a.binary != b.binary || (a.size() && b.size() && a.descriptors.cols != b.descriptors.cols))
		throw CError(
			"registration", "two key frames with different descriptors", "use one detector in a run");
	auto all = matchReciprocal(a.descriptors, b.descriptors, a.binary, m_options.match_ratio);
	std::stable_sort(
		all.begin(), all.end(), [](const auto& m, const auto& n) { return m.distance < n.distance; });
	std::set<std::pair<double, double>> taken_a, taken_b;
	std::vector<std::pair<int, int>> kept;
	for (const TDescriptorMatch& m : all) {
		const Eigen::Vector3d &p = a.points[m.a].uvr, &q = b.points[m.b].uvr;
		const bool new_in_a = taken_a.emplace(p.x(), p.y()).second,
				   new_in_b = taken_b.emplace(q.x(), q.y()).second;
		if (new_in_a && new_in_b) kept.emplace_back(m.a, m.b);
	}
	std::sort(kept.begin(), kept.end());
	return kept;
}

TRegistration CStereoRegistration::align(const TKeyFrame& a, const TKeyFrame& b, unsigned seed) const
{
	TRegistration r;
	if (static_cast<int>(std::min(a.size(), b.size())) < m_options.min_matches) return r;
	if (m_options.canonical_order && before(b, a)) return inverted(alignMatches(b, a, match(b, a), seed));
	return alignMatches(a, b, match(a, b), seed);
}

TRegistration CStereoRegistration::alignMatches(
	const TKeyFrame& a, const TKeyFrame& b, const std::vector<std::pair<int, int>>& matches,
	unsigned seed) const
{
	TRegistration r;
	r.matches = static_cast<int>(matches.size());
	r.status = ERegistrationStatus::TOO_FEW_MATCHES;
	if (r.matches < m_options.min_matches) return r;

	const TRansacOptions ransac{
		m_options.ransac, m_options.ransac_threshold, m_options.ransac_confidence,
		m_options.ransac_iterations, m_options.ransac_seed + seed};
	const auto start = ransacPnP(m_camera, a, b, matches, ransac);
	r.status = ERegistrationStatus::RANSAC_FAILED;
	if (!start) return r;

	CTwoViewRefinement refinement(m_camera, a, b, matches);
	r.status = ERegistrationStatus::REFINEMENT_FAILED;
	if (!refinement.solve(*start, TTukeyLoss{m_options.point_cutoff}, r.T_a_b)) return r;
	summarise(refinement, a, b, matches, r);
	r.status = judge(r);
	return r;
}

void CStereoRegistration::summarise(
	CTwoViewRefinement& refinement, const TKeyFrame& a, const TKeyFrame& b,
	const std::vector<std::pair<int, int>>& matches, TRegistration& r) const
{
	const auto& chi2 = refinement.chi2(r.T_a_b);
	double squares = 0;
	for (int k = 0; k < r.matches; k++) {
		if (chi2[k] > 0.5 * m_options.point_cutoff) continue;
		r.inlier_pairs.push_back(matches[k]);
		r.chi2 += chi2[k];
		r.information += refinement.information(r.T_a_b, k);
		const Vector6d e = refinement.residual(r.T_a_b, k);
		squares += e.head<2>().squaredNorm() + e.segment<2>(3).squaredNorm();
	}
	r.information *= m_efficiency;
	r.inliers = static_cast<int>(r.inlier_pairs.size());
	// The variance of unit weight a posteriori: this floor, this water.
	if (m_options.scale_by_residuals && r.chi2 > r.dof() && r.dof() > 0) r.information *= r.dof() / r.chi2;
	if (r.inliers) r.rmse_px = std::sqrt(squares / (4.0 * r.inliers));
	r.spread_px = spread(a, b, r.inlier_pairs);
}

ERegistrationStatus CStereoRegistration::judge(const TRegistration& r) const
{
	if (r.inliers < m_options.min_inliers) return ERegistrationStatus::TOO_FEW_INLIERS;
	if (r.rmse_px > m_options.max_rmse) return ERegistrationStatus::RMSE_TOO_LARGE;
	if (r.spread_px < m_options.min_spread) return ERegistrationStatus::CLUSTERED;
	if (!isPositiveDefinite(r.information)) return ERegistrationStatus::DEGENERATE;
	return ERegistrationStatus::ACCEPTED;
}
}  // namespace posidonia
