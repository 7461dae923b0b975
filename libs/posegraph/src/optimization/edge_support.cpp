#include <posidonia/posegraph/edge_support.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "graph/anchors.h"

namespace posidonia
{
namespace
{
/** A relative pose with the covariance of its right perturbation. */
struct TStep
{
	Eigen::Isometry3d T{Eigen::Isometry3d::Identity()};
	Matrix6d cov{Matrix6d::Zero()};

	TStep operator*(const TStep& b) const { return {T * b.T, composeCovariance(cov, b.T, b.cov)}; }
	TStep inverse() const { return {T.inverse(), inverseCovariance(T, cov)}; }
};

/** An edge told from its lower node to its higher one. */
struct TUpward
{
	int low, high;
	TStep step;
};

TUpward upward(const CPoseGraph& graph, const TPoseEdge& edge)
{
	const TStep step{presentMeasurement(graph, edge), edge.information.inverse()};
	if (edge.from < edge.to) return {edge.from, edge.to, step};
	return {edge.to, edge.from, step.inverse()};
}

class CSupport
{
   public:
	CSupport(
		const CPoseGraph& graph, const std::vector<int>& trusted, const std::vector<int>& open,
		double threshold2, int window)
		: m_next(graph.nodeCount()), m_threshold2(threshold2), m_window(window)
	{
		for (const int k : trusted) {
			const TUpward up = upward(graph, graph.edge(k));
			if (up.high == up.low + 1) m_next[up.low] = up.step;
		}
		for (const int k : open) {
			m_edges.push_back(upward(graph, graph.edge(k)));
			m_by_low.emplace(m_edges.back().low, m_edges.size() - 1);
		}
	}

	/** For each open edge: cycles that close, less those that do not. */
	std::vector<int> votes() const
	{
		std::vector<int> votes(m_edges.size(), 0);
		for (size_t a = 0; a < m_edges.size(); a++) {
			const auto end = m_by_low.upper_bound(m_edges[a].low + m_window);
			for (auto it = m_by_low.lower_bound(m_edges[a].low); it != end; ++it) {
				const size_t b = it->second;
				if (m_edges[b].low == m_edges[a].low && b <= a) continue;  // each pair once
				if (std::abs(m_edges[a].high - m_edges[b].high) > m_window) continue;
				const std::optional<double> s = cycle(m_edges[a], m_edges[b]);
				if (!s) continue;
				votes[a] += *s <= m_threshold2 ? 1 : -1;
				votes[b] += *s <= m_threshold2 ? 1 : -1;
			}
		}
		return votes;
	}

   private:
	/** Along the trusted edges, in either direction. */
	std::optional<TStep> between(int from, int to) const
	{
		TStep sum;
		for (int i = std::min(from, to); i < std::max(from, to); i++) {
			if (!m_next[i]) return std::nullopt;
			sum = sum * *m_next[i];
		}
		return from <= to ? sum : sum.inverse();
	}

	/** Squared Mahalanobis distance of a against the way through b. */
	std::optional<double> cycle(const TUpward& a, const TUpward& b) const
	{
		const auto to_b = between(a.low, b.low), from_b = between(b.high, a.high);
		if (!to_b || !from_b) return std::nullopt;
		const TStep way = *to_b * b.step * *from_b;
		const Vector6d d = localCoordinates(a.step.T, way.T);
		return d.dot((a.step.cov + way.cov).ldlt().solve(d));
	}

	std::vector<std::optional<TStep>> m_next;  ///< trusted step to the node after
	std::vector<TUpward> m_edges;
	std::multimap<int, size_t> m_by_low;
	double m_threshold2;
	int m_window;
};
}  // namespace

std::vector<int> supportedEdges(
	const CPoseGraph& graph, const std::vector<int>& trusted, const std::vector<int>& open, double threshold2,
	int window)
{
	const auto votes = CSupport(graph, trusted, open, threshold2, window).votes();
	std::vector<int> out;
	for (size_t k = 0; k < open.size(); k++)
		if (votes[k] > 0) out.push_back(open[k]);
	return out;
}
}  // namespace posidonia
