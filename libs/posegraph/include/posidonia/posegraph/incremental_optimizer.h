#pragma once

#include <posidonia/base/error.h>
#include <posidonia/base/options.h>
#include <posidonia/posegraph/bayes_tree.h>
#include <posidonia/posegraph/marginals.h>
#include <posidonia/posegraph/sparse_optimizer.h>

namespace posidonia
{
struct TIncrementalOptions
{
	double relinearize_step{0.1};
	double reweigh_step{0.02};
	double solve_tolerance{1e-4};
	int max_solved{500};
	int inner_ring{30};
	double max_work{0.8};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"relinearize_step", relinearize_step, above(0),
			"A node is linearised anew when it has moved further from where it was [m, rad]");
		v.number(
			"reweigh_step", reweigh_step, above(0),
			"A robust factor is weighted anew when its weight (0 .. 1) has changed by more");
		v.number(
			"solve_tolerance", solve_tolerance, atLeast(0),
			"Older nodes are solved anew where something near them changed by more [m, rad / 10]");
		v.integer(
			"max_solved", max_solved, atLeast(1),
			"Older nodes solved anew in an update; small changes of more wait for the next ones");
		v.integer(
			"inner_ring", inner_ring, between(1, 1000),
			"So many nodes nearest to the newest are eliminated last, since the next are joined on there");
		v.number(
			"max_work", max_work, between(0, 1),
			"Nodes are linearised anew, those that moved most first, up to this part of a whole elimination");
	}
};

/** What an update did. */
struct TIncrementalResult
{
	int new_nodes{0}, new_factors{0};
	int eliminated{0};		 ///< nodes eliminated anew
	int relinearized{0};	 ///< nodes linearised anew
	int waiting{0};			 ///< nodes that moved far enough to be linearised anew, left for later updates
	int solved{0};			 ///< nodes whose solution changed
	int waiting_cliques{0};	 ///< cliques of older nodes whose solution waits for later updates
	double work{0};			 ///< multiply-adds of the eliminations
	bool rebuilt{false};	 ///< by the batch optimiser, since the information was not positive definite
};

/** Nonlinear least squares of a graph that grows (README, "Incremental"): nodes and factors arrive, an update
 * eliminates anew only the cliques on the way from what changed to the root, linearises anew what has moved,
 * solves what changed. The newest node's pose is that of a whole solve at the present linearisation; older
 * ones differ from it by less than the tolerance's effect; refine() makes all exact. */
class CIncrementalOptimizer
{
   public:
	explicit CIncrementalOptimizer(
		const TIncrementalOptions& options = {}, const TOptimizerOptions& batch = TOptimizerOptions());

	/** Takes over what the graph has more than at the last call, and factors of known numbers that have other
	 * values now; moves the graph's nodes. A node's fixed flag counts when it is first seen.
	 * @param changed_edges, changed_priors replaced by setEdge(), setPrior(), setLoss() since the last call
	 * @throws CError as CSparseOptimizer for what cannot be solved; once the graph is mended the next call
	 * goes on */
	TIncrementalResult update(
		CPoseGraph& graph, const std::vector<int>& changed_edges = {},
		const std::vector<int>& changed_priors = {});

	/** All nodes exact: the batch optimiser from here, and a new elimination at its result. */
	TOptimizerResult refine(CPoseGraph& graph);

	/** Covariances from the present elimination; good until the next update(). */
	CMarginals marginals() const;

	const CBayesTree& tree() const { return m_tree; }

   private:
	/** An edge or a prior of the graph. */
	struct TFactor
	{
		bool prior;
		int index;
	};
	struct TOutlook
	{
		int newest;				///< pose, -1 when there is none
		Eigen::Vector3d ahead;	///< direction of its motion, or zero
	};
	class CWeightedFactors;

	void followNodes(const CPoseGraph& graph);
	void followFactors(const CPoseGraph& graph, TIncrementalResult& result);
	void addFactor(const TFactor& factor, const TFactorNodes& nodes);
	void touchChanged(const std::vector<int>& edges, const std::vector<int>& priors);
	void relinearizeMoved(TIncrementalResult& result);
	void relinearize(int node);

	int eliminate(const CPoseGraph& graph, TIncrementalResult& result);
	TOutlook outlook() const;
	double nearness(int node) const;
	std::vector<double> nearness(const std::vector<int>& nodes) const;
	void touchAhead();
	std::vector<int> orderOf(const CBayesTree::TTop& top, const CFactorSource& factors);
	void findPairs(const CBayesTree::TTop& top);
	std::vector<int> ringsOf(const std::vector<int>& nodes) const;
	const TRobustLoss& lossOf(const CPoseGraph& graph, int factor) const;
	double weightOf(const CPoseGraph& graph, int factor) const;
	TFactorNormal normalOf(const CPoseGraph& graph, int factor) const;
	void findReweighted(const CPoseGraph& graph, int node);
	void touchReweighted();
	bool touchUnsettledNewest(TIncrementalResult& result);
	void solve(CPoseGraph& graph, TIncrementalResult& result);
	void moveNode(CPoseGraph& graph, int node) const;
	void rebuild(const CPoseGraph& graph);
	void takeAllOut(const CPoseGraph& graph);

	TIncrementalOptions m_options;
	CSparseOptimizer m_batch;
	CBayesTree m_tree;
	TNodeStates m_linearization;
	std::vector<ENodeKind> m_kinds;
	std::vector<char> m_free;
	std::vector<Vector6d> m_d;	///< from the linearisation to the estimate
	std::vector<std::vector<int>> m_factors_of;
	std::vector<TFactor> m_factors;
	std::vector<TFactorNodes> m_factor_nodes;  ///< those that are free
	std::vector<int> m_factor_of_edge, m_factor_of_prior;
	std::vector<int> m_new_nodes, m_new_factors;
	std::vector<int> m_moved;  ///< nodes to look at for relinearisation
	std::vector<char> m_is_moved;
	std::vector<double> m_weights;	///< of each factor, where it was last summed
	std::vector<int> m_reweighted;	///< factors that have another weight now
	std::vector<char> m_is_reweighted;
	TOutlook m_outlook{-1, Eigen::Vector3d::Zero()};
	std::vector<char> m_is_seen;			  ///< scratch, of each node
	std::vector<int> m_local;				  ///< scratch: place of a node in the top
	std::vector<std::array<int, 2>> m_pairs;  ///< scratch
};
}  // namespace posidonia
