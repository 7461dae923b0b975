// CPU time of the stages of a node, each beside a peer or a floor of the same run (names end in _Peer).
#include <benchmark/benchmark.h>
#include <posidonia/posegraph/sparse_optimizer.h>
#include <posidonia/sim/survey_simulator.h>
#include <posidonia/vision/key_frame_extractor.h>
#include <posidonia/vision/stereo_registration.h>

#include <opencv2/features2d.hpp>
#include <random>

using namespace posidonia;

namespace
{
/** Two neighbouring stereo pairs of a simulated survey over the reef photograph. */
struct TScene
{
	TGreyPair a, b;
	TScene()
	{
		TSimulationOptions options;
		options.floor.image = POSIDONIA_SOURCE_DIR "/ini/textures/noaa_reef.jpg";
		options.run.duration = 60;
		CSurveySimulator simulator(options, TSensorSuite::sparus2());
		std::vector<TGreyPair> kept;
		simulator.stream([&](const TSimulatedObservation& o) {
			if (o.frame && o.kept && o.truth.T_map_body.translation().z() > 3.4 && kept.size() < 2)
				kept.push_back(simulator.render(o));
		});
		a = kept.at(0);
		b = kept.at(1);
	}
};
const TScene& scene()
{
	static const TScene s;
	return s;
}
const TStereoCamera kCamera;

TKeyFrame keyFrame(const TGreyPair& pair)
{
	return CKeyFrameExtractor({}, kCamera).extract(pair.left, pair.right);
}

void KeyFrame(benchmark::State& state)
{
	const CKeyFrameExtractor extractor({}, kCamera);
	for (auto _ : state)
		benchmark::DoNotOptimize(extractor.extract(scene().a.left, scene().a.right).size());
}
BENCHMARK(KeyFrame)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

/** The floor below any SIFT key frame: OpenCV's detector on both whole pictures, nothing else. */
void KeyFrame_Peer_OpenCvSift(benchmark::State& state)
{
	const auto sift = cv::SIFT::create(1200, 3, 0.02);
	std::vector<cv::KeyPoint> points;
	cv::Mat descriptors;
	for (auto _ : state)
		for (const cv::Mat& image : {scene().a.left, scene().a.right})
			sift->detectAndCompute(image, {}, points, descriptors);
}
BENCHMARK(KeyFrame_Peer_OpenCvSift)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void Match(benchmark::State& state)
{
	const TKeyFrame a = keyFrame(scene().a), b = keyFrame(scene().b);
	const CStereoRegistration registration({}, kCamera);
	for (auto _ : state)
		benchmark::DoNotOptimize(registration.match(a, b).size());
}
BENCHMARK(Match)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void Match_Peer_OpenCvCrossCheck(benchmark::State& state)
{
	cv::Mat a, b;
	keyFrame(scene().a).descriptors.convertTo(a, CV_32F);
	keyFrame(scene().b).descriptors.convertTo(b, CV_32F);
	const cv::BFMatcher matcher(cv::NORM_L2, true);
	std::vector<cv::DMatch> matches;
	for (auto _ : state)
		matcher.match(a, b, matches);
}
BENCHMARK(Match_Peer_OpenCvCrossCheck)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void Register(benchmark::State& state)
{
	const TKeyFrame a = keyFrame(scene().a), b = keyFrame(scene().b);
	const CStereoRegistration registration({}, kCamera);
	for (auto _ : state)
		benchmark::DoNotOptimize(registration.align(a, b).inliers);
}
BENCHMARK(Register)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

/** A lawn-mower survey of n nodes with noise: odometry, the previous 4 nodes, 4 of the track before. */
CPoseGraph lawnMower(int n)
{
	std::mt19937 rng(1);
	std::normal_distribution<double> noise(0, 1);
	const auto perturbed = [&](const Eigen::Isometry3d& T, double s) {
		Vector6d d;
		for (int k = 0; k < 6; k++)
			d[k] = s * noise(rng);
		return retract(T, d);
	};
	CPoseGraph graph;
	std::vector<Eigen::Isometry3d> truth;
	for (int i = 0; i < n; i++) {
		const int track = i / 24, k = i % 24;
		Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
		T.translation() << 3.0 * track, 0.5 * (track % 2 ? 23 - k : k), 3.5;
		truth.push_back(T);
		graph.addNode(perturbed(T, 0.05), i == 0);
	}
	const auto add = [&](int i, int j) {
		TPoseEdge e;
		e.from = i;
		e.to = j;
		e.T_from_to =
			perturbed(truth[static_cast<size_t>(i)].inverse() * truth[static_cast<size_t>(j)], 1e-3);
		e.information = 1e6 * Matrix6d::Identity();
		graph.addEdge(e);
	};
	for (int j = 1; j < n; j++) {
		for (int i = std::max(0, j - 4); i < j; i++)
			add(i, j);
		const int across = 2 * 24 * (j / 24) - 1 - j;
		for (int i = across - 2; i < across + 2; i++)
			if (i >= 0 && i < j - 4) add(i, j);
	}
	return graph;
}

void OptimizeSurvey(benchmark::State& state)
{
	const CPoseGraph start = lawnMower(static_cast<int>(state.range(0)));
	for (auto _ : state) {
		CPoseGraph graph = start;
		CSparseOptimizer optimizer;
		benchmark::DoNotOptimize(optimizer.optimize(graph).iterations);
	}
}
BENCHMARK(OptimizeSurvey)->Arg(365)->Arg(1000)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
}  // namespace

BENCHMARK_MAIN();
