#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

namespace posidonia
{
/** A line with data of a text file; it knows where it stands. */
struct TDataLine
{
	std::string path;
	int number{0};	///< from 1
	std::string text;

	/** Throws CError "<path>:<number>: <problem>; <way out>". */
	[[noreturn]] void fail(const std::string& problem, const std::string& way_out) const;

	/** Cells between commas, blanks around them stripped. */
	std::vector<std::string> cellsByComma() const;
	/** Cells between runs of blanks and tabs. */
	std::vector<std::string> cellsByBlank() const;

	/** The finite number, or whole number, that fills the cell; fail() otherwise. */
	double real(const std::string& cell) const;
	long long whole(const std::string& cell) const;

	/** Rotation of (x, y, z, w), normalised; fail() when its norm is off 1 by more than 1 %. */
	Eigen::Matrix3d rotation(double x, double y, double z, double w) const;
};

/** Every line that is neither blank nor a comment (#). Throws CError when the file can't be read. */
std::vector<TDataLine> readDataLines(const std::string& path);
}  // namespace posidonia
