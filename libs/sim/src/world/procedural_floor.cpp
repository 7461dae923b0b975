#include <posidonia/sim/floor.h>
#include <posidonia/sim/random.h>

#include <functional>
#include <opencv2/imgproc.hpp>

/* Noise by octaves, coarse to fine: each octave enlarges the sum so far by two (pyrUp, a cubic B-spline) and
 * adds white noise made of the hash of (seed, octave, row, column) - value noise with nothing that ever
 * repeats. Fixed point: 16 bits a pixel, kUnit to a grey level. */
namespace posidonia
{
namespace
{
constexpr double kUnit = 32;

/** Four bytes of hash to a number of mean 0 and standard deviation 2 * 73.9, nearly Gaussian. */
int bellShaped(uint64_t bits)
{
	return static_cast<int>((bits & 255) + (bits >> 8 & 255) + (bits >> 16 & 255) + (bits >> 24 & 255)) - 510;
}

/** Adds white noise of standard deviation `sigma` [grey levels]. */
void addWhite(cv::Mat& image, double sigma, uint64_t seed)
{
	const double bell_sigma = 2 * std::sqrt((256.0 * 256.0 - 1) / 12);
	const int factor = static_cast<int>(std::lround(sigma * kUnit / bell_sigma * 4096));
	for (int y = 0; y < image.rows; y++) {
		int16_t* row = image.ptr<int16_t>(y);
		const uint64_t row_seed = mixed(seed, static_cast<uint64_t>(y));
		uint64_t hash = 0;
		for (int x = 0; x < image.cols; x++) {
			hash = x % 2 == 0 ? mixed(row_seed + static_cast<uint64_t>(x)) : hash >> 32;
			row[x] = cv::saturate_cast<int16_t>(row[x] + (bellShaped(hash) * factor >> 12));
		}
	}
}

/** Sum of octaves of zero mean; sigmas[n] is that of the white noise whose pixels are 2^n wide. CV_16SC1. */
cv::Mat octaves(cv::Size size, const std::vector<double>& sigmas, uint64_t seed)
{
	std::vector<cv::Size> sizes{size};
	while (sizes.size() < sigmas.size())
		sizes.push_back((sizes.back() + cv::Size(1, 1)) / 2);
	cv::Mat sum = cv::Mat::zeros(sizes.back(), CV_16S);
	for (size_t n = sigmas.size(); n-- > 0;) {
		if (sum.size() != sizes[n]) {
			cv::Mat larger;
			cv::pyrUp(sum, larger, sum.size() * 2);
			sum = larger(cv::Rect({0, 0}, sizes[n])).clone();
		}
		if (sigmas[n] > 0) addWhite(sum, sigmas[n], mixed(seed, n));
	}
	return sum;
}

/** Standard deviation [grey levels] of each octave of a picture: what its halved copy can't show. */
std::vector<double> bandSigmas(const cv::Mat& picture, size_t n_octaves)
{
	std::vector<double> sigmas;
	cv::Mat level, coarser, back, mean, sigma;
	picture.convertTo(level, CV_16S, kUnit);
	while (sigmas.size() < n_octaves && std::min(level.cols, level.rows) >= 8) {
		cv::pyrDown(level, coarser);
		cv::pyrUp(coarser, back, level.size());
		cv::meanStdDev(level - back, mean, sigma);
		sigmas.push_back(sigma.at<double>(0) / kUnit);
		level = coarser;
	}
	return sigmas;
}

/** Stones about a jittered grid of unit cells (Worley 1996), one centre a cell. */
class CStoneField
{
   public:
	/** Cells 0 to columns - 1, 0 to rows - 1, and some around them. */
	CStoneField(int columns, int rows, uint64_t seed)
		: m_columns(columns + 2 * kMargin), m_rows(rows + 2 * kMargin)
	{
		for (int j = 0; j < m_rows; j++)
			for (int i = 0; i < m_columns; i++) {
				const uint64_t h = mixed(seed, static_cast<uint64_t>(i), static_cast<uint64_t>(j));
				m_centres.push_back(
					{static_cast<float>(i + unitInterval(h)), static_cast<float>(j + unitInterval(mixed(h))),
					 static_cast<float>(2 * unitInterval(mixed(h, 1)) - 1)});
			}
	}
	/** Shade, -1 to 1, of the stone at (x, y), and how far the crack towards the next one is, in cells. */
	struct TPoint
	{
		float shade, crack;
	};
	TPoint at(float x, float y) const
	{
		x = std::min(std::max(x + kMargin, 1.0f), static_cast<float>(m_columns) - 1.5f);
		y = std::min(std::max(y + kMargin, 1.0f), static_cast<float>(m_rows) - 1.5f);
		float nearest = 1e9f, second = 1e9f, shade = 0;
		const TCentre* row =
			&m_centres[static_cast<size_t>((static_cast<int>(y) - 1) * m_columns + static_cast<int>(x) - 1)];
		for (int j = 0; j < 3; j++, row += m_columns)
			for (int i = 0; i < 3; i++) {
				const float dx = row[i].x - x, dy = row[i].y - y, d = dx * dx + dy * dy;
				second = std::min(second, std::max(nearest, d));
				shade = d < nearest ? row[i].shade : shade;
				nearest = std::min(nearest, d);
			}
		return {shade, std::sqrt(second) - std::sqrt(nearest)};
	}

