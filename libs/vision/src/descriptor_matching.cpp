#include <posidonia/vision/descriptor_matching.h>

#include <cstring>
#include <limits>

// Kernels for the processor found at run time; whole numbers, so each gives the same result.
// Sanitizers don't know functions that are resolved before main.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define POSIDONIA_CLONES(...) __attribute__((target_clones(__VA_ARGS__)))
#else
#define POSIDONIA_CLONES(...)
#endif

namespace posidonia
{
namespace
{
POSIDONIA_CLONES("avx2", "default")
void dotProducts(const int16_t* a, const int16_t* b, int width, int rows, int* out)
{
	for (int j = 0; j < rows; j++, b += width) {
		int sum = 0;
		for (int k = 0; k < width; k++)
			sum += static_cast<int>(a[k]) * static_cast<int>(b[k]);
		out[j] = sum;
	}
}

POSIDONIA_CLONES("popcnt", "default")
void hammingDistances(const uint64_t* a, const uint64_t* b, int width, int rows, int* out)
{
	for (int j = 0; j < rows; j++, b += width) {
		int sum = 0;
		for (int k = 0; k < width; k++)
			sum += __builtin_popcountll(a[k] ^ b[k]);
		out[j] = sum;
	}
}
}  // namespace

CDescriptorDistance::TSide::TSide(const cv::Mat& d, bool binary) : rows(d.rows)
{
	width = binary ? (d.cols + 7) / 8 : (d.cols + 31) / 32 * 32;
	if (binary) {
		words.assign(static_cast<size_t>(rows) * width, 0);
		for (int i = 0; i < rows; i++)
			std::memcpy(&words[static_cast<size_t>(i) * width], d.ptr(i), static_cast<size_t>(d.cols));
		return;
	}
	numbers.assign(static_cast<size_t>(rows) * width, 0);
	for (int i = 0; i < rows; i++) {
		int16_t* row = &numbers[static_cast<size_t>(i) * width];
		for (int k = 0; k < d.cols; k++)
			row[k] = d.at<uint8_t>(i, k);
		int norm;
		dotProducts(row, row, width, 1, &norm);
		squared_norms.push_back(norm);
	}
}

CDescriptorDistance::CDescriptorDistance(const cv::Mat& a, const cv::Mat& b, bool binary)
	: m_binary(binary), m_a(a, binary), m_b(b, binary)
{
}

int CDescriptorDistance::operator()(int i, int j) const
{
	int out;
	if (m_binary) {
		const size_t w = m_a.width;
		hammingDistances(&m_a.words[i * w], &m_b.words[j * w], m_a.width, 1, &out);
		return out;
	}
	const size_t w = m_a.width;
	dotProducts(&m_a.numbers[i * w], &m_b.numbers[j * w], m_a.width, 1, &out);
	return m_a.squared_norms[i] + m_b.squared_norms[j] - 2 * out;
}

void CDescriptorDistance::row(int i, int* out) const
{
	const size_t w = m_a.width;
	if (m_binary) return hammingDistances(&m_a.words[i * w], m_b.words.data(), m_a.width, m_b.rows, out);
	dotProducts(&m_a.numbers[i * w], m_b.numbers.data(), m_a.width, m_b.rows, out);
	for (int j = 0; j < m_b.rows; j++)
		out[j] = m_a.squared_norms[i] + m_b.squared_norms[j] - 2 * out[j];
}

bool CDescriptorDistance::passesRatio(int best, int second, double ratio) const
{
	if (ratio >= 1) return true;
	return best < (m_binary ? ratio : ratio * ratio) * second;
}

std::vector<TDescriptorMatch> matchReciprocal(const cv::Mat& a, const cv::Mat& b, bool binary, double ratio)
{
	if (a.empty() || b.empty()) return {};
	const CDescriptorDistance distance(a, b, binary);
	constexpr int FAR = std::numeric_limits<int>::max();
	std::vector<int> row(b.rows), best_a(a.rows, -1), first_b(b.rows, FAR), second_b(b.rows, FAR),
		best_b(b.rows, -1);
	std::vector<char> distinct_a(a.rows);
	for (int i = 0; i < a.rows; i++) {
		distance.row(i, row.data());
		int first = FAR, second = FAR;
		for (int j = 0; j < b.rows; j++) {
			const int d = row[j];
			if (d < second) {
				if (d < first)
					second = first, first = d, best_a[i] = j;
				else
					second = d;
			}
			if (d < second_b[j]) {
				if (d < first_b[j])
					second_b[j] = first_b[j], first_b[j] = d, best_b[j] = i;
				else
					second_b[j] = d;
			}
		}
		distinct_a[i] = distance.passesRatio(first, second, ratio);
	}

	std::vector<TDescriptorMatch> matches;
	for (int i = 0; i < a.rows; i++) {
		const int j = best_a[i];
		if (best_b[j] == i && distinct_a[i] && distance.passesRatio(first_b[j], second_b[j], ratio))
			matches.push_back({i, j, first_b[j]});
	}
	return matches;
}
}  // namespace posidonia
