#include <posidonia/graphslam/shared_points.h>

#include <algorithm>
#include <set>

namespace posidonia
{
void CSharedPoints::addEdge(int from, int to, const TPoints& points)
{
	const auto nodes = static_cast<size_t>(std::max(from, to)) + 1;
	if (m_edges_of.size() < nodes) {
		m_edges_of.resize(nodes);
		m_observation_of.resize(nodes);
	}
	m_edges_of[static_cast<size_t>(from)].push_back(edgeCount());
	m_edges_of[static_cast<size_t>(to)].push_back(edgeCount());
	TEdge edge{from, to, {}};
	edge.spots.reserve(points.size());
	for (const auto& [p, q] : points) {
		const int spot = joined(observationOf(from, p), observationOf(to, q));
		m_observations[static_cast<size_t>(spot)].uses++;
		edge.spots.push_back(spot);
	}
	m_edges.push_back(std::move(edge));
}

int CSharedPoints::observationOf(int node, int point)
{
	auto& of_node = m_observation_of[static_cast<size_t>(node)];
	const auto p = static_cast<size_t>(point);
	if (of_node.size() <= p) of_node.resize(p + 1, -1);
	if (of_node[p] < 0) {
		of_node[p] = static_cast<int>(m_observations.size());
		m_observations.push_back({node, of_node[p], of_node[p]});
	}
	return of_node[p];
}

int CSharedPoints::rootOf(int observation) const
{
	auto& all = m_observations;
	auto i = static_cast<size_t>(observation);
	while (static_cast<size_t>(all[i].parent) != i) {
		all[i].parent = all[static_cast<size_t>(all[i].parent)].parent;	 // halves the path
		i = static_cast<size_t>(all[i].parent);
	}
	return static_cast<int>(i);
}

int CSharedPoints::joined(int a, int b)
{
	int to = rootOf(a), from = rootOf(b);
	if (to == from) return to;
	if (m_observations[static_cast<size_t>(to)].observations <
		m_observations[static_cast<size_t>(from)].observations)
		std::swap(to, from);
	TObservation &large = m_observations[static_cast<size_t>(to)],
				 &small = m_observations[static_cast<size_t>(from)];
	small.parent = to;
	std::swap(small.next, large.next);	// two rings become one
	large.observations += small.observations;
	large.uses += small.uses;
	return to;
}

double CSharedPoints::share(int edge) const
{
	const TEdge& e = m_edges[static_cast<size_t>(edge)];
	if (e.spots.empty()) return 1;
	double sum = 0;
	for (const int spot : e.spots) {
		const TObservation& root = m_observations[static_cast<size_t>(rootOf(spot))];
		sum += std::min(1.0, (root.observations - 1.0) / root.uses);
	}
	return sum / static_cast<double>(e.spots.size());
}

void CSharedPoints::touchNodesOf(int observation, std::vector<char>& touched) const
{
	int i = observation;
	do {
		const TObservation& o = m_observations[static_cast<size_t>(i)];
		touched[static_cast<size_t>(o.node)] = 1;
		i = o.next;
	} while (i != observation);
}

std::vector<int> CSharedPoints::takeTouched()
{
	std::vector<char> touched(m_edges_of.size(), 0);
	std::set<int> edges;
	for (; m_taken < edgeCount(); m_taken++) {
		const TEdge& e = m_edges[static_cast<size_t>(m_taken)];
		edges.insert(m_taken);
		for (const int spot : e.spots)
			touchNodesOf(spot, touched);
	}
	for (size_t node = 0; node < touched.size(); node++) {
		if (!touched[node]) continue;
		for (const int e : m_edges_of[node])
			if (touched[static_cast<size_t>(m_edges[static_cast<size_t>(e)].from)] &&
				touched[static_cast<size_t>(m_edges[static_cast<size_t>(e)].to)])
				edges.insert(e);
	}
	return {edges.begin(), edges.end()};
}
}  // namespace posidonia
