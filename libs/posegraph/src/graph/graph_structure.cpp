#include <posidonia/base/error.h>
#include <posidonia/posegraph/graph_structure.h>

#include <algorithm>

namespace posidonia
{
namespace
{
bool operator==(const TFactorNodes& a, const TFactorNodes& b)
{
	return std::equal(a.node, a.node + 3, b.node);
}

template <class FACTORS>
bool isPrefix(const std::vector<TFactorNodes>& known, const FACTORS& factors)
{
	if (known.size() > factors.size()) return false;
	for (size_t k = 0; k < known.size(); k++)
		if (!(known[k] == nodesOf(factors[k]))) return false;
	return true;
}

/** What holds a set of joined poses. */
struct THold
{
	bool fixed{false}, horizontal{false}, down{false}, tilt{false}, heading{false};
	int numbers{0}, places{0};	///< scalars measured; positions measured

	void add(EPriorKind kind)
	{
		fixed |= kind == EPriorKind::FullPose;
		const bool place = kind == EPriorKind::Position || kind == EPriorKind::HorizontalPosition;
		horizontal |= place;
		down |= kind == EPriorKind::Position || kind == EPriorKind::Depth;
		tilt |= kind == EPriorKind::RollPitch || kind == EPriorKind::Attitude;
		heading |= kind == EPriorKind::Heading || kind == EPriorKind::Attitude;
		places += place;
		numbers += priorDimension(kind);
	}

	/** What is certainly missing, or nullptr. Two places may give the heading and six numbers the tilt; if
	 * they do not, the factorisation finds out. */
	const char* missing() const
	{
		if (fixed) return nullptr;
		if (numbers == 0) return "no chain of edges joins it to a fixed node or to a prior";
		if (!horizontal) return "no prior holds the horizontal position of its component";
		if (!down) return "no prior holds the depth of its component";
		if (!heading && places < 2) return "no prior holds the heading of its component";
		if (!tilt && numbers < 6) return "no prior holds roll and pitch of its component";
		return nullptr;
	}
};
}  // namespace

bool CGraphStructure::follow(const CPoseGraph& graph)
{
	const bool grew = grewFrom(graph);
	if (!grew) *this = CGraphStructure();
	bool changed = !grew || graph.nodeCount() != m_fixed.size() || graph.edgeCount() != m_edges.size() ||
				   graph.priorCount() != m_priors.size();
	m_fixed.resize(graph.nodeCount(), 0);
	for (size_t node = 0; node < m_fixed.size(); node++) {
		const bool fixed = graph.isFixed(int(node));
		changed |= fixed != bool(m_fixed[node]);
		m_fixed[node] = fixed;
	}
	if (changed) append(graph);
	return changed;
}

bool CGraphStructure::grewFrom(const CPoseGraph& graph) const
{
	return graph.nodeCount() >= m_fixed.size() && isPrefix(m_edges, graph.edges()) &&
		   isPrefix(m_priors, graph.priors());
}

void CGraphStructure::append(const CPoseGraph& graph)
{
	for (size_t node = m_parent.size(); node < graph.nodeCount(); node++)
		m_parent.push_back(int(node));
	std::vector<TPair> pairs;
	for (size_t k = m_edges.size(); k < graph.edgeCount(); k++) {
		const TPoseEdge& edge = graph.edges()[k];
		m_edges.push_back(nodesOf(edge));
		appendFactor(m_edges.back(), pairs);
		m_parent[root(edge.from)] = root(edge.to);
	}
	for (size_t k = m_priors.size(); k < graph.priorCount(); k++) {
		m_priors.push_back(nodesOf(graph.priors()[k]));
		appendFactor(m_priors.back(), pairs);
	}
	std::sort(pairs.begin(), pairs.end());
	const auto middle = m_pairs.insert(m_pairs.end(), pairs.begin(), pairs.end());
	std::inplace_merge(m_pairs.begin(), middle, m_pairs.end());
	m_pairs.erase(std::unique(m_pairs.begin(), m_pairs.end()), m_pairs.end());
	m_free.clear();
	for (size_t node = 0; node < m_fixed.size(); node++)
		if (!m_fixed[node]) m_free.push_back(int(node));
}

void CGraphStructure::appendFactor(const TFactorNodes& nodes, std::vector<TPair>& pairs)
{
	for (int a = 0; a < nodes.count; a++)
		for (int b = 0; b < a; b++)
			pairs.push_back({std::min(nodes.node[a], nodes.node[b]), std::max(nodes.node[a], nodes.node[b])});
}

int CGraphStructure::root(int node) const
{
	while (m_parent[node] != node)
		node = m_parent[node] = m_parent[m_parent[node]];
	return node;
}

void CGraphStructure::requireHeld(const CPoseGraph& graph) const
{
	std::vector<THold> holds(graph.nodeCount());
	for (int node = 0; node < int(graph.nodeCount()); node++)
		holds[root(node)].fixed |= m_fixed[node];
	for (const TPosePrior& prior : graph.priors())
		if (prior.loss.weight > 0) holds[root(prior.node)].add(prior.kind);
	for (const int node : m_free) {
		if (graph.nodeKind(node) == ENodeKind::ErrorVariable) continue;	 // its prior holds it
		if (const char* missing = holds[root(node)].missing())
			throw CError(
				describeNode(graph, node), missing,
				"fix a node of its component, or add the missing edge or prior");
	}
}
}  // namespace posidonia
