#include <posidonia/sim/floor.h>
#include <posidonia/sim/random.h>

#include <functional>
#include <opencv2/imgproc.hpp>

/* Noise by octaves, coarse to fine: each octave enlarges the sum so far by two (pyrUp, a cubic B-spline) and adds
 * white noise made of the hash of (seed, octave, row, column) - value noise with nothing that ever repeats. Fixed
 * point: 16 bits a pixel, kUnit to a grey level. */
namespace posidonia
{
namespace
{
constexpr double kUnit = 32;

/** White noise of standard deviation `sigma` [grey levels]: sums of four hashed bytes, nearly Gaussian. */
void addWhite(cv::Mat& image, double sigma, uint64_t seed)
{
	const double byte_sigma = std::sqrt((256.0 * 256.0 - 1) / 12);
	const int factor = static_cast<int>(std::lround(sigma * kUnit / (2 * byte_sigma) * 4096));
	cv::parallel_for_(cv::Range(0, image.rows), [&](const cv::Range& rows) {
		for (int y = rows.start; y < rows.end; y++)
		{
			int16_t* row = image.ptr<int16_t>(y);
			const uint64_t row_seed = mixed(seed, static_cast<uint64_t>(y));
			for (int x = 0; x < image.cols; x += 2)
			{
				const uint64_t h = mixed(row_seed + static_cast<uint64_t>(x));
				const auto sum = [](uint64_t bits) {
					return static_cast<int>(
						(bits & 255) + (bits >> 8 & 255) + (bits >> 16 & 255) + (bits >> 24 & 255)) - 510;
				};
				row[x] = cv::saturate_cast<int16_t>(row[x] + (sum(h) * factor >> 12));
				if (x + 1 < image.cols) row[x + 1] = cv::saturate_cast<int16_t>(row[x + 1] + (sum(h >> 32) * factor >> 12));
			}
		}
	});
}

/** Sum of octaves of zero mean; sigmas[n] is that of the white noise whose pixels are 2^n wide. CV_16SC1. */
cv::Mat octaves(cv::Size size, const std::vector<double>& sigmas, uint64_t seed)
{
	std::vector<cv::Size> sizes{size};
	while (sizes.size() < sigmas.size()) sizes.push_back((sizes.back() + cv::Size(1, 1)) / 2);
	cv::Mat sum = cv::Mat::zeros(sizes.back(), CV_16S);
	for (size_t n = sigmas.size(); n-- > 0;)
	{
		if (sum.size() != sizes[n])
		{
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
	while (sigmas.size() < n_octaves && std::min(level.cols, level.rows) >= 8)
	{
		cv::pyrDown(level, coarser);
		cv::pyrUp(coarser, back, level.size());
		cv::meanStdDev(level - back, mean, sigma);
		sigmas.push_back(sigma.at<double>(0) / kUnit);
		level = coarser;
	}
	return sigmas;
}

/** Seconds-nearest distances of a jittered grid of stones (Worley 1996): shade of the nearest stone and how far the
 * point is from the crack between the nearest two, 0 to 1. */
struct TStone
{
	double shade, crack;
};
TStone stoneAt(double x, double y, uint64_t seed)
{
	const int64_t cx = static_cast<int64_t>(std::floor(x)), cy = static_cast<int64_t>(std::floor(y));
	double nearest = 1e9, second = 1e9;
	uint64_t nearest_hash = 0;
	for (int64_t j = cy - 1; j <= cy + 1; j++)
		for (int64_t i = cx - 1; i <= cx + 1; i++)
		{
			const uint64_t h = mixed(seed + static_cast<uint64_t>(i) * 0x9E3779B1ull + static_cast<uint64_t>(j) * 0x85EBCA77C2B2AE63ull);
			const double dx = static_cast<double>(i) + static_cast<double>(h & 0xFFFF) / 65536 - x;
			const double dy = static_cast<double>(j) + static_cast<double>(h >> 16 & 0xFFFF) / 65536 - y;
			const double d = dx * dx + dy * dy;
			if (d < nearest) second = nearest, nearest = d, nearest_hash = h;
			else if (d < second) second = d;
		}
	return {static_cast<double>(nearest_hash >> 32 & 0xFFFF) / 32768 - 1, std::sqrt(second) - std::sqrt(nearest)};
}

/** Adds stones of `size_px` pixels, shades of +-`shade` and dark cracks of `depth` grey levels. */
void addStones(cv::Mat& image, const cv::Mat& warp, double size_px, double shade, double depth, uint64_t seed)
{
	cv::parallel_for_(cv::Range(0, image.rows), [&](const cv::Range& rows) {
		for (int y = rows.start; y < rows.end; y++)
			for (int x = 0; x < image.cols; x++)
			{
				const double bend = warp.at<int16_t>(y, x) / kUnit * 0.008;	 // crooked edges
				const TStone s = stoneAt(x / size_px + bend, y / size_px - bend, seed);
				const double crack = std::max(0.0, 1 - s.crack * 5);
				image.at<int16_t>(y, x) = cv::saturate_cast<int16_t>(
					image.at<int16_t>(y, x) + kUnit * (shade * s.shade - depth * crack * crack));
			}
	});
}

/** Sigmas of octaves given by the width of their grains [m]; octaves finer than a pixel are left out. */
std::vector<double> sigmasByGrain(double resolution, double largest, const std::function<double(double)>& sigma)
{
	std::vector<double> sigmas;
	for (double grain = resolution; grain <= largest; grain *= 2) sigmas.push_back(sigma(grain));
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
	// Fine grain, faint patches; the octaves of 2 to 8 cm carry the few features there are.
	const auto sigma = [](double grain) { return grain < 0.015 ? 3.5 : grain < 0.1 ? 5.0 : 3.0; };
	return toGrey(octaves(size, sigmasByGrain(resolution, 3.0, sigma), seed), 128);
}

cv::Mat proceduralRock(cv::Size size, double resolution, uint64_t seed)
{
	// Stones at half the resolution (a crack is wider than that), fine grain on top at full resolution.
	const cv::Size half((size.width + 1) / 2, (size.height + 1) / 2);
	const auto coarse = [](double grain) { return grain < 0.03 ? 5.0 : 7.0; };
	cv::Mat stones = octaves(half, sigmasByGrain(2 * resolution, 2.0, coarse), mixed(seed, 1));
	const cv::Mat warp = stones.clone();
	addStones(stones, warp, 0.55 / (2 * resolution), 30, 55, mixed(seed, 2));
	addStones(stones, warp, 0.14 / (2 * resolution), 16, 28, mixed(seed, 3));
	cv::Mat full;
	cv::pyrUp(stones, full, half * 2);
	full = full(cv::Rect({0, 0}, size)).clone();
	addWhite(full, 7, mixed(seed, 4));
	return toGrey(full, 128);
}
}  // namespace posidonia
