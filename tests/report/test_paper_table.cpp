#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/report/paper_table.h>

#include <cmath>

using namespace posidonia;

TEST(PaperTable, ShowsThePaperThenOurs)
{
	const std::string text = paperTable(
		1, {{"Odometry", 180.5, 0.58123}, {"SLAM", 181.2, 0.0161}, {"Ground truth", 181.13, std::nan("")}});
	EXPECT_EQ(
		text,
		"Table 2 of the paper (experiment 1), and ours\n"
		"Input                Traj. Dist. (m)  Trans. ME (m)\n"
		"-------------------  ---------------  -------------\n"
		"paper: Odometry               181.06           0.64\n"
		"paper: SLAM                   181.14           0.15\n"
		"paper: Ground truth           181.13              -\n"
		"ours:  Odometry               180.50          0.581\n"
		"ours:  SLAM                   181.20          0.016\n"
		"ours:  Ground truth           181.13              -\n");
}

TEST(PaperTable, HoldsTableThreeToo)
{
	const std::string text = paperTable(2, {});
	for (const char* number : {"181.76", "1.95", "182.71", "0.40", "182.65"})
		EXPECT_NE(text.find(number), std::string::npos) << number;
	EXPECT_THROW(paperTable(3, {}), CError);
}
