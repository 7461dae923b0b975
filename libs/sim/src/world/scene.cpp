#include <posidonia/base/error.h>
#include <posidonia/sim/relief_sea_floor.h>
#include <posidonia/sim/scene.h>

#include <cmath>

#include <posidonia/sim/png_file.h>
#include "overview.h"

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;

/** The rig as it is in the world, and what it sees. */
struct CScene::TCamera
{
	TCamera(
		const TSimulationOptions& o, const TStereoSpec& nominal_rig, std::shared_ptr<const CSeaFloor> floor)
		: nominal(nominal_rig),
		  errors(drawnSigns(o.calibration_error, o.run.seed)),
		  spec(trueStereo(nominal, errors)),
		  T_body_camera(spec.T_body_sensor()),
		  lamp(o.lamp.position[0], o.lamp.position[1], o.lamp.position[2]),
		  exposure(o.camera.exposure),
		  snow(o.snow),
		  texture(o.floor, o.run.seed),
		  renderer(
			  texture, std::move(floor), spec.camera, {o.water, o.camera, o.lamp, o.port},
			  (lamp - T_body_camera.translation()).norm()),
		  noise_seed(seedOf(o.run.seed, "pixel noise")),
		  snow_seed(seedOf(o.run.seed, "marine snow"))
	{
	}
	TStereoSpec nominal;
	TCalibrationErrorOptions errors;
	TStereoSpec spec;
	Isometry3d T_body_camera;
	Vector3d lamp;	  ///< In the body [m]
	double exposure;  ///< [s]
	TSnowOptions snow;
	CFloorTexture texture;
	CFloorRenderer renderer;
	uint64_t noise_seed, snow_seed;
};

std::shared_ptr<const CSeaFloor> makeSeaFloor(const TSimulationOptions& o)
{
	if (o.relief.kind == "flat") return std::make_shared<CFlatSeaFloor>(o.floor.depth);
	return std::make_shared<CReliefSeaFloor>(makeRelief(o.relief, o.floor, o.run.seed));
}

CScene::CScene(const TSimulationOptions& options, const TSensorSuite& nominal)
	: m_floor_options(options.floor), m_floor(makeSeaFloor(options))
{
	if (!options.run.stereo || nominal.stereo.empty()) return;
	if (nominal.stereo.size() > 1)
		throw CError(
			"[Sensor.*]", "the simulator carries one stereo rig at most", "leave one entry of kind stereo");
	m_camera = std::make_unique<TCamera>(options, nominal.stereo.begin()->second, m_floor);
}
CScene::~CScene() = default;

double CScene::cameraClock() const
{
	return m_camera->errors.camera_clock;
}

namespace
{
/** The body `t` [s] after the middle of the exposure, its velocity and rate constant. */
Isometry3d bodyAt(const TExposure& exposure, double t)
{
	if (t == 0) return exposure.T_map_body;
	const Vector3d turn = exposure.omega_body * t;
	Isometry3d T = exposure.T_map_body * Eigen::Translation3d(exposure.v_body * t);
	if (turn.norm() > 0) T.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
	return T;
}
}  // namespace

/** The camera `aside` [m] of the left one, at instants spread evenly over the exposure: at most half a pixel
 * of motion apart, up to 16. */
std::vector<CFloorRenderer::TMoment> CScene::momentsOf(const TExposure& exposure, double aside) const
{
	const TStereoCamera& camera = m_camera->spec.camera;
	const Vector3d position = (exposure.T_map_body * m_camera->T_body_camera).translation();
	const double height = std::max(0.1, m_floor->depthAt(position.head<2>()) - position.z());
	const double corner = std::hypot(camera.width, camera.height) / 2;
	const double speed = camera.fx * exposure.v_body.norm() / height +
						 std::max(camera.fx, corner) * exposure.omega_body.norm();	// [px/s]
	const int n = static_cast<int>(std::clamp(std::ceil(2 * speed * m_camera->exposure), 1.0, 16.0));
	std::vector<CFloorRenderer::TMoment> moments;
	for (int i = 0; i < n; i++) {
		const Isometry3d T_map_body = bodyAt(exposure, ((i + 0.5) / n - 0.5) * m_camera->exposure);
		const Isometry3d T_map_left = T_map_body * m_camera->T_body_camera;
		moments.push_back({T_map_left * Eigen::Translation3d(aside, 0, 0), T_map_body * m_camera->lamp});
	}
	return moments;
}

TGreyPair CScene::photograph(const TExposure& exposure, uint64_t frame) const
{
	const TStereoCamera& camera = m_camera->spec.camera;
	const Isometry3d T_map_left = exposure.T_map_body * m_camera->T_body_camera;
	const CFloorRenderer::TConditions conditions{
		drawFlakes(m_camera->snow, camera, T_map_left, mixed(m_camera->snow_seed, frame)),
		m_camera->snow.brightness, exposure.water_factor};
	const auto picture = [&](double aside, uint64_t side) {
		return m_camera->renderer.render(
			momentsOf(exposure, aside), conditions, mixed(m_camera->noise_seed, frame, side));
	};
	return {picture(0, 0), picture(camera.baseline, 1)};
}

cv::Mat1f CScene::depths(const Isometry3d& T_map_body) const
{
	return m_camera->renderer.depths(T_map_body * m_camera->T_body_camera);
}

void CScene::writeOverview(const std::string& path, const std::vector<Vector3d>& way) const
{
	writePng(path, overviewOf(m_camera->texture, *m_floor, way));
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
			throw CError(
				"[Floor] depth", "a point of the way lies under the sea floor", "make [Floor] depth larger");
		if (std::abs(p.x()) + reach > m_floor_options.extent_north / 2 ||
			std::abs(p.y()) + reach > m_floor_options.extent_east / 2)
			throw CError(
				"[Floor]",
				"the camera sees over the end of the floor's texture at north " + std::to_string(p.x()) +
					" east " + std::to_string(p.y()),
				"make [Floor] extent_north or extent_east larger");
	}
}
}  // namespace posidonia
