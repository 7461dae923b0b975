#include <posidonia/base/error.h>
#include <posidonia/posegraph/chordal_initialization.h>

#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <numeric>

#include "graph/anchors.h"

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;

namespace
{
/** |x_to - B x_from - c|^2 in the metric W; x are 3 x k. */
struct TLinearEdge
{
	int from, to;
	Matrix3d B, W;
	MatrixXd c;
};

/** Number of each node among the free ones, -1 when anchored or no pose. */
std::vector<int> freeNumbers(const CPoseGraph& graph, const std::vector<char>& anchored)
{
	std::vector<int> number(graph.nodeCount(), -1);
	int next = 0;
	for (int node = 0; node < int(graph.nodeCount()); node++)
		if (!anchored[node] && graph.nodeKind(node) == ENodeKind::Pose) number[node] = next++;
	return number;
}

/** Throws CError naming a node that no chain of edges joins to an anchor. */
void requireJoined(const CPoseGraph& graph, std::vector<char> reached)
{
	std::vector<int> parent(graph.nodeCount());
	std::iota(parent.begin(), parent.end(), 0);
	const auto root = [&parent](int node) {
		while (parent[node] != node)
			node = parent[node] = parent[parent[node]];
		return node;
	};
	for (const TPoseEdge& edge : graph.edges())
		if (edge.loss.weight > 0) parent[root(edge.from)] = root(edge.to);
	std::vector<char> held(graph.nodeCount(), 0);
	for (int node = 0; node < int(graph.nodeCount()); node++)
		held[root(node)] |= reached[node];
	for (int node = 0; node < int(graph.nodeCount()); node++)
		reached[node] = held[root(node)];
	requireReached(graph, reached);
}

/** Sparse normal equations of TLinearEdge over the free nodes. */
class CLinearGraph
{
   public:
	CLinearGraph(const std::vector<int>& number, int free_count, int columns)
		: m_number(number), m_b(MatrixXd::Zero(3 * free_count, columns))
	{
	}

	void add(const TLinearEdge& edge, const std::vector<MatrixXd>& x)
	{
		const int i = m_number[edge.from], j = m_number[edge.to];
		const Matrix3d Bt_W = edge.B.transpose() * edge.W;
		MatrixXd c = edge.c;
		if (i < 0) c += edge.B * x[edge.from];
		if (j < 0) c -= x[edge.to];
		if (i >= 0) addNode(i, Bt_W * edge.B, -Bt_W * c);
		if (j >= 0) addNode(j, edge.W, edge.W * c);
		if (i < 0 || j < 0) return;
		if (i > j)
			addBlock(i, j, -Bt_W);
		else
			addBlock(j, i, -Bt_W.transpose());
	}

	/** Solves and puts the free nodes' values into x. */
	void solve(std::vector<MatrixXd>& x) const
	{
		if (m_b.rows() == 0) return;
		Eigen::SparseMatrix<double> A(m_b.rows(), m_b.rows());
		A.setFromTriplets(m_entries.begin(), m_entries.end());
		const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> llt(A);
		if (llt.info() != Eigen::Success)
			throw CError(
				"chordal initialisation", "the linear system is singular to working precision",
				"look for edges of very unequal information");
		const MatrixXd solution = llt.solve(m_b);
		for (size_t node = 0; node < m_number.size(); node++)
			if (m_number[node] >= 0) x[node] = solution.middleRows<3>(3 * m_number[node]);
	}

   private:
	void addNode(int i, const Matrix3d& H, const MatrixXd& b)
	{
		addBlock(i, i, H);
		m_b.middleRows<3>(3 * i) += b;
	}

	void addBlock(int row, int column, const Matrix3d& H)
	{
		for (int r = 0; r < 3; r++)
			for (int c = 0; c < 3; c++)
				if (row > column || r >= c) m_entries.emplace_back(3 * row + r, 3 * column + c, H(r, c));
	}

	const std::vector<int>& m_number;
	MatrixXd m_b;
	std::vector<Eigen::Triplet<double>> m_entries;
};

/** The nearest rotation in the Frobenius norm. */
Matrix3d projected(const Matrix3d& M)
{
	const Eigen::JacobiSVD<Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
	const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
	return svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

/** R_to = R_from R_from_to, read as R_to^T = R_from_to^T R_from^T: columns do not mix, so one matrix serves
 * all three. */
void solveRotations(
	const CPoseGraph& graph, const std::vector<int>& number, int free_count, std::vector<Isometry3d>& poses)
{
	CLinearGraph system(number, free_count, 3);
	std::vector<MatrixXd> x;
	x.reserve(poses.size());
	for (const Isometry3d& T : poses)
		x.push_back(T.linear().transpose());
	for (const TPoseEdge& edge : graph.edges()) {
		const double weight = edge.loss.weight * edge.information.bottomRightCorner<3, 3>().trace() / 3;
		if (weight > 0)
			system.add(
				{edge.from, edge.to, presentMeasurement(graph, edge).linear().transpose(),
				 weight * Matrix3d::Identity(), MatrixXd::Zero(3, 3)},
				x);
	}
	system.solve(x);
	for (size_t node = 0; node < poses.size(); node++)
		if (number[node] >= 0) poses[node].linear() = projected(x[node].transpose());
}

/** t_to = t_from + R_from t_from_to, in the metric of the translation's information, which is in `to`'s
 * frame. */
void solveTranslations(
	const CPoseGraph& graph, const std::vector<int>& number, int free_count, std::vector<Isometry3d>& poses)
{
	CLinearGraph system(number, free_count, 1);
	std::vector<MatrixXd> x;
	x.reserve(poses.size());
	for (const Isometry3d& T : poses)
		x.push_back(T.translation());
	for (const TPoseEdge& edge : graph.edges()) {
		if (edge.loss.weight == 0) continue;
		const Isometry3d M = presentMeasurement(graph, edge);
		const Matrix3d R_from = poses[edge.from].linear(), R = R_from * M.linear();
		const Matrix3d W = edge.loss.weight * R * edge.information.topLeftCorner<3, 3>() * R.transpose();
		system.add({edge.from, edge.to, Matrix3d::Identity(), W, R_from * M.translation()}, x);
	}
	system.solve(x);
	for (size_t node = 0; node < poses.size(); node++)
		if (number[node] >= 0) poses[node].translation() = x[node];
}
}  // namespace

void initializeChordal(CPoseGraph& graph)
{
	std::vector<Isometry3d> poses = graph.poses();
	const std::vector<char> anchored = anchors(graph, poses);
	requireJoined(graph, anchored);
	const std::vector<int> number = freeNumbers(graph, anchored);
	const int free_count = int(std::count_if(number.begin(), number.end(), [](int n) { return n >= 0; }));
	solveRotations(graph, number, free_count, poses);
	solveTranslations(graph, number, free_count, poses);
	graph.setPoses(poses);
}
}  // namespace posidonia
