#include "ray_tracer.h"

#include <embree3/rtcore.h>
#include <posidonia/base/error.h>

#include <algorithm>
#include <limits>

namespace posidonia
{
namespace
{
/** How far the border goes on [m]: past any horizon of a camera under water. */
constexpr float kSkirt = 1000;

/** Vertices of the grid and one more row or column on each side, far out. */
void writeVertices(const TDepthGrid& grid, float* vertex)
{
	const int rows = grid.depth.rows, cols = grid.depth.cols;
	const float res = static_cast<float>(grid.resolution);
	const auto outside = [](int i, int n) { return i < 0 ? -kSkirt : i >= n ? kSkirt : 0; };
	for (int j = -1; j <= rows; j++)
		for (int i = -1; i <= cols; i++) {
			const int row = std::clamp(j, 0, rows - 1), col = std::clamp(i, 0, cols - 1);
			*vertex++ = (static_cast<float>(rows - 1) / 2 - static_cast<float>(row)) * res - outside(j, rows);
			*vertex++ = (static_cast<float>(col) - static_cast<float>(cols - 1) / 2) * res + outside(i, cols);
			*vertex++ = grid.depth(row, col);
		}
}
}  // namespace

/** Embree's objects, freed in the order that it asks for. */
struct CRayTracer::TEmbree
{
	// One thread builds the tree, so that it is the same tree each time; no configuration file is read.
	RTCDevice device{rtcNewDevice("threads=1,ignore_config_files=1")};
	RTCScene scene{rtcNewScene(device)};

	TEmbree() = default;
	TEmbree(const TEmbree&) = delete;
	TEmbree& operator=(const TEmbree&) = delete;
	~TEmbree()
	{
		rtcReleaseScene(scene);
		rtcReleaseDevice(device);
	}
	void requireNoError() const
	{
		const RTCError error = rtcGetDeviceError(device);
		if (error == RTC_ERROR_NONE) return;
		throw CError(
			"[Relief]", "Embree can't build the floor (error " + std::to_string(error) + ")",
			"make resolution coarser");
	}
	void build(const TDepthGrid& grid) const
	{
		const unsigned width = static_cast<unsigned>(grid.depth.cols + 2),
					   height = static_cast<unsigned>(grid.depth.rows + 2);
		const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_GRID);
		writeVertices(
			grid, static_cast<float*>(rtcSetNewGeometryBuffer(
					  geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
					  size_t(width) * height)));
		auto* patch = static_cast<RTCGrid*>(
			rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
		*patch = {0, width, static_cast<unsigned short>(width), static_cast<unsigned short>(height)};
		rtcCommitGeometry(geometry);
		rtcAttachGeometry(scene, geometry);
		rtcReleaseGeometry(geometry);
		rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
		rtcCommitScene(scene);
		requireNoError();
	}
};

CRayTracer::CRayTracer(const TDepthGrid& grid)
{
	constexpr int largest = 32767 - 2;	// of Embree's grid geometry
	if (std::max(grid.depth.rows, grid.depth.cols) > largest ||
		std::min(grid.depth.rows, grid.depth.cols) < 2)
		throw CError("[Relief]", "the height field must have 2 to 32765 points a side", "change resolution");
	auto embree = std::make_unique<TEmbree>();
	embree->build(grid);
	m_embree = std::move(embree);
}
CRayTracer::~CRayTracer() = default;

void CRayTracer::TPacket::add(const Eigen::Vector3f& from, const Eigen::Vector3f& along)
{
	for (int axis = 0; axis < 3; axis++) {
		origin[axis][count] = from[axis];
		direction[axis][count] = along[axis];
	}
	count++;
}

void CRayTracer::trace(TPacket& packet) const
{
	alignas(64) RTCRayHit16 rays;
	alignas(64) int valid[16];
	for (int k = 0; k < 16; k++) {
		const int from = std::min(k, packet.count - 1);	 // the rest: any numbers, but defined ones
		valid[k] = k < packet.count ? -1 : 0;
		rays.ray.org_x[k] = packet.origin[0][from];
		rays.ray.org_y[k] = packet.origin[1][from];
		rays.ray.org_z[k] = packet.origin[2][from];
		rays.ray.dir_x[k] = packet.direction[0][from];
		rays.ray.dir_y[k] = packet.direction[1][from];
		rays.ray.dir_z[k] = packet.direction[2][from];
		rays.ray.tnear[k] = rays.ray.time[k] = 0;
		rays.ray.tfar[k] = std::numeric_limits<float>::infinity();
		rays.ray.mask[k] = ~0u;
		rays.ray.id[k] = rays.ray.flags[k] = 0;
		rays.hit.geomID[k] = rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
	}
	RTCIntersectContext context;
	rtcInitIntersectContext(&context);
	context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
	rtcIntersect16(valid, m_embree->scene, &context, &rays);
	std::copy_n(rays.ray.tfar, packet.count, packet.range);	 // (stays infinite where nothing is hit)
}
}  // namespace posidonia
