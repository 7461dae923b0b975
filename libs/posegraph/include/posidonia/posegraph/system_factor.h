#pragma once

#include <posidonia/posegraph/clique_factor.h>
#include <posidonia/posegraph/normal_equations.h>

namespace posidonia
{
/** The batch optimiser's L, by the graph's nodes. */
class CSystemFactor : public CCliqueFactor
{
   public:
	CSystemFactor(const CNormalEquations& system, const CMultifrontalCholesky& cholesky)
		: m_system(system), m_cholesky(cholesky)
	{
	}
	int cliqueOf(int node) const override
	{
		const int column = m_system.columnOf(node);
		return column < 0 ? -1 : m_cholesky.forest().clique_of[column];
	}
	TClique clique(int c) const override
	{
		const auto& clique = m_cholesky.forest().cliques[c];
		return {clique.parent,		 clique.size(),
				clique.pivots,		 m_system.nodesOfColumns().data() + clique.first,
				m_cholesky.panel(c), m_cholesky.rowsInParent(c)};
	}
	std::vector<int> parentsFirst() const override
	{
		std::vector<int> out;
		for (int c = int(m_cholesky.forest().cliques.size()) - 1; c >= 0; c--)
			out.push_back(c);
		return out;
	}
	size_t version() const override { return m_cholesky.factorizations(); }

   private:
	const CNormalEquations& m_system;
	const CMultifrontalCholesky& m_cholesky;
};
}  // namespace posidonia
