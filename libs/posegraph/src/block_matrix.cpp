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
	setScalarPattern();
	m_values.assign(m_rows.size(), 0.0);
}

void CBlockMatrix::setScalarPattern()
{
	m_column_starts.assign(1, 0);
	m_rows.clear();
	m_rows.reserve(36 * m_block_rows.size());
	for (int column = 0; column < dimension(); column++) {
		const int c = column / 6;
		for (int k = m_first[c]; k < m_first[c + 1]; k++)
			for (int i = 0; i < 6; i++)
				m_rows.push_back(6 * m_block_rows[k] + i);
		m_column_starts.push_back(int(m_rows.size()));
	}
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
	std::fill(m_values.begin(), m_values.end(), 0.0);
}

Eigen::VectorXd CBlockMatrix::diagonal() const
{
	Eigen::VectorXd d(dimension());
	for (int i = 0; i < dimension(); i++)
		d[i] = m_values[m_column_starts[i] + i % 6];
	return d;
}

void CBlockMatrix::setDiagonal(const Eigen::VectorXd& diagonal)
{
	for (int i = 0; i < dimension(); i++)
		m_values[m_column_starts[i] + i % 6] = diagonal[i];
}

Eigen::MatrixXd CBlockMatrix::toDense() const
{
	Eigen::MatrixXd D = Eigen::MatrixXd::Zero(dimension(), dimension());
	for (int j = 0; j < dimension(); j++)
		for (int p = m_column_starts[j]; p < m_column_starts[j + 1]; p++)
			D(m_rows[p], j) = D(j, m_rows[p]) = m_values[p];
	return D;
}
}  // namespace posidonia
