#include <posidonia/obs/observations.h>

#include "apps_testing.h"

namespace fs = std::filesystem;
using namespace posidonia;
using namespace posidonia::testing;

namespace
{
size_t filesIn(const std::string& folder)
{
	return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}
}  // namespace

TEST(SimApp, WritesWhatItsSummarySays)
{
	const TSurvey& s = survey();
	CRawlogReader reader(s.rawlog);
	size_t n = 0, pairs = 0;
	const CStereoImageLoader loader(s.rawlog);
	while (const auto o = reader.next()) {
		n++;
		const auto* pair = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(o.get());
		if (!pair) continue;
		const TGreyPair pictures = loader.load(*pair);
		EXPECT_EQ(pictures.left.size(), cv::Size(320, 240)) << "pair " << pairs;
		EXPECT_EQ(pictures.right.size(), cv::Size(320, 240)) << "pair " << pairs;
		pairs++;
	}
	EXPECT_EQ(reader.damage(), "");
	EXPECT_EQ(n, s.summary.observations);
	EXPECT_EQ(pairs, s.summary.kept_pairs);
	EXPECT_EQ(filesIn(s.prefix + "_Images"), 2 * pairs);
	EXPECT_GT(pairs, 7u);
	EXPECT_EQ(readSensors(s.prefix + ".sensors.ini").stereo.at("STEREO").camera.width, 320);
	const TTrajectory truth = readTum(s.truth);
	EXPECT_NEAR(truth.back().stamp - truth.front().stamp, s.summary.duration, 1);
	EXPECT_NEAR(s.summary.path_length, 4.5, 0.6);
}

TEST(SimApp, SameSeedSameBytesWhateverTheThreads)
{
	const CTempFolder folder;
	for (const char* threads : {"1", "3"}) {
		CSimApp app;
		runApp(
			app, {"-c", survey().ini, "-o", folder / threads, "--set",
				  std::string("Simulation.threads=") + threads, "--set", "Simulation.duration=12"});
	}
	const std::string a = folder / "1/tiny", b = folder / "3/tiny";
	EXPECT_EQ(fileBytes(a + ".gt.tum"), fileBytes(b + ".gt.tum"));
	EXPECT_TRUE(fileBytes(a + ".rawlog") == fileBytes(b + ".rawlog"));
	size_t pictures = 0;
	for (const auto& file : fs::directory_iterator(a + "_Images")) {
		const std::string name = file.path().filename().string();
		EXPECT_TRUE(fileBytes(file.path().string()) == fileBytes(b + "_Images/" + name)) << name;
		pictures++;
	}
	EXPECT_GT(pictures, 0u);
}

TEST(SimApp, AnotherSeedGivesOtherMeasurements)
{
	const CTempFolder folder;
	for (const char* seed : {"1", "2"}) {
		CSimApp app;
		runApp(
			app, {"-c", survey().ini, "-o", folder.path(), "--name", seed, "--set",
				  std::string("Simulation.seed=") + seed, "--set", "Simulation.duration=5"});
	}
	EXPECT_FALSE(fileBytes(folder / "1.rawlog") == fileBytes(folder / "2.rawlog"));
}
