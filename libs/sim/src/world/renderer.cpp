#include <posidonia/sim/random.h>
#include <posidonia/sim/renderer.h>

#include <cmath>

#include "floor_view.h"
#include "row_kernels.h"

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
TLevelView viewOf(const cv::Mat& level, size_t n)
{
	return {
		level.data, static_cast<int>(level.step.p[0]), 1.0 / static_cast<double>(size_t(1) << n),
		level.cols - 1.001, level.rows - 1.001};
}

/** Values of one level of the texture at the pixels [first, end) of a row. */
void sampleLevel(const TLevelView& level, size_t first, size_t end, TPixelRow& row, std::vector<float>& out)
{
	texelsAt(
		level, &row.col[first], &row.row[first],
		{&row.work_at[first], &row.work_x[first], &row.work_y[first]}, &out[first], end - first);
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
	for (size_t n = 0; n < texture.levels().size(); n++)
		m_level_views.push_back(viewOf(texture.levels()[n], n));
	m_level_views.push_back(m_level_views.back());	// the last has no coarser one to blend with
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
	const uint8_t fine = static_cast<uint8_t>(level);
	return {fine, static_cast<float>(level - fine)};
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
		if (exposure.size() > 1)
			for (float& light : row.light)
				light *= share;
		if (!snow.empty())
			std::transform(
				row.light.begin(), row.light.end(), snow.ptr<float>(v), row.light.begin(),
				std::plus<float>());
		m_sensor.develop(
			v, row.light.data(), mixed(noise_seed, static_cast<uint64_t>(v)), picture.ptr<uint8_t>(v));
	}
	return picture;
}

void CFloorRenderer::addLight(const CFloorView& view, const CWaterTables& water, int v, TPixelRow& row) const
{
	view.intersectRow(v, row);
	const size_t width = row.light.size();
	for (size_t first = 0, end; first < width; first = end) {  // runs of one level
		for (end = first; end < width && row.level[end] == row.level[first];)
			end++;
		sampleLevel(m_level_views[row.level[first]], first, end, row, row.radiance);
		sampleLevel(m_level_views[row.level[first] + 1u], first, end, row, row.coarse);
	}
	blend(row.radiance.data(), row.coarse.data(), row.share.data(), width);
	addThroughWater(
		water.view(), {row.radiance.data(), row.irradiance.data(), row.way.data(), row.range.data()},
		row.light.data(), width);
}

cv::Mat1f CFloorRenderer::depths(const Isometry3d& T_map_camera) const
{
	cv::Mat1f depths = m_floor->rangesAlong(m_rays, T_map_camera);
	float* value = depths.ptr<float>();
	for (size_t i = 0; i < m_rays.size(); i++)
		value[i] = m_rays.origin.z[i] + value[i] * m_rays.direction.z[i];
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
