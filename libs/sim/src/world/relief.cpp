#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/sim/random.h>
#include <posidonia/sim/relief.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

/* Heights up [m] about zero until the very end, where they become depths. */
namespace posidonia
{
namespace
{
/** Heights on the grid of TDepthGrid. */
struct TGrid
{
	TGrid(double metres_north, double metres_east, double width)
		: resolution(width), height(pixels(metres_north), pixels(metres_east), 0.0f)
	{
	}
	int pixels(double metres) const { return static_cast<int>(std::ceil(metres / resolution)) + 1; }
	double north(int row) const { return ((height.rows - 1) / 2.0 - row) * resolution; }
	double east(int col) const { return (col - (height.cols - 1) / 2.0) * resolution; }
	int row(double north_m) const
	{
		return static_cast<int>(std::lround((height.rows - 1) / 2.0 - north_m / resolution));
	}
	int col(double east_m) const
	{
		return static_cast<int>(std::lround((height.cols - 1) / 2.0 + east_m / resolution));
	}
	/** Adds f(north, east) [m] everywhere. */
	template <class F>
	void add(F&& f)
	{
		for (int j = 0; j < height.rows; j++)
			for (int i = 0; i < height.cols; i++)
				height(j, i) += static_cast<float>(f(north(j), east(i)));
	}

	double resolution;
	cv::Mat1f height;
};

/** Smooth noise: white numbers `spacing` pixels apart, enlarged by a cubic spline. */
cv::Mat1f smoothNoise(cv::Size size, double spacing, uint64_t seed)
{
	const int margin = 3;
	cv::Mat1f white(
		static_cast<int>(size.height / spacing) + 2 * margin,
		static_cast<int>(size.width / spacing) + 2 * margin);
	for (int j = 0; j < white.rows; j++)
		for (int i = 0; i < white.cols; i++)
			white(j, i) = static_cast<float>(
				2 * unitInterval(mixed(seed, static_cast<uint64_t>(i), static_cast<uint64_t>(j))) - 1);
	cv::Mat1f large;
	cv::resize(white, large, {}, spacing, spacing, cv::INTER_CUBIC);
	const int inside = static_cast<int>(spacing);
	return large(cv::Rect({inside, inside}, size)).clone();
}

/** Hills of four octaves; half the width, half the height. */
cv::Mat1f hills(cv::Size size, double largest, uint64_t seed)
{
	cv::Mat1f sum(size, 0.0f);
	double spacing = std::max(largest / 2, 2.0), weight = 1;
	for (uint64_t octave = 0; octave < 4 && spacing >= 2; octave++, spacing /= 2, weight /= 2)
		sum += weight * smoothNoise(size, spacing, mixed(seed, octave));
	return sum;
}

void addSlope(TGrid& grid, const TReliefOptions& o)
{
	const double c = std::cos(o.slope_direction), s = std::sin(o.slope_direction);
	grid.add([&](double north, double east) { return o.slope * (c * north + s * east); });
}

/** Crests that wander a little: a sine whose phase is bent by smooth noise. */
void addRipples(TGrid& grid, const TReliefOptions& o, uint64_t seed)
{
	if (o.ripple_height == 0) return;
	const cv::Mat1f bend =
		smoothNoise(grid.height.size(), std::max(2.0, 4 * o.ripple_length / grid.resolution), seed);
	const double c = std::cos(o.ripple_direction), s = std::sin(o.ripple_direction);
	for (int j = 0; j < grid.height.rows; j++)
		for (int i = 0; i < grid.height.cols; i++) {
			const double across = c * grid.north(j) + s * grid.east(i);
			const double phase = 2 * M_PI * across / o.ripple_length + 1.5 * static_cast<double>(bend(j, i));
			grid.height(j, i) += static_cast<float>(o.ripple_height / 2 * std::sin(phase));
		}
}

/** A lumpy stone: an ellipse seen from above, 1 - rho^4 in height. */
struct TBoulder
{
	double north, east, radius, turn, aspect, lumps;  ///< [m], [m], [m], [rad], short / long axis, [rad]

