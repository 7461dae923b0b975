#include <posidonia/eval/loop_evaluation.h>
#include <posidonia/geometry/se3.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace posidonia
{
using Eigen::Isometry3d;

namespace
{
using TNodeId = std::uint64_t;
using TPair = std::pair<TNodeId, TNodeId>;
using TTruth = std::map<TNodeId, Isometry3d>;

TPair unordered(TNodeId a, TNodeId b)
{
	return {std::min(a, b), std::max(a, b)};
}

std::optional<double> ratio(int part, int whole)
{
	if (whole == 0) return {};
	return static_cast<double>(part) / whole;
}

/** (translation [m], rotation [rad]) between the measured and the true T_from_to. */
Eigen::Vector2d edgeError(const TLoopRow& row, const TTruth& T_map_body)
{
	const Isometry3d T_from_to = T_map_body.at(row.from).inverse() * T_map_body.at(row.to);
	const Vector6d d = localCoordinates(T_from_to, *row.T_from_to);
	return {d.head<3>().norm(), d.tail<3>().norm()};
}

/** Collects the errors of the accepted edges of one sort. */
struct TEdgeCollector
{
	std::vector<double> translations, rotations;
	int wrong{0};

	void add(const Eigen::Vector2d& error, bool right)
	{
		translations.push_back(error[0]);
		rotations.push_back(error[1]);
		if (!right) wrong++;
	}
	TEdgeQuality quality() const
	{
		return {
			static_cast<int>(translations.size()), wrong, statistics(translations), statistics(rotations)};
	}
};

/** A footprint with a circle around it, which tells most pairs apart at once. */
struct TNodeFootprint
{
	TNodeId id;
	TPolygon polygon;
	Eigen::Vector2d centre{0, 0};
	double radius{0};

	TNodeFootprint(TNodeId node, TPolygon corners) : id(node), polygon(std::move(corners))
	{
		for (const auto& c : polygon)
			centre += c / static_cast<double>(polygon.size());
		for (const auto& c : polygon)
			radius = std::max(radius, (c - centre).norm());
	}
	bool mayTouch(const TNodeFootprint& other) const
	{
		return (centre - other.centre).norm() < radius + other.radius;
	}
};

/** Pairs of nodes further apart than the gap whose true footprints overlap enough. */
std::set<TPair> overlappingPairs(
	const TTruth& T_map_body, const TFootprintCamera& camera, const TLoopEvaluationOptions& options)
{
	std::vector<TNodeFootprint> footprints;
	for (const auto& [id, T] : T_map_body)
		footprints.emplace_back(id, footprint(camera, T));
	std::set<TPair> pairs;
	for (const auto& b : footprints)
		for (const auto& a : footprints) {
			// Ids ascend: no later `a` is far enough from b either.
			if (a.id + static_cast<TNodeId>(options.min_node_gap) >= b.id) break;
			if (a.mayTouch(b) && overlap(a.polygon, b.polygon) > options.min_overlap)
				pairs.insert({a.id, b.id});
		}
	return pairs;
}

int countIn(const std::set<TPair>& some, const std::set<TPair>& among)
{
	return static_cast<int>(
		std::count_if(some.begin(), some.end(), [&](const TPair& pair) { return among.count(pair) > 0; }));
}
}  // namespace

std::optional<double> TEdgeQuality::precision() const
{
	return ratio(accepted - wrong, accepted);
}
std::optional<double> TLoopEvaluation::recallOfTried() const
{
	return ratio(overlapping_found, overlapping_tried);
}
std::optional<double> TLoopEvaluation::recallOfAll() const
{
	return ratio(overlapping_found, overlapping);
}

TLoopEvaluation evaluateLoops(
	const std::vector<TLoopRow>& rows, const TTruth& T_map_body, const TFootprintCamera& camera,
	const TLoopEvaluationOptions& options)
{
	TLoopEvaluation result;
	TEdgeCollector loops, sequential;
	std::set<TPair> tried, found;
	for (const auto& row : rows) {
		if (!row.consecutive()) result.statuses[row.status]++;
		if (T_map_body.count(row.from) == 0 || T_map_body.count(row.to) == 0) {
			result.without_truth++;
			continue;
		}
		if (row.kind == "odometry") continue;  // not a registration
		const TPair pair = unordered(row.from, row.to);
		if (row.tried()) tried.insert(pair);
		if (!row.accepted()) continue;
		const Eigen::Vector2d error = edgeError(row, T_map_body);
		const bool right =
			error[0] <= options.max_translation_error && error[1] <= options.max_rotation_error;
		(row.consecutive() ? sequential : loops).add(error, right);
		if (right) found.insert(pair);
	}
	result.loops = loops.quality();
	result.sequential = sequential.quality();
	const std::set<TPair> overlapping = overlappingPairs(T_map_body, camera, options);
	result.overlapping = static_cast<int>(overlapping.size());
	result.overlapping_tried = countIn(overlapping, tried);
	result.overlapping_found = countIn(overlapping, found);
	return result;
}

namespace
{
void addRatio(TMetrics& rows, const std::string& what, const std::optional<double>& value)
{
	if (value) rows.push_back({what, "", *value});
}

void addQuality(TMetrics& rows, const std::string& prefix, const TEdgeQuality& q)
{
	const double degrees = 180 / M_PI;
	rows.push_back({prefix + ".accepted", "", static_cast<double>(q.accepted)});
	rows.push_back({prefix + ".false", "", static_cast<double>(q.wrong)});
	addRatio(rows, prefix + ".precision", q.precision());
	if (q.accepted == 0) return;
	rows.push_back({prefix + ".translation_error.median", "m", q.translation.median});
	rows.push_back({prefix + ".translation_error.max", "m", q.translation.max});
	rows.push_back({prefix + ".rotation_error.median", "deg", degrees * q.rotation.median});
	rows.push_back({prefix + ".rotation_error.max", "deg", degrees * q.rotation.max});
}
}  // namespace

TMetrics loopMetrics(const std::string& prefix, const TLoopEvaluation& e)
{
	TMetrics rows;
	const auto count = [&](const std::string& what, int n) {
		rows.push_back({prefix + what, "", static_cast<double>(n)});
	};
	addQuality(rows, prefix, e.loops);
	count(".overlapping_pairs", e.overlapping);
	count(".overlapping_pairs_tried", e.overlapping_tried);
	count(".overlapping_pairs_found", e.overlapping_found);
	addRatio(rows, prefix + ".recall_of_tried", e.recallOfTried());
	addRatio(rows, prefix + ".recall_of_all", e.recallOfAll());
	count(".rows_without_truth", e.without_truth);
	for (const auto& [status, n] : e.statuses)
		count(".status." + status, n);
	addQuality(rows, prefix + ".sequential", e.sequential);
	return rows;
}
}  // namespace posidonia
