#include <posidonia/base/error.h>
#include <posidonia/posegraph/factor_normal.h>
#include <posidonia/posegraph/pose_graph.h>

#include <algorithm>
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
	if (!(std::isfinite(loss.scale) && loss.scale > 0)) return "the robust loss's scale is not positive";
	if (!(std::isfinite(loss.weight) && loss.weight >= 0)) return "the loss's weight is negative";
	return nullptr;
}

const char* const kNotDefinite = "the information is not symmetric positive definite";

std::string nodeName(int node)
{
	return "node " + std::to_string(node);
}

std::string edgeName(int index, const TPoseEdge& edge)
{
	return "edge " + std::to_string(index) + " (" + std::to_string(edge.from) + " -> " +
		   std::to_string(edge.to) + ")";
}

std::string priorName(int index, const TPosePrior& prior)
{
	return "prior " + std::to_string(index) + " (" + toString(prior.kind) + " of node " +
		   std::to_string(prior.node) + ")";
}

/** The part of M that the kind uses, the rest zero. */
Matrix6d usedPart(EPriorKind kind, const Matrix6d& M, bool all_columns)
{
	const int n = priorDimension(kind), columns = all_columns ? 6 : n;
	Matrix6d out = Matrix6d::Zero();
	out.topLeftCorner(n, columns) = M.topLeftCorner(n, columns);
	return out;
}

/** As it is stored: what the kind does not use is zero. */
TPosePrior cleaned(const TPosePrior& prior)
{
	TPosePrior out = prior;
	out.information = usedPart(prior.kind, prior.information, false);
	out.sensitivity = usedPart(prior.kind, prior.sensitivity, true);
	return out;
}

bool sameNodes(const TFactorNodes& a, const TFactorNodes& b)
{
	return std::equal(a.node, a.node + 3, b.node);
}

/** "edges 6, 9" or "no edges". */
template <class FACTORS>
std::string factorsAt(const std::string& what, const FACTORS& factors, int node, int limit)
{
	std::string out;
	int found = 0;
	for (size_t k = 0; k < factors.size(); k++) {
		const TFactorNodes nodes = nodesOf(factors[k]);
		if (std::find(nodes.node, nodes.node + nodes.count, node) == nodes.node + nodes.count) continue;
		if (++found > limit) return what + out + " ...";
		out += (found == 1 ? " " : ", ") + std::to_string(k);
	}
	return out.empty() ? "no " + what : what + out;
}
}  // namespace

int CPoseGraph::addNode(const Eigen::Isometry3d& T_map_node, bool fixed)
{
	if (const char* problem = poseProblem(T_map_node))
		throw CError(nodeName(int(nodeCount())), problem, "give a finite rotation and translation");
	return addNode(ENodeKind::Pose, T_map_node, Vector6d::Zero(), fixed);
}

int CPoseGraph::addErrorVariable(const Vector6d& value, const Matrix6d& prior_information)
{
	TPosePrior prior;
	prior.kind = EPriorKind::ErrorVariable;
	prior.value = value;
	prior.information = prior_information;
	prior.node = int(nodeCount());
	if (!value.allFinite() || !isPositiveDefinite(prior_information))
		throw CError(
			"error variable, " + nodeName(prior.node), value.allFinite() ? kNotDefinite : "it is not finite",
			"give a finite value and the inverse of a covariance");
	addNode(ENodeKind::ErrorVariable, Eigen::Isometry3d::Identity(), value, false);
	addPrior(prior);
	return prior.node;
}

int CPoseGraph::addNode(
	ENodeKind kind, const Eigen::Isometry3d& T_map_node, const Vector6d& value, bool fixed)
{
	m_states.poses.push_back(T_map_node);
	m_states.values.push_back(value);
	m_kinds.push_back(kind);
	m_fixed.push_back(fixed);
	return int(m_kinds.size()) - 1;
}

