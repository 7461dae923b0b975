#pragma once

#include <posidonia/posegraph/pose_graph.h>

#include <algorithm>
#include <cmath>
#include <random>

/** Graphs with planted poses, deterministic by seed: edges in order of arrival, from the older node to the
 * newer, each with noise drawn from the covariance that it states. */
namespace posidonia::testing
{
/** A graph and where its nodes truly are. The graph's poses are dead reckoning: odometry edges composed. */
struct TSyntheticGraph
{
	CPoseGraph graph;
	std::vector<Eigen::Isometry3d> planted;
};

/** Standard deviations of an edge, isotropic. */
struct TEdgeSigmas
{
	double position, rotation;	///< [m], [rad]
};

class CNoisyGraphBuilder
{
   public:
	CNoisyGraphBuilder(std::vector<Eigen::Isometry3d> planted, unsigned seed) : m_rng(seed)
	{
		m_out.planted = std::move(planted);
	}

	/** Node i, its pose by composing a new odometry edge from i - 1; node 0 is fixed where it truly is. */
	void addNode(int i, const TEdgeSigmas& odometry)
	{
		if (i == 0) {
			m_out.graph.addNode(m_out.planted[0], true);
			return;
		}
		const TPoseEdge edge = noisyEdge(i - 1, i, odometry);
		m_out.graph.addNode(orthonormalized(m_out.graph.pose(i - 1) * edge.T_from_to));
		m_out.graph.addEdge(edge);
	}

	void addEdge(int from, int to, const TEdgeSigmas& sigmas)
	{
		m_out.graph.addEdge(noisyEdge(from, to, sigmas));
	}

	TSyntheticGraph take() { return std::move(m_out); }

   private:
	TPoseEdge noisyEdge(int from, int to, const TEdgeSigmas& sigmas)
	{
		Vector6d d, sigma;
		sigma << Eigen::Vector3d::Constant(sigmas.position), Eigen::Vector3d::Constant(sigmas.rotation);
		for (int k = 0; k < 6; k++)
			d[k] = sigma[k] * m_normal(m_rng);
		const auto& T = m_out.planted;
		TPoseEdge edge;
		edge.from = from;
		edge.to = to;
		edge.T_from_to = orthonormalized(retract(T[size_t(from)].inverse() * T[size_t(to)], d));
		edge.information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
		return edge;
	}

	TSyntheticGraph m_out;
	std::mt19937 m_rng;
	std::normal_distribution<double> m_normal{0, 1};
};

/** A lawn-mower survey: parallel tracks, and after every `tracks_a_block` of them a cross-line, diagonally
 * back over the whole block and out again. */
struct TLawnMower
{
	int nodes{1000};
	int track{100};		///< Nodes of a track
	int sequential{2};	///< Edges of a node to the nodes before it; the first is the odometry
	int across{3};		///< Edges of a node to the nearest nodes of the track before; on a cross-line, of the
						///< tracks below
	int tracks_a_block{20};
	double spacing{0.5};		///< Between nodes [m]
	double track_spacing{1.5};	///< [m]
	TEdgeSigmas odometry{0.005, 0.002}, stereo{0.002, 0.001};
	unsigned seed{1};
};

class CLawnMowerPath
{
   public:
	/** A node's place on the survey: of a track, or (track -1) of a cross-line. */
	struct TPlace
	{
		Eigen::Isometry3d T_map_node;
		int track, along;  ///< `along`: index from the end of the tracks at x = 0
	};

	explicit CLawnMowerPath(const TLawnMower& survey) : m_survey(survey)
	{
		for (int track = 0; !full(); track++) {
			addTrack(track);
			if ((track + 1) % survey.tracks_a_block == 0) addCrossLine(track);
		}
	}
	const std::vector<TPlace>& places() const { return m_places; }

   private:
	bool full() const { return int(m_places.size()) >= m_survey.nodes; }

	void addTrack(int track)
	{
		const bool outward = track % 2 == 0;
		for (int k = 0; k < m_survey.track && !full(); k++)
			add(alongTrack(outward ? k : m_survey.track - 1 - k), m_survey.track_spacing * track,
				outward ? 0 : M_PI, track, outward ? k : m_survey.track - 1 - k);
	}

	/** From where the block's last track ended to the middle of its first, and back to where the next begins.
	 */
	void addCrossLine(int last_track)
	{
		const int last_along = last_track % 2 == 0 ? m_survey.track - 1 : 0;
		const Eigen::Vector2d end(alongTrack(last_along), m_survey.track_spacing * last_track),
			far(alongTrack(m_survey.track / 2),
				m_survey.track_spacing * (last_track + 1 - m_survey.tracks_a_block)),
			next = end + Eigen::Vector2d(0, m_survey.track_spacing);
		addLine(end, far);
		addLine(far, next);
	}

