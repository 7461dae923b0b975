#include <posidonia/sim/random.h>
#include <posidonia/sim/renderer.h>

#include <cmath>

#include "floor_view.h"

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
/** Bilinear value of a level at (column, row), which the caller keeps inside. */
inline float sampled(const cv::Mat& level, double col, double row)
{
	const int i = static_cast<int>(col), j = static_cast<int>(row);
	const float fx = static_cast<float>(col - i), fy = static_cast<float>(row - j);
	const uint8_t *p = level.data + static_cast<size_t>(j) * level.step.p[0] + i, *q = p + level.step.p[0];
	const float top = static_cast<float>(p[0]) + fx * static_cast<float>(p[1] - p[0]);
	const float bottom = static_cast<float>(q[0]) + fx * static_cast<float>(q[1] - q[0]);
	return top + fy * (bottom - top);
}

/** A point of level 0, in pixel areas (column + 0.5: areas, not centres, nest from level to level), on level
 * n, kept inside: beyond the texture its border goes on. */
float levelValue(const cv::Mat& level, size_t n, double col, double row)
{
	const double scale = 1.0 / static_cast<double>(size_t(1) << n);
	return sampled(
		level, std::min(std::max(col * scale - 0.5, 0.0), level.cols - 1.001),
		std::min(std::max(row * scale - 0.5, 0.0), level.rows - 1.001));
}
}  // namespace

