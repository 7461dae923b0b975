#include "row_kernels.h"

#include <algorithm>
#include <cmath>

// Sanitizers don't know functions that are resolved before main.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define POSIDONIA_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define POSIDONIA_CLONES
#endif

namespace posidonia
{
namespace
{
/** x in [0, last]; 0 where x is no number. */
template <class T>
inline T inside(T x, T last)
{
	return std::min(last, std::max(T(0), x));
}
}  // namespace

POSIDONIA_CLONES
void turnRow(const float* R, const float* offset, TConstRowOf3 p, TRowOf3 q, size_t n)
{
	const float xx = R[0], yx = R[1], zx = R[2], xy = R[3], yy = R[4], zy = R[5], xz = R[6], yz = R[7],
				zz = R[8], x0 = offset[0], y0 = offset[1], z0 = offset[2];
#pragma omp simd
	for (size_t u = 0; u < n; u++) {
		const float x = p.x[u], y = p.y[u], z = p.z[u];
		q.x[u] = x0 + (xx * x + xy * y + xz * z);
		q.y[u] = y0 + (yx * x + yy * y + yz * z);
		q.z[u] = z0 + (zx * x + zy * y + zz * z);
	}
}

POSIDONIA_CLONES
void stepToSurface(
	const TGridView& depth, TConstRowOf3 from, TConstRowOf3 along, float* range, float* miss, float* rates,
	size_t n)
{
	const TGridView g = depth;
#pragma omp simd
	for (size_t u = 0; u < n; u++) {
		const float r = range[u];
		const float col = g.centre_col + (from.y[u] + r * along.y[u]) * g.per_metre;
		const float row = g.centre_row - (from.x[u] + r * along.x[u]) * g.per_metre;
		const float x = inside(col, g.last_col), y = inside(row, g.last_row);
		const int i = static_cast<int>(x), j = static_cast<int>(y), at = j * g.stride + i;
		const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
		const float a = g.data[at], b = g.data[at + 1], c = g.data[at + g.stride],
					d = g.data[at + g.stride + 1];
		// The cell's second triangle bends off the plane of the first by its twist. (No comparison: it would
		// keep the loop scalar.)
		const float beyond = fx + fy - 1, second = 0.5f + std::copysign(0.5f, beyond);
		const float twist = (a + d) - (b + c), bend = second * twist;
		const float floor = a + fx * (b - a) + fy * (c - a) + beyond * bend;
		const float along_col = b - a + bend, along_row = c - a + bend;
		const float above = floor - (from.z[u] + r * along.z[u]);
		const float rate = along.z[u] + (along_row * along.x[u] - along_col * along.y[u]) * g.per_metre;
		range[u] = r + above / rate;
		miss[u] = above;
		rates[u] = rate;
	}
}

POSIDONIA_CLONES
void valuesAt(const TGridView& grid, const float* north, const float* east, float* value, size_t n)
{
	const TGridView g = grid;
#pragma omp simd
	for (size_t u = 0; u < n; u++) {
		const float col = g.centre_col + east[u] * g.per_metre, row = g.centre_row - north[u] * g.per_metre;
		const float x = inside(col, g.last_col), y = inside(row, g.last_row);
		const int i = static_cast<int>(x), j = static_cast<int>(y), at = j * g.stride + i;
		const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
		const float a = g.data[at], b = g.data[at + 1], c = g.data[at + g.stride],
					d = g.data[at + g.stride + 1];
		const float top = a + fx * (b - a), bottom = c + fx * (d - c);
		value[u] = top + fy * (bottom - top);
	}
}

POSIDONIA_CLONES
void pointsAlong(TConstRowOf3 from, TConstRowOf3 along, float farthest, float* range, TRowOf3 p, size_t n)
{
#pragma omp simd
	for (size_t u = 0; u < n; u++) {
		const float given = range[u];
		const float ahead = given > 0 ? given : 0.0f, r = ahead < farthest ? ahead : farthest;
		range[u] = r;
		p.x[u] = from.x[u] + r * along.x[u];
		p.y[u] = from.y[u] + r * along.y[u];
		p.z[u] = from.z[u] + r * along.z[u];
	}
}
POSIDONIA_CLONES
void meetPlane(const TPlaneRow& plane, double* col, double* row, float* range, size_t n)
{
	const TPlaneRow p = plane;
	const int width = static_cast<int>(n);
#pragma omp simd
	for (int u = 0; u < width; u++) {
		const double north = p.origin[0] + u * p.step[0], east = p.origin[1] + u * p.step[1];
		const double down = p.origin[2] + u * p.step[2];
		const double per_depth = 1 / std::max(down, 1e-3);	// over the horizon: far away
		range[u] = static_cast<float>(p.height * per_depth) * p.length[u];
		col[u] = p.foot_col + east * per_depth * p.pixels;
		row[u] = p.foot_row - north * per_depth * p.pixels;
	}
}

namespace
{
POSIDONIA_CLONES
void placeTexels(
	const TLevelView& level, const double* col, const double* row, const TTexelWork& work, size_t n)
{
	const TLevelView g = level;
	int* at = work.at;
	float *fx = work.fx, *fy = work.fy;
#pragma omp simd
	for (size_t u = 0; u < n; u++) {
		const double c = col[u] * g.scale - 0.5, r = row[u] * g.scale - 0.5;
		const double x = inside(c, g.last_col), y = inside(r, g.last_row);
		const int i = static_cast<int>(x), j = static_cast<int>(y);
		at[u] = j * g.stride + i;
		fx[u] = static_cast<float>(x - i), fy[u] = static_cast<float>(y - j);
	}
}
}  // namespace

void texelsAt(
	const TLevelView& level, const double* col, const double* row, const TTexelWork& work, float* value,
	size_t n)
{
	placeTexels(level, col, row, work, n);
	for (size_t u = 0; u < n; u++) {
		const uint8_t *p = level.data + work.at[u], *q = p + level.stride;
		const float top = static_cast<float>(p[0]) + work.fx[u] * static_cast<float>(p[1] - p[0]);
		const float bottom = static_cast<float>(q[0]) + work.fx[u] * static_cast<float>(q[1] - q[0]);
		value[u] = top + work.fy[u] * (bottom - top);
	}
}

POSIDONIA_CLONES
void addThroughWater(const TWaterView& water, const TRadianceRow& row, float* light, size_t n)
{
	const TWaterView w = water;
	const TRadianceRow r = row;
#pragma omp simd
	for (size_t u = 0; u < n; u++) {
		const float way = r.way[u] / w.step + 0.5f, range = r.range[u] / w.step + 0.5f;
		const int i = static_cast<int>(inside(way, w.last)), j = static_cast<int>(inside(range, w.last));
		light[u] += r.radiance[u] * r.irradiance[u] * w.direct[i] + w.veil[j];
	}
}

POSIDONIA_CLONES
void blend(float* a, const float* b, const float* share, size_t n)
{
#pragma omp simd
	for (size_t u = 0; u < n; u++)
		a[u] += share[u] * (b[u] - a[u]);
}
}  // namespace posidonia
