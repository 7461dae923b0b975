#pragma once

#include <posidonia/base/options.h>

#include <string>

namespace posidonia
{
/** How a key frame is made of a rectified stereo pair (README, sections 1 and 2). */
struct TFeatureOptions
{
	std::string detector{"SIFT"};
	int max_features{800};
	int shrink{2};
	int grid_columns{8}, grid_rows{6};
	double sift_contrast{0.02};
	int orb_fast_threshold{7};
	double akaze_threshold{0.0005};
	double poor_picture{0.2};
	bool clahe{false};
	double clahe_clip{3};

	double min_depth{0.5}, max_depth{20};  ///< [m]
	double row_tolerance{1.0};			   ///< [px] at the finest scale
	double stereo_ratio{1.0};
	double patch_scale{2.0};
	double min_ncc{0.7};
	bool average_left_right{true};
	bool correct_light_fall{true};

	double sigma_uv{0}, sigma_uv_growth{0};	 ///< 0: as measured for the detector
	double sigma_disparity{0.015}, disparity_noise_scale{0.65};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice("detector", detector, {"SIFT", "ORB", "AKAZE"}, "Features");
		v.integer(
			"max_features", max_features, between(10, 10000), "Key points kept an image, spread over a grid");
		v.integer(
			"shrink", shrink, between(1, 4),
			"Detect on the image shrunk so many times: 2 leaves out the finest scale and costs a third "
			"(disparities "
			"are always measured on the whole image)");
		v.integer(
			"grid_columns", grid_columns, between(1, 64), "Columns of the grid that spreads the key points");
		v.integer("grid_rows", grid_rows, between(1, 64), "Rows of that grid");
		v.number(
			"sift_contrast", sift_contrast, between(1e-4, 0.5), "SIFT contrast threshold (share of white)");
		v.integer(
			"orb_fast_threshold", orb_fast_threshold, between(1, 100), "ORB's FAST threshold [grey levels]");
		v.number("akaze_threshold", akaze_threshold, between(1e-6, 0.1), "AKAZE detector threshold");
		v.number(
			"poor_picture", poor_picture, between(0, 1),
			"Equalise and search again where fewer than this share of max_features is found; "
			"0: never");
		v.flag("clahe", clahe, "Equalise the contrast locally before detection (turbid water)");
		v.number("clahe_clip", clahe_clip, between(0.1, 40), "Clip limit of that equalisation");
		v.number("min_depth", min_depth, above(0), "Nearest point [m]");
		v.number("max_depth", max_depth, above(0), "Farthest point [m], > min_depth");
		v.number(
			"row_tolerance", row_tolerance, above(0), "Left-right row difference [px] at the finest scale");
		v.number(
			"stereo_ratio", stereo_ratio, between(0.1, 1), "Left-right ratio test, best/second; 1 = off");
		v.number(
			"patch_scale", patch_scale, between(0.2, 10), "Radius of the aligned patch in key-point sizes");
		v.number(
			"min_ncc", min_ncc, between(-1, 1), "Least correlation of the aligned left and right patches");
		v.flag("average_left_right", average_left_right, "Position = mean of the left and right detections");
		v.flag(
			"correct_light_fall", correct_light_fall,
			"SIFT: undo the pull on key points of a contrast that falls towards the corners");
		v.number(
			"sigma_uv", sigma_uv, atLeast(0),
			"Position noise across views [px] of a finest-scale key point; 0 = as measured for the detector");
		v.number(
			"sigma_uv_growth", sigma_uv_growth, atLeast(0),
			"Growth of that noise an octave; 0 = as measured for the detector");
		v.number("sigma_disparity", sigma_disparity, above(0), "Floor of the disparity noise [px]");
		v.number(
			"disparity_noise_scale", disparity_noise_scale, above(0),
			"Disparity noise over what the patch's own residual and gradient predict");
	}

	/** Position noise of a key point [px], the same in u and v. */
	double positionSigma(double octave) const;

	/** Throws CError on options that contradict each other. */
	void check() const;
};
}  // namespace posidonia
