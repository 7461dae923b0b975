#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/dataset/import_dataset.h>
#include <posidonia/obs/observations.h>
#include <posidonia/obs/rawlog_writer.h>

#include <algorithm>
#include <filesystem>

#include "import_dvl_gt.h"
#include "import_output.h"
#include "row_sources.h"
#include "stereo_pairs.h"

namespace fs = std::filesystem;

namespace posidonia
{
using Eigen::Isometry3d;

namespace
{
constexpr const char* kFolders[] = {"cam0", "cam1", "imu0", "ahrs0", "dvl0", "pressure0", "gps0", "odom0"};

std::string mav0Of(const std::string& input)
{
	if (!fs::is_directory(input)) throw CError(input, "no such folder", "give the folder that holds mav0/");
	const std::string mav0 = fs::is_directory(input + "/mav0") ? input + "/mav0" : input;
	const auto there = [&](const char* name) { return fs::is_directory(mav0 + "/" + name); };
	if (std::none_of(std::begin(kFolders), std::end(kFolders), there))
		throw CError(
			mav0, "holds no sensor's folder",
			"cam0, cam1, imu0, ahrs0, dvl0, pressure0, gps0 or odom0 are read");
	return mav0;
}

/** NAME_Images.part, which becomes NAME_Images in finish() and else disappears. */
class CImagesFolder
{
   public:
	explicit CImagesFolder(const std::string& path) : m_path(path)
	{
		fs::remove_all(part());
		makeFolder(part());
	}
	~CImagesFolder()
	{
		std::error_code ignored;
		fs::remove_all(part(), ignored);
	}
	CImagesFolder(const CImagesFolder&) = delete;
	CImagesFolder& operator=(const CImagesFolder&) = delete;

	std::string part() const { return m_path + ".part"; }
	void finish() const
	{
		std::error_code problem;
		fs::remove_all(m_path, problem);
		if (!problem) fs::rename(part(), m_path, problem);
		if (problem) throw CError(m_path, "can't be replaced: " + problem.message(), "check its permissions");
	}

