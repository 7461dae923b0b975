#pragma once

#include <posidonia/geometry/trajectory.h>
#include <posidonia/graphslam/slam_parts.h>

#include <memory>
#include <string>

namespace posidonia
{
/** The pose handed out at a stereo pair, when it was handed out. */
struct TCausalPose
{
	double stamp{0};
	Eigen::Isometry3d T_map_body{Eigen::Isometry3d::Identity()};
	Eigen::Isometry3d T_odom_body{Eigen::Isometry3d::Identity()};
};

/** Stereo graph-SLAM as one object: observations go in, in order of arrival; poses come out. It owns the
 * odometry, the deciders, the optimiser and the MRPT engine that runs them; no one outside needs to include
 * the engine. */
class CStereoSlam
{
   public:
	/** @param config_file ini that MRPT's engine and its own optimiser read (may be empty: their defaults)
	 * Throws CError for an unknown decider or optimiser, with the names that are known. */
	CStereoSlam(
		const TStereoSlamOptions& options, const TSensorSuite& sensors,
		std::unique_ptr<COdometrySource> odometry, std::unique_ptr<CStereoImageLoader> images,
		const std::string& config_file = "");
	~CStereoSlam();

	void add(const mrpt::obs::CObservation::Ptr& observation);

	/** Call after the last observation: the nodes' poses become the graph's optimum, which they are within
	 * a millimetre of until then; loops.csv gets the edges' weights there. */
	void makeExact();

	/** Map and odometry now; T_map_body = T_map_odom T_odom_body with T_map_odom from the last node. */
	TCausalPose now() const;
	/** Covariance of now().T_map_body over its own frame's (rho, phi): the root's, the graph's from the root
	 * to the last node, the odometry's since. Priors, which hold the graph to the map, make the real one
	 * smaller. */
	Matrix6d covariance() const;
	/** Was a node made by the last observation? */
	bool addedNode() const;

	/** Every pose handed out at a stereo pair (never rewritten). */
	const std::vector<TCausalPose>& causal() const;
	/** The nodes as they are now. */
	TTrajectory nodes() const;
	/** Covariance of each node's T_map_body over (rho, phi), from the optimum of the graph with its priors.
	 * Without a prior of the root ([Priors] root = false) it is held fixed, and they are seen from there. */
	std::vector<Matrix6d> nodeCovariances() const;
	const CSlamMap& map() const;
	/** The pictures of the newest key frame; empty before the first, and where no decider makes any. */
	const TGreyPair& lastPictures() const;
	const COdometrySource& odometry() const;
	mrpt::system::CTimeLogger& timer() const;

	/** Chi-square of the edges at the present poses, and at poses composed by Dijkstra from the root. */
	double chi2() const;
	double dijkstraChi2() const;
	/** g2o file of the graph (17 digits). */
	void saveG2o(const std::string& path) const;

   private:
	struct TImplementation;
	std::unique_ptr<TImplementation> m_impl;
};

}  // namespace posidonia
