#include <posidonia/vision/patch_alignment.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace posidonia
{
namespace
{
/** Smoothing before the alignment [px]. Images hold some texture above their sampling limit, which comes back
 * as aliases that pull every disparity to the whole pixel; on a flat floor all points share one fraction, so
 * that does not average out: 0.8 px of smoothing left 0.02 px of it, 1.5 px leaves 0.006. */
constexpr double SMOOTHING = 1.5;
constexpr int MAX_ITERATIONS = 12;
constexpr double CONVERGED = 1e-3;	// [px]

/** White noise smoothed by a Gaussian is correlated over 4 pi s^2 pixels: a sum over n of them holds n over
 * this many independent ones. An upper bound for the alignment, whose weights vary over the patch. */
constexpr double CORRELATED_PIXELS = 4 * M_PI * SMOOTHING * SMOOTHING;

cv::Mat smoothed(const cv::Mat& image)
{
	cv::Mat f;
	image.convertTo(f, CV_32F);
	cv::GaussianBlur(f, f, cv::Size(9, 9), SMOOTHING);
	return f;
}

/** Slope along the row, fourth order. */
cv::Mat slope(const cv::Mat& image)
{
	const cv::Mat kernel = (cv::Mat_<float>(1, 5) << 1, -8, 0, 8, -1) / 12;
	cv::Mat out;
	cv::filter2D(image, out, CV_32F, kernel);
	return out;
}

/** Lagrange's weights of the samples at -1, 0, 1, 2 for the place t in [0, 1): exact for cubics. (Catmull-Rom
 * is not: its error t (1 - t) (1 - 2 t) f''' / 6 is one of phase, 0.003 px at t = 0.15 and 1.5 px of
 * smoothing.) */
struct TCubic
{
	float w[4];
	explicit TCubic(double t)
	{
		w[0] = static_cast<float>(-t * (t - 1) * (t - 2) / 6);
		w[1] = static_cast<float>((t + 1) * (t - 1) * (t - 2) / 2);
		w[2] = static_cast<float>(-(t + 1) * t * (t - 2) / 2);
		w[3] = static_cast<float>((t + 1) * t * (t - 1) / 6);
	}
};
}  // namespace

/** Centred second moments of left L, right R and the left's slope G. */
struct CPatchAligner::TNormalEquations
{
	double n{0}, l{0}, r{0}, g{0}, ll{0}, rr{0}, gg{0}, lr{0}, lg{0}, rg{0};

	void addRow(const float* left, const float* gradient, const float* right, int count, const TCubic& c)
	{
		const float w0 = c.w[0], w1 = c.w[1], w2 = c.w[2], w3 = c.w[3];
		float L1 = 0, R1 = 0, G1 = 0, LL = 0, RR = 0, GG = 0, LR = 0, LG = 0, RG = 0;
#pragma omp simd reduction(+ : L1, R1, G1, LL, RR, GG, LR, LG, RG)
		for (int i = 0; i < count; i++) {
			const float L = left[i], G = gradient[i];
			const float R = w0 * right[i - 1] + w1 * right[i] + w2 * right[i + 1] + w3 * right[i + 2];
			L1 += L, R1 += R, G1 += G;
			LL += L * L, RR += R * R, GG += G * G;
			LR += L * R, LG += L * G, RG += R * G;
		}
		n += count, l += L1, r += R1, g += G1;
		ll += LL, rr += RR, gg += GG, lr += LR, lg += LG, rg += RG;
	}
	void centre()
	{
		ll -= l * l / n, rr -= r * r / n, gg -= g * g / n;
		lr -= l * r / n, lg -= l * g / n, rg -= r * g / n;
	}
};

CPatchAligner::CPatchAligner(const cv::Mat& left, const cv::Mat& right)
	: m_left(smoothed(left)), m_left_slope(slope(m_left)), m_right(smoothed(right))
{
}

bool CPatchAligner::linearise(int x, int y, double disparity, int radius, TNormalEquations& n) const
{
	const double u = x - disparity;
	const int whole = static_cast<int>(std::floor(u));
	const bool inside = x >= radius && x + radius < m_left.cols && y >= radius && y + radius < m_left.rows &&
						whole >= radius + 1 && whole + radius + 2 < m_right.cols;
	if (!inside) return false;
	const TCubic cubic(u - whole);
	for (int j = y - radius; j <= y + radius; j++)
		n.addRow(
			m_left.ptr<float>(j) + x - radius, m_left_slope.ptr<float>(j) + x - radius,
			m_right.ptr<float>(j) + whole - radius, 2 * radius + 1, cubic);
	n.centre();
	return true;
}

std::optional<TPatchAlignment> CPatchAligner::align(
	double u, double v, double start, int radius, double reach) const
{
	// The left patch sits on whole pixels, so only the right one is interpolated; the disparity of a smooth
	// floor is the same half a pixel aside.
	const int x = static_cast<int>(std::lround(u)), y = static_cast<int>(std::lround(v));
	double d = start;
	for (int i = 0; i < MAX_ITERATIONS; i++) {
		TNormalEquations e;
		if (!linearise(x, y, d, radius, e)) return {};
		// L - mean = gain (R - mean) - step (G - mean). The slope is the left image's, which no interpolation
		// touches: the right one's noise would not cancel against its own slope, and pull every disparity of
		// a flat floor the same way.
		const double det = e.rr * e.gg - e.rg * e.rg;
		if (!(det > 1e-9 * e.rr * e.gg) || !(e.ll > 0)) return {};
		const double gain = (e.lr * e.gg - e.lg * e.rg) / det;
		const double step = std::clamp((e.lr * e.rg - e.lg * e.rr) / det, -1.0, 1.0);
		if (!(gain > 0)) return {};
		d += step;
		if (std::abs(d - start) > reach) return {};
		if (std::abs(step) > CONVERGED) continue;
		const double residual = std::max(0.0, e.ll - gain * e.lr + step * e.lg);
		const double gradient = e.gg - e.rg * e.rg / e.rr;
		const double sigma = std::sqrt(residual / (e.n - 3) * CORRELATED_PIXELS / gradient);
		return TPatchAlignment{d, sigma, e.lr / std::sqrt(e.ll * e.rr), std::sqrt(e.ll / e.rr)};
	}
	return {};
}
}  // namespace posidonia
