#include "eval_testing.h"

#include <posidonia/eval/trajectory_io.h>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
TTrajectory randomTrajectory(double start)
{
	std::mt19937 rng(4);
	TTrajectory trajectory;
	for (int i = 0; i < 50; i++)
		trajectory.push_back({start + 0.1 * i, randomPose(rng, 30, 3)});
	return trajectory;
}

void expectSame(const TTrajectory& a, const TTrajectory& b, double stamp_tolerance)
{
	ASSERT_EQ(a.size(), b.size());
	for (size_t i = 0; i < a.size(); i++) {
		EXPECT_NEAR(a[i].stamp, b[i].stamp, stamp_tolerance) << "i=" << i;
		EXPECT_LT((a[i].T.matrix() - b[i].T.matrix()).norm(), 3e-9) << "i=" << i;
	}
}
}  // namespace

TEST(TrajectoryIo, TumIsExactlyAsDocumented)
{
	TStampedPose pose{1400000000.25, Eigen::Isometry3d::Identity()};
	pose.T.translation() << 1.5, -2, -1e-12;
	pose.T.linear() = Eigen::Quaterniond(-0.5, 0.5, -0.5, 0.5).toRotationMatrix();
	EXPECT_EQ(
		tumText({pose}),
		"1400000000.250000000 1.500000000 -2.000000000 0.000000000 -0.500000000000 0.500000000000 "
		"-0.500000000000 "
		"0.500000000000\n");
}

TEST(TrajectoryIo, TumRoundTripAndSameBytesAgain)
{
	const TTrajectory trajectory = randomTrajectory(1403636579.76);
	const CTextFile file("");
	writeTum(file.path(), trajectory);
	const TTrajectory read = readTum(file.path());
	expectSame(trajectory, read, 0);
	expectSame(trajectory, readTrajectory(file.path()), 0);
	EXPECT_EQ(tumText(read), tumText(trajectory));
}

TEST(TrajectoryIo, EurocRoundTrip)
{
	const TTrajectory trajectory = randomTrajectory(1403636579.76);
	const CTextFile file("");
	writeEuroc(file.path(), trajectory);
	expectSame(trajectory, readEuroc(file.path()), 3e-7);
	expectSame(trajectory, readTrajectory(file.path()), 3e-7);
}

TEST(TrajectoryIo, EurocKeepsNanosecondsToTheLastBitOfADouble)
{
	const CTextFile file("#timestamp [ns],p\n1403636579763555584, 1,2,3, 1,0,0,0, 9,9,9\n");
	const TTrajectory read = readEuroc(file.path());
	ASSERT_EQ(read.size(), 1u);
	EXPECT_EQ(read[0].stamp, 1403636579.763555584);
	EXPECT_EQ(read[0].T.translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(TrajectoryIo, KittiRoundTripWithIndexAndWithStamps)
{
	const TTrajectory trajectory = randomTrajectory(10);
	const CTextFile file("");
	writeKitti(file.path(), trajectory);
	std::string stamps;
	for (const auto& p : trajectory)
		stamps += std::to_string(p.stamp) + "\n";
	expectSame(trajectory, readKitti(file.path(), CTextFile(stamps).path()), 1e-6);
	const TTrajectory by_index = readTrajectory(file.path());
	for (size_t i = 0; i < by_index.size(); i++)
		EXPECT_EQ(by_index[i].stamp, static_cast<double>(i));
	const std::string error = errorOf([&] { readKitti(file.path(), CTextFile("1\n2\n").path()); });
	expectContains(error, "2 stamps for the 50 poses");
}

TEST(TrajectoryIo, ReadsCommentsBlankLinesAndWindowsEnds)
{
	const CTextFile file("# t x y z qx qy qz qw\r\n\r\n  1 2\t3 4   0 0 0 1\r\n1 2 3 4 0 0 0 1");
	EXPECT_EQ(readTum(file.path()).size(), 2u);
}

TEST(TrajectoryIo, ErrorsNameFileLineAndProblem)
{
	const std::vector<std::pair<std::string, std::string>> cases{
		{"1 2 3 4 0 0 0\n", "7 columns, expected 8"},
		{"1 2 3 4 0 0 0 1 9\n", "9 columns, expected 8"},
		{"1 2 x 4 0 0 0 1\n", "'x' is not a number"},
		{"1 2 3.5m 4 0 0 0 1\n", "'3.5m' is not a number"},
		{"1 2 nan 4 0 0 0 1\n", "'nan' is not finite"},
		{"1 2 3 4 0 0 0 0\n", "norm is 0.0"},
		{"0.5 2 3 4 0 0 0 1\n", "the stamp 0.500000000 s is before the previous one, 1.000000000 s"}};
	for (const auto& [line, problem] : cases) {
		const CTextFile file("# comment\n1 2 3 4 0 0 0 1\n" + line);
		const std::string error = errorOf([&f = file] { readTum(f.path()); });
		expectContains(error, file.path() + ":3: ");
		expectContains(error, problem);
	}
}

TEST(TrajectoryIo, ErrorsOfTheOtherFormats)
{
	const CTextFile euroc("#t\n1.5,0,0,0,1,0,0,0\n");
	expectContains(
		errorOf([&] { readEuroc(euroc.path()); }), euroc.path() + ":2: '1.5' is not a whole number");
	const CTextFile shorter("1,0,0,0\n");
	expectContains(errorOf([&] { readEuroc(shorter.path()); }), ":1: 4 columns, expected at least 8");
	const CTextFile mirror("1 0 0 0 0 1 0 0 0 0 -1 0\n");
	expectContains(errorOf([&] { readKitti(mirror.path()); }), ":1: the 3x3 part is not a rotation");
	const CTextFile empty("# nothing\n");
	expectContains(errorOf([&] { readTum(empty.path()); }), empty.path() + ": holds no pose");
	expectContains(errorOf([&] { readTum("/no/such.tum"); }), "/no/such.tum: no such file");
}

TEST(TrajectoryIo, RefusesToWriteWhatIsNotFinite)
{
	TTrajectory trajectory(3);
	trajectory[2].T.translation().x() = std::nan("");
	expectContains(errorOf([&] { tumText(trajectory); }), "pose 2: is not finite");
}
