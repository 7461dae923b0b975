// Times and errors of key frames and registrations on rendered scenes: bench_vision [SIFT|ORB|AKAZE] [pairs]
// [key=value ...].
#include "floor_renderer.h"

#include <posidonia/geometry/se3.h>
#include <posidonia/vision/key_frame_extractor.h>
#include <posidonia/vision/stereo_registration.h>
#include <posidonia/vision/two_view_refinement.h>

#include <posidonia/base/ini_file.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>

using namespace posidonia;
using posidonia::testing::CFloorRenderer;

namespace
{
/** Processor time of the whole process [ms], deaf to what else the machine does. */
double cpuMilliseconds()
{
	return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct TSample
{
	std::vector<double> values;
	void add(double x) { values.push_back(x); }
	double quantile(double q)
	{
		if (values.empty()) return NAN;
		std::sort(values.begin(), values.end());
		return values[std::min(
			values.size() - 1, static_cast<size_t>(q * static_cast<double>(values.size())))];
	}
	double mean() const
	{
		double s = 0;
		for (double x : values)
			s += x;
		return s / static_cast<double>(values.size());
	}
	/** Standard deviation from the quartiles, deaf to tails. */
	double robustSigma() { return (quantile(0.75) - quantile(0.25)) / 1.349; }
	double rms() const
	{
		double s = 0;
		for (double x : values)
			s += x * x;
		return std::sqrt(s / static_cast<double>(values.size()));
	}
};

struct TKind
{
	const char* name;
	double step, across, yaw_deg, altitude_ratio, tilt_deg;
};
const TKind KINDS[] = {{"neighbour 0.5 m", 0.5, 0, 0, 1, 2},	{"neighbour 1.0 m", 1.0, 0, 5, 1, 2},
					   {"across 90 deg", 0.4, 0.4, 90, 1, 2},	{"across 180 deg", 0.4, 0.4, 180, 1, 2},
					   {"yaw 45 deg", 0.3, 0.3, 45, 1, 2},		{"altitude x1.25", 0.3, 0.2, 20, 1.25, 3},
					   {"altitude x0.8", 0.3, 0.2, 20, 0.8, 3}, {"tilt 8 deg", 0.3, 0.2, 30, 1, 8}};

struct TResult
{
	TSample mm, mrad, chi2, matches, inliers, align_ms, rmse, pointchi2;
	TSample component[6], effect[3];
	int accepted{0}, wrong{0}, pairs{0};
	std::map<std::string, int> refused;
};

struct TBench
{
	int pairs{10}, first_kind{0}, last_kind{7};
	bool procedural{true}, reef{true};
	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.integer("pairs", pairs, atLeast(1), "Pairs of a kind");
		v.integer("first_kind", first_kind, between(0, 7), "First kind of pair");
		v.integer("last_kind", last_kind, between(0, 7), "Last kind of pair");
		v.flag("procedural", procedural, "Over procedural noise");
		v.flag("reef", reef, "Over the photograph");
	}
};

/** Noise by octave against the known floor. */
struct TNoise
{
	std::map<int, TSample> locking, disparity_px, disparity_sigmas, place_px, place_sigmas, shift_u, shift_v;
};

int octaveOf(const TStereoPoint& p)
{
	return static_cast<int>(std::lround(p.octave));
}

/** Where the ray through a point's pixel meets the floor. */
Eigen::Vector2d floorPoint(const TStereoCamera& c, const Eigen::Isometry3d& T, const TStereoPoint& p)
{
	const Eigen::Vector3d ray =
		T.linear() * Eigen::Vector3d((p.uvr.x() - c.cx) / c.fx, (p.uvr.y() - c.cy) / c.fy, 1);
	return (T.translation() - ray * (T.translation().z() / ray.z())).head<2>();
}
double trueDisparity(const TStereoCamera& c, const Eigen::Isometry3d& T, const TStereoPoint& p)
{
	const Eigen::Vector3d ray((p.uvr.x() - c.cx) / c.fx, (p.uvr.y() - c.cy) / c.fy, 1);
	const double depth = -T.translation().z() / (T.linear() * ray).z();
	return c.fx * c.baseline / depth;
}

void run(
	const cv::Mat& texture, double metres_per_pixel, const TFeatureOptions& fo,
	const TRegistrationOptions& ro, const TBench& bench)
{
	const TStereoCamera camera;
	const CFloorRenderer renderer(texture, metres_per_pixel, camera);
	const CKeyFrameExtractor extractor(fo, camera);
	const CStereoRegistration registration(ro, camera);
	std::mt19937 rng(7);
	unsigned noise_seed = 1;
	const double reach_x = 0.5 * texture.cols * metres_per_pixel - 5,
				 reach_y = 0.5 * texture.rows * metres_per_pixel - 5;
	std::uniform_real_distribution<double> unit(-1, 1);
	TSample extract_ms, points;
	TNoise noise;
	TSample all_chi2;
	for (int k = bench.first_kind; k <= bench.last_kind; k++) {
		const TKind& kind = KINDS[k];
		TResult result;
		for (int i = 0; i < bench.pairs; i++) {
			const double x = reach_x * unit(rng), y = reach_y * unit(rng), yaw = M_PI * unit(rng),
						 deg = M_PI / 180;
			const auto tilt = [&] { return kind.tilt_deg * deg * unit(rng); };
			const double altitude = 2.5 * (1 + 0.05 * unit(rng));
			const double t0 = tilt(), t1 = tilt(), t2 = tilt(), t3 = tilt();
			const auto T_w_a = CFloorRenderer::pose(x, y, altitude, yaw, t0, t1);
			const auto T_w_b = CFloorRenderer::pose(
				x - kind.step * std::sin(-yaw) + kind.across * std::cos(yaw),
				y + kind.step * std::cos(yaw) + kind.across * std::sin(yaw), altitude * kind.altitude_ratio,
				yaw + kind.yaw_deg * deg, t2, t3);
			const auto image_a = renderer.render(T_w_a, 3, noise_seed++),
					   image_b = renderer.render(T_w_b, 3, noise_seed++);
			double start = cpuMilliseconds();
			const TKeyFrame a = extractor.extract(image_a.left, image_a.right);
			extract_ms.add(cpuMilliseconds() - start);
			const TKeyFrame b = extractor.extract(image_b.left, image_b.right);
			points.add(static_cast<double>(a.size()));
			start = cpuMilliseconds();
			const TRegistration r = registration.align(a, b, i);
			result.align_ms.add(cpuMilliseconds() - start);
			const Eigen::Isometry3d truth = T_w_a.inverse() * T_w_b;
			const Vector6d e = localCoordinates(r.T_a_b, truth);
			result.pairs++;
			for (const auto& p : a.points) {
				const double d = p.uvd().z() - trueDisparity(camera, T_w_a, p);
				noise.disparity_px[octaveOf(p)].add(d);
				noise.disparity_sigmas[octaveOf(p)].add(d / p.sigma_d);
			}
			if (!r.accepted()) {
				result.refused[toString(r.status)]++;
				continue;
			}
			result.accepted++;
			if (e.head<3>().norm() > 0.3 || e.tail<3>().norm() > 5 * deg) result.wrong++;
			result.mm.add(1e3 * e.head<3>().norm());
			result.mrad.add(1e3 * e.tail<3>().norm());
			result.chi2.add(e.dot(r.information * e) / 6);
			all_chi2.add(e.dot(r.information * e) / 6);
			const Matrix6d covariance = r.information.inverse();
			for (int k = 0; k < 6; k++)
				result.component[k].add(e[k] / std::sqrt(covariance(k, k)));
			result.matches.add(r.matches);
			result.inliers.add(r.inliers);
			result.rmse.add(r.rmse_px);
			result.pointchi2.add(r.chi2 / r.dof());
			// Noise of all right matches, also of those the robust loss left out.
			TSample in_u, in_v, in_d;
			for (const auto& p : a.points) {
				const double x = (p.uvd().z() - trueDisparity(camera, T_w_a, p)) / p.sigma_d;
				if (std::abs(x) >= 4) continue;
				in_d.add(x);
				const double t = trueDisparity(camera, T_w_a, p);
				noise.locking[static_cast<int>(10 * (t - std::floor(t)))].add(1e3 * x * p.sigma_d);
			}
			for (const auto& [k, l] : registration.match(a, b)) {
				const Eigen::Vector2d d =
					T_w_a.linear().topLeftCorner<2, 2>().transpose() *
					(floorPoint(camera, T_w_a, a.points[k]) - floorPoint(camera, T_w_b, b.points[l]));
				const double pixel_a = -T_w_a.translation().z() / camera.fx,
							 pixel_b = -T_w_b.translation().z() / camera.fx;
				const double sa = a.points[k].sigma_uv * pixel_a, sb = b.points[l].sigma_uv * pixel_b;
				const int octave = octaveOf(a.points[k]);
				if (d.norm() > 2 * pixel_a * std::exp2(0.5 * octave)) continue;
				if (kind.yaw_deg == 180)
					noise.shift_u[octave].add(0.5 * d.x() / pixel_a),
						noise.shift_v[octave].add(0.5 * d.y() / pixel_a);
				for (int m = 0; m < 2; m++) {
					const double x = d[m] / std::hypot(sa, sb);
					noise.place_px[octave].add(d[m] / std::hypot(pixel_a, pixel_b));
					noise.place_sigmas[octave].add(x);
					if (std::abs(x) < 4) (m ? in_v : in_u).add(x);
				}
			}
			const auto effect = [](TSample& s) {
				return std::pow(s.mean() / s.rms(), 2) * static_cast<double>(s.values.size());
			};
			result.effect[0].add(effect(in_u)), result.effect[1].add(effect(in_v)),
				result.effect[2].add(effect(in_d));
		}
		std::printf(
			"%-16s %3d/%3d ok %d wrong | matches %4.0f inliers %4.0f | mm %6.2f p90 %6.2f | mrad %5.2f p90 "
			"%5.2f | chi2/6 mean %5.2f med %5.2f | points' chi2/dof %.2f rmse %.2f px | %5.2f ms",
			kind.name, result.accepted, result.pairs, result.wrong, result.matches.quantile(0.5),
			result.inliers.quantile(0.5), result.mm.quantile(0.5), result.mm.quantile(0.9),
			result.mrad.quantile(0.5), result.mrad.quantile(0.9), result.chi2.mean(),
			result.chi2.quantile(0.5), result.pointchi2.mean(), result.rmse.mean(),
			result.align_ms.quantile(0.5));
		std::printf(" | xyz rpy rms/sigma");
		for (auto& c : result.component)
			std::printf(" %.2f", c.rms());
		std::printf(
			" | design effect u v d %.1f %.1f %.1f", result.effect[0].mean(), result.effect[1].mean(),
			result.effect[2].mean());
		for (const auto& [why, n] : result.refused)
			std::printf(" [%s %d]", why.c_str(), n);
		std::printf("\n");
	}
	std::printf(
		"all: chi2/6 mean %.2f over %zu; extract %.1f ms CPU, %.0f points\n", all_chi2.mean(),
		all_chi2.values.size(), extract_ms.quantile(0.5), points.quantile(0.5));
	std::printf("disparity bias [1e-3 px] by tenth of the true disparity's fraction:");
	for (auto& [tenth, s] : noise.locking)
		std::printf(" %.1f", s.mean());
	std::printf("\n");
	for (auto& [octave, s] : noise.disparity_px)
		std::printf(
			"octave %d: disparity n %6zu mean %6.3f sigma %.3f rms %.3f px = sigma %.2f rms %.2f stated | "
			"place n %6zu sigma %.3f rms %.3f px = sigma %.2f rms %.2f stated | shift %.3f %.3f px\n",
			octave, s.values.size(), s.mean(), s.robustSigma(), s.rms(),
			noise.disparity_sigmas[octave].robustSigma(), noise.disparity_sigmas[octave].rms(),
			noise.place_px[octave].values.size(), noise.place_px[octave].robustSigma(),
			noise.place_px[octave].rms(), noise.place_sigmas[octave].robustSigma(),
			noise.place_sigmas[octave].rms(), noise.shift_u[octave].mean(), noise.shift_v[octave].mean());
}
}  // namespace

int main(int argc, char** argv)
{
	CIniFile ini = CIniFile::fromText("");
	for (int i = 1; i < argc; i++)
		ini.set(argv[i]);
	const auto bench = ini.load<TBench>("Bench");
	const auto fo = ini.load<TFeatureOptions>("Features");
	const auto ro = ini.load<TRegistrationOptions>("Registration");
	ini.refuseUnknown();
	if (bench.procedural) {
		std::printf("procedural floor, %s\n", fo.detector.c_str());
		run(CFloorRenderer::proceduralTexture(5000, 3), 0.004, fo, ro, bench);
	}
	if (bench.reef) {
		std::printf("reef photograph, %s\n", fo.detector.c_str());
		run(CFloorRenderer::reefPhotograph(), CFloorRenderer::kMetresPerPixel, fo, ro, bench);
	}
}
