// The order in which CIncrementalOptimizer eliminates: by where the next nodes are likely to be joined on.
#include <posidonia/posegraph/elimination_order.h>
#include <posidonia/posegraph/incremental_optimizer.h>

#include <algorithm>
#include <numeric>
#include <queue>

namespace posidonia
{
namespace
{
/** The rings with the two innermost groups kept apart, all others one. */
std::vector<int> innermostOf(std::vector<int> rings)
{
	const int innermost = *std::max_element(rings.begin(), rings.end()) - 1;
	for (int& ring : rings)
		ring = std::max(0, ring - innermost + 1);
	return rings;
}
}  // namespace

/** The newest pose and the way that it came. */
CIncrementalOptimizer::TOutlook CIncrementalOptimizer::outlook() const
{
	const auto poseBefore = [&](int node) {
		do
			node--;
		while (node >= 0 && m_kinds[node] != ENodeKind::Pose);
		return node;
	};
	TOutlook out{poseBefore(int(m_d.size())), Eigen::Vector3d::Zero()};
	const int before = poseBefore(out.newest);
	const auto at = [&](int node) { return m_linearization.poses[node].translation(); };
	if (before >= 0) out.ahead = (at(out.newest) - at(before)).stableNormalized();
	return out;
}

/** How soon new nodes are likely to be joined on to this one: the nearer to the newest pose, the sooner,
 * where what lies ahead of its motion counts a part of its distance [-m]. Error variables at once. */
double CIncrementalOptimizer::nearness(int node) const
{
	constexpr double kAhead = 1.0 / 16;	 // tracks are long, and much closer to each other
	if (m_kinds[node] == ENodeKind::ErrorVariable) return 1;
	const auto at = [&](int n) { return m_linearization.poses[n].translation(); };
	Eigen::Vector3d way = at(node) - at(m_outlook.newest);
	way -= (1 - kAhead) * std::max(0.0, way.dot(m_outlook.ahead)) * m_outlook.ahead;
	return -way.norm();
}

std::vector<double> CIncrementalOptimizer::nearness(const std::vector<int>& nodes) const
{
	std::vector<double> out;
	out.reserve(nodes.size());
	for (const int node : nodes)
		out.push_back(nearness(node));
	return out;
}

/** When much is eliminated anew, so are the nodes where the next are likely to be joined on: they come into
 * the innermost ring then, and the next updates will touch little. */
void CIncrementalOptimizer::touchAhead()
{
	constexpr int kMuch = 4, kAhead = 2;  // innermost rings
	if (m_outlook.newest < 0 || m_tree.touchedNodes() < kMuch * m_options.inner_ring) return;
	std::vector<int> seen;
	std::priority_queue<std::pair<double, int>> queue;
	const auto see = [&](int node) {
		if (m_is_seen[node] || m_kinds[node] != ENodeKind::Pose) return;
		m_is_seen[node] = 1;
		seen.push_back(node);
		queue.push({nearness(node), node});
	};
	see(m_outlook.newest);
	for (int k = 0; k < kAhead * m_options.inner_ring && !queue.empty(); k++) {
		const int node = queue.top().second;
		queue.pop();
		m_tree.touch(m_tree.cliqueOf(node));
		for (const int factor : m_factors_of[node])
			for (int a = 0; a < m_factor_nodes[factor].count; a++)
				see(m_factor_nodes[factor].node[a]);
	}
	for (const int node : seen)
		m_is_seen[node] = 0;
}

/** Minimum degree from ring to ring, the outermost first. Rings serve the next updates; where they cost this
 * one much more than it would without the outer ones, there are only the innermost and the rest. */
std::vector<int> CIncrementalOptimizer::orderOf(const CBayesTree::TTop& top, const CFactorSource& factors)
{
	constexpr int kMany = 8;  // innermost rings: smaller tops are cheap in any order
	constexpr double kMuchMore = 1.25;
	findPairs(top);
	const auto ordered = [&](const std::vector<int>& rings) {
		std::vector<int> order = constrainedMinimumDegreeOrder(int(rings.size()), m_pairs, rings);
		for (int& k : order)
			k = top.nodes[k];
		return order;
	};
	const std::vector<int> rings = ringsOf(top.nodes);
	std::vector<int> order = ordered(rings);
	if (int(order.size()) < kMany * m_options.inner_ring) return order;
	std::vector<int> freer = ordered(innermostOf(rings));
	const bool much_more =
		m_tree.workOf(top, order, factors) > kMuchMore * m_tree.workOf(top, freer, factors);
	return much_more ? freer : order;
}

/** Places in the top of nodes that are coupled. */
void CIncrementalOptimizer::findPairs(const CBayesTree::TTop& top)
{
	m_local.resize(m_d.size());
	for (size_t k = 0; k < top.nodes.size(); k++)
		m_local[top.nodes[k]] = int(k);
	m_pairs.clear();
	const auto couple = [&](const int* nodes, int count) {
		for (int a = 0; a < count; a++)
			for (int b = 0; b < a; b++)
				m_pairs.push_back({m_local[nodes[b]], m_local[nodes[a]]});
	};
	for (const int factor : top.factors)
		couple(m_factor_nodes[factor].node, m_factor_nodes[factor].count);
	for (const int orphan : top.orphans)
		couple(m_tree.separatorOf(orphan).data(), int(m_tree.separatorOf(orphan).size()));
}

/** Rings round the newest pose, the innermost with the highest number, each kRingGrowth times as large as the
 * one inside. The next nodes are joined on in the innermost, seldom further out: so the outer ones, whose
 * fronts are larger, are seldom eliminated anew. The newest node itself comes after all rings, as do error
 * variables, which are joined with everything. */
std::vector<int> CIncrementalOptimizer::ringsOf(const std::vector<int>& nodes) const
{
	constexpr long kRingGrowth = 4;
	const int n = int(nodes.size());
	const std::vector<double> late = nearness(nodes);
	std::vector<int> by_nearness(n);
	std::iota(by_nearness.begin(), by_nearness.end(), 0);
	std::sort(by_nearness.begin(), by_nearness.end(), [&](int a, int b) {
		return late[a] != late[b] ? late[a] > late[b] : nodes[a] > nodes[b];
	});
	int rings = 1;
	for (long size = m_options.inner_ring; size < n; size *= kRingGrowth)
		rings++;
	std::vector<int> ring_of(n, 0);
	if (n <= rings) return ring_of;	 // CAMD wants groups below n
	long size = m_options.inner_ring;
	for (int k = 0, ring = rings - 1; k < n; k++) {
		if (k >= size) ring--, size *= kRingGrowth;
		ring_of[by_nearness[k]] = ring;
	}
	for (int k = 0; k < n; k++)
		if (m_kinds[nodes[k]] == ENodeKind::ErrorVariable || nodes[k] == int(m_d.size()) - 1)
			ring_of[k] = rings;
	return ring_of;
}
}  // namespace posidonia
