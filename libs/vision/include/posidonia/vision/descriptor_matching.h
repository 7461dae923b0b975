#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace posidonia
{
/** Distances between two sets of 8-bit descriptors as exact whole numbers: squared Euclidean (SIFT) or
 * Hamming. */
class CDescriptorDistance
{
   public:
	/** @param a,b CV_8U, a descriptor a row, equal columns */
	CDescriptorDistance(const cv::Mat& a, const cv::Mat& b, bool binary);

	int operator()(int row_of_a, int row_of_b) const;

	/** Distances of a row of `a` to all rows of `b`. */
	void row(int row_of_a, int* out) const;

	/** Is the best distance (not its square) below `ratio` times the second? */
	bool passesRatio(int best, int second, double ratio) const;

   private:
	/** Descriptors as 16-bit numbers, or as 64-bit words, padded with zeros. */
	struct TSide
	{
		int rows{0}, width{0};
		std::vector<int16_t> numbers;
		std::vector<int> squared_norms;
		std::vector<uint64_t> words;
		TSide(const cv::Mat& d, bool binary);
	};

	bool m_binary;
	TSide m_a, m_b;
};

/** Two descriptors that are each other's nearest. */
struct TDescriptorMatch
{
	int a, b;	   ///< Rows
	int distance;  ///< Squared Euclidean or Hamming
};

/** Rows of a and b that are each other's nearest; ties go to the lower row. With `ratio` < 1 the best
 * distance must also be below `ratio` times the second, seen from either side. Symmetric in a and b but for
 * ties.
 * @return sorted by row of a */
std::vector<TDescriptorMatch> matchReciprocal(const cv::Mat& a, const cv::Mat& b, bool binary, double ratio);
}  // namespace posidonia