const char* CPoseGraph::edgeProblem(const TPoseEdge& edge) const
{
	if (!isNode(edge.from, ENodeKind::Pose) || !isNode(edge.to, ENodeKind::Pose))
		return "a node does not exist or is no pose";
	if (edge.from == edge.to) return "both ends are the same node";
	if (edge.error_variable != -1 && !isNode(edge.error_variable, ENodeKind::ErrorVariable))
		return "its error variable does not exist or is a pose";
	if (const char* problem = poseProblem(edge.T_from_to)) return problem;
	if (!isPositiveDefinite(edge.information)) return kNotDefinite;
	if (edge.error_variable >= 0 && edge.sensitivity.cols() != 6) return "the sensitivity is not 6 x 6";
	if (!edge.sensitivity.allFinite()) return "the sensitivity is not finite";
	return lossProblem(edge.loss);
}

const char* CPoseGraph::priorProblem(const TPosePrior& prior) const
{
	const bool of_error = prior.kind == EPriorKind::ErrorVariable;
	if (!isNode(prior.node, of_error ? ENodeKind::ErrorVariable : ENodeKind::Pose))
		return "the node does not exist or is of the wrong kind";
	if (prior.error_variable != -1 && (of_error || !isNode(prior.error_variable, ENodeKind::ErrorVariable)))
		return "its error variable does not exist or is a pose";
	if (const char* problem = poseProblem(prior.T_map_node)) return problem;
	if (!prior.value.allFinite()) return "the value is not finite";
	Matrix6d padded = usedPart(prior.kind, prior.information, false);
	for (int i = priorDimension(prior.kind); i < 6; i++)
		padded(i, i) = padded(0, 0);
	if (!isPositiveDefinite(padded)) return kNotDefinite;
	if (!usedPart(prior.kind, prior.sensitivity, true).allFinite()) return "the sensitivity is not finite";
	return lossProblem(prior.loss);
}

int CPoseGraph::addEdge(const TPoseEdge& edge)
{
	const int index = int(m_edges.size());
	if (const char* problem = edgeProblem(edge))
		throw CError(
			edgeName(index, edge), problem,
			"the graph has nodes 0 to " + std::to_string(int(nodeCount()) - 1));
	m_edges.push_back(edge);
	return index;
}

int CPoseGraph::addPrior(const TPosePrior& prior)
{
	const int index = int(m_priors.size());
	if (const char* problem = priorProblem(prior))
		throw CError(
			priorName(index, prior), problem,
			"the graph has nodes 0 to " + std::to_string(int(nodeCount()) - 1));
	m_priors.push_back(cleaned(prior));
	return index;
}

CPoseGraph CPoseGraph::withEdges(const std::vector<int>& indices) const
{
	CPoseGraph out;
	out.m_states = m_states;
	out.m_kinds = m_kinds;
	out.m_fixed = m_fixed;
	out.m_priors = m_priors;
	for (const int k : indices)
		out.m_edges.push_back(edge(k));
	return out;
}

void CPoseGraph::setEdge(int index, const TPoseEdge& other)
{
	const TPoseEdge& old = edge(index);
	const char* problem =
		sameNodes(nodesOf(other), nodesOf(old)) ? edgeProblem(other) : "it joins other nodes";
	if (problem)
		throw CError(
			"edge " + std::to_string(index), problem,
			"replace it by one from " + std::to_string(old.from) + " to " + std::to_string(old.to));
	m_edges[index] = other;
}

void CPoseGraph::setPrior(int index, const TPosePrior& other)
{
	const TPosePrior& old = prior(index);
	const bool same = sameNodes(nodesOf(other), nodesOf(old)) && other.kind == old.kind;
	if (const char* problem = same ? priorProblem(other) : "it is of another kind or of other nodes")
		throw CError(priorName(index, old), problem, "replace it by one of the same kind and nodes");
	m_priors[index] = cleaned(other);
}

