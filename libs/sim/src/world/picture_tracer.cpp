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
	  m_edge(m_inverse.size()),
	  m_from(static_cast<size_t>(rays.width)),
	  m_along(static_cast<size_t>(rays.width)),
	  m_range(static_cast<size_t>(rays.width), 1.0f),
	  m_miss(m_range.size()),
	  m_rate(m_range.size())
{
}

cv::Mat1f CPictureTracer::ranges()
{
	traceCorners();
	findEdges();
	for (int v = 0; v < m_rays.height; v++)
		fillRow(v);
	trace();
	return m_ranges;
}

void CPictureTracer::queue(size_t i)
{
	m_queued[m_packet.count] = i;
	m_packet.add(m_centre + m_R * m_rays.origin[i], m_R * m_rays.direction[i]);
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
			m_inverse(j, i) = 1 / (m_rays.origin.z[k] + m_ranges.ptr<float>()[k] * m_rays.direction.z[k]);
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

bool CPictureTracer::smooth(int i, int j) const
{
	return !(m_edge(j, i) || m_edge(j, i + 1) || m_edge(j + 1, i) || m_edge(j + 1, i + 1));
}

void CPictureTracer::guessRow(int v)
{
	const int j = std::min(v / kBlock, m_inverse.rows - 2), v0 = kBlock * j;
	const float fv =
		static_cast<float>(v - v0) / static_cast<float>(std::min(kBlock, m_rays.height - 1 - v0));
	for (int i = 0; i + 1 < m_inverse.cols; i++) {
		if (!smooth(i, j)) continue;
		const int u0 = kBlock * i;
		const float left = m_inverse(j, i) + fv * (m_inverse(j + 1, i) - m_inverse(j, i));
		const float right = m_inverse(j, i + 1) + fv * (m_inverse(j + 1, i + 1) - m_inverse(j, i + 1));
		const float step = (right - left) / static_cast<float>(std::min(kBlock, m_rays.width - 1 - u0));
		for (int u = u0; u < std::min(u0 + kBlock, m_rays.width); u++) {
			const size_t k = pixel(u, v);
			const float depth = 1 / (left + static_cast<float>(u - u0) * step);
			m_range[static_cast<size_t>(u)] = (depth - m_rays.origin.z[k]) / m_rays.direction.z[k];
		}
	}
}

void CPictureTracer::fillRow(int v)
{
	const size_t first = pixel(0, v), width = static_cast<size_t>(m_rays.width);
	const float none[] = {0, 0, 0};
	turnRow(m_R.data(), m_centre.data(), rowOf(m_rays.origin, first), rowOf(m_from), width);
	turnRow(m_R.data(), none, rowOf(m_rays.direction, first), rowOf(m_along), width);
	guessRow(v);
	for (int step = 0; step < 2; step++)
		stepToSurface(
			m_surface.depth(), rowOf(m_from, 0), rowOf(m_along, 0), m_range.data(), m_miss.data(),
			m_rate.data(), width);
	const int j = std::min(v / kBlock, m_inverse.rows - 2);
	float* out = m_ranges.ptr<float>(v);
	for (int i = 0; i + 1 < m_inverse.cols; i++) {
		const bool guessed = smooth(i, j);
		for (int u = kBlock * i; u < std::min(kBlock * (i + 1), m_rays.width); u++)
			if (guessed && met(static_cast<size_t>(u)))
				out[u] = m_range[static_cast<size_t>(u)];
			else
				queue(first + static_cast<size_t>(u));
	}
}
}  // namespace posidonia
