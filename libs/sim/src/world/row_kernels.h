#pragma once

#include <posidonia/sim/flat_port.h>
#include <posidonia/sim/water.h>

#include <cstddef>

/** Loops over a row of pixels, compiled for the processor found at run time. Each number is the same with
 * any of them: no sums, no fused operations. Names as in the classes that call them. */
namespace posidonia
{
/** Three numbers a pixel. */
struct TRowOf3
{
	float *x, *y, *z;
};
struct TConstRowOf3
{
	const float *x, *y, *z;
};
inline TRowOf3 rowOf(TPixelVectors& v)
{
	return {v.x.data(), v.y.data(), v.z.data()};
}
/** `first`: index of the row's first pixel. */
inline TConstRowOf3 rowOf(const TPixelVectors& v, size_t first)
{
	return {v.x.data() + first, v.y.data() + first, v.z.data() + first};
}
/** q = offset + R p; R by columns. */
void turnRow(const float* R, const float* offset, TConstRowOf3 p, TRowOf3 q, size_t n);

/** A grid of numbers by (north, east), kept inside. */
struct TGridView
{
	const float* data;
	int stride;	 ///< Numbers in a row
	float per_metre, centre_col, centre_row, last_col, last_row;
};
/** One step of Newton's method for each ray (from, along) of the row that starts at `range`: where does it
 * meet the triangle below its point? `miss`: how far above that triangle it was before the step [m]; `rate`:
 * by how much it nears the triangle a metre (below zero: it comes from behind). */
void stepToSurface(
	const TGridView& depth, TConstRowOf3 from, TConstRowOf3 along, float* range, float* miss, float* rate,
	size_t n);

/** Bilinear values of a grid at (north, east). */
void valuesAt(const TGridView& grid, const float* north, const float* east, float* value, size_t n);

/** p = from + min(max(range, 0), farthest) * along; range likewise. */
void pointsAlong(TConstRowOf3 from, TConstRowOf3 along, float farthest, float* range, TRowOf3 p, size_t n);
/** Where the rays origin + u step (map axes) of a level floor's row meet it: texture coordinates of `foot` +
 * `pixels` a height (pixels: height in texture pixels) and ranges [m]; `length`: of the rays with unit depth.
 */
struct TPlaneRow
{
	double origin[3], step[3], foot_col, foot_row, pixels, height;
	const float* length;
};
void meetPlane(const TPlaneRow& plane, double* col, double* row, float* range, size_t n);

/** Level n of a mip pyramid by the coordinates of level 0 in pixel areas (column + 0.5: areas, not centres,
 * nest from level to level). Beyond the texture its border goes on. */
struct TLevelView
{
	const uint8_t* data;
	int stride;						   ///< Bytes in a row
	double scale, last_col, last_row;  ///< Pixels of this level in one of level 0; largest coordinates
};
/** Bilinear values of a level; `at`, `fx` and `fy` are for its work. */
struct TTexelWork
{
	int* at;
	float *fx, *fy;
};
void texelsAt(
	const TLevelView& level, const double* col, const double* row, const TTexelWork& work, float* value,
	size_t n);

/** light += radiance * irradiance * direct(way) + veil(range). */
struct TRadianceRow
{
	const float *radiance, *irradiance, *way, *range;
};
void addThroughWater(const TWaterView& water, const TRadianceRow& row, float* light, size_t n);

/** a += share (b - a). */
void blend(float* a, const float* b, const float* share, size_t n);
}  // namespace posidonia
