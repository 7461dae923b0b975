// The order in which CIncrementalOptimizer eliminates: by where the next nodes are likely to be joined on.
#include <posidonia/posegraph/elimination_order.h>
#include <posidonia/posegraph/incremental_optimizer.h>

#include <algorithm>
#include <numeric>
#include <queue>

namespace posidonia
{
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

/** Minimum degree from ring to ring, the outermost first. */
std::vector<int> CIncrementalOptimizer::orderOf(const CBayesTree::TTop& top)
{
	const int n = int(top.nodes.size());
	m_local.resize(m_d.size());
	for (int k = 0; k < n; k++)
		m_local[top.nodes[k]] = k;
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
	std::vector<int> order = constrainedMinimumDegreeOrder(n, m_pairs, ringsOf(top.nodes));
	for (int& k : order)
		k = top.nodes[k];
	return order;
}

/** Rings round the newest pose, the innermost with the highest number, each kRingGrowth times as large as the
 * one inside. The next nodes are joined on in the innermost, seldom further out: so the outer ones, whose
 * fronts are larger, are seldom eliminated anew. The newest node itself comes after all rings, as do error
 * variables, which are joined with everything. */
std::vector<int> CIncrementalOptimizer::ringsOf(const std::vector<int>& nodes) const
{
	constexpr double kRingGrowth = 4;
	const int n = int(nodes.size());
	const std::vector<double> late = nearness(nodes);
	std::vector<int> by_nearness(n);
	std::iota(by_nearness.begin(), by_nearness.end(), 0);
	std::sort(by_nearness.begin(), by_nearness.end(), [&](int a, int b) {
		return late[a] != late[b] ? late[a] > late[b] : nodes[a] > nodes[b];
	});
	int rings = 1;
	for (double size = m_options.inner_ring; size < n; size *= kRingGrowth)
		rings++;
	std::vector<int> ring_of(n, 0);
	if (n <= rings) return ring_of;	 // CAMD wants groups below n
	double size = m_options.inner_ring;
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
