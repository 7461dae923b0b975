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

TEST(RefusedPairs, areJudgedAgainWhenTheGraphHasMoved)
{
	// Drift of 30 mm/m, a quarter of it declared: the first loops are refused, until the sequential edges
	// and later loops bring the graph nearer.
	TSetup setup = strongDrift();
	setup.slam.slam.edge_deciders = "CSequentialStereoERD CRoiStereoERD";
	setup.corruption.drift_xy = 0.03;
	setup.corruption.drift_z = 0.01;
	setup.corruption.declared_factor = 0.25;
	const auto with = run(setup);
	setup.slam.gate.retry_moved = 0;
	const auto without = run(setup);

	const std::string kRetried = "accepted on retry";
	std::printf(
		"[   INFO   ] with retries: %d accepted so, %d refused, mean error %.3f m; without: %d refused, %.3f "
		"m\n",
		rowsWith(*with, kRetried), rowsWith(*with, kRefused), meanNodeError(*with),
		rowsWith(*without, kRefused), meanNodeError(*without));
	EXPECT_GT(rowsWith(*with, kRetried), 10);
	EXPECT_EQ(rowsWith(*without, kRetried), 0);
	EXPECT_LT(rowsWith(*with, kRefused), rowsWith(*without, kRefused));

	for (const auto& row : with->map().candidates) {
		if (row.status != kRetried) continue;
		EXPECT_TRUE(row.measured);
		EXPECT_FALSE(errorOfPair(*with, row.from, row.to, row.T_from_to).isFalse());
		int edges = 0;
		for (const auto& edge : with->map().edges())
			edges += edge.from == row.from && edge.to == row.to && edge.kind == row.kind &&
					 edge.T_from_to.matrix() == row.T_from_to.matrix();
		EXPECT_EQ(edges, 1) << row.from << " to " << row.to;
	}
}
