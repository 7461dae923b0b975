#include <posidonia/base/error.h>
#include <posidonia/sim/flat_port.h>

#include <cmath>

/* A flat port bends each ray by Snell's law, n sin(angle) = const, in the plane of ray and axis. The rays of
 * the water meet the axis at different points: there is no single centre, so no pin-hole is exact at all
 * ranges (Treibitz et al. 2012, "Flat refractive geometry"). */
namespace posidonia
{
namespace
{
/** No lens looks farther off its axis than 80 degrees: the sine of that. */
constexpr double kWidest = 0.985;

double tangent(double sine)
{
	return sine / std::sqrt(1 - sine * sine);
}

/** Radius [m] of the ray at `z` [m] along the axis. */
double radiusAt(const TPortOptions& port, double sine_air, double z)
{
	const TPortRay ray = throughPort(port, sine_air);
	return ray.radius + (z - port.distance - port.glass) * ray.sine / ray.cosine;
}

/** Sine in air of the ray that passes `radius` at `z`, by bisection: the radius grows with the sine. */
double sineThrough(const TPortOptions& port, double radius, double z)
{
	double low = 0, high = kWidest;
	for (int i = 0; i < 50; i++) {
		const double middle = (low + high) / 2;
		(radiusAt(port, middle, z) < radius ? low : high) = middle;
	}
	return (low + high) / 2;
}

/** One ray: direction (x, y, 1) of the pin-hole bent by the port. */
void addPortRay(const TPortOptions& port, double x, double y, TViewRays& rays)
{
	const double slope = std::hypot(x, y), z = port.rectified_at;
	const double sine = z > 0 ? sineThrough(port, slope * z, z) : slope / std::hypot(slope, 1);
	const TPortRay ray = throughPort(port, sine);
	const double along_x = slope > 0 ? x / slope : 0, along_y = slope > 0 ? y / slope : 0;
	rays.origin.push_back(along_x * ray.radius, along_y * ray.radius, port.distance + port.glass);
	rays.direction.push_back(along_x * ray.sine, along_y * ray.sine, ray.cosine);
	rays.lit.push_back(z > 0 && radiusAt(port, kWidest, z) < slope * z ? 0 : 1);
}

void addPinHoleRay(double x, double y, TViewRays& rays)
{
	const double length = std::sqrt(x * x + y * y + 1);
	rays.origin.push_back(0, 0, 0);
	rays.direction.push_back(x / length, y / length, 1 / length);
	rays.lit.push_back(1);
}
}  // namespace

TPortRay throughPort(const TPortOptions& port, double sine_air)
{
	const double sine = sine_air / port.n_water;
	return {
		port.distance * tangent(sine_air) + port.glass * tangent(sine_air / port.n_glass), sine,
		std::sqrt(1 - sine * sine)};
}

TViewRays viewRays(const TStereoCamera& camera, const TPortOptions& port)
{
	if (port.flat() && port.rectified_at > 0 && port.rectified_at <= port.distance + port.glass)
		throw CError("[Port] rectified_at", "lies within the port", "make it larger, or 0");
	TViewRays rays;
	rays.width = camera.width, rays.height = camera.height;
	rays.focal = port.flat() && port.rectified_at == 0 ? port.n_water * camera.fx : camera.fx;
	for (int v = 0; v < camera.height; v++)
		for (int u = 0; u < camera.width; u++) {
			const double x = (u - camera.cx) / camera.fx, y = (v - camera.cy) / camera.fy;
			if (port.flat())
				addPortRay(port, x, y, rays);
			else
				addPinHoleRay(x, y, rays);
		}
	return rays;
}
}  // namespace posidonia