const TPoseEdge& CPoseGraph::edge(int index) const
{
	if (index < 0 || index >= int(m_edges.size()))
		throw CError(
			"edge " + std::to_string(index), "no such edge",
			"the graph has " + std::to_string(m_edges.size()) + " edges");
	return m_edges[index];
}

const TPosePrior& CPoseGraph::prior(int index) const
{
	if (index < 0 || index >= int(m_priors.size()))
		throw CError(
			"prior " + std::to_string(index), "no such prior",
			"the graph has " + std::to_string(m_priors.size()) + " priors");
	return m_priors[index];
}

void CPoseGraph::setLoss(int edge_index, const TRobustLoss& loss)
{
	if (const char* problem = lossProblem(loss))
		throw CError(edgeName(edge_index, edge(edge_index)), problem, "give a scale above 0");
	edge(edge_index);
	m_edges[edge_index].loss = loss;
}

void CPoseGraph::setPriorLoss(int prior_index, const TRobustLoss& loss)
{
	if (const char* problem = lossProblem(loss))
		throw CError(priorName(prior_index, prior(prior_index)), problem, "give a scale above 0");
	prior(prior_index);
	m_priors[prior_index].loss = loss;
}

ENodeKind CPoseGraph::nodeKind(int node) const
{
	requireNode(node);
	return m_kinds[node];
}

const Eigen::Isometry3d& CPoseGraph::pose(int node) const
{
	requireNode(node);
	return m_states.poses[node];
}

const Vector6d& CPoseGraph::errorVariable(int node) const
{
	requireKind(node, ENodeKind::ErrorVariable);
	return m_states.values[node];
}

void CPoseGraph::setPose(int node, const Eigen::Isometry3d& T_map_node)
{
	requireKind(node, ENodeKind::Pose);
	if (const char* problem = poseProblem(T_map_node))
		throw CError(nodeName(node), problem, "give a finite rotation and translation");
	m_states.poses[node] = T_map_node;
}

void CPoseGraph::setErrorVariable(int node, const Vector6d& value)
{
	requireKind(node, ENodeKind::ErrorVariable);
	if (!value.allFinite()) throw CError(nodeName(node), "the value is not finite", "give finite numbers");
	m_states.values[node] = value;
}

void CPoseGraph::setPoses(const std::vector<Eigen::Isometry3d>& poses)
{
	if (poses.size() != nodeCount())
		throw CError(
			"pose graph",
			std::to_string(poses.size()) + " poses for " + std::to_string(nodeCount()) + " nodes",
			"give one a node");
	m_states.poses = poses;
}

void CPoseGraph::setStates(const TNodeStates& states)
{
	setPoses(states.poses);
	if (states.values.size() != nodeCount())
		throw CError("pose graph", "as many values as nodes are needed", "take states() and change them");
	m_states.values = states.values;
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

bool CPoseGraph::isNode(int node, ENodeKind kind) const
{
	return node >= 0 && node < int(nodeCount()) && m_kinds[node] == kind;
}

void CPoseGraph::requireNode(int node) const
{
	if (node >= 0 && node < int(nodeCount())) return;
	throw CError(nodeName(node), "no such node", "the graph has " + std::to_string(nodeCount()) + " nodes");
}

void CPoseGraph::requireKind(int node, ENodeKind kind) const
{
	requireNode(node);
	if (m_kinds[node] == kind) return;
	const bool is_pose = m_kinds[node] == ENodeKind::Pose;
	throw CError(
		nodeName(node), is_pose ? "it is a pose" : "it is an error variable",
		is_pose ? "an error variable is asked for" : "a pose is asked for");
}

std::string describeNode(const CPoseGraph& graph, int node, int limit)
{
	return nodeName(node) + " (" + factorsAt("edges", graph.edges(), node, limit) + "; " +
		   factorsAt("priors", graph.priors(), node, limit) + ")";
}
}  // namespace posidonia
