#pragma once

#include <posidonia/geometry/se3.h>
#include <posidonia/vision/key_frame.h>
#include <posidonia/vision/registration_options.h>

#include <string>
#include <utility>
#include <vector>

namespace posidonia
{
/** Why a registration ended as it did; reports count them. */
enum class ERegistrationStatus
{
	ACCEPTED,
	TOO_FEW_POINTS,	 ///< A key frame has fewer points than matches are asked for
	TOO_FEW_MATCHES,
	RANSAC_FAILED,		///< No consensus
	REFINEMENT_FAILED,	///< No convergence
	TOO_FEW_INLIERS,
	RMSE_TOO_LARGE,
	CLUSTERED,	 ///< Inliers on a line or in a spot of the image
	DEGENERATE,	 ///< Information not positive definite
};

/** "accepted", "too few matches" ... */
std::string toString(ERegistrationStatus status);
/** All of them, in the order of the checks. */
const std::vector<ERegistrationStatus>& allRegistrationStatuses();

/** Outcome of a registration. Pose and information count only when accepted() (what was reached is kept for
 * audit). */
struct TRegistration
{
	ERegistrationStatus status{ERegistrationStatus::TOO_FEW_POINTS};
	Eigen::Isometry3d T_a_b{Eigen::Isometry3d::Identity()};	 ///< Left camera of b to left camera of a
	Matrix6d information{Matrix6d::Zero()};	 ///< Of T_a_b, (rho, phi) in its own frame, see geometry/se3.h
	int matches{0}, inliers{0};
	double rmse_px{0};	///< Root mean square of the inliers' left-image residuals in both views, an axis [px]
	double chi2{0};		///< Sum over the inliers; about 3 inliers - 6 when the stated noise is right
	double spread_px{0};  ///< Smaller of both views' narrower standard deviations of the inliers [px]
	std::vector<std::pair<int, int>> inlier_pairs;	///< (point of a, point of b)

	bool accepted() const { return status == ERegistrationStatus::ACCEPTED; }
	int dof() const { return 3 * inliers - 6; }
};

/** Registers two key frames: reciprocal matches, PnP RANSAC, refinement of pose and points on all four
 * images, information, gates (paper, section 3.2; README). Deterministic; safe to call from many threads. */
class CStereoRegistration
{
   public:
	CStereoRegistration(const TRegistrationOptions& options, const TStereoCamera& camera);

	/** @param seed added to the option's seed, e.g. from the pair's ids */
	TRegistration align(const TKeyFrame& a, const TKeyFrame& b, unsigned seed = 0) const;

	/** Matches one to one in position, too: two descriptors of one place (SIFT's orientations) vote once. */
	std::vector<std::pair<int, int>> match(const TKeyFrame& a, const TKeyFrame& b) const;

	/** The steps after matching, from given pairs (point of a, point of b), in the given direction. */
	TRegistration alignMatches(
		const TKeyFrame& a, const TKeyFrame& b, const std::vector<std::pair<int, int>>& matches,
		unsigned seed) const;

	const TRegistrationOptions& options() const { return m_options; }

   private:
	void summarise(
		class CTwoViewRefinement& refinement, const TKeyFrame& a, const TKeyFrame& b,
		const std::vector<std::pair<int, int>>& matches, TRegistration& r) const;
	ERegistrationStatus judge(const TRegistration& r) const;

	TRegistrationOptions m_options;
	TStereoCamera m_camera;
	double m_efficiency;  // of the robust loss
};
}  // namespace posidonia
