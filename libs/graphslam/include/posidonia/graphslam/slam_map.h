#pragma once

#include <mrpt/graphs/CNetworkOfPoses.h>
#include <posidonia/geometry/se3.h>
#include <posidonia/graphslam/shared_points.h>
#include <posidonia/nav/odometry_source.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace posidonia
{
struct TKeyFrame;

/** MRPT's graph: nodes are global poses T_map_body, edges Gaussians in information form. */
using TSlamGraph = mrpt::graphs::CNetworkOfPoses3DInf;

enum class EEdgeKind
{
	ODOMETRY,
	SEQUENTIAL,
	ROI
};
/** "odometry", "sequential", "roi". */
const char* toString(EEdgeKind kind);

/** What a node knows beside its pose in the graph. */
struct TSlamNode
{
	double stamp{0};											   ///< UTC [s]
	Eigen::Isometry3d T_odom_body{Eigen::Isometry3d::Identity()};  ///< The odometry's pose at `stamp`
	std::shared_ptr<const TKeyFrame> key_frame;	 ///< Null until an edge decider asked for it
	std::vector<int> places{};		///< Of each of its points: the first of those at the same pixel
	TUnaryMeasurements measured{};	///< What was measured absolutely there
};

/** A constraint T_from_to between two nodes with its information over (rho, phi). */
struct TSlamEdge
{
	int from{0}, to{0};
	EEdgeKind kind{EEdgeKind::ODOMETRY};
	Eigen::Isometry3d T_from_to{Eigen::Isometry3d::Identity()};
	Matrix6d information{Matrix6d::Identity()};	 ///< Of this measurement alone
	double path_length{0};						 ///< Odometry edges: metres travelled
	/** Stereo edges: the measurement is made of these points, (point of `from`, point of `to`). */
	CSharedPoints::TPoints points{};
	/** The part of `information` that it may claim in the graph, (0, 1] (README, "Shared points"). */
	double share{1};
};

/** A candidate pair and what became of it: a row of loops.csv. */
struct TCandidateRow
{
	int from{0}, to{0};
	EEdgeKind kind{EEdgeKind::ROI};
	std::string status;
	int matches{0}, inliers{0};
	double rmse_px{0};
	Eigen::Isometry3d T_from_to{Eigen::Isometry3d::Identity()};
	bool measured{false};  ///< Does T_from_to hold a registration?
	/** Accepted pairs: what the robust loss left of the edge's information at the end of a run, 0 .. 1. */
	double weight{1};

	bool accepted() const { return status == "accepted" || status == "accepted on retry"; }
};

/** The map that deciders and optimiser share: MRPT's graph with, in order of insertion and without the detour
 * through yaw-pitch-roll, what each node and edge is. Whoever adds a node or an edge adds it here, and here
 * alone. */
class CSlamMap
{
   public:
	/** Binds to the engine's graph; it must outlive this object. */
	void bind(TSlamGraph& graph) { m_graph = &graph; }

	/** Adds node number nodeCount() at T_map_body. */
	void addNode(const TSlamNode& node, const Eigen::Isometry3d& T_map_body);
	/** Adds an edge to MRPT's graph, too. */
	void addEdge(const TSlamEdge& edge);

	/** Gives the odometry edge that ends at node `to` another value, and the node its odometry's pose. Throws
	 * CError when there is no such edge. */
	void reviseOdometry(int to, const TPoseEstimate& edge, const Eigen::Isometry3d& T_odom_body);
	/** Revises the shares of the stereo edges after others were added (README, "Shared points"). */
	void shareInformation();
	/** Indices of edges that were revised, in order; it only grows. */
	const std::vector<int>& revisedEdges() const { return m_revised; }

	int nodeCount() const { return static_cast<int>(m_nodes.size()); }
	int lastNode() const { return nodeCount() - 1; }
	const TSlamNode& node(int i) const { return m_nodes[static_cast<size_t>(i)]; }
	void setKeyFrame(int i, std::shared_ptr<const TKeyFrame> key_frame);
	const std::vector<TSlamNode>& nodes() const { return m_nodes; }
	const std::vector<TSlamEdge>& edges() const { return m_edges; }

	/** T_map_body of a node as the graph has it now. */
	Eigen::Isometry3d pose(int i) const;
	void setPose(int i, const Eigen::Isometry3d& T_map_body);
	/** Prediction of T_i_j by the present poses. */
	Eigen::Isometry3d relativePose(int i, int j) const { return pose(i).inverse() * pose(j); }

	/** For each node, the fewest metres of odometry edges on any way through the graph to `to`; stereo edges
	 * count nothing, since they do not pass on the odometry's drift. */
	std::vector<double> odometryMetresTo(int to) const;

	/** To the candidates that became edges. @param weights of every edge */
	void setWeights(const std::vector<double>& weights);

	Matrix6d root_covariance{Matrix6d::Zero()};	 ///< Of the first node's T_odom_body, over (rho, phi)
	std::vector<TCandidateRow> candidates;		 ///< Every pair that was considered, in order

   private:
	void setShare(int edge, double share);
	void writeToMrpt(int edge);

	TSlamGraph* m_graph{nullptr};
	std::vector<TSlamNode> m_nodes;
	std::vector<TSlamEdge> m_edges;
	std::vector<int> m_revised;
	std::vector<std::vector<int>> m_edges_of;  // indices of the edges at each node
	CSharedPoints m_shared_points;
	std::vector<int> m_stereo_edges;  // index of each edge in m_shared_points
	size_t m_edges_shared{0};		  // edges that shareInformation() has seen
};

/** loops.csv of the candidates: from,to,kind,status,matches,inliers,rmse_px,tx,ty,tz,qx,qy,qz,qw,weight. */
std::string candidatesCsv(const std::vector<TCandidateRow>& rows);
}  // namespace posidonia
