#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/base/error.h>
#include <posidonia/sim/survey_simulator.h>

#include <posidonia/sim/random.h>
#include <cmath>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "survey_test_tools.h"
#include "temp_folder.h"
#include "world_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
Isometry3d bodyAt(double north, double east, double down, double yaw = 0)
{
	Isometry3d T = Isometry3d::Identity();
	T.translation() << north, east, down;
	T.linear() = rotationFromYawPitchRoll(yaw, 0, 0);
	return T;
}
/** Stones, perfect camera and clear water over 14 m x 14 m. */
TSimulationOptions clearWorld()
{
	TSimulationOptions o;
	o.floor.texture = "rock", o.floor.extent_north = o.floor.extent_east = 14, o.floor.resolution = 0.01;
	o.water = clearWater(), o.camera = perfectSensor();
	return o;
}
TGreyPair photographOf(const TSimulationOptions& o, const TExposure& exposure, uint64_t frame = 0)
{
	return CScene(o, TSensorSuite::sparus2()).photograph(exposure, frame);
}
double difference(const cv::Mat& a, const cv::Mat& b)
{
	return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total());
}
}  // namespace

TEST(CameraSensor, VarianceIsThatOfTheAmplifierPlusThePhotons)
{
	TOptics optics = perfectOptics();
	for (const double gain : {0.0, 0.05, 0.2})
		for (const int grey : {20, 80, 200}) {
			optics.camera.noise = 2, optics.camera.photon_gain = gain;
			const CFloorTexture plain = plainTexture(grey);
			const CFloorRenderer renderer(
				plain, std::make_shared<CFlatSeaFloor>(kSeaFloor), TStereoCamera(), optics);
			const cv::Mat picture = renderer.render(cameraAt(0, 0, 3.5), 1);
			const double variance = 4 + gain * grey + 1.0 / 12;	 // (the last: rounding to whole grey levels)
			const double n = 640 * 480;
			EXPECT_NEAR(meanOf(picture), grey, 4.5 * std::sqrt(variance / n)) << gain << " " << grey;
			EXPECT_NEAR(std::pow(sigmaOf(picture), 2), variance, 4.5 * variance * std::sqrt(2 / n) + 0.01)
				<< gain << " " << grey;
		}
}

TEST(MotionBlur, SpreadsAlongTheMotionByItsVariance)
{
	// A bright dot in the middle; the blur of a length L adds L^2 / 12 of variance along the motion.
	cv::Mat grey(3200, 3200, CV_8U, cv::Scalar(0));
	for (int y = -30; y <= 30; y++)
		for (int x = -30; x <= 30; x++)
			grey.at<uint8_t>(1600 + y, 1600 + x) =
				cv::saturate_cast<uint8_t>(250 * std::exp(-(x * x + y * y) / 200.0));
	const CFloorTexture texture(grey, kTexel);
	const CFloorRenderer renderer(
		texture, std::make_shared<CFlatSeaFloor>(kSeaFloor), TStereoCamera(), perfectOptics());
	std::vector<CFloorRenderer::TMoment> exposure;
	const int n = 16;
	for (int i = 0; i < n; i++)	 // 10 pixels of motion to the north, up in the picture
		exposure.push_back({cameraAt(((i + 0.5) / n - 0.5) * 10 * 2.5 / 283, 0, 3.5)});
	const auto variances = [](const cv::Mat& picture) {
		const cv::Moments m = cv::moments(picture);
		return Eigen::Vector2d(m.mu20 / m.m00, m.mu02 / m.m00);
	};
	const Eigen::Vector2d sharp = variances(renderer.render(cameraAt(0, 0, 3.5), 1)),
						  blurred = variances(renderer.render(exposure, {}, 1));
	EXPECT_NEAR(blurred.x(), sharp.x(), 0.3) << "across";
	EXPECT_NEAR(blurred.y() - sharp.y(), 100 / 12.0, 0.5) << "along";
}

