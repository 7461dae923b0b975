#include "stereo_pairs.h"

#include <mrpt/core/format.h>
#include <posidonia/base/error.h>
#include <posidonia/dataset/csv_reader.h>

#include <atomic>
#include <exception>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>

namespace fs = std::filesystem;

namespace posidonia
{
std::string TImagePair::leftName(size_t i) const
{
	return mrpt::format("STEREO_%06zu_left.png", i);
}
std::string TImagePair::rightName(size_t i) const
{
	return mrpt::format("STEREO_%06zu_right.png", i);
}

std::vector<TImageRow> readImageRows(const std::string& camera_folder, CBadRows& bad)
{
	CCsvReader csv(camera_folder + "/data.csv", {2}, false, bad);
	std::vector<TImageRow> rows;
	while (const auto row = csv.next()) {
		if (row->fields[1].empty())
			csv.refuse(*row, "has no file name");
		else
			rows.push_back({row->stamp, camera_folder + "/data/" + row->fields[1], csv.where(row->line)});
	}
	return rows;
}

std::vector<TImagePair> pairImages(
	const std::vector<TImageRow>& left, const std::vector<TImageRow>& right, int64_t half_period,
	size_t& unequal, size_t& single)
{
	std::vector<TImagePair> pairs;
	const auto distance = [&](size_t l, size_t r) { return std::abs(left[l].stamp - right[r].stamp); };
	unequal = single = 0;
	size_t l = 0, r = 0;
	while (l < left.size() && r < right.size()) {
		const int64_t apart = distance(l, r);
		const bool left_waits = r + 1 < right.size() && distance(l, r + 1) < apart;
		const bool right_waits = l + 1 < left.size() && distance(l + 1, r) < apart;
		if (apart <= half_period && !left_waits && !right_waits) {
			pairs.push_back({left[l++], right[r++], true, "", ""});
			unequal += apart != 0;
			continue;
		}
		single++;
		left[l].stamp < right[r].stamp ? l++ : r++;
	}
	single += left.size() - l + right.size() - r;
	return pairs;
}

namespace
{
/** A picture that can't be used, with the row that names it. */
struct TImageProblem
{
	std::string where, problem;
};

cv::Mat greyOf(const cv::Mat& picture)
{
	if (picture.channels() == 1) return picture;
	cv::Mat grey;
	cv::cvtColor(picture, grey, picture.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
	return grey;
}

cv::Mat readPicture(const TImageRow& row, const TStereoCamera& camera)
{
	if (!fs::is_regular_file(row.file)) throw TImageProblem{row.where, "image " + row.file + " not found"};
	const cv::Mat picture = cv::imread(row.file, cv::IMREAD_UNCHANGED);
	if (picture.empty()) throw TImageProblem{row.where, "image " + row.file + " can't be read"};
	if (picture.depth() != CV_8U) throw TImageProblem{row.where, "image " + row.file + " is not of 8 bits"};
	if (picture.cols != camera.width || picture.rows != camera.height)
		throw TImageProblem{
			row.where, mrpt::format(
						   "image %s is %dx%d, sensor.yaml says %dx%d", row.file.c_str(), picture.cols,
						   picture.rows, camera.width, camera.height)};
	return picture;
}

void writePicture(
	const TImageRow& row, const CStereoRectifier& rectifier, bool right_side, const cv::Mat& picture,
	const std::string& path)
{
	const bool as_is =
		rectifier.isIdentity() && picture.channels() == 1 && fs::path(row.file).extension() == ".png";
	if (as_is) {
		std::error_code problem;
		fs::copy_file(row.file, path, problem);
		if (problem) throw CError(path, "can't be written: " + problem.message(), "is the disk full?");
	}
	else if (!cv::imwrite(path, rectifier.rectified(greyOf(picture), right_side)))
		throw CError(path, "can't be written", "is the disk full?");
}

void writePair(TImagePair& pair, size_t index, const CStereoRectifier& rectifier, const std::string& folder)
{
	try {
		const cv::Mat left = readPicture(pair.left, rectifier.camera()),
					  right = readPicture(pair.right, rectifier.camera());
		writePicture(pair.left, rectifier, false, left, folder + "/" + pair.leftName(index));
		writePicture(pair.right, rectifier, true, right, folder + "/" + pair.rightName(index));
	}
	catch (const TImageProblem& problem) {
		pair.usable = false;
		pair.where = problem.where;
		pair.problem = problem.problem;
	}
}
}  // namespace

void writePairs(
	std::vector<TImagePair>& pairs, const CStereoRectifier& rectifier, const std::string& folder,
	CBadRows& bad, const std::function<void(double)>& progress)
{
	std::exception_ptr failure[2];
	std::atomic<size_t> done{0};
	std::atomic<bool> stop{false};
	const auto work = [&](size_t first) {
		try {
			for (size_t i = first; i < pairs.size() && !stop; i += 2) {
				writePair(pairs[i], i, rectifier, folder);
				if (first == 0 && progress)
					progress(double(++done) / double(pairs.size()));
				else
					++done;
			}
		}
		catch (...)	 // the disk: hand it to the caller's thread
		{
			failure[first] = std::current_exception();
			stop = true;
		}
	};
	std::thread second(work, 1);
	work(0);
	second.join();
	for (const auto& f : failure)
		if (f) std::rethrow_exception(f);
	for (const auto& pair : pairs)
		if (!pair.usable) bad.add(pair.where, pair.problem);
}
}  // namespace posidonia
