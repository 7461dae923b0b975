#include <posidonia/sim/random.h>
#include <posidonia/sim/renderer.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
constexpr float kRangeStep = 0.005f;  ///< [m]
constexpr int kRanges = 8192;		  ///< Up to 41 m
constexpr int kNoiseBits = 12;

/** x with P(normal <= x) = p, by Newton's method on erfc. */
double normalQuantile(double p)
{
	double x = 0;
	for (int i = 0; i < 60; i++) {
		const double error = 0.5 * std::erfc(-x / std::sqrt(2.0)) - p;
		const double density = std::exp(-x * x / 2) / std::sqrt(2 * M_PI);
		x -= std::clamp(error / density, -0.5, 0.5);
	}
	return x;
}

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
struct TLevelView
{
	TLevelView(const cv::Mat& texture, size_t n)
		: level(texture),
		  scale(std::ldexp(1.0, -static_cast<int>(n))),
		  last_col(texture.cols - 1.001),
		  last_row(texture.rows - 1.001)
	{
	}
	float at(double col, double row) const
	{
		return sampled(
			level, std::min(std::max(col * scale - 0.5, 0.0), last_col),
			std::min(std::max(row * scale - 0.5, 0.0), last_row));
	}
	const cv::Mat& level;
	double scale, last_col, last_row;
};
}  // namespace

/** One row of the picture: its viewing rays in map, origin + column * step, and where the camera is. */
struct CFloorRenderer::TRays
{
	Vector3d origin, step;
	double height;		   ///< Of the camera over the floor [m]
	Eigen::Vector2d foot;  ///< Texture pixel (level 0) straight below the camera
	const float* length;   ///< Of each ray with unit depth
};

/** What is known of one row of the picture, by column. */
struct CFloorRenderer::TRow
{
	explicit TRow(size_t width) : col(width), row(width), range(width), radiance(width) {}
	std::vector<double> col, row;		 ///< On level 0, + 0.5
	std::vector<float> range, radiance;	 ///< [m], [grey levels]
};

/** Two neighbouring mip levels and the share of the coarser one. */
struct CFloorRenderer::TLevels
{
	size_t fine, coarse;
	float share;
};

CFloorRenderer::CFloorRenderer(
	const CFloorTexture& floor, double depth, const TStereoCamera& camera, const TWaterOptions& water,
	const TCameraOptions& sensor)
	: m_floor(floor), m_depth(depth), m_camera(camera)
{
	buildTables(water, sensor);
}

void CFloorRenderer::buildTables(const TWaterOptions& water, const TCameraOptions& sensor)
{
	for (int i = 0; i < kRanges; i++) {
		const double range = i * static_cast<double>(kRangeStep);
		m_direct.push_back(static_cast<float>(std::exp(-water.attenuation * range)));
		m_veil.push_back(
			static_cast<float>(water.veiling_light * (1 - std::exp(-water.backscatter * range))));
	}
	const int n = 1 << kNoiseBits;
	for (int i = 0; i < n; i++)
		m_noise.push_back(static_cast<float>(sensor.noise * normalQuantile((i + 0.5) / n)));
	const double corner = std::hypot(m_camera.width, m_camera.height) / 2;
	for (int v = 0; v < m_camera.height; v++)
		for (int u = 0; u < m_camera.width; u++) {
			const double off =
				std::hypot(u - (m_camera.width - 1) / 2.0, v - (m_camera.height - 1) / 2.0) / corner;
			m_vignetting.push_back(static_cast<float>(1 - sensor.vignetting * off * off));
			m_ray_length.push_back(static_cast<float>(
				Vector3d((u - m_camera.cx) / m_camera.fx, (v - m_camera.cy) / m_camera.fy, 1).norm()));
		}
}

CFloorRenderer::TLevels CFloorRenderer::chooseLevels(double height) const
{
	// Level whose pixels are as wide as a picture pixel's footprint; between two levels, a blend.
	const double footprint = height / m_camera.fx, last = static_cast<double>(m_floor.levels().size() - 1);
	const double level = std::clamp(std::log2(footprint / m_floor.resolution()), 0.0, last);
	const size_t fine = static_cast<size_t>(level);
	return {
		fine, std::min(fine + 1, m_floor.levels().size() - 1),
		static_cast<float>(level - static_cast<double>(fine))};
}