TEST(MotionBlur, FollowsExposureVelocityAndRate)
{
	TSimulationOptions o = clearWorld();
	const TExposure still{bodyAt(0, 0, 3.5)};
	const TExposure ahead{still.T_map_body, {0.5, 0, 0}}, turning{still.T_map_body, {0, 0, 0}, {0, 0, 0.5}};
	const cv::Mat sharp = photographOf(o, still).left;
	EXPECT_EQ(difference(photographOf(o, ahead).left, sharp), 0) << "no exposure, no blur";
	o.camera.exposure = 0.02;
	EXPECT_EQ(difference(photographOf(o, still).left, sharp), 0) << "no motion, no blur";
	const double brief = difference(photographOf(o, ahead).left, sharp);
	EXPECT_GT(brief, 0.2);
	EXPECT_GT(difference(photographOf(o, turning).left, sharp), 0.2);
	o.camera.exposure = 0.05;
	EXPECT_GT(difference(photographOf(o, ahead).left, sharp), 1.5 * brief);
	// The middle of the exposure is the pose: a body that moved on shows the same place in the same pixels.
	const TGreyPair blurred = photographOf(o, ahead);
	cv::Mat there;
	cv::blur(sharp, there, {1, 5});
	EXPECT_LT(difference(blurred.left, there), difference(blurred.left, sharp));
}

TEST(MarineSnow, FlakesArePoissonInNumberAndEvenInVolume)
{
	TSnowOptions o;
	o.density = 60, o.reach = 1.5;
	const TStereoCamera camera;
	const Isometry3d view = cameraAt(1, 2, 3, 0.4, 0.1, 0.2);
	const double section = 640.0 / 283 * 480 / 283;
	const double volume = section * (std::pow(1.5, 3) - std::pow(kNearestFlake, 3)) / 3,
				 mean = o.density * volume;
	std::vector<double> counts;
	size_t near = 0, all = 0;
	for (uint64_t seed = 0; seed < 400; seed++) {
		const auto flakes = drawFlakes(o, camera, view, seed);
		counts.push_back(static_cast<double>(flakes.size()));
		all += flakes.size();
		for (const TFlake& flake : flakes) {
			const Vector3d p = view.inverse() * flake.position, uvr = camera.project(p);
			EXPECT_GE(p.z(), kNearestFlake - 1e-9);
			EXPECT_LE(p.z(), 1.5 + 1e-9);
			EXPECT_LT(std::abs(uvr.x() - 319.5), 320.001);
			EXPECT_LT(std::abs(uvr.y() - 239.5), 240.001);
			near += p.z() < 1;
		}
	}
	const double n = 400, average = std::accumulate(counts.begin(), counts.end(), 0.0) / n;
	double variance = 0;
	for (const double c : counts)
		variance += (c - average) * (c - average) / (n - 1);
	EXPECT_NEAR(average, mean, 4.5 * std::sqrt(mean / n));
	EXPECT_NEAR(variance, mean, 4.5 * mean * std::sqrt(2 / n)) << "a Poisson number's";
	const double share = (1 - std::pow(kNearestFlake, 3)) / (std::pow(1.5, 3) - std::pow(kNearestFlake, 3));
	EXPECT_NEAR(
		static_cast<double>(near) / static_cast<double>(all), share,
		4.5 * std::sqrt(share * (1 - share) / static_cast<double>(all)));
}

