#pragma once

#include <Eigen/Dense>
#include <vector>

namespace posidonia
{
/** Contrast that falls towards the corners (vignetting, a longer way through the water): contrast ~
 * exp(slope rho^2), rho = 1 in the corners. It pulls key points towards the brighter side (README, section
 * 1). */
class CLightFall
{
   public:
	/** Size of the picture [px]. */
	CLightFall(int width, int height);

	/** A spot of the floor in both pictures. */
	struct TSample
	{
		Eigen::Vector3d uvr;  ///< (u_left, v, u_right) [px]
		double contrast;	  ///< Left over right
	};
	/** The slope that the contrasts of the same spots at different places of the left and right pictures
	 * tell: whatever lies on the floor drops out. With few or useless samples it is near 0, what light does
	 * without a measurement being taken as 0 +- 0.5. Robust. */
	double slopeOf(const std::vector<TSample>& samples) const;

	/** By how much SIFT's key point at a place of this octave [px] is pulled [px, u and v]. */
	Eigen::Vector2d pull(const Eigen::Vector2d& uv, double octave, double slope) const;

   private:
	double rho2(double u, double v) const;
	Eigen::Vector2d m_middle;
	double m_radius2;  ///< Of the corners, squared [px^2]
};
}  // namespace posidonia