	void addLine(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
	{
		const int steps = int((b - a).norm() / m_survey.spacing);
		for (int k = 1; k <= steps && !full(); k++) {
			const Eigen::Vector2d p = a + (b - a) * k / (steps + 1);
			add(p.x(), p.y(), std::atan2((b - a).y(), (b - a).x()), -1, -1);
		}
	}

	double alongTrack(int k) const { return m_survey.spacing * k; }

	/** Over a floor with gentle slopes. */
	void add(double x, double y, double yaw, int track, int along)
	{
		Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
		T.linear() = rotationFromYawPitchRoll(yaw, 0.05 * std::sin(0.3 * x), 0.05 * std::cos(0.2 * y));
		T.translation() << x, y, 10 + 0.3 * std::sin(0.1 * x) * std::cos(0.15 * y);
		m_places.push_back({T, track, along});
	}

	const TLawnMower& m_survey;
	std::vector<TPlace> m_places;
};

/** The older nodes nearest to node i on the ground, not farther than two track spacings: of the track before,
 * or for a cross-line of the tracks of its block (`first` is the first node looked at). */
inline std::vector<int> nearestAcross(
	const std::vector<CLawnMowerPath::TPlace>& places, int i, int first, const TLawnMower& survey)
{
	const auto& here = places[size_t(i)];
	std::vector<std::pair<double, int>> found;
	for (int k = first; k < i - survey.sequential; k++) {
		const auto& there = places[size_t(k)];
		if (here.track < 0 ? there.track < 0 : there.track != here.track - 1) continue;
		const double distance =
			(here.T_map_node.translation() - there.T_map_node.translation()).head<2>().norm();
		if (here.track >= 0 || distance < 2 * survey.track_spacing) found.push_back({distance, k});
	}
	const size_t kept = std::min(found.size(), size_t(survey.across));
	std::partial_sort(found.begin(), found.begin() + std::ptrdiff_t(kept), found.end());
	std::vector<int> nodes;
	for (size_t k = 0; k < kept; k++)
		nodes.push_back(found[k].second);
	return nodes;
}

inline TSyntheticGraph lawnMower(const TLawnMower& survey)
{
	const CLawnMowerPath path(survey);
	std::vector<Eigen::Isometry3d> planted;
	for (const auto& place : path.places())
		planted.push_back(place.T_map_node);
	// The track before begins at most two tracks and a cross-line before a node; a cross-line sees its block.
	const int block = survey.tracks_a_block * survey.track,
			  cross =
				  int(2 *
					  std::hypot(
						  survey.track_spacing * survey.tracks_a_block, survey.spacing * survey.track / 2) /
					  survey.spacing) +
				  2;
	CNoisyGraphBuilder builder(planted, survey.seed);
	for (int i = 0; i < survey.nodes; i++) {
		builder.addNode(i, survey.odometry);
		for (int back = 2; back <= survey.sequential && i - back >= 0; back++)
			builder.addEdge(i - back, i, survey.stereo);
		const bool crossing = path.places()[size_t(i)].track < 0;
		const int first = std::max(0, i - cross - (crossing ? block : 2 * survey.track));
		for (const int k : nearestAcross(path.places(), i, first, survey))
			builder.addEdge(k, i, survey.stereo);
	}
	return builder.take();
}

/** sphere2500's structure and, told alike in all axes, the noise of its residuals (not that of its
 * information): `laps` rings of `ring` nodes up a sphere; each node is joined to the next and to the one
 * above it. */
struct TSphere
{
	int laps{50}, ring{50};
	double radius{50};	///< [m]
	TEdgeSigmas sigmas{0.08, 0.034};
	unsigned seed{1};
};

inline TSyntheticGraph sphere(const TSphere& options)
{
	const int n = options.laps * options.ring;
	std::vector<Eigen::Isometry3d> planted;
	for (int i = 0; i < n; i++) {
		const double longitude = 2 * M_PI * (i % options.ring) / options.ring,
					 latitude = M_PI * ((i + 0.5) / n - 0.5);
		Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
		T.linear() = rotationFromYawPitchRoll(longitude, -latitude, 0);
		T.translation() = T.linear() * Eigen::Vector3d(options.radius, 0, 0);
		planted.push_back(T);
	}
	CNoisyGraphBuilder builder(planted, options.seed);
	for (int i = 0; i < n; i++) {
		builder.addNode(i, options.sigmas);
		if (i >= options.ring) builder.addEdge(i - options.ring, i, options.sigmas);
	}
	return builder.take();
}
}  // namespace posidonia::testing