TEST(MarineSnow, AddsTheLightOfItsFlakes)
{
	// A flake of diameter D at depth z fills (pi / 4) (D f / z)^2 pixels; summed over the view's volume, z
	// cancels: density width height (pi / 4) D^2 (reach - nearest) brightness, E[D^2] = size^2 (1 + 1 / 12).
	TSnowOptions o;
	o.density = 100, o.reach = 1.2, o.size = 0.004, o.brightness = 80;
	const TStereoCamera camera;
	const CFloorTexture black = plainTexture(0);
	const CFloorRenderer renderer(black, std::make_shared<CFlatSeaFloor>(kSeaFloor), camera, perfectOptics());
	const Isometry3d view = cameraAt(0, 0, 3.5);
	// Grey levels are whole numbers: faint skirts of the flakes are lost on black, so they lie on some noise.
	TOptics noisy = perfectOptics();
	noisy.camera.noise = 3;
	const CFloorTexture grey = plainTexture(50);
	const CFloorRenderer on_grey(grey, std::make_shared<CFlatSeaFloor>(kSeaFloor), camera, noisy);
	double light = 0;
	const int frames = 30;
	for (uint64_t frame = 0; frame < frames; frame++) {
		const CFloorRenderer::TConditions snow{drawFlakes(o, camera, view, frame), o.brightness, 1};
		light +=
			(meanOf(on_grey.render({{view}}, snow, frame)) - meanOf(on_grey.render(view, frame))) / frames;
	}
	const double expected =
		o.density * M_PI / 4 * o.size * o.size * (1 + 1.0 / 12) * (1.2 - kNearestFlake) * o.brightness;
	EXPECT_NEAR(light, expected, 0.1 * expected);
	EXPECT_EQ(meanOf(renderer.render(view, 1)), 0) << "no snow, no light";
}

TEST(MarineSnow, EyesSeeTheSameFlakesAndFramesOthers)
{
	const TStereoCamera camera;
	const CFloorTexture black = plainTexture(0);
	const CFloorRenderer renderer(black, std::make_shared<CFlatSeaFloor>(kSeaFloor), camera, perfectOptics());
	const Isometry3d left = cameraAt(0, 0, 3.5), right = left * Eigen::Translation3d(camera.baseline, 0, 0);
	const CFloorRenderer::TConditions one{{{left * Vector3d(0.1, -0.05, 0.8), 0.01}}, 200, 1};
	for (const auto& [eye, shift] :
		 {std::pair(left, 0.0), std::pair(right, camera.fx * camera.baseline / 0.8)}) {
		const cv::Moments m = cv::moments(renderer.render({{eye}}, one, 1));
		EXPECT_NEAR(m.m10 / m.m00, 319.5 + 283 * 0.1 / 0.8 - shift, 0.05);
		EXPECT_NEAR(m.m01 / m.m00, 239.5 - 283 * 0.05 / 0.8, 0.05);
	}
	const CFloorRenderer::TConditions buried{{{left * Vector3d(0, 0, 2.6), 0.05}}, 200, 1};
	EXPECT_EQ(meanOf(renderer.render({{left}}, buried, 1)), 0) << "in the floor";

	TSimulationOptions o = clearWorld();
	const cv::Mat clear = photographOf(o, {bodyAt(0, 0, 3.5)}, 1).left;
	o.snow.density = 50;
	const cv::Mat first = photographOf(o, {bodyAt(0, 0, 3.5)}, 1).left;
	EXPECT_GT(difference(first, clear), 0.05);
	EXPECT_EQ(difference(first, photographOf(o, {bodyAt(0, 0, 3.5)}, 1).left), 0);
	EXPECT_GT(difference(first, photographOf(o, {bodyAt(0, 0, 3.5)}, 2).left), 0.05);
}

TEST(Scene, PhotographIsThatOfTheRendererFromTheTruePose)
{
	TSimulationOptions o = clearWorld();
	o.camera = TCameraOptions(), o.calibration_error.camera_yaw = 0.1,
	o.calibration_error.camera_clock = 0.25;
	const CScene scene(o, TSensorSuite::sparus2());
	EXPECT_EQ(scene.cameraClock(), 0.25);
	const TStereoSpec spec = trueStereo(TSensorSuite::sparus2().stereo.at("STEREO"), o.calibration_error);
	const CFloorTexture texture(o.floor, o.run.seed);
	const CFloorRenderer renderer(texture, o.floor.depth, spec.camera, o.water, o.camera);
	const Isometry3d body = bodyAt(0.4, -1, 3.4, 0.7);
	const TGreyPair pair = renderPair(
		renderer, body * spec.T_body_sensor(), spec.camera.baseline, seedOf(o.run.seed, "pixel noise"), 7);
	const TGreyPair photograph = scene.photograph(body, 7);
	EXPECT_EQ(difference(photograph.left, pair.left) + difference(photograph.right, pair.right), 0);
}

