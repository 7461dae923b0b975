#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace posidonia
{
/** A left-right alignment of two patches along the row. */
struct TPatchAlignment
{
	double disparity;  ///< u_left - u_right [px]
	double sigma;	   ///< Its noise as predicted by the patch's residual and gradient [px]
	double ncc;		   ///< Correlation of the aligned patches
	double contrast;   ///< Contrast (standard deviation) of the left patch over that of the right
};

/** A stereo pair smoothed for patch alignment. */
class CPatchAligner
{
   public:
	/** @param left,right rectified grey images, CV_8U, same size */
	CPatchAligner(const cv::Mat& left, const cv::Mat& right);

	/** Least squares over disparity, gain and offset of I_left(x, y) = gain I_right(x - d, y) + offset in a
	 * square of half-size `radius` [px] round (u, v), from the disparity `start`. None if it leaves the image
	 * or moves more than `reach` [px], or doesn't converge. */
	std::optional<TPatchAlignment> align(double u, double v, double start, int radius, double reach) const;

   private:
	struct TNormalEquations;
	bool linearise(int x, int y, double disparity, int radius, TNormalEquations& n) const;

	cv::Mat m_left, m_left_slope, m_right;	// CV_32F, smoothed
};
}  // namespace posidonia
