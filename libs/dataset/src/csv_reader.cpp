#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/dataset/csv_reader.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace posidonia
{
namespace
{
std::string trimmed(const std::string& s)
{
	const auto first = s.find_first_not_of(" \t\r");
	if (first == std::string::npos) return {};
	return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> split(const std::string& line)
{
	std::vector<std::string> fields;
	size_t from = 0;
	for (size_t comma; (comma = line.find(',', from)) != std::string::npos; from = comma + 1)
		fields.push_back(trimmed(line.substr(from, comma - from)));
	fields.push_back(trimmed(line.substr(from)));
	return fields;
}

/** The whole of `text` as a number; locale-independent. */
template <class NUMBER>
std::optional<NUMBER> parsed(const std::string& text)
{
	NUMBER x{};
	const auto result = std::from_chars(text.data(), text.data() + text.size(), x);
	if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return {};
	return x;
}

std::string column(size_t i)
{
	return "column " + std::to_string(i + 1);
}
}  // namespace

double TCsvRow::numberOrNan(size_t i) const
{
	const auto x = parsed<double>(fields.at(i));
	if (!x || std::isinf(*x)) throw CRowProblem(column(i) + " '" + fields[i] + "' is not a number");
	return *x;
}

double TCsvRow::number(size_t i) const
{
	const double x = numberOrNan(i);
	if (std::isnan(x)) throw CRowProblem(column(i) + " '" + fields[i] + "' is not a number");
	return x;
}

bool TCsvRow::flag(size_t i) const
{
	if (fields.at(i) != "0" && fields[i] != "1")
		throw CRowProblem(column(i) + " '" + fields[i] + "' must be 0 or 1");
	return fields[i] == "1";
}

CCsvReader::CCsvReader(const std::string& path, std::vector<size_t> columns, bool more_columns, CBadRows& bad)
	: m_path(path), m_columns(std::move(columns)), m_more_columns(more_columns), m_seconds(false), m_bad(bad)
{
	const std::string header = openWithHeader("each sensor's folder holds a data.csv");
	if (header.empty() || header[0] != '#')
		throw CError(where(1), "is not a header", "the first line starts with #, as '#timestamp [ns],...'");
}

CCsvReader::CCsvReader(const std::string& path, const std::vector<std::string>& header, CBadRows& bad)
	: m_path(path), m_columns{header.size()}, m_more_columns(false), m_seconds(true), m_bad(bad)
{
	std::string all;
	for (const auto& name : header)
		all += (all.empty() ? "" : ",") + name;
	const auto names = split(openWithHeader("it starts with the line '" + all + "'"));
	const std::string way_out = "the first line must be '" + all + "'";
	for (size_t i = 0; i < std::min(names.size(), header.size()); i++)
		if (names[i] != header[i])
			throw CError(
				where(1), column(i) + " is '" + names[i] + "', '" + header[i] + "' was expected", way_out);
	if (names.size() != header.size())
		throw CError(
			where(1),
			"names " + std::to_string(names.size()) + " columns, " + std::to_string(header.size()) +
				" were expected",
			way_out);
}

std::string CCsvReader::openWithHeader(const std::string& way_out)
{
	requireFile(m_path, way_out);
	m_file.open(m_path, std::ios::binary);
	std::string header;
	std::getline(m_file, header);
	m_line = 1;
	return header;
}

int64_t CCsvReader::stampOf(const std::string& field) const
{
	if (m_seconds) {
		constexpr double kLatest = 4e9;	 // year 2096: integers of nanoseconds stay far from their end
		const auto seconds = parsed<double>(field);
		if (!seconds || !(*seconds >= 0 && *seconds < kLatest))
			throw CRowProblem("time '" + field + "' is no number >= 0 [s]");
		return std::llround(*seconds * 1e9);
	}
	const auto stamp = parsed<int64_t>(field);
	if (!stamp || *stamp <= 0) throw CRowProblem("time stamp '" + field + "' is no integer > 0 [ns]");
	return *stamp;
}

TCsvRow CCsvReader::parse(const std::string& text) const
{
	TCsvRow row;
	row.line = m_line;
	row.fields = split(text);
	const size_t n = row.fields.size();
	const bool fits =
		std::count(m_columns.begin(), m_columns.end(), n) || (m_more_columns && n > m_columns[0]);
	if (!fits)
		throw CRowProblem(
			"has " + std::to_string(n) + " columns, " + std::to_string(m_columns[0]) + " were expected" +
			(m_columns.size() > 1 ? " (or " + std::to_string(m_columns[1]) + ")" : ""));
	row.stamp = stampOf(row.fields[0]);
	if (row.stamp < m_last)
		throw CRowProblem(
			"time stamp " + row.fields[0] + " goes backwards: the row before has " +
			(m_seconds ? std::to_string(double(m_last) * 1e-9) : std::to_string(m_last)));
	return row;
}

std::optional<TCsvRow> CCsvReader::next()
{
	for (std::string text; std::getline(m_file, text);) {
		m_line++;
		if (trimmed(text).empty()) continue;
		try {
			const TCsvRow row = parse(text);
			m_last = row.stamp;
			return row;
		}
		catch (const CRowProblem& problem) {
			m_bad.add(where(m_line), problem.what());
		}
	}
	return {};
}

void CCsvReader::refuse(const TCsvRow& row, const std::string& problem)
{
	m_bad.add(where(row.line), problem);
}
}  // namespace posidonia
