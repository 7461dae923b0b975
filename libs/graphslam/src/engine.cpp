// The one translation unit that instantiates MRPT's engine (about 20 s and 1 GB to compile).
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/graphslam/CSparseGSO.h>
#include <posidonia/graphslam/CStereoGraphSlamEngine.h>
#include <posidonia/graphslam/decider_registry.h>
#include <posidonia/graphslam/stereo_slam.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/g2o_file.h>
#include <posidonia/posegraph/spanning_tree.h>
#include <posidonia/posegraph/sparse_optimizer.h>

namespace posidonia
{
using namespace mrpt::obs;
using Eigen::Isometry3d;

CStereoGraphSlamEngine::CStereoGraphSlamEngine(
	const std::string& config_file, TSlamParts& parts, TNodeDecider& node_decider, TEdgeDecider& edge_decider,
	TOptimizer& optimizer)
	: CGraphSlamEngine(config_file, "", "", nullptr, &node_decider, &edge_decider, &optimizer)
{
	parts.map.bind(m_graph);
}

bool CStereoGraphSlamEngine::_execGraphSlamStep(
	CActionCollection::Ptr& action, CSensoryFrame::Ptr& observations, CObservation::Ptr& observation, size_t&)
{
	m_curr_timestamp = observation->timestamp;
	if (m_init_timestamp == INVALID_TIMESTAMP) m_init_timestamp = m_curr_timestamp;

	std::lock_guard<std::mutex> graph_lock(m_graph_section);
	m_added_node = m_node_reg->updateState(action, observations, observation);
	m_edge_reg->updateState(action, observations, observation);
	m_optimizer->updateState(action, observations, observation);
	if (m_added_node) m_nodeID_max = m_graph.nodeCount() - 1;
	return true;
}

TSlamGraph CStereoGraphSlamEngine::dijkstraGraph() const
{
	TSlamGraph graph = m_graph;
	const mrpt::poses::CPose3D root_pose = graph.nodes.at(graph.root);
	graph.dijkstra_nodes_estimate();
	for (auto& [id, pose] : graph.nodes)
		pose = TSlamGraph::global_pose_t(root_pose + pose);
	return graph;
}

namespace
{
/** The engine's constructor tells the console that it runs headless, before its verbosity can be set. */
class CQuietConsole
{
   public:
	CQuietConsole() : m_out(std::cout.rdbuf(nullptr)), m_err(std::cerr.rdbuf(nullptr)) {}
	~CQuietConsole()
	{
		std::cout.rdbuf(m_out);
		std::cerr.rdbuf(m_err);
		std::cout.clear();
		std::cerr.clear();
	}

   private:
	std::streambuf *m_out, *m_err;
};

std::unique_ptr<CStereoGraphSlamEngine> makeEngine(
	const std::string& config_file, TSlamParts& parts, TNodeDecider& nodes, TEdgeDecider& edges,
	TGraphOptimizer& optimizer)
{
	const CQuietConsole quiet;
	auto engine = std::make_unique<CStereoGraphSlamEngine>(config_file, parts, nodes, edges, optimizer);
	for (mrpt::system::COutputLogger* logger :
		 std::initializer_list<mrpt::system::COutputLogger*>{engine.get(), &nodes, &edges, &optimizer})
		logger->setMinLoggingLevel(mrpt::system::LVL_ERROR);
	return engine;
}
}  // namespace

/** In the order of their dependencies: the engine dies first. */
struct CStereoSlam::TImplementation
{
	std::unique_ptr<COdometrySource> odometry;
	std::unique_ptr<CStereoImageLoader> images;
	TSlamParts parts;
	std::unique_ptr<TNodeDecider> node_decider;
	std::unique_ptr<TEdgeDecider> edge_decider;
	std::unique_ptr<TGraphOptimizer> optimizer;
	std::unique_ptr<CStereoGraphSlamEngine> engine;
	std::vector<TCausalPose> causal;

