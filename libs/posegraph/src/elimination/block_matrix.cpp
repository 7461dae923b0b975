#include <posidonia/posegraph/block_matrix.h>

#include <algorithm>

namespace posidonia
{
void CBlockMatrix::setPattern(int block_count, const std::vector<TPosition>& below)
{
	m_block_count = block_count;
	m_first.assign(block_count + 1, 0);
	m_block_rows.clear();
	auto next = below.begin();
	for (int c = 0; c < block_count; c++) {
		m_block_rows.push_back(c);
		for (; next != below.end() && (*next)[0] == c; ++next)
			m_block_rows.push_back((*next)[1]);
		m_first[c + 1] = int(m_block_rows.size());
	}
	m_values.resize(36 * m_block_rows.size());
	setZero();
}

CBlockMatrix::TSlot CBlockMatrix::diagonalSlot(int column) const
{
	return {36 * size_t(m_first[column]), 6 * (m_first[column + 1] - m_first[column])};
}

CBlockMatrix::TSlot CBlockMatrix::slot(int row, int column) const
{
	const auto begin = m_block_rows.begin() + m_first[column],
			   end = m_block_rows.begin() + m_first[column + 1];
	TSlot slot = diagonalSlot(column);
	slot.offset += 6 * size_t(std::lower_bound(begin, end, row) - begin);
	return slot;
}

void CBlockMatrix::setZero()
{
	std::fill_n(m_values.data(), m_values.size(), 0.0);
}

Eigen::VectorXd CBlockMatrix::diagonal() const
{
	Eigen::VectorXd d(dimension());
	for (int c = 0; c < m_block_count; c++) {
		const auto [offset, stride] = diagonalSlot(c);
		for (int k = 0; k < 6; k++)
			d[6 * c + k] = m_values.data()[offset + size_t(k * (stride + 1))];
	}
	return d;
}

void CBlockMatrix::setDiagonal(const Eigen::VectorXd& diagonal)
{
	for (int c = 0; c < m_block_count; c++) {
		const auto [offset, stride] = diagonalSlot(c);
		for (int k = 0; k < 6; k++)
			m_values.data()[offset + size_t(k * (stride + 1))] = diagonal[6 * c + k];
	}
}

Eigen::MatrixXd CBlockMatrix::toDense() const
{
	Eigen::MatrixXd D = Eigen::MatrixXd::Zero(dimension(), dimension());
	for (int c = 0; c < m_block_count; c++)
		for (const int r : rowsOfColumn(c)) {
			const TSlot at = slot(r, c);
			const Eigen::Map<const Matrix6d, 0, Eigen::OuterStride<>> B(
				m_values.data() + at.offset, Eigen::OuterStride<>(at.stride));
			D.block<6, 6>(6 * r, 6 * c) = B;
			D.block<6, 6>(6 * c, 6 * r) = B.transpose();
		}
	return D;
}
}  // namespace posidonia
