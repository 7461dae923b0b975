#pragma once

#include <posidonia/posegraph/sparse_optimizer.h>

namespace posidonia
{
struct TGncOptions
{
	double inlier_probability{0.999};
	double convexity_factor{1.4};
	int max_rounds{150};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"inlier_probability", inlier_probability, between(0.5, 0.999999999),
			"Part of the true edges that the chi-square test of 6 degrees of freedom shall keep [-]");
		v.number(
			"convexity_factor", convexity_factor, between(1.01, 10),
			"Growth of mu a round: from convex to truncated least squares (Yang et al. 2020, remark 5) [-]");
		v.integer("max_rounds", max_rounds, between(1, 10000), "Rounds at most");
	}
};

struct TGncResult
{
	TOptimizerResult optimum;  ///< of the last optimisation, with the final weights
	/** Of every edge: 1 kept (trusted ones always), 0 rejected. The graph's edges have it as their loss's
	 * weight. */
	std::vector<double> edge_weights;
	int rounds{0};
	bool settled{false};  ///< did the weights reach 0 or 1 within max_rounds?
	std::vector<int> rejectedEdges() const;
};

/** Truncated least squares by graduated non-convexity (Yang, Antonante, Tzoumas, Carlone 2020, sec. IV): from
 * a convex cost in which every edge counts to one in which an edge counts fully or not at all. Starts from
 * the edges that confirm one another, when there are any (edge_support.h; README, "Graduated
 * non-convexity"). The loss of an edge that is not trusted is replaced by none, of weight 0 or 1. */
class CGraduatedNonconvexity
{
   public:
	explicit CGraduatedNonconvexity(const TGncOptions& options = {}, const TOptimizerOptions& final = {});

	/** Trusts the edges between consecutive nodes (odometry). Throws CError as CSparseOptimizer does. */
	TGncResult optimize(CPoseGraph& graph);
	/** @param trusted edges that keep weight and loss; with the priors they must hold the graph */
	TGncResult optimize(CPoseGraph& graph, const std::vector<int>& trusted);

   private:
	/** One run's state. */
	struct TRun
	{
		CPoseGraph& graph;
		std::vector<int> trusted, open;	 ///< edges
		TGncResult result;
	};

	bool startFromSupported(TRun& run);
	TGncResult bestOf(TRun& run, const std::vector<double>& mus);
	double truncatedCost(const TRun& run) const;
	double startFromAll(TRun& run);
	void anneal(TRun& run, double mu);
	void truncate(TRun& run);
	bool reweigh(TRun& run, double mu) const;
	void optimizeWeighted(TRun& run, CSparseOptimizer& optimizer) const;

	TGncOptions m_options;
	double m_threshold2;  ///< squared Mahalanobis distance beyond which an edge is an outlier [-]
	CSparseOptimizer m_coarse, m_final;
};

/** Weight of a squared distance s at convexity mu: 1 near zero, 0 far out (Yang et al. 2020, eq. 14). mu ->
 * infinity is truncation at s = threshold2. */
double gncWeight(double s, double threshold2, double mu);
}  // namespace posidonia