	/** [m] over the floor that it lies on; 0 beside it. */
	double heightAt(double north_m, double east_m) const
	{
		const double x = std::cos(turn) * (north_m - north) + std::sin(turn) * (east_m - east);
		const double y = (std::cos(turn) * (east_m - east) - std::sin(turn) * (north_m - north)) / aspect;
		const double bulge = 1 + 0.12 * std::sin(3 * std::atan2(y, x) + lumps);
		const double rho2 = (x * x + y * y) / (radius * radius * bulge * bulge);
		return rho2 < 1 ? 0.7 * radius * aspect * (1 - rho2 * rho2) : 0;
	}
};

/** Adds a boulder where it is higher than those before it. */
void layBoulder(const TBoulder& b, const TGrid& grid, cv::Mat1f& boulders)
{
	const double reach = 1.2 * b.radius;
	const cv::Range rows(
		std::max(0, grid.row(b.north + reach)), std::min(boulders.rows, grid.row(b.north - reach) + 1));
	const cv::Range cols(
		std::max(0, grid.col(b.east - reach)), std::min(boulders.cols, grid.col(b.east + reach) + 1));
	for (int j = rows.start; j < rows.end; j++)
		for (int i = cols.start; i < cols.end; i++)
			boulders(j, i) =
				std::max(boulders(j, i), static_cast<float>(b.heightAt(grid.north(j), grid.east(i))));
}

void addBoulders(TGrid& grid, const TReliefOptions& o, uint64_t seed)
{
	const double metres_north = grid.height.rows * grid.resolution,
				 metres_east = grid.height.cols * grid.resolution;
	const auto count = std::lround(o.boulder_density * metres_north * metres_east);
	cv::Mat1f boulders(grid.height.size(), 0.0f);
	CNoise draw(seed);
	for (long i = 0; i < count; i++) {
		TBoulder b;
		b.north = draw.uniform(-metres_north / 2, metres_north / 2);
		b.east = draw.uniform(-metres_east / 2, metres_east / 2);
		b.radius = o.boulder_size / 2 * draw.uniform(0.6, 1.4);
		b.turn = draw.uniform(0, M_PI), b.aspect = draw.uniform(0.6, 1), b.lumps = draw.uniform(0, 2 * M_PI);
		layBoulder(b, grid, boulders);
	}
	grid.height += boulders;
}

struct TExtremes
{
	double low, high;  ///< [m]
	double range() const { return high - low; }
};
TExtremes extremesOf(const cv::Mat1f& height)
{
	TExtremes e{};
	cv::minMaxLoc(height, &e.low, &e.high);
	return e;
}

/** `base` plus as much of `hills` as makes the range 2 * `half`, shifted to +-`half`. */
cv::Mat1f filledWithHills(const cv::Mat1f& base, const cv::Mat1f& hills, double half)
{
	const double bare = extremesOf(base).range();
	if (bare > 2 * half + 1e-6)
		throw CError(
			"[Relief]",
			"slope, ripples and boulders alone are " + std::to_string(bare) + " m high, more than +-height",
			"make height larger, or slope, ripple_height or boulder_size smaller");
	double low = 0, high = 4 * half / extremesOf(hills).range();  // so much is certainly too much
	for (int i = 0; i < 40; i++) {
		const double middle = (low + high) / 2;
		(extremesOf(cv::Mat1f(base + middle * hills)).range() > 2 * half ? high : low) = middle;
	}
	const cv::Mat1f filled(base + low * hills);
	const TExtremes e = extremesOf(filled);
	return cv::Mat1f(filled - (e.low + e.high) / 2);
}

cv::Mat1f proceduralHeights(TGrid grid, const TReliefOptions& o, uint64_t seed)
{
	addSlope(grid, o);
	addRipples(grid, o, mixed(seed, 1));
	addBoulders(grid, o, mixed(seed, 2));
	return filledWithHills(
		grid.height, hills(grid.height.size(), o.hill_size / grid.resolution, mixed(seed, 3)), o.height);
}

cv::Mat1f readHeights(const TReliefOptions& o)
{
	requireFile(o.image, "set [Relief] image, or kind = procedural");
	const cv::Mat grey = cv::imread(o.image, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH);
	if (grey.empty()) throw CError(o.image, "is no picture that OpenCV can read", "give a PNG or JPEG");
	cv::Mat1f heights;
	grey.convertTo(heights, CV_32F);
	return heights;
}

/** Lays the picture onto the middle of `heights`; its border of `blend` [m] fades into them. */
void layPicture(const TReliefOptions& o, double blend, const TGrid& grid, cv::Mat1f& heights)
{
	cv::Mat1f picture;
	const cv::Mat1f raw = readHeights(o);
	const double scale = o.image_width / grid.resolution / raw.cols;
	cv::resize(raw, picture, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
	const TExtremes e = extremesOf(raw);
	picture = cv::min(cv::max(picture, e.low), e.high);	 // a cubic overshoots
	const double gain = e.range() > 0 ? 2 * o.height / e.range() : 0;
	const int top = (heights.rows - picture.rows) / 2, left = (heights.cols - picture.cols) / 2;
	for (int j = std::max(0, -top); j < std::min(picture.rows, heights.rows - top); j++)
		for (int i = std::max(0, -left); i < std::min(picture.cols, heights.cols - left); i++) {
			const int inside = std::min({i, j, picture.cols - 1 - i, picture.rows - 1 - j});
			const double x = std::min(1.0, (inside + 0.5) * grid.resolution / blend), w = x * x * (3 - 2 * x);
			const double here = gain * (static_cast<double>(picture(j, i)) - e.low) - o.height;
			float& out = heights(j + top, i + left);
			out = static_cast<float>(w * here + (1 - w) * static_cast<double>(out));
		}
}
}  // namespace

TDepthGrid makeRelief(const TReliefOptions& relief, const TFloorOptions& floor, uint64_t seed)
{
	const TGrid grid(floor.extent_north, floor.extent_east, relief.resolution);
	cv::Mat1f heights = proceduralHeights(grid, relief, seedOf(seed, "relief"));
	if (relief.kind == "image") layPicture(relief, floor.blend, grid, heights);
	return {cv::Mat1f(floor.depth - heights), relief.resolution};
}
}  // namespace posidonia
