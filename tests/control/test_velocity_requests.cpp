#include <gtest/gtest.h>
#include <posidonia/control/velocity_requests.h>

using namespace posidonia;

TEST(VelocityRequests, TheHigherPriorityWinsWhateverTheOrder)
{
	for (bool first : {true, false}) {
		CVelocityRequests requests;
		const TVelocityRequest low{"mission", 1, PRIORITY_NORMAL, 0.3, 0.1, 0.2};
		const TVelocityRequest high{"stop", 1, PRIORITY_SAFETY, 0.0, 0.0, 0.0};
		requests.put(first ? low : high);
		requests.put(first ? high : low);
		EXPECT_EQ(requests.merged(1).surge, 0) << "first=" << first;
		EXPECT_EQ(requests.merged(1).yaw_rate, 0) << "first=" << first;
	}
}

TEST(VelocityRequests, ALowerOneIsMergedOnlyWhenNoneOfItsAxesIsTaken)
{
	CVelocityRequests requests;
	requests.put({"climb", 1, PRIORITY_SAFETY_HIGH, {}, -0.5, {}});
	requests.put({"course", 1, PRIORITY_NORMAL, 0.3, {}, 0.2});
	requests.put({"depth", 1, PRIORITY_NORMAL, {}, 0.1, {}});
	requests.put({"all", 1, PRIORITY_SAFETY_LOW, 9.0, 9.0, 9.0});
	const TVelocityCommand merged = requests.merged(1);
	EXPECT_EQ(merged.heave, -0.5);
	EXPECT_EQ(merged.surge, 0.3);
	EXPECT_EQ(merged.yaw_rate, 0.2);
}

TEST(VelocityRequests, SamePriorityAdds)
{
	CVelocityRequests requests;
	requests.put({"a", 1, PRIORITY_NORMAL, 0.3, {}, {}});
	requests.put({"b", 1, PRIORITY_NORMAL, 0.1, {}, {}});
	EXPECT_DOUBLE_EQ(requests.merged(1).surge, 0.4);
	requests.put({"b", 1, PRIORITY_NORMAL, -0.1, {}, {}});
	EXPECT_DOUBLE_EQ(requests.merged(1).surge, 0.2) << "the last of a requester counts";
}

TEST(VelocityRequests, TheyExpire)
{
	CVelocityRequests requests;
	requests.put({"stop", 1, PRIORITY_SAFETY, 0.0, {}, {}});
	requests.put({"mission", 1.2, PRIORITY_NORMAL, 0.3, {}, {}});
	EXPECT_EQ(requests.merged(1.29).surge, 0);
	EXPECT_EQ(requests.merged(1.4).surge, 0.3);
	EXPECT_EQ(requests.merged(1.6).surge, 0);
}