cv::Mat CFloorRenderer::render(const Isometry3d& T_map_camera, uint64_t noise_seed, double water_factor) const
{
	const Matrix3d& R = T_map_camera.linear();
	const Vector3d centre = T_map_camera.translation();
	// A camera in the floor sees what one a hair above it sees.
	TRays rays{
		{},
		R.col(0) / m_camera.fx,
		std::max(m_depth - centre.z(), 1e-3),
		m_floor.pixelAt(centre.head<2>()),
		nullptr};
	const TLevels levels = chooseLevels(rays.height);
	const size_t width = static_cast<size_t>(m_camera.width);
	TRow row(width);
	cv::Mat picture(m_camera.height, m_camera.width, CV_8U);
	for (int v = 0; v < m_camera.height; v++) {
		rays.origin = R * Vector3d(-m_camera.cx / m_camera.fx, (v - m_camera.cy) / m_camera.fy, 1);
		rays.length = m_ray_length.data() + static_cast<size_t>(v) * width;
		intersectRow(rays, row);
		sampleRow(levels, row);
		develop(
			v, row, static_cast<float>(water_factor), mixed(noise_seed, static_cast<uint64_t>(v)),
			picture.ptr<uint8_t>(v));
	}
	return picture;
}

void CFloorRenderer::intersectRow(const TRays& rays, TRow& row) const
{
	const double pixels = rays.height / m_floor.resolution();
	for (int u = 0; u < m_camera.width; u++) {
		const double north = rays.origin.x() + u * rays.step.x(), east = rays.origin.y() + u * rays.step.y();
		const double down = rays.origin.z() + u * rays.step.z();
		const double per_depth = 1 / std::max(down, 1e-3);	// over the horizon: far away
		row.range[u] = static_cast<float>(rays.height * per_depth) * rays.length[u];
		row.col[u] = rays.foot.x() + 0.5 + east * per_depth * pixels;
		row.row[u] = rays.foot.y() + 0.5 - north * per_depth * pixels;
	}
}

void CFloorRenderer::sampleRow(const TLevels& levels, TRow& row) const
{
	const TLevelView fine(m_floor.levels()[levels.fine], levels.fine);
	const TLevelView coarse(m_floor.levels()[levels.coarse], levels.coarse);
	for (int u = 0; u < m_camera.width; u++) {
		const float a = fine.at(row.col[u], row.row[u]), b = coarse.at(row.col[u], row.row[u]);
		row.radiance[u] = a + levels.share * (b - a);
	}
}

void CFloorRenderer::develop(
	int v, const TRow& row, float water_factor, uint64_t noise_seed, uint8_t* out) const
{
	const float* vignetting =
		m_vignetting.data() + static_cast<size_t>(v) * static_cast<size_t>(m_camera.width);
	const float *direct = m_direct.data(), *veil = m_veil.data(), *noise = m_noise.data();
	constexpr uint64_t mask = (1 << kNoiseBits) - 1;
	uint64_t bits = 0;
	for (int u = 0; u < m_camera.width; u++) {
		bits = u % 4 == 0 ? mixed(noise_seed + static_cast<uint64_t>(u)) : bits >> 16;
		const int i =
			static_cast<int>(std::min(water_factor * row.range[u] / kRangeStep + 0.5f, kRanges - 1.0f));
		const float light = (row.radiance[u] * direct[i] + veil[i]) * vignetting[u] + noise[bits & mask];
		out[u] = static_cast<uint8_t>(std::min(std::max(light + 0.5f, 0.0f), 255.0f));
	}
}

TGreyPair renderPair(
	const CFloorRenderer& renderer, const Isometry3d& T_map_camera, double baseline, uint64_t seed,
	uint64_t frame, double water_factor)
{
	const Isometry3d T_map_right = T_map_camera * Eigen::Translation3d(baseline, 0, 0);
	return {
		renderer.render(T_map_camera, mixed(seed, frame, 0), water_factor),
		renderer.render(T_map_right, mixed(seed, frame, 1), water_factor)};
}
}  // namespace posidonia
