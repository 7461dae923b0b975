#include <gtest/gtest.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/base/error.h>
#include <posidonia/base/ini_file.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/rawlog_reader.h>
#include <posidonia/sim/survey_simulator.h>

#include <sstream>

#include "survey_test_tools.h"
#include "temp_folder.h"

using namespace posidonia;
using namespace posidonia::testing;
using mrpt::obs::CObservationStereoImages;
using posidonia::testing::CTempFolder;
using posidonia::testing::errorOf;
using posidonia::testing::fileBytes;

namespace
{
TSimulationOptions shortSurvey()
{
	TSimulationOptions o;
	o.floor.texture = "rock", o.floor.resolution = 0.01;
	o.floor.extent_north = o.floor.extent_east = 16;
	o.route.way_points = {0, 0, 0, 2, 2, 2};
	o.route.start[2] = 2.5;
	return o;
}
std::map<std::string, std::string> runInto(const TSimulationOptions& o, const TSensorSuite& s = smallCamera())
{
	const CTempFolder folder;
	CSurveySimulator(o, s).run(folder / "survey");
	return contents(folder.path());
}
std::vector<Eigen::Vector3d> keptPositions(const TSimulationOptions& o)
{
	std::vector<Eigen::Vector3d> kept;
	CSurveySimulator(o, smallCamera()).stream([&](const TSimulatedObservation& s) {
		if (s.frame && s.kept) kept.push_back(s.truth.T_map_body.translation());
	});
	return kept;
}
}  // namespace

TEST(Survey, SameSeedSameBytesWhateverTheThreads)
{
	TSimulationOptions o = shortSurvey();
	o.run.threads = 1;
	const auto one = runInto(o);
	o.run.threads = 2;
	EXPECT_EQ(one, runInto(o)) << "two threads";
	EXPECT_GT(one.size(), 10u);
	o.run.seed = 2;
	const auto other = runInto(o);
	EXPECT_NE(one.at("survey.rawlog"), other.at("survey.rawlog"));
	EXPECT_NE(one.at("survey.gt.tum"), other.at("survey.gt.tum"));
	EXPECT_NE(
		one.at("survey_Images/STEREO_000000_left.png"), other.at("survey_Images/STEREO_000000_left.png"));
}

TEST(Survey, RawlogReadsBackWithItsPictures)
{
	const CTempFolder folder;
	CSurveySimulator simulator(shortSurvey(), smallCamera());
	double last_fraction = 0;
	const auto summary = simulator.run(folder / "survey", [&](double fraction) { last_fraction = fraction; });
	EXPECT_EQ(last_fraction, 1);
	CRawlogReader reader(folder / "survey.rawlog");
	const CStereoImageLoader loader(folder / "survey.rawlog");
	size_t count = 0, pairs = 0;
	double previous = 0;
	while (const auto o = reader.next()) {
		EXPECT_GE(stampOf(*o), previous);
		previous = stampOf(*o);
		count++;
		if (!IS_CLASS(*o, CObservationStereoImages)) continue;
		const TGreyPair pictures = loader.load(dynamic_cast<CObservationStereoImages&>(*o));
		EXPECT_EQ(pictures.left.size(), cv::Size(160, 120));
		EXPECT_EQ(pictures.right.size(), cv::Size(160, 120));
		pairs++;
	}
	EXPECT_EQ(count, summary.observations);
	EXPECT_EQ(pairs, summary.kept_pairs);
	EXPECT_NO_THROW(readSensors(folder / "survey.sensors.ini"));
}

TEST(Survey, EmbeddedPicturesAreThoseOfTheFiles)
{
	const CTempFolder folder;
	CSurveySimulator simulator(shortSurvey(), smallCamera());
	simulator.run(folder / "survey");
	const CStereoImageLoader loader(folder / "survey.rawlog");
	size_t checked = 0;
	simulator.stream([&](const TSimulatedObservation& o) {
		if (!o.frame || !o.kept || checked++ > 3) return;
		const auto& pair = dynamic_cast<const CObservationStereoImages&>(*o.observation);
		const TGreyPair files = loader.load(pair);
		simulator.embedPictures(o);
		EXPECT_FALSE(pair.imageLeft.isExternallyStored());
		const TGreyPair embedded = loader.load(pair);
		EXPECT_EQ(cv::norm(files.left, embedded.left, cv::NORM_INF), 0);
		EXPECT_EQ(cv::norm(files.right, embedded.right, cv::NORM_INF), 0);
	});
	EXPECT_GT(checked, 3u);
}

TEST(Survey, GroundTruthIsThePoseAtEveryStereoStamp)
{
	const CTempFolder folder;
	CSurveySimulator simulator(shortSurvey(), smallCamera());
	const auto summary = simulator.run(folder / "survey");
	std::istringstream lines(fileBytes(folder / "survey.gt.tum"));
	size_t n = 0;
	double t, x, y, z, qx, qy, qz, qw;
	while (lines >> t >> x >> y >> z >> qx >> qy >> qz >> qw) {
		const auto pose = simulator.motion().at(t - 1420070400).T_map_body;
		EXPECT_LT((pose.translation() - Eigen::Vector3d(x, y, z)).norm(), 1e-9) << "t=" << t;
		EXPECT_LT((pose.linear() - Eigen::Quaterniond(qw, qx, qy, qz).toRotationMatrix()).norm(), 1e-9)
			<< "t=" << t;
		EXPECT_NEAR(t, 1420070400 + static_cast<double>(n) / 3, 3e-7);
		n++;
	}
	EXPECT_EQ(n, summary.stereo_pairs);
	EXPECT_GT(summary.stereo_pairs, 2 * summary.kept_pairs);
}

