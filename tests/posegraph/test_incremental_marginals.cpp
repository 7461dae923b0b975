#include "incremental_checks.h"

using namespace posidonia;
using namespace posidonia::testing;

TEST(Incremental, MarginalsEqualTheBatchs)
{
	const CPoseGraph whole = surveyWithPriors(150);
	CArrival arrival(whole);
	CIncrementalOptimizer optimizer;
	arriveAll(arrival, optimizer);
	optimizer.refine(arrival.graph);
	CSparseOptimizer batch;
	const auto expected = batch.marginals(arrival.graph), got = optimizer.marginals();
	const auto all = got.allCovariances();
	ASSERT_EQ(all.size(), arrival.graph.nodeCount());
	for (int i = 0; i < int(all.size()); i++) {
		const Matrix6d S = expected.covarianceOf(i);
		EXPECT_LT((got.covarianceOf(i) - S).norm(), 1e-6 * S.norm()) << "node " << i;
		EXPECT_LT((all[size_t(i)] - S).norm(), 1e-6 * S.norm()) << "node " << i << " of all";
	}
	for (const auto [i, j] : {std::array{1, 150}, {30, 31}, {77, 10}}) {
		const Matrix6d S = expected.relativeCovariance(i, j);
		EXPECT_LT((got.relativeCovariance(i, j) - S).norm(), 1e-6 * S.norm()) << i << ", " << j;
	}
	const Eigen::MatrixXd joint = expected.jointCovariance({0, 3, 149});
	EXPECT_LT((got.jointCovariance({0, 3, 149}) - joint).norm(), 1e-6 * joint.norm());
	optimizer.update(arrival.graph);
	EXPECT_THROW(got.covarianceOf(3), CError) << "outdated";
}

/** Between refinements too the covariance is that of the present elimination, near the batch's. */
TEST(Incremental, MarginalsOfAGrowingSurveyAreNearTheBatchs)
{
	const auto whole = lawnMower(survey(300));
	CArrival arrival(whole.graph);
	CIncrementalOptimizer optimizer;
	while (arrival.more()) {
		const int node = arrival.addNode();
		optimizer.update(arrival.graph);
		if (node % 60 != 59) continue;
		CSparseOptimizer batch;
		const auto expected = batch.marginals(arrival.graph), got = optimizer.marginals();
		const auto all = got.allCovariances();
		for (int i = 1; i <= node; i += 7) {
			const Matrix6d S = expected.covarianceOf(i);
			EXPECT_LT((got.covarianceOf(i) - S).norm(), 0.02 * S.norm()) << "nodes " << node << ", " << i;
			EXPECT_LT((all[size_t(i)] - got.covarianceOf(i)).norm(), 1e-8 * S.norm()) << node << ", " << i;
		}
	}
}
