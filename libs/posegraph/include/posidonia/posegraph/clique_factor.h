#pragma once

#include <cstddef>
#include <vector>

namespace posidonia
{
/** L of an eliminated graph as its cliques hold it, whoever eliminated it: what marginals are computed from.
 */
class CCliqueFactor
{
   public:
	struct TClique
	{
		int parent;			  ///< -1: a root
		int blocks, pivots;	  ///< the front's, and of them those eliminated here
		const int* nodes;	  ///< of the pivots
		const double* panel;  ///< simd/front_kernels.h
		const int*
			rows_in_parent;	 ///< for each block after the pivots, which block of the parent's front it is
	};

	virtual ~CCliqueFactor() = default;
	/** -1 for a node that is held fixed. */
	virtual int cliqueOf(int node) const = 0;
	virtual TClique clique(int clique) const = 0;
	/** All cliques, each after its parent. */
	virtual std::vector<int> parentsFirst() const = 0;
	/** Changes whenever L does. */
	virtual size_t version() const = 0;
};
}  // namespace posidonia
