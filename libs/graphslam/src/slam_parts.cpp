#include <posidonia/base/error.h>
#include <posidonia/graphslam/slam_parts.h>

#include <cmath>

namespace posidonia
{
using mrpt::obs::CObservationStereoImages;

std::vector<Matrix6d> CChainUncertainty::relativeCovariances(
	const CSlamMap& map, const std::vector<int>& is, int j)
{
	// Backwards along the odometry edges k -> k+1: cov(T_k_j) from cov(T_(k+1)_j).
	std::vector<const TSlamEdge*> step(static_cast<size_t>(map.nodeCount()), nullptr);
	for (const auto& e : map.edges())
		if (e.kind == EEdgeKind::ODOMETRY) step[static_cast<size_t>(e.from)] = &e;
	std::vector<Matrix6d> to_j(static_cast<size_t>(j) + 1, Matrix6d::Zero());
	Eigen::Isometry3d T_k_j = Eigen::Isometry3d::Identity();
	for (int k = j - 1; k >= 0; k--) {
		const TSlamEdge* e = step[static_cast<size_t>(k)];
		const auto at = static_cast<size_t>(k);
		to_j[at] = composeCovariance(e->information.inverse(), T_k_j, to_j[at + 1]);
		T_k_j = e->T_from_to * T_k_j;
	}
	std::vector<Matrix6d> covariances;
	for (int i : is)
		covariances.push_back(to_j[static_cast<size_t>(i)]);
	return covariances;
}

namespace
{
/** The rig is told twice, in the log and in the sensors.ini: they must not contradict each other unnoticed.
 */
void requireSameSize(const CObservationStereoImages& pair, const TStereoSpec& spec)
{
	if (static_cast<int>(pair.leftCamera.ncols) == spec.camera.width &&
		static_cast<int>(pair.leftCamera.nrows) == spec.camera.height)
		return;
	throw CError(
		"sensor '" + pair.sensorLabel + "'",
		mrpt::format(
			"pictures are %ux%u, the sensors.ini says %dx%d", pair.leftCamera.ncols, pair.leftCamera.nrows,
			spec.camera.width, spec.camera.height),
		"correct width and height there");
}
}  // namespace

const TSlamParts::TRig& TSlamParts::rigOf(const CObservationStereoImages& pair)
{
	if (m_rig && m_rig_label == pair.sensorLabel) return *m_rig;
	if (m_rig)
		throw CError(
			"sensor '" + pair.sensorLabel + "'", "a second stereo rig beside '" + m_rig_label + "'",
			"remove one with rawlog-edit --remove-label");
	const TStereoSpec& spec = specOf(sensors.stereo, pair.sensorLabel);
	requireSameSize(pair, spec);
	m_rig_label = pair.sensorLabel;
	m_rig.emplace(TRig{
		spec.camera, spec.T_body_sensor(), CKeyFrameExtractor(options.features, spec.camera),
		CStereoRegistration(options.registration, spec.camera)});
	return *m_rig;
}

const TKeyFrame& TSlamParts::keyFrameOf(int i, const CObservationStereoImages& pair)
{
	if (!map.node(i).key_frame) {
		const TRig& rig = rigOf(pair);
		{
			const mrpt::system::CTimeLoggerEntry timing(timer, "read_images");
			last_pictures = images.load(pair);
		}
		const mrpt::system::CTimeLoggerEntry timing(timer, "key_frame");
		map.setKeyFrame(
			i, std::make_shared<TKeyFrame>(rig.extractor.extract(last_pictures.left, last_pictures.right)));
	}
	return *map.node(i).key_frame;
}
}  // namespace posidonia
