#pragma once

#include <posidonia/geometry/se3.h>
#include <posidonia/posegraph/large_buffer.h>

#include <array>
#include <vector>

namespace posidonia
{
/** Lower triangle of a symmetric sparse matrix of 6x6 blocks, block column by block column. A block column
 * with m blocks is one dense column-major 6m x 6 array, its diagonal block on top; so a block is a strided
 * map. The diagonal blocks are stored in full. */
class CBlockMatrix
{
   public:
	/** (column, row) of a block below the diagonal, column < row. */
	using TPosition = std::array<int, 2>;
	using TBlock = Eigen::Map<Matrix6d, Eigen::Unaligned, Eigen::OuterStride<>>;

	/** Where a block's values start and how far its columns are apart. */
	struct TSlot
	{
		size_t offset{0};
		int stride{0};
	};

	/** Block rows, for range-based loops. */
	struct TRows
	{
		const int *first, *last;
		const int* begin() const { return first; }
		const int* end() const { return last; }
	};

	/** @param below blocks below the diagonal, sorted and each once; every diagonal block is there too */
	void setPattern(int block_count, const std::vector<TPosition>& below);

	int blockCount() const { return m_block_count; }
	int dimension() const { return 6 * m_block_count; }
	TSlot diagonalSlot(int column) const;
	/** The block at (row, column), row > column; it must be in the pattern. */
	TSlot slot(int row, int column) const;
	TBlock block(const TSlot& slot)
	{
		return TBlock(m_values.data() + slot.offset, Eigen::OuterStride<>(slot.stride));
	}

	/** Where the blocks of a column begin in the order of all blocks, column by column. */
	int firstBlock(int column) const { return m_first[column]; }
	/** Block rows of a column's blocks, ascending, the diagonal's first. */
	TRows rowsOfColumn(int column) const
	{
		return {m_block_rows.data() + m_first[column], m_block_rows.data() + m_first[column + 1]};
	}

	void setZero();
	Eigen::VectorXd diagonal() const;
	void setDiagonal(const Eigen::VectorXd& diagonal);

	/** All values, block column by block column. */
	const double* values() const { return m_values.data(); }

	/** All of it, dense and symmetric: for checks of small systems. */
	Eigen::MatrixXd toDense() const;

   private:
	int m_block_count{0};
	std::vector<int> m_first;		///< index of each block column's first block (its diagonal); n + 1
	std::vector<int> m_block_rows;	///< block row of each block
	CLargeBuffer m_values;
};
}  // namespace posidonia