TEST(Survey, NodesKeepsThePairNearestToEachHalfMetre)
{
	TSimulationOptions o = shortSurvey();
	const auto kept = keptPositions(o);
	ASSERT_GT(kept.size(), 5u);
	for (size_t i = 1; i < kept.size(); i++)
		EXPECT_NEAR((kept[i] - kept[i - 1]).norm(), 0.5, 0.056)
			<< "half a step of 0.3 m/s at 3 Hz; pair " << i;
	o.run.node_distance = 0.25;
	EXPECT_GT(keptPositions(o).size(), 1.7 * static_cast<double>(kept.size()));
	o.run.save_images = "all";
	size_t all = 0;
	CSurveySimulator simulator(o, smallCamera());
	simulator.stream([&](const TSimulatedObservation& s) { all += s.frame.has_value(); });
	EXPECT_EQ(keptPositions(o).size(), all);
}

TEST(Survey, CalibrationErrorsChangeTheWorldNotTheRawlog)
{
	TSimulationOptions o = shortSurvey();
	o.run.duration = 12;
	const auto exact = runInto(o);
	using set_t = std::function<void(TCalibrationErrorOptions&)>;
	const std::map<std::string, set_t> cases{
		{"focal", [](auto& e) { e.focal_length = 0.02; }}, {"baseline", [](auto& e) { e.baseline = 0.1; }},
		{"yaw", [](auto& e) { e.camera_yaw = 0.03; }},	  {"pitch", [](auto& e) { e.camera_pitch = 0.03; }},
		{"roll", [](auto& e) { e.camera_roll = 0.03; }},	 {"clock", [](auto& e) { e.camera_clock = 0.2; }}};
	for (const auto& [name, set] : cases) {
		TSimulationOptions off = o;
		set(off.calibration_error);
		auto wrong = runInto(off);
		ASSERT_EQ(wrong.size(), exact.size()) << name;
		size_t changed = 0;
		for (const auto& [file, bytes] : exact)
			if (file.find(".png") != std::string::npos)
				changed += bytes != wrong.at(file);
			else
				EXPECT_EQ(bytes, wrong.at(file)) << name << ": " << file;
		EXPECT_GT(changed, 0u) << name;
	}
}

TEST(Survey, CameraClockShowsThePoseOfStampPlusOffset)
{
	TSimulationOptions o = shortSurvey();
	o.camera.noise = 0, o.run.save_images = "all";
	const auto frames = [&](double offset) {
		o.calibration_error.camera_clock = offset;
		const CSurveySimulator simulator(o, smallCamera());
		std::vector<cv::Mat> lefts;
		simulator.stream([&](const TSimulatedObservation& s) {
			if (s.frame && *s.frame > 30 && *s.frame < 36) lefts.push_back(simulator.render(s).left);
		});
		return lefts;
	};
	const auto now = frames(0), late = frames(1.0 / 3);	 // one period on: shows the next frame's view
	for (size_t i = 0; i + 1 < now.size(); i++)
		EXPECT_LE(cv::norm(late[i], now[i + 1], cv::NORM_INF), 2) << i;
	EXPECT_GT(cv::norm(late[0], now[0], cv::NORM_INF), 10);
}

TEST(Survey, FloorMustLieUnderTheRoute)
{
	TSimulationOptions o = shortSurvey();
	o.floor.extent_east = 6;
	EXPECT_HOLDS(errorOf<CError>([&] { CSurveySimulator(o, smallCamera()); }), "extent_east");
	o = shortSurvey();
	o.floor.depth = 3;
	EXPECT_HOLDS(errorOf<CError>([&] { CSurveySimulator(o, smallCamera()); }), "under the sea floor");
}

TEST(Survey, RunsWithoutACamera)
{
	TSimulationOptions o = shortSurvey();
	o.run.stereo = false;
	const auto files = runInto(o);
	EXPECT_EQ(files.size(), 2u) << "rawlog and sensors.ini";
}

TEST(Survey, OptionsLoadStrictlyBySection)
{
	const std::string text =
		"[Simulation]\nseed = 9\nsave_images = all\n[Route]\nway_points = 0 0 0 5\nturn_rate = 10\n"
		"[CalibrationError]\ncamera_yaw = 1\n[Floor]\ntexture = sand\n";
	CIniFile ini = CIniFile::fromText(text);
	TSimulationOptions o;
	o.forEachSection([&](const char* section, auto& options) { ini.loadOnto(options, section); });
	ini.refuseUnknown();
	EXPECT_EQ(o.run.seed, 9u);
	EXPECT_EQ(o.run.save_images, "all");
	EXPECT_EQ(o.route.way_points, (std::vector<double>{0, 0, 0, 5}));
	EXPECT_NEAR(o.route.turn_rate, 10 * M_PI / 180, 1e-15);
	EXPECT_NEAR(o.calibration_error.camera_yaw, M_PI / 180, 1e-15);
	EXPECT_EQ(o.floor.texture, "sand");
}
