#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/sim/floor.h>
#include <posidonia/sim/random.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace posidonia
{
namespace
{
constexpr int kLevels = 6;					   ///< 5 mm to 16 cm a pixel
constexpr int kMultiple = 1 << (kLevels - 1);  ///< Pixels of level 0 to one of the last

cv::Mat readGrey(const std::string& path)
{
	requireFile(path, "set [Floor] image, or texture = sand or rock");
	cv::Mat grey = cv::imread(path, cv::IMREAD_GRAYSCALE);
	if (grey.empty()) throw CError(path, "is no picture that OpenCV can read", "give a JPEG or PNG");
	return grey;
}

/** The picture resampled so that its width covers `metres` at `resolution`. */
cv::Mat scaledToMetres(const cv::Mat& picture, double metres, double resolution)
{
	const double scale = metres / resolution / picture.cols;
	cv::Mat scaled;
	cv::resize(picture, scaled, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
	return scaled;
}

/** Weight of the picture: 0 at its border, 1 from `blend` pixels inside on. */
std::vector<float> borderRamp(int length, double blend)
{
	std::vector<float> ramp(static_cast<size_t>(length));
	for (int i = 0; i < length; i++) {
		const double x = std::min(1.0, (std::min(i, length - 1 - i) + 0.5) / blend);
		ramp[static_cast<size_t>(i)] = static_cast<float>(x * x * (3 - 2 * x));
	}
	return ramp;
}

/** Lays `picture` onto the middle of `floor`; the border fades so that the contrast (not only the mean) goes
 * on. */
void layInMiddle(const cv::Mat& picture, double blend, cv::Mat& floor)
{
	const cv::Rect whole({0, 0}, floor.size());
	const cv::Rect place({(floor.cols - picture.cols) / 2, (floor.rows - picture.rows) / 2}, picture.size());
	const cv::Rect seen = place & whole;
	const auto ramp_x = borderRamp(picture.cols, blend), ramp_y = borderRamp(picture.rows, blend);
	const float mean = static_cast<float>(cv::mean(picture)[0]);
	for (int y = seen.y; y < seen.br().y; y++) {
		uint8_t* out = floor.ptr<uint8_t>(y);
		const uint8_t* in = picture.ptr<uint8_t>(y - place.y);
		const float wy = ramp_y[static_cast<size_t>(y - place.y)];
		for (int x = seen.x; x < seen.br().x; x++) {
			const float w = wy * ramp_x[static_cast<size_t>(x - place.x)];
			if (w >= 1) {
				out[x] = in[x - place.x];
				continue;
			}
			const float p = static_cast<float>(in[x - place.x]) - mean, q = static_cast<float>(out[x]) - mean;
			const float blended = (w * p + (1 - w) * q) / std::sqrt(w * w + (1 - w) * (1 - w));
			out[x] = cv::saturate_cast<uint8_t>(mean + blended);
		}
	}
}

cv::Mat photoFloor(const TFloorOptions& o, cv::Size size, uint64_t seed)
{
	const cv::Mat picture = scaledToMetres(readGrey(o.image), o.image_width, o.resolution);
	cv::Mat floor = proceduralLike(picture, size, seed);
	layInMiddle(picture, o.blend / o.resolution, floor);
	return floor;
}

cv::Mat tiledFloor(const TFloorOptions& o, cv::Size size)
{
	const cv::Mat tile = scaledToMetres(readGrey(o.image), o.image_width, o.resolution);
	cv::Mat floor;
	cv::repeat(tile, size.height / tile.rows + 1, size.width / tile.cols + 1, floor);
	return floor(cv::Rect({0, 0}, size)).clone();
}

/** Mean and contrast as the options say: the mean of a picture stays. */
void adjust(const TFloorOptions& o, cv::Mat& floor)
{
	const bool from_picture = o.texture == "photo" || o.texture == "tiled";
	const double mean = cv::mean(floor)[0], wanted = from_picture ? mean : o.brightness;
	floor.convertTo(floor, CV_8U, o.contrast, wanted - o.contrast * mean);
}

cv::Mat floorOf(const TFloorOptions& o, uint64_t seed)
{
	// Rounded up to what the coarsest level needs.
	const auto pixels = [&](double metres) {
		return static_cast<int>(std::ceil(metres / o.resolution / kMultiple)) * kMultiple;
	};
	const cv::Size size(pixels(o.extent_east), pixels(o.extent_north));
	const uint64_t own = seedOf(seed, "floor");
	cv::Mat floor = o.texture == "photo"   ? photoFloor(o, size, own)
					: o.texture == "tiled" ? tiledFloor(o, size)
					: o.texture == "rock"  ? proceduralRock(size, o.resolution, own)
										   : proceduralSand(size, o.resolution, own);
	adjust(o, floor);
	return floor;
}
}  // namespace

CFloorTexture::CFloorTexture(const TFloorOptions& options, uint64_t seed) : m_resolution(options.resolution)
{
	build(floorOf(options, seed));
}

CFloorTexture::CFloorTexture(const cv::Mat& level0, double resolution) : m_resolution(resolution)
{
	build(level0);
}

void CFloorTexture::build(const cv::Mat& level0)
{
	const cv::Size size(level0.cols / kMultiple * kMultiple, level0.rows / kMultiple * kMultiple);
	if (size.area() == 0)
		throw CError("[Floor]", "the texture is smaller than 32 pixels", "enlarge its extent");
	const cv::Point corner((level0.cols - size.width) / 2, (level0.rows - size.height) / 2);
	m_levels = {level0(cv::Rect(corner, size)).clone()};
	while (m_levels.size() < kLevels) {
		cv::Mat half;  // exactly 2 x 2 pixels to one
		cv::resize(m_levels.back(), half, m_levels.back().size() / 2, 0, 0, cv::INTER_AREA);
		m_levels.push_back(half);
	}
}

Eigen::Vector2d CFloorTexture::pixelAt(const Eigen::Vector2d& north_east) const
{
	const cv::Mat& level = m_levels.front();
	return {
		(level.cols - 1) / 2.0 + north_east.y() / m_resolution,
		(level.rows - 1) / 2.0 - north_east.x() / m_resolution};
}
}  // namespace posidonia