	TImplementation(
		const TStereoSlamOptions& options, const TSensorSuite& sensors,
		std::unique_ptr<COdometrySource> odometry_, std::unique_ptr<CStereoImageLoader> images_,
		const std::string& config_file)
		: odometry(std::move(odometry_)),
		  images(std::move(images_)),
		  parts(options, sensors, *odometry, *images),
		  node_decider(makeNodeDecider(options.slam.node_decider, parts)),
		  edge_decider(makeEdgeDecider(options.slam.edge_deciders, parts)),
		  optimizer(makeOptimizer(options.slam.optimizer, parts)),
		  engine(makeEngine(config_file, parts, *node_decider, *edge_decider, *optimizer))
	{
		parts.timer.setMinLoggingLevel(mrpt::system::LVL_ERROR);  // else it prints itself when it dies
	}
};

CStereoSlam::CStereoSlam(
	const TStereoSlamOptions& options, const TSensorSuite& sensors, std::unique_ptr<COdometrySource> odometry,
	std::unique_ptr<CStereoImageLoader> images, const std::string& config_file)
	: m_impl(std::make_unique<TImplementation>(
		  options, sensors, std::move(odometry), std::move(images), config_file))
{
}
CStereoSlam::~CStereoSlam() = default;

void CStereoSlam::add(const CObservation::Ptr& observation)
{
	{
		const mrpt::system::CTimeLoggerEntry timing(timer(), "odometry");
		m_impl->odometry->add(*observation);
		// The n-th clone was made at node n.
		for (const TRevisedEdge& r : m_impl->odometry->takeRevisedEdges())
			if (r.clone > 0)
				m_impl->parts.map.reviseOdometry(static_cast<int>(r.clone), r.edge, r.T_odom_body);
	}
	CActionCollection::Ptr no_action;
	CSensoryFrame::Ptr no_frame;
	CObservation::Ptr present = observation;
	size_t entry = 0;
	m_impl->engine->_execGraphSlamStep(no_action, no_frame, present, entry);
	if (m_impl->engine->addedNode()) m_impl->odometry->clone();
	if (IS_CLASS(*observation, CObservationStereoImages) && map().nodeCount() > 0)
		m_impl->causal.push_back(now());
}

TCausalPose CStereoSlam::now() const
{
	const Isometry3d T_odom_body = m_impl->odometry->now().T;
	const int last = map().lastNode();
	Isometry3d T_map_odom = Isometry3d::Identity();	 // until the first node, map and odom are one
	if (last >= 0) T_map_odom = map().pose(last) * map().node(last).T_odom_body.inverse();
	return {m_impl->odometry->stamp(), T_map_odom * T_odom_body, T_odom_body};
}

Matrix6d CStereoSlam::covariance() const
{
	const TPoseEstimate odometry = m_impl->odometry->now();
	const int last = map().lastNode();
	if (last < 0) return odometry.cov;
	Matrix6d cov = map().root_covariance;
	if (last > 0)
		cov = composeCovariance(
			cov, map().relativePose(0, last),
			m_impl->parts.uncertainty->relativeCovariances(map(), {0}, last).front());
	const TPoseEstimate since = m_impl->odometry->sinceClone();
	return composeCovariance(cov, since.T, since.cov);
}

bool CStereoSlam::addedNode() const
{
	return m_impl->engine->addedNode();
}
const std::vector<TCausalPose>& CStereoSlam::causal() const
{
	return m_impl->causal;
}
std::vector<Matrix6d> CStereoSlam::nodeCovariances() const
{
	if (map().nodeCount() == 0) return {};
	const TStereoSlamOptions& options = m_impl->parts.options;
	CPoseGraph graph = toPoseGraph(map(), options.loss, options.priors);
	CSparseOptimizer optimizer(options.optimizer);
	optimizer.optimize(graph);
	return optimizer.marginals(graph).allCovariances();
}
const TGreyPair& CStereoSlam::lastPictures() const
{
	return m_impl->parts.last_pictures;
}
const CSlamMap& CStereoSlam::map() const
{
	return m_impl->parts.map;
}
const COdometrySource& CStereoSlam::odometry() const
{
	return *m_impl->odometry;
}
mrpt::system::CTimeLogger& CStereoSlam::timer() const
{
	return m_impl->parts.timer;
}

TTrajectory CStereoSlam::nodes() const
{
	TTrajectory trajectory;
	for (int i = 0; i < map().nodeCount(); i++)
		trajectory.push_back({map().node(i).stamp, map().pose(i)});
	return trajectory;
}

void CStereoSlam::makeExact()
{
	m_impl->parts.make_exact();
}

double CStereoSlam::chi2() const
{
	return posidonia::chi2(toPoseGraph(map(), m_impl->parts.options.loss));
}

double CStereoSlam::dijkstraChi2() const
{
	CPoseGraph graph = toPoseGraph(map(), m_impl->parts.options.loss);
	const TSlamGraph dijkstra = m_impl->engine->dijkstraGraph();
	for (int i = 0; i < map().nodeCount(); i++)
		graph.setPose(i, fromMrpt(dijkstra.nodes.at(static_cast<mrpt::graphs::TNodeID>(i))));
	return posidonia::chi2(graph);
}

void CStereoSlam::saveG2o(const std::string& path) const
{
	writeG2o(path, toPoseGraph(map(), m_impl->parts.options.loss));
}
}  // namespace posidonia
