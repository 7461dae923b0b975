#pragma once

#include <posidonia/geometry/stereo_camera.h>
#include <posidonia/vision/feature_options.h>
#include <posidonia/vision/features.h>
#include <posidonia/vision/key_frame.h>

#include <optional>
#include <utility>
#include <vector>

namespace posidonia
{
/** Makes key frames of rectified stereo pairs: features on both images (a thread each), matching along rows,
 * disparity by patch alignment, triangulation with covariance. Deterministic; safe to call from many threads.
 */
class CKeyFrameExtractor
{
   public:
	/** Throws CError on options or a camera that make no sense. */
	CKeyFrameExtractor(const TFeatureOptions& options, const TStereoCamera& camera);

	/** @param left,right rectified grey images, CV_8UC1, of the camera's size
	 * @throw CError on images of another type or size */
	TKeyFrame extract(const cv::Mat& left, const cv::Mat& right) const;

	const TFeatureOptions& options() const { return m_options; }
	const TStereoCamera& camera() const { return m_camera; }

   private:
	/** A stereo point, and the contrast of its left picture over the right one. */
	struct TMeasured
	{
		TStereoPoint point;
		double contrast;
	};

	/** Every pair (left, right) of key points measured, on two threads. */
	std::vector<std::optional<TMeasured>> measureAll(
		const class CPatchAligner& aligner, const TFeatures& left, const TFeatures& right,
		const std::vector<std::pair<int, int>>& pairs) const;
	void checkImage(const cv::Mat& image, const char* side) const;
	void correctLightFall(std::vector<std::optional<TMeasured>>& points) const;
	std::optional<TMeasured> measure(
		const class CPatchAligner& aligner, const cv::KeyPoint& left, const cv::KeyPoint& right,
		double octave) const;

	TFeatureOptions m_options;
	TStereoCamera m_camera;
	double m_min_disparity, m_max_disparity;  // [px]
};
}  // namespace posidonia
