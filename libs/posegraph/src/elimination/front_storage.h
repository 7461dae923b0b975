#pragma once

#include <posidonia/posegraph/block_matrix.h>
#include <posidonia/posegraph/elimination_forest.h>

#include <map>

namespace posidonia
{
/** Hands out places in an array that does not exist yet: first fit, lowest first. */
class CSpace
{
   public:
	/** Where `size` numbers of the owner go. */
	size_t take(int owner, size_t size);
	/** Nothing when the owner has none here. */
	void release(int owner);
	/** Numbers needed for all that was taken. */
	size_t size() const { return m_size; }

   private:
	struct TPiece
	{
		size_t begin, size;
	};
	std::map<size_t, size_t> m_free;  ///< size of each free piece by its begin; neighbours are joined
	std::map<int, TPiece> m_taken;
	size_t m_size{0};
};

/** For each block of a clique's separator, which block of the parent's front it is; the parent's size at the
 * end. */
void appendRowsInParent(
	const TEliminationForest::TClique& clique, const TEliminationForest::TClique& parent,
	std::vector<int>& rows);

/** Multiply-adds to eliminate a clique, its pivots and its separator in blocks. */
double eliminationWork(int pivots, int separator);

/** Multiply-adds of the clique and all below it, for each clique. */
std::vector<double> subtreeWork(const TEliminationForest& forest);

/** The first clique of each clique's subtree, which is consecutive. */
std::vector<int> firstOfSubtree(const TEliminationForest& forest);

/** Adds the blocks of a column of H to block column J of a front. @param rows of each block: its block row
 * there */
void addColumn(const CBlockMatrix& H, int column, const int* rows, int J, double* to, int ld);
}  // namespace posidonia
