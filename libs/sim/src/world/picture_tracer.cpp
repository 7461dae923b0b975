#include "picture_tracer.h"

#include <cmath>

namespace posidonia
{
using Eigen::Vector3f;

CPictureTracer::CPictureTracer(
	const CHeightSurface& surface, const CRayTracer& tracer, const TViewRays& rays,
	const Eigen::Isometry3d& T_map_camera)
	: m_surface(surface),
	  m_tracer(tracer),
	  m_rays(rays),
	  m_R(T_map_camera.linear().cast<float>()),
	  m_centre(T_map_camera.translation().cast<float>()),
	  m_ranges(rays.height, rays.width),
	  m_inverse((rays.height + kBlock - 2) / kBlock + 1, (rays.width + kBlock - 2) / kBlock + 1),
	  m_edge(m_inverse.size())
{
}

cv::Mat1f CPictureTracer::ranges()
{
	traceCorners();
	findEdges();
	for (int j = 0; j + 1 < m_inverse.rows; j++)
		for (int i = 0; i + 1 < m_inverse.cols; i++)
			fillBlock(i, j);
	trace();
	return m_ranges;
}

Vector3f CPictureTracer::originOf(size_t i) const
{
	return m_centre + m_R * Vector3f(m_rays.origin_x[i], m_rays.origin_y[i], m_rays.origin_z[i]);
}
Vector3f CPictureTracer::directionOf(size_t i) const
{
	return m_R * Vector3f(m_rays.x[i], m_rays.y[i], m_rays.z[i]);
}

void CPictureTracer::queue(size_t i)
{
	m_queued[m_packet.count] = i;
	m_packet.add(originOf(i), directionOf(i));
	if (m_packet.full()) trace();
}

void CPictureTracer::trace()
{
	if (m_packet.count == 0) return;
	m_tracer.trace(m_packet);
	for (int k = 0; k < m_packet.count; k++)
		m_ranges.ptr<float>()[m_queued[k]] = m_packet.range[k];
	m_packet.count = 0;
}

void CPictureTracer::traceCorners()
{
	const auto corner = [&](int i, int j) {
		return pixel(std::min(kBlock * i, m_rays.width - 1), std::min(kBlock * j, m_rays.height - 1));
	};
	for (int j = 0; j < m_inverse.rows; j++)
		for (int i = 0; i < m_inverse.cols; i++)
			queue(corner(i, j));
	trace();
	for (int j = 0; j < m_inverse.rows; j++)
		for (int i = 0; i < m_inverse.cols; i++) {
			const size_t k = corner(i, j);
			m_inverse(j, i) = 1 / (m_rays.origin_z[k] + m_ranges.ptr<float>()[k] * m_rays.z[k]);
		}
}

bool CPictureTracer::bends(int i, int j) const
{
	const float here = m_inverse(j, i);
	const auto second = [&](int di, int dj) {
		if (i < di || j < dj || i + di >= m_inverse.cols || j + dj >= m_inverse.rows) return 0.0f;
		return m_inverse(j - dj, i - di) + m_inverse(j + dj, i + di) - 2 * here;
	};
	const float most = kBend * here;
	return !(here > 0 && std::abs(second(1, 0)) < most && std::abs(second(0, 1)) < most);
}

void CPictureTracer::findEdges()
{
	for (int j = 0; j < m_inverse.rows; j++)
		for (int i = 0; i < m_inverse.cols; i++)
			m_edge(j, i) = bends(i, j);
}

void CPictureTracer::fillBlock(int i, int j)
{
	if (!(m_edge(j, i) || m_edge(j, i + 1) || m_edge(j + 1, i) || m_edge(j + 1, i + 1)))
		return fillSmooth(i, j);
	for (int v = kBlock * j; v < std::min(kBlock * (j + 1), m_rays.height); v++)
		for (int u = kBlock * i; u < std::min(kBlock * (i + 1), m_rays.width); u++)
			queue(pixel(u, v));
}

void CPictureTracer::fillSmooth(int i, int j)
{
	const int u0 = kBlock * i, v0 = kBlock * j;
	const int u1 = std::min(u0 + kBlock, m_rays.width - 1), v1 = std::min(v0 + kBlock, m_rays.height - 1);
	const float per_u = 1 / static_cast<float>(u1 - u0), per_v = 1 / static_cast<float>(v1 - v0);
	for (int v = v0; v < std::min(v0 + kBlock, m_rays.height); v++) {
		const float fv = static_cast<float>(v - v0) * per_v;
		const float left = m_inverse(j, i) + fv * (m_inverse(j + 1, i) - m_inverse(j, i));
		const float right = m_inverse(j, i + 1) + fv * (m_inverse(j + 1, i + 1) - m_inverse(j, i + 1));
		for (int u = u0; u < std::min(u0 + kBlock, m_rays.width); u++) {
			const size_t k = pixel(u, v);
			const float inverse = left + static_cast<float>(u - u0) * per_u * (right - left);
			const float range = refined(k, (1 / inverse - m_rays.origin_z[k]) / m_rays.z[k]);
			if (range > 0)
				m_ranges(v, u) = range;
			else
				queue(k);
		}
	}
}

float CPictureTracer::refined(size_t i, float range) const
{
	const Vector3f origin = originOf(i), along = directionOf(i);
	for (int step = 0; step <= kSteps; step++) {
		const auto floor = m_surface.at(origin.x() + range * along.x(), origin.y() + range * along.y());
		const float above = floor.depth - (origin.z() + range * along.z());
		const float rate = along.z() - floor.per_north * along.x() - floor.per_east * along.y();
		if (rate < 0.05f) return -1;  // along the floor, or from behind
		range += above / rate;
		if (std::abs(above) < kClose) return range;
	}
	return -1;
}
}  // namespace posidonia
