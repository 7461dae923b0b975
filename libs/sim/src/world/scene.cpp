#include <posidonia/base/error.h>
#include <posidonia/sim/scene.h>

#include <cmath>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;

/** The rig as it is in the world, and what it sees. */
struct CScene::TCamera
{
	TCamera(const TSimulationOptions& o, const TStereoSpec& nominal_rig)
		: nominal(nominal_rig),
		  errors(drawnSigns(o.calibration_error, o.run.seed)),
		  spec(trueStereo(nominal, errors)),
		  T_body_camera(spec.T_body_sensor()),
		  texture(o.floor, o.run.seed),
		  renderer(texture, o.floor.depth, spec.camera, o.water, o.camera),
		  seed(seedOf(o.run.seed, "pixel noise"))
	{
	}
	TStereoSpec nominal;
	TCalibrationErrorOptions errors;
	TStereoSpec spec;
	Isometry3d T_body_camera;
	CFloorTexture texture;
	CFloorRenderer renderer;
	uint64_t seed;
};

std::shared_ptr<const CSeaFloor> makeSeaFloor(const TSimulationOptions& options)
{
	return std::make_shared<CFlatSeaFloor>(options.floor.depth);
}

CScene::CScene(const TSimulationOptions& options, const TSensorSuite& nominal)
	: m_floor_options(options.floor), m_floor(makeSeaFloor(options))
{
	if (!options.run.stereo || nominal.stereo.empty()) return;
	if (nominal.stereo.size() > 1)
		throw CError(
			"[Sensor.*]", "the simulator carries one stereo rig at most", "leave one entry of kind stereo");
	m_camera = std::make_unique<TCamera>(options, nominal.stereo.begin()->second);
}
CScene::~CScene() = default;

double CScene::cameraClock() const
{
	return m_camera->errors.camera_clock;
}

TGreyPair CScene::photograph(const TExposure& exposure, uint64_t frame) const
{
	const Isometry3d T_map_camera = exposure.T_map_body * m_camera->T_body_camera;
	return renderPair(
		m_camera->renderer, T_map_camera, m_camera->spec.camera.baseline, m_camera->seed, frame,
		exposure.water_factor);
}

void CScene::requireFloorUnder(const std::vector<Vector3d>& positions) const
{
	const TStereoCamera& camera = m_camera->nominal.camera;
	const double view = std::hypot(camera.width, camera.height) / 2 / camera.fx;
	const double arm = m_camera->nominal.T_body_sensor().translation().head<2>().norm();
	for (const Vector3d& p : positions) {
		const double height = m_floor->depthAt(p.head<2>()) - p.z();
		const double reach = height * view + arm + m_floor_options.margin;
		if (height <= 0)
			throw CError("[Route]", "a set point lies under the sea floor", "make [Floor] depth larger");
		if (std::abs(p.x()) + reach > m_floor_options.extent_north / 2 ||
			std::abs(p.y()) + reach > m_floor_options.extent_east / 2)
			throw CError(
				"[Route]",
				"the camera sees over the end of the floor's texture at north " + std::to_string(p.x()) +
					" east " + std::to_string(p.y()),
				"make [Floor] extent_north or extent_east larger");
	}
}
}  // namespace posidonia