CFloorRenderer::CFloorRenderer(
	const CFloorTexture& texture, std::shared_ptr<const CSeaFloor> floor, const TStereoCamera& camera,
	const TOptics& optics, double lamp_distance)
	: m_texture(texture),
	  m_floor(std::move(floor)),
	  m_camera(camera),
	  m_optics(optics),
	  m_lamp_distance(lamp_distance),
	  m_rays(viewRays(camera, optics.port)),
	  m_water(optics.water, optics.lamp, lamp_distance, 1),
	  m_sensor(camera, optics.camera)
{
	m_sensor.mask(m_rays.lit);
	for (int i = 0; i < 4096; i++)
		m_levels.push_back(levelsAt(i * static_cast<double>(TMipLevels::kStep)));
	for (int v = 0; v < camera.height; v++)
		for (int u = 0; u < camera.width; u++)
			m_ray_length.push_back(static_cast<float>(
				Vector3d((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1).norm()));
}

CFloorRenderer::CFloorRenderer(
	const CFloorTexture& texture, double depth, const TStereoCamera& camera, const TWaterOptions& water,
	const TCameraOptions& sensor)
	: CFloorRenderer(texture, std::make_shared<CFlatSeaFloor>(depth), camera, {water, sensor, {}, {}})
{
}
CFloorRenderer::~CFloorRenderer() = default;

TMipLevels CFloorRenderer::levelsAt(double depth) const
{
	// Level whose pixels are as wide as a picture pixel's footprint; between two levels, a blend.
	const double footprint = depth / m_rays.focal, last = static_cast<double>(m_texture.levels().size() - 1);
	const double level = std::clamp(std::log2(footprint / m_texture.resolution()), 0.0, last);
	const size_t fine = static_cast<size_t>(level);
	return {fine, static_cast<float>(level - static_cast<double>(fine))};
}

std::unique_ptr<const CFloorView> CFloorRenderer::viewFrom(const TMoment& moment) const
{
	const auto level = m_floor->levelDepth();
	if (!level || m_optics.lamp.on() || m_optics.port.flat())
		return std::make_unique<CTracedView>(
			CTracedView::TWorld{*m_floor, m_texture, m_rays, m_optics.lamp, m_levels}, moment);
	const Vector3d centre = moment.T_map_camera.translation();
	// A camera in the floor sees what one a hair above it sees.
	const double height = std::max(*level - centre.z(), 1e-3);
	return std::make_unique<CPlaneView>(
		m_camera, m_ray_length, moment.T_map_camera.linear(), height, m_texture.pixelAt(centre.head<2>()),
		m_texture.resolution(), levelsAt(height));
}

cv::Mat CFloorRenderer::render(
	const std::vector<TMoment>& exposure, const TConditions& conditions, uint64_t noise_seed) const
{
	const CWaterTables murky =
		conditions.water_factor == 1
			? m_water
			: CWaterTables(m_optics.water, m_optics.lamp, m_lamp_distance, conditions.water_factor);
	std::vector<std::unique_ptr<const CFloorView>> views;
	for (const TMoment& moment : exposure)
		views.push_back(viewFrom(moment));
	const cv::Mat1f snow = snowLight(exposure, conditions, murky);
	const float share = 1 / static_cast<float>(exposure.size());
	TPixelRow row(static_cast<size_t>(m_camera.width));
	cv::Mat picture(m_camera.height, m_camera.width, CV_8U);
	for (int v = 0; v < m_camera.height; v++) {
		std::fill(row.light.begin(), row.light.end(), 0.0f);
		for (const auto& view : views)
			addLight(*view, murky, v, row);
		for (int u = 0; u < m_camera.width; u++)
			row.light[u] = row.light[u] * share + (snow.empty() ? 0 : snow(v, u));
		m_sensor.develop(
			v, row.light.data(), mixed(noise_seed, static_cast<uint64_t>(v)), picture.ptr<uint8_t>(v));
	}
	return picture;
}

void CFloorRenderer::addLight(const CFloorView& view, const CWaterTables& water, int v, TPixelRow& row) const
{
	view.intersectRow(v, row);
	const auto& levels = m_texture.levels();
	for (int u = 0; u < m_camera.width; u++) {
		const auto [n, share] = row.levels[u];
		const size_t next = std::min(n + 1, levels.size() - 1);
		const float a = levelValue(levels[n], n, row.col[u], row.row[u]);
		const float b = levelValue(levels[next], next, row.col[u], row.row[u]);
		const float radiance = (a + share * (b - a)) * row.irradiance[u];
		row.light[u] += radiance * water.direct(row.way[u]) + water.veil(row.range[u]);
	}
}

cv::Mat1f CFloorRenderer::depths(const Isometry3d& T_map_camera) const
{
	cv::Mat1f depths = m_floor->rangesAlong(m_rays, T_map_camera);
	float* value = depths.ptr<float>();
	for (size_t i = 0; i < m_rays.size(); i++)
		value[i] = m_rays.origin_z[i] + value[i] * m_rays.z[i];
	return depths;
}

cv::Mat1f CFloorRenderer::snowLight(
	const std::vector<TMoment>& exposure, const TConditions& conditions, const CWaterTables& water) const
{
	cv::Mat1f light;
	if (conditions.flakes.empty()) return light;
	light = cv::Mat1f::zeros(m_camera.height, m_camera.width);
	const double brightness = conditions.flake_brightness / static_cast<double>(exposure.size());
	for (const TMoment& moment : exposure)
		for (const TFlake& flake : conditions.flakes)
			addFlake(flake, moment, brightness, water, light);
	return light;
}

/** A disc of the flake's diameter, spread by the lens: a Gaussian of the disc's variance and light. */
void CFloorRenderer::addFlake(
	const TFlake& flake, const TMoment& moment, double brightness, const CWaterTables& water,
	cv::Mat1f& light) const
{
	constexpr double kLens = 0.7;  // sigma of the picture of a point [px]
	const Vector3d p = moment.T_map_camera.inverse() * flake.position;
	if (p.z() < kNearestFlake / 2) return;
	const Vector3d centre = moment.T_map_camera.translation();
	const double range = p.norm();
	if (m_floor->rangeAlong(centre, (flake.position - centre) / range) < range) return;	 // in the floor
	double gain = brightness, way = range;
	if (m_optics.lamp.on()) {
		const double distance = std::max((moment.lamp - flake.position).norm(), kNearestFlake);
		gain *= std::pow(m_optics.lamp.reference / distance, 2), way += distance;
	}
	const Vector3d uvr = m_camera.project(p);
	const double width = m_camera.fx * flake.diameter / p.z(), variance = kLens * kLens + width * width / 16;
	const double peak =
		gain * static_cast<double>(water.direct(static_cast<float>(way))) * width * width / 8 / variance;
	const int reach = static_cast<int>(std::ceil(4 * std::sqrt(variance)));
	const int u0 = static_cast<int>(std::lround(uvr.x())), v0 = static_cast<int>(std::lround(uvr.y()));
	for (int v = std::max(v0 - reach, 0); v <= std::min(v0 + reach, m_camera.height - 1); v++)
		for (int u = std::max(u0 - reach, 0); u <= std::min(u0 + reach, m_camera.width - 1); u++) {
			const double off = (u - uvr.x()) * (u - uvr.x()) + (v - uvr.y()) * (v - uvr.y());
			light(v, u) += static_cast<float>(peak * std::exp(-off / (2 * variance)));
		}
}

TGreyPair renderPair(
	const CFloorRenderer& renderer, const Isometry3d& T_map_camera, double baseline, uint64_t seed,
	uint64_t frame)
{
	const Isometry3d T_map_right = T_map_camera * Eigen::Translation3d(baseline, 0, 0);
	return {
		renderer.render(T_map_camera, mixed(seed, frame, 0)),
		renderer.render(T_map_right, mixed(seed, frame, 1))};
}
}  // namespace posidonia