   private:
	std::string m_path;
};

void readAxes(TImport& import)
{
	import.axes = readBodyYaml(import.mav0 + "/body.yaml");
	TDatasetReport& report = import.report;
	report.warnings = import.axes.warnings;
	report.levelled = import.options.level;
	if (import.options.level) {
		if (!fs::is_directory(import.mav0 + "/imu0"))
			throw CError(
				import.mav0, "levelling needs imu0, which is absent",
				"give T_FRD_body in body.yaml instead of --level");
		const CSensorYaml imu(import.mav0 + "/imu0/sensor.yaml");
		CBadRows counted_later(import.options.skip_bad);
		const Eigen::Vector3d force = meanForceOfFirstSecond(import.mav0 + "/imu0/data.csv", counted_later);
		const Isometry3d T_body_imu = import.axes.mount(imu.pose("T_BS"));
		import.axes.T_FRD_body =
			Isometry3d(levellingRotation(T_body_imu.linear() * force)) * import.axes.T_FRD_body;
	}
	report.T_FRD_body = import.axes.T_FRD_body;
	report.datum = import.axes.datum ? import.axes.datum : import.options.datum;
	if (report.datum) report.datum_source = import.axes.datum ? "body.yaml" : "ini";
}

void warnIf(TDatasetReport& report, size_t n, const std::string& what)
{
	if (n) report.warnings.push_back(std::to_string(n) + " " + what);
}

/** The stereo pairs as a source, their pictures written into `folder`. Empty when a camera is absent. */
std::optional<TSource> stereoSource(
	TImport& import, const std::string& folder, const dataset_progress_t& progress)
{
	bool complete = true;
	for (const std::string camera : {"cam0", "cam1"})
		if (!fs::is_directory(import.mav0 + "/" + camera)) {
			import.report.absent.push_back(camera + " (no stereo pairs)");
			complete = false;
		}
	if (!complete) return {};
	TDatasetReport& report = import.report;
	const std::string cam0 = import.mav0 + "/cam0", cam1 = import.mav0 + "/cam1";
	const auto left = TRawCamera::fromYaml(cam0 + "/sensor.yaml", report.warnings);
	const auto right = TRawCamera::fromYaml(cam1 + "/sensor.yaml", report.warnings);
	const CStereoRectifier rectifier(left, right, import.options.cubic, cam1 + "/sensor.yaml");

	size_t unequal = 0, single = 0;
	auto pairs = std::make_shared<std::vector<TImagePair>>(pairImages(
		readImageRows(cam0, import.bad), readImageRows(cam1, import.bad),
		static_cast<int64_t>(0.5e9 / left.rate), unequal, single));
	warnIf(
		report, unequal,
		"stereo pairs have unequal time stamps (within half a period); the left one is used");
	warnIf(report, single, "images of cam0 or cam1 have no partner within half a period and are left out");
	writePairs(*pairs, rectifier, folder, import.bad, [&](double f) {
		if (progress) progress("stereo pairs", f);
	});

	auto spec = std::make_shared<TStereoSpec>();
	spec->camera = report.camera = rectifier.camera();
	spec->rate = left.rate;
	spec->pose = TSensorMount::poseNumbers(import.axes.mount(left.T_BS * Isometry3d(rectifier.rotation())));
	import.suite.stereo["STEREO"] = *spec;
	report.rectified = !rectifier.isIdentity();

	const auto index = std::make_shared<size_t>(0);
	const auto next = [pairs, spec, index]() -> std::optional<TStampedObservation> {
		while (*index < pairs->size() && !(*pairs)[*index].usable)
			++*index;
		if (*index == pairs->size()) return {};
		const size_t i = (*index)++;
		const TImagePair& pair = (*pairs)[i];
		auto observation = makeStereo("STEREO", 0, *spec, pair.leftName(i), pair.rightName(i));
		observation->timestamp = mrptStamp(pair.left.stamp);
		return TStampedObservation{pair.left.stamp, observation};
	};
	return TSource{"STEREO", next};
}

void finishReport(TImport& import, const std::vector<TSource>& sources)
{
	TDatasetReport& report = import.report;
	for (const auto& source : sources)
		if (!report.observations.count(source.label))
			report.warnings.push_back(source.label + ": its folder holds no row");
	if (report.datum_source == "first fix")
		report.warnings.push_back("no datum in body.yaml or ini: the first fix is proposed as [World]");
	report.bad_rows = import.bad.count();
	for (const auto& message : import.bad.messages())
		report.warnings.push_back(message);
	auto& sigmas = import.gps_sigmas;
	if (sigmas.empty()) return;
	std::nth_element(sigmas.begin(), sigmas.begin() + sigmas.size() / 2, sigmas.end());
	import.suite.gps["GPS"].sigma_horizontal = sigmas[sigmas.size() / 2];
}

TDatasetReport importEuroc(const TDatasetOptions& options, const dataset_progress_t& progress)
{
	TImport import(options, mav0Of(options.input));
	readAxes(import);
	CRawlogWriter writer(options.output);
	auto sources = openRowSources(import);
	const auto ground_truth = readGroundTruth(import);

	const CImagesFolder images(imagesFolderOf(options.output));
	if (const auto stereo = stereoSource(import, images.part(), progress)) sources.push_back(*stereo);
	if (progress) progress("rawlog", 0);
	mergeInto(writer, sources, import.report);
	if (!writer.count()) throw CError(import.mav0, "holds no usable row", "check its data.csv files");
	finishReport(import, sources);

	removeEarlier(options.output);
	if (import.report.observations.count("STEREO")) images.finish();
	if (ground_truth)
		writeFileWhole(groundTruthPathOf(options.output), [&](std::ostream& out) { out << *ground_truth; });
	writeSensors(sensorsPathOf(options.output), import.suite);
	writer.finish();
	if (progress) progress("rawlog", 1);
	return import.report;
}
}  // namespace

TDatasetReport importDataset(const TDatasetOptions& options, const dataset_progress_t& progress)
{
	checkOutput(options);
	return options.format == EDatasetFormat::DVL_GT_CSV ? importDvlGt(options, progress)
														: importEuroc(options, progress);
}
}  // namespace posidonia
