#pragma once

#include <posidonia/report/run_data.h>

#include <string>
#include <vector>

namespace posidonia
{
/** A node's error and what the graph says of it. */
struct TJudgedNode
{
	int node{0};
	double t{0};				   ///< From the run's start [s]
	Eigen::Vector3d error, sigma;  ///< North, east, down [m]
	double nees{0};				   ///< Of the position: chi-square of 3 degrees of freedom when honest
};

/** The nodes that have a covariance and a true pose at their time. */
std::vector<TJudgedNode> judgedNodes(const TRunData& run);

/** Error of each node, north, east and down, within its 3 sigma: one picture, for papers. Throws CError when
 * there is nothing to draw. */
std::string plotNodeErrors(const std::vector<TJudgedNode>& nodes);
/** NEES over time with its 95 % band. */
std::string plotNees(const std::vector<TJudgedNode>& nodes);
}  // namespace posidonia
