#pragma once

#include <posidonia/posegraph/factor_normal.h>

#include <array>

namespace posidonia
{
/** Which nodes are free and which of them share a factor; kept beside a graph that grows, where following it
 * costs a comparison of what is known and work only for what is new. */
class CGraphStructure
{
   public:
	/** (a, b), a < b. */
	using TPair = std::array<int, 2>;

	/** Looks at the graph. False when nothing changed since the last call. */
	bool follow(const CPoseGraph& graph);

	/** Throws CError naming a pose that neither a fixed node nor enough priors hold, and what is missing. */
	void requireHeld(const CPoseGraph& graph) const;

	const std::vector<int>& freeNodes() const { return m_free; }
	/** Pairs of nodes, fixed ones included, that share a factor; sorted, each once. */
	const std::vector<TPair>& pairs() const { return m_pairs; }
	/** The nodes of every edge, then of every prior, as of the last follow(). */
	const std::vector<TFactorNodes>& edges() const { return m_edges; }
	const std::vector<TFactorNodes>& priors() const { return m_priors; }

   private:
	bool grewFrom(const CPoseGraph& graph) const;
	void append(const CPoseGraph& graph);
	void appendFactor(const TFactorNodes& nodes, std::vector<TPair>& pairs);
	int root(int node) const;

	std::vector<char> m_fixed;
	std::vector<TFactorNodes> m_edges, m_priors;
	std::vector<TPair> m_pairs;
	std::vector<int> m_free;
	mutable std::vector<int> m_parent;	///< sets of poses joined by edges; error variables join nothing
};
}  // namespace posidonia