   private:
	struct TCentre
	{
		float x, y, shade;
	};
	static constexpr int kMargin = 4;
	int m_columns, m_rows;
	std::vector<TCentre> m_centres;
};

/** Where stones bend: two independent fields, CV_16SC1. */
struct TBend
{
	cv::Mat x, y;
};

/** Stones of `width` pixels with crooked edges. */
struct TStones
{
	double width, shade, crack;	 ///< [px], contrast between stones and darkness of the cracks [grey levels]
};
void addStones(cv::Mat& image, const TBend& bend, const TStones& stones, uint64_t seed)
{
	const float cell = static_cast<float>(1 / stones.width),
				bent = static_cast<float>(0.3 / kUnit / stones.width);
	const CStoneField field(
		static_cast<int>(image.cols / stones.width) + 1, static_cast<int>(image.rows / stones.width) + 1,
		seed);
	const float shade = static_cast<float>(kUnit * stones.shade),
				depth = static_cast<float>(kUnit * stones.crack);
	for (int y = 0; y < image.rows; y++)
		for (int x = 0; x < image.cols; x++) {
			const auto s = field.at(
				static_cast<float>(x) * cell + bent * bend.x.at<int16_t>(y, x),
				static_cast<float>(y) * cell + bent * bend.y.at<int16_t>(y, x));
			const float crack = std::max(0.0f, 1 - 6 * s.crack);
			int16_t& out = image.at<int16_t>(y, x);
			out =
				cv::saturate_cast<int16_t>(static_cast<float>(out) + shade * s.shade - depth * crack * crack);
		}
}

/** Adds a Gaussian dot; `height` in units of the image. */
void addDot(cv::Mat& image, const cv::Point2d& centre, double radius, double height)
{
	const cv::Point2d reach(3 * radius, 3 * radius);
	const cv::Rect seen = cv::Rect(centre - reach, centre + reach) & cv::Rect({0, 0}, image.size());
	for (int y = seen.y; y < seen.br().y; y++)
		for (int x = seen.x; x < seen.br().x; x++) {
			const cv::Point2d off = (cv::Point2d(x, y) - centre) / radius;
			int16_t& out = image.at<int16_t>(y, x);
			out = cv::saturate_cast<int16_t>(out + height * std::exp(-off.ddot(off)));
		}
}

/** Bright and dark dots, one in each cell of a grid. */
struct TDots
{
	double spacing, radius, contrast;  ///< [px], mean [px], largest [grey levels]
};
void addDots(cv::Mat& image, const TDots& dots, uint64_t seed)
{
	for (int j = 0; j * dots.spacing < image.rows; j++)
		for (int i = 0; i * dots.spacing < image.cols; i++) {
			const uint64_t h = mixed(seed, static_cast<uint64_t>(i), static_cast<uint64_t>(j));
			const cv::Point2d centre(i + unitInterval(h), j + unitInterval(mixed(h)));
			addDot(
				image, centre * dots.spacing, dots.radius * (0.5 + unitInterval(mixed(h, 1))),
				kUnit * dots.contrast * (2 * unitInterval(mixed(h, 2)) - 1));
		}
}

/** Sigmas of octaves given by the width of their grains [m]; octaves finer than a pixel are left out. */
std::vector<double> sigmasByGrain(
	double resolution, double largest, const std::function<double(double)>& sigma)
{
	std::vector<double> sigmas;
	for (double grain = resolution; grain <= largest; grain *= 2)
		sigmas.push_back(sigma(grain));
	return sigmas;
}

cv::Mat toGrey(const cv::Mat& image, double mean)
{
	cv::Mat grey;
	image.convertTo(grey, CV_8U, 1 / kUnit, mean);
	return grey;
}
}  // namespace

cv::Mat proceduralLike(const cv::Mat& sample, cv::Size size, uint64_t seed)
{
	// White noise passes its own octave's band with about 0.9 of its power; the coarser bands get the rest.
	std::vector<double> sigmas = bandSigmas(sample, 9);
	cv::Mat sum = octaves(size, sigmas, seed), mean, sigma, sample_mean, sample_sigma;
	cv::meanStdDev(sum, mean, sigma);
	cv::meanStdDev(sample, sample_mean, sample_sigma);
	const double gain = sigma.at<double>(0) > 0 ? sample_sigma.at<double>(0) / sigma.at<double>(0) : 0;
	cv::Mat grey;
	sum.convertTo(grey, CV_8U, gain, sample_mean.at<double>(0) - gain * mean.at<double>(0));
	return grey;
}

cv::Mat proceduralSand(cv::Size size, double resolution, uint64_t seed)
{
	// Fine grain and faint patches; the few features are dots of shell and gravel.
	const auto sigma = [](double grain) { return grain < 0.015 ? 4.0 : grain < 0.1 ? 6.0 : 3.0; };
	cv::Mat sand = octaves(size, sigmasByGrain(resolution, 3.0, sigma), mixed(seed, 1));
	addDots(sand, {0.17 / resolution, 0.014 / resolution, 85}, mixed(seed, 2));
	return toGrey(sand, 128);
}

cv::Mat proceduralRock(cv::Size size, double resolution, uint64_t seed)
{
	// Stones at half the resolution (a crack is wider than that), fine grain on top at full resolution.
	const cv::Size half((size.width + 1) / 2, (size.height + 1) / 2);
	const double pixel = 2 * resolution;
	const auto grain = sigmasByGrain(pixel, 2.0, [](double g) { return g < 0.03 ? 5.0 : 8.0; });
	const auto smooth = sigmasByGrain(pixel, 0.7, [](double g) { return g < 0.06 ? 0.0 : 40.0; });
	cv::Mat stones = octaves(half, grain, mixed(seed, 1));
	const TBend bend{octaves(half, smooth, mixed(seed, 5)), octaves(half, smooth, mixed(seed, 6))};
	addStones(stones, bend, {0.6 / pixel, 40, 70}, mixed(seed, 2));
	addStones(stones, bend, {0.17 / pixel, 22, 45}, mixed(seed, 3));
	cv::Mat full;
	cv::pyrUp(stones, full, half * 2);
	full = full(cv::Rect({0, 0}, size)).clone();
	addWhite(full, 7, mixed(seed, 4));
	return toGrey(full, 128);
}
}  // namespace posidonia
