#pragma once

#include <posidonia/dataset/bad_rows.h>
#include <posidonia/dataset/stereo_rectifier.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace posidonia
{
/** A row of camN/data.csv. */
struct TImageRow
{
	int64_t stamp{0};	///< [ns]
	std::string file;	///< Full path
	std::string where;	///< "<csv>:<line>"
};

/** Two images of (nearly) one instant. */
struct TImagePair
{
	TImageRow left, right;
	bool usable{true};
	std::string problem, where;	 ///< When not usable

	std::string leftName(size_t index) const;
	std::string rightName(size_t index) const;
};

/** Rows of <camera_folder>/data.csv. */
std::vector<TImageRow> readImageRows(const std::string& camera_folder, CBadRows& bad);

/** Pairs by equal stamps, else the nearest within `half_period` [ns]. `unequal` and `single` count pairs with
 * unequal stamps and images without a partner. */
std::vector<TImagePair> pairImages(
	const std::vector<TImageRow>& left, const std::vector<TImageRow>& right, int64_t half_period,
	size_t& unequal, size_t& single);

/** Reads, checks, rectifies and writes every pair into `folder` as grey PNG, on two threads (each picture is
 * one thread's: the bytes don't depend on it). A bad pair goes to `bad` and is marked unusable. */
void writePairs(
	std::vector<TImagePair>& pairs, const CStereoRectifier& rectifier, const std::string& folder,
	CBadRows& bad, const std::function<void(double)>& progress);
}  // namespace posidonia
