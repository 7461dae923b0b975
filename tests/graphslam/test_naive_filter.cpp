// The paper's corruption with a filter that does not know of it: true loops are lost at the gate.
#include <gtest/gtest.h>

#include "survey.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** Loops alone, drift of 50 mm/m, hardly any floors. */
TSetup strongDrift()
{
	TSetup setup;
	setup.slam.slam.edge_deciders = "CRoiStereoERD";
	setup.slam.gate.sigma_floor_xyz = 0.005;
	setup.slam.gate.sigma_floor_angle = 0.1 * M_PI / 180;
	setup.slam.roi.max_candidates = 4;
	setup.corruption.drift_xy = 0.05;
	setup.corruption.drift_z = 0.02;
	return setup;
}

const std::string kRefused = "refused by the chi-square gate";

int rowsWith(const CStereoSlam& slam, const std::string& status)
{
	int count = 0;
	for (const auto& row : slam.map().candidates)
		count += row.status == status;
	return count;
}
}  // namespace

TEST(NaiveFilter, losesTrueLoopsThatADeclaredDriftKeeps)
{
	TSetup setup = strongDrift();
	const auto honest = run(setup);
	setup.corruption.declared_sigma_xy = setup.corruption.declared_sigma_z = 0;
	const auto naive = run(setup);

	const int kept = edgesOf(*honest, EEdgeKind::ROI), kept_naive = edgesOf(*naive, EEdgeKind::ROI);
	std::printf(
		"[   INFO   ] ROI edges: declared %d (refused %d), naive %d (refused %d); mean error %.3f and %.3f "
		"m\n",
		kept, rowsWith(*honest, kRefused), kept_naive, rowsWith(*naive, kRefused), meanNodeError(*honest),
		meanNodeError(*naive));
	EXPECT_GT(kept, 20);
	EXPECT_LT(2 * kept_naive, kept);
	EXPECT_LT(5 * meanNodeError(*honest), meanNodeError(*naive));

	EXPECT_GT(rowsWith(*naive, kRefused), 20);
	for (const auto& row : naive->map().candidates) {
		if (row.status != kRefused) continue;
		ASSERT_TRUE(row.measured);
		const TPairError error = errorOfPair(*naive, row.from, row.to, row.T_from_to);
		EXPECT_FALSE(error.isFalse())
			<< row.from << " to " << row.to << ": refused, and " << error.metres << " m off";
	}
}

TEST(NaiveFilter, theJumpGateAsksNoCovariance)
{
	TSetup setup = strongDrift();
	setup.corruption.declared_sigma_xy = setup.corruption.declared_sigma_z = 0;
	setup.slam.gate.kind = "jump";
	setup.stop_at_nodes = 14;
	const auto slam = run(setup);
	EXPECT_GT(edgesOf(*slam, EEdgeKind::ROI), 5);
	EXPECT_EQ(rowsWith(*slam, "refused by the jump gate"), 0);
	setup.slam.gate.max_jump = 0.001;
	EXPECT_GT(rowsWith(*run(setup), "refused by the jump gate"), 5);
}
