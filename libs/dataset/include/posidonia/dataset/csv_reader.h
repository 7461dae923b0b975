#pragma once

#include <posidonia/dataset/bad_rows.h>

#include <cstdint>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace posidonia
{
/** A row that does not hold what it should: told with its file and line by the reader's user. */
struct CRowProblem : std::runtime_error
{
	using std::runtime_error::runtime_error;
};

/** One data row. */
struct TCsvRow
{
	int64_t stamp{0};				  ///< UTC [ns], of the first column
	size_t line{0};					  ///< In the file, from 1
	std::vector<std::string> fields;  ///< All columns, blanks trimmed

	/** Column `i` as a finite number; throws CRowProblem. */
	double number(size_t i) const;
	/** As number(), but NaN is let through (a lost beam). */
	double numberOrNan(size_t i) const;
	/** Column `i` as 0 or 1; throws CRowProblem. */
	bool flag(size_t i) const;
};

/** Reads a table row by row: one header line, comma-separated columns, the first a time that never goes
 * backwards. Two kinds: an ASL data.csv (the header starts with '#', integer stamps [ns]) and a table whose
 * header names its columns (times in seconds). */
class CCsvReader
{
   public:
	/** `columns`: the counts that are allowed; `more_columns`: more than the first are allowed too.
	 * Throws CError when there is no file or no header. */
	CCsvReader(const std::string& path, std::vector<size_t> columns, bool more_columns, CBadRows& bad);
	/** `header`: the columns' names, exactly these in this order; the first is the time [s], >= 0.
	 * Throws CError when there is no file, or naming the column whose name is another one. */
	CCsvReader(const std::string& path, const std::vector<std::string>& header, CBadRows& bad);

	/** The next row that parses; empty at the end. Bad rows go to CBadRows. */
	std::optional<TCsvRow> next();
	/** Hands the row last read to CBadRows. */
	void refuse(const TCsvRow& row, const std::string& problem);
	/** "<path>:<line>" */
	std::string where(size_t line) const { return m_path + ":" + std::to_string(line); }

   private:
	std::string openWithHeader(const std::string& way_out);
	TCsvRow parse(const std::string& text) const;
	int64_t stampOf(const std::string& field) const;

	std::string m_path;
	std::ifstream m_file;
	std::vector<size_t> m_columns;
	bool m_more_columns;
	bool m_seconds;	 ///< The stamp is a decimal number of seconds
	CBadRows& m_bad;
	size_t m_line{0};
	int64_t m_last{0};
};
}  // namespace posidonia