TEST(Scene, WithoutARigThereIsAFloorOnly)
{
	TSimulationOptions o = clearWorld();
	o.run.stereo = false;
	const CScene scene(o, TSensorSuite::sparus2());
	EXPECT_FALSE(scene.hasCamera());
	EXPECT_EQ(scene.floor()->depthAt({1, 2}), 6);
}

TEST(Scene, MarginKeepsTheTextureUnderAVehicleOffItsRoute)
{
	TSimulationOptions o = clearWorld();
	const std::vector<Vector3d> route{{0, 0, 3.5}, {2, 2, 3.5}};
	EXPECT_NO_THROW(CScene(o, TSensorSuite::sparus2()).requireFloorUnder(route));
	o.floor.margin = 4;
	const CScene scene(o, TSensorSuite::sparus2());
	EXPECT_HOLDS(errorOf<CError>([&] { scene.requireFloorUnder(route); }), "extent_north");
}

namespace
{
TSimulationOptions reliefSurvey()
{
	TSimulationOptions o;
	o.floor.texture = "rock", o.floor.resolution = 0.01;
	o.floor.extent_north = o.floor.extent_east = 16;
	o.route.way_points = {0, 0, 0, 2};
	o.route.start[2] = 3.0;
	o.run.duration = 14, o.run.node_distance = 0.25;
	o.relief.kind = "procedural", o.relief.boulder_density = 0.5, o.water.jerlov = "3C",
	o.lamp.kind = "point";
	o.snow.density = 20, o.camera.exposure = 0.02, o.camera.photon_gain = 0.03;
	o.run.save_depth = true, o.run.overview = true;
	return o;
}
}  // namespace

TEST(Scene, EverythingOnGivesTheSameBytesWithOneAndTwoThreads)
{
	TSimulationOptions o = reliefSurvey();
	std::map<std::string, std::string> runs[2];
	for (const int threads : {1, 2}) {
		const CTempFolder folder;
		o.run.threads = threads;
		CSurveySimulator(o, smallCamera()).run(folder / "survey");
		runs[threads - 1] = contents(folder.path());
	}
	EXPECT_EQ(runs[0], runs[1]);
	EXPECT_GT(runs[0].size(), 10u);
}

TEST(Scene, DepthsOfKeptPairsAreWrittenInMillimetresAndTheWorldFromAbove)
{
	const CTempFolder folder;
	CSurveySimulator simulator(reliefSurvey(), smallCamera());
	const auto summary = simulator.run(folder / "survey");
	size_t checked = 0;
	simulator.stream([&](const TSimulatedObservation& o) {
		if (!o.frame || !o.kept) return;
		const auto& pair = dynamic_cast<const mrpt::obs::CObservationStereoImages&>(*o.observation);
		std::string name = pair.imageLeft.getExternalStorageFile();
		name.replace(name.find("_left"), 5, "_depth");
		const cv::Mat1w file = cv::imread(folder / ("survey_Images/" + name), cv::IMREAD_UNCHANGED);
		const cv::Mat1f depths = simulator.depths(o);
		ASSERT_EQ(file.size(), depths.size()) << name;
		for (int v = 0; v < file.rows; v++)
			for (int u = 0; u < file.cols; u++)
				ASSERT_NEAR(file(v, u), 1000 * depths(v, u), 0.501) << name;
		checked++;
	});
	EXPECT_EQ(checked, summary.kept_pairs);
	EXPECT_GT(checked, 2u);
	const cv::Mat3b overview = cv::imread(folder / "survey.overview.png");
	EXPECT_EQ(overview.size(), cv::Size(1600, 1600));
	// The route runs east from the middle, in red.
	const cv::Vec3b on_route = overview(800, 820);
	EXPECT_GT(on_route[2], on_route[0] + 100);
}
