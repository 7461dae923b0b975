#pragma once

#include <posidonia/posegraph/clique_factor.h>
#include <posidonia/posegraph/elimination_forest.h>
#include <posidonia/posegraph/factor_normal.h>
#include <posidonia/posegraph/large_buffer.h>

#include <cstdint>
#include <deque>

namespace posidonia
{
struct TFrontKernels;

/** Factors by their numbers, as an elimination asks for them. */
class CFactorSource
{
   public:
	virtual ~CFactorSource() = default;
	/** Those that are not fixed. */
	virtual TFactorNodes nodesOf(int factor) const = 0;
	/** From now on the factor has the weight that its loss gives it at the present estimate. */
	virtual void weighAnew(int factor) = 0;
	/** Weighted normal equations over nodesOf() at the present linearisation. */
	virtual TFactorNormal normalOf(int factor) const = 0;
};

/** The eliminated graph as a tree of cliques (Kaess et al. 2012), each with its columns of L and with what
 * its subtree leaves to the parent. A change touches the cliques on the way to the root; these are taken out
 * and eliminated anew, in a new order, while the subtrees that hung on them (orphans) are only summed again.
 *
 * Nodes and factors are numbers of the caller's. Everything is in the order of calls: the same calls give the
 * same bytes. */
class CBayesTree : public CCliqueFactor
{
   public:
	/** What is taken out: variables and factors to be eliminated anew. */
	struct TTop
	{
		std::vector<int> nodes;	   ///< in their old order of elimination
		std::vector<int> factors;  ///< ascending
		std::vector<int> orphans;  ///< cliques
	};

	CBayesTree();

	/** Makes the clique and all above it part of the next top. */
	void touch(int clique);
	/** Clique where the factor was summed, -1 for one that is new. */
	int cliqueOfFactor(int factor) const;
	/** Multiply-adds of the cliques that touch() marked since the last takeTop(). */
	double touchedWork() const { return m_touched_work; }
	/** Their nodes. */
	int touchedNodes() const { return m_touched_nodes; }

	TTop takeTop();

	/** Eliminates the top anew. @param order of its nodes; @param late of each of them in this order: the
	 * higher, the sooner it will be touched again
	 * @return -1, or the node where H is not positive definite; the tree must then be cleared */
	int eliminate(
		const TTop& top, const std::vector<int>& order, const std::vector<double>& late,
		CFactorSource& factors);

	/** Multiply-adds of that elimination. */
	double workOf(const TTop& top, const std::vector<int>& order, const CFactorSource& factors);

	/** How much of the solution below what is fresh a call looks at. */
	struct TSolveEffort
	{
		Vector6d tolerance;	 ///< A smaller change of a coordinate is not carried further down; above 0
		int nodes;			 ///< Once so many are solved, small changes wait for later calls
		double urgent;		 ///< Changes of more tolerances never wait
	};
	/** Solution of the cliques made by the last eliminate(), exact; and further down wherever a coordinate
	 * changes by more than the tolerance. Returns the nodes whose solution changed. @param d of every node */
	const std::vector<int>& solve(const TSolveEffort& effort, std::vector<Vector6d>& d);
	/** Cliques that wait. */
	size_t waiting() const { return m_reached.size(); }

	void clear();

	/** Nodes that the clique's subtree is joined to the rest by. */
	const std::vector<int>& separatorOf(int clique) const { return m_cliques[clique].separator; }
	size_t cliqueCount() const { return m_cliques.size() - m_unused.size(); }
	/** Multiply-adds to eliminate all cliques. */
	double wholeWork() const { return m_whole_work; }

	int cliqueOf(int node) const override { return node < int(m_clique_of.size()) ? m_clique_of[node] : -1; }
	CCliqueFactor::TClique clique(int clique) const override;
	std::vector<int> parentsFirst() const override;
	size_t version() const override { return m_version; }

   private:
	struct TClique
	{
		std::vector<int> pivots, separator;	 ///< nodes, in order of elimination
		std::vector<int> factors, children;
		std::vector<int>
			rows;  ///< of the separator's blocks in the parent's front; the parent's size at the end
		bool rows_ascend{true};
		int parent{-1};
		double work{0};
		size_t made{0};		///< the version that it was made at
		int kept_below{0};	///< pivots of it and of cliques below whose rests were dropped
		CLargeBuffer panel;
		CLargeBuffer
			rest;  ///< what it leaves to the parent; may be dropped, and is then found again by elimination
		bool has_rest{false};
		bool rest_is_passing{false};  ///< found again for the parent's, and of no use after that
		float reached{
			0};	 ///< tolerances by which what its solution depends on has changed since it was found

		int left() const { return int(separator.size()); }
		int size() const { return int(pivots.size()) + left(); }
	};

	std::vector<int> newCliques(const TEliminationForest& forest, const std::vector<int>& order);
	void adoptOrphan(int orphan);
	void placeFactor(int factor, const TFactorNodes& nodes);
	TEliminationForest forestOf(
		const TTop& top, const std::vector<int>& order, const std::vector<double>& late,
		const CFactorSource& factors);
	TVariableSets setsOf(const TTop& top, const CFactorSource& factors);
	int eliminateClique(TClique& clique, CFactorSource& factors);
	void takeFactors(TClique& clique, const CFactorSource& factors);
	void sumFactors(TClique& clique, bool panel);
	void sumChildren(TClique& clique, bool panel);
	void sumRest(TClique& clique);
	void recoverRests(const std::vector<int>& orphans, const CFactorSource& factors);
	void mapChildRows(TClique& clique);
	void solveClique(const TClique& clique, std::vector<Vector6d>& d);
	void backSubstitute(const TClique& clique, const std::vector<Vector6d>& d);
	void reach(int clique, float change);
	void solveReached(const TSolveEffort& effort, std::vector<Vector6d>& d);
	float changeOf(const TClique& clique, const Vector6d& tolerance, const std::vector<Vector6d>& d);
	void take(const TClique& clique, std::vector<Vector6d>& d);
	int newSlot();
	void dropOldRests();
	void dropLargeRestsBelow(const TClique& clique);
	void dropRestUnless(TClique& clique, int stands_for);

	const TFrontKernels* m_kernels;
	std::vector<TClique> m_cliques;
	std::vector<int> m_unused;		   ///< slots of m_cliques
	std::vector<char> m_touched_flag;  ///< of each slot
	std::vector<int> m_touched;
	double m_touched_work{0}, m_whole_work{0};
	int m_touched_nodes{0};
	std::vector<int> m_clique_of;  ///< of each node
	std::vector<int64_t> m_rank;   ///< of each node: its place in the order of elimination
	int64_t m_next_rank{0};
	std::vector<int> m_clique_of_factor;
	std::vector<int> m_fresh;			   ///< cliques of the last eliminate(), children first
	std::vector<int> m_adopted;			   ///< orphans below them
	std::vector<int> m_local;			   ///< scratch: block of a node in the front at hand
	std::vector<TFactorNormal> m_normals;  ///< scratch: of the clique at hand
	std::vector<double> m_x;			   ///< scratch
	std::vector<int> m_reached;			   ///< cliques to look at
	std::vector<int> m_solved;
	/** A clique, when it was made, and when it was last touched. */
	struct TAged
	{
		int clique;
		size_t made, since;
	};
	std::deque<TAged> m_by_age;
	size_t m_version{0};
};
}  // namespace posidonia
