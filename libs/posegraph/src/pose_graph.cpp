#include <posidonia/base/error.h>
#include <posidonia/posegraph/pose_graph.h>

#include <cmath>

namespace posidonia
{
namespace
{
/** What is wrong with a pose, or nullptr. */
const char* poseProblem(const Eigen::Isometry3d& T)
{
	if (!T.matrix().allFinite()) return "the pose is not finite";
	const Eigen::Matrix3d R = T.linear();
	const bool orthonormal = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < 1e-6;
	return orthonormal && R.determinant() > 0 ? nullptr : "the pose's rotation is not orthonormal";
}

const char* lossProblem(const TRobustLoss& loss)
{
	return std::isfinite(loss.scale) && loss.scale > 0 ? nullptr : "the robust loss's scale is not positive";
}

const char* edgeProblem(const TPoseEdge& edge, int node_count)
{
	const auto exists = [&](int node) { return node >= 0 && node < node_count; };
	if (!exists(edge.from) || !exists(edge.to)) return "a node does not exist";
	if (edge.from == edge.to) return "both ends are the same node";
	if (const char* problem = poseProblem(edge.T_from_to)) return problem;
	if (!isPositiveDefinite(edge.information)) return "the information is not symmetric positive definite";
	return lossProblem(edge.loss);
}
}  // namespace

int CPoseGraph::addNode(const Eigen::Isometry3d& T_map_node, bool fixed)
{
	const int id = int(m_poses.size());
	if (const char* problem = poseProblem(T_map_node))
		throw CError("node " + std::to_string(id), problem, "give a finite rotation and translation");
	m_poses.push_back(T_map_node);
	m_fixed.push_back(fixed);
	return id;
}

int CPoseGraph::addEdge(const TPoseEdge& edge)
{
	const int index = int(m_edges.size());
	if (const char* problem = edgeProblem(edge, int(m_poses.size())))
		throw CError(
			"edge " + std::to_string(index) + " (" + std::to_string(edge.from) + " -> " +
				std::to_string(edge.to) + ")",
			problem, "the graph has nodes 0 to " + std::to_string(int(m_poses.size()) - 1));
	m_edges.push_back(edge);
	return index;
}

void CPoseGraph::setEdge(int index, const TPoseEdge& other)
{
	const TPoseEdge& old = edge(index);
	const char* problem = other.from == old.from && other.to == old.to
							  ? edgeProblem(other, int(m_poses.size()))
							  : "it joins other nodes";
	if (problem)
		throw CError(
			"edge " + std::to_string(index), problem,
			"replace it by one from " + std::to_string(old.from) + " to " + std::to_string(old.to));
	m_edges[index] = other;
}

const TPoseEdge& CPoseGraph::edge(int index) const
{
	if (index < 0 || index >= int(m_edges.size()))
		throw CError(
			"edge " + std::to_string(index), "no such edge",
			"the graph has " + std::to_string(m_edges.size()) + " edges");
	return m_edges[index];
}

void CPoseGraph::setLoss(int edge_index, const TRobustLoss& loss)
{
	edge(edge_index);
	if (const char* problem = lossProblem(loss))
		throw CError("edge " + std::to_string(edge_index), problem, "give a scale above 0");
	m_edges[edge_index].loss = loss;
}

const Eigen::Isometry3d& CPoseGraph::pose(int node) const
{
	requireNode(node);
	return m_poses[node];
}

void CPoseGraph::setPose(int node, const Eigen::Isometry3d& T_map_node)
{
	requireNode(node);
	if (const char* problem = poseProblem(T_map_node))
		throw CError("node " + std::to_string(node), problem, "give a finite rotation and translation");
	m_poses[node] = T_map_node;
}

void CPoseGraph::setPoses(const std::vector<Eigen::Isometry3d>& poses)
{
	if (poses.size() != m_poses.size())
		throw CError(
			"pose graph",
			std::to_string(poses.size()) + " poses for " + std::to_string(m_poses.size()) + " nodes",
			"give one a node");
	m_poses = poses;
}

bool CPoseGraph::isFixed(int node) const
{
	requireNode(node);
	return m_fixed[node];
}

void CPoseGraph::setFixed(int node, bool fixed)
{
	requireNode(node);
	m_fixed[node] = fixed;
}

void CPoseGraph::requireNode(int node) const
{
	if (node >= 0 && node < int(m_poses.size())) return;
	throw CError(
		"node " + std::to_string(node), "no such node",
		"the graph has " + std::to_string(m_poses.size()) + " nodes");
}
}  // namespace posidonia
