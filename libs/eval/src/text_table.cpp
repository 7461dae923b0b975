#include <posidonia/base/error.h>
#include <posidonia/eval/text_table.h>

#include <algorithm>

namespace posidonia
{
namespace
{
/** Characters, not bytes: continuation bytes of UTF-8 are 10xxxxxx. */
size_t width(const std::string& text)
{
	return static_cast<size_t>(
		std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/** A number, with a unit or a sign around it, or a mark for "none". */
bool looksNumeric(const std::string& cell)
{
	if (cell.empty() || cell == "-") return true;
	const size_t first = cell.find_first_not_of("+-.");
	return first != std::string::npos && cell[first] >= '0' && cell[first] <= '9';
}

std::string padded(const std::string& cell, size_t to, bool right)
{
	const std::string blanks(to - width(cell), ' ');
	return right ? blanks + cell : cell + blanks;
}

std::string line(const std::vector<std::string>& cells)
{
	std::string text;
	for (const auto& cell : cells)
		text += (text.empty() ? "" : "  ") + cell;
	text.erase(text.find_last_not_of(' ') + 1);
	return text + '\n';
}
}  // namespace

void CTextTable::add(std::vector<std::string> cells)
{
	if (cells.size() != m_header.size())
		throw CError(
			"text table",
			std::to_string(cells.size()) + " cells under " + std::to_string(m_header.size()) + " heads",
			"give one cell a column");
	m_rows.push_back(std::move(cells));
}

std::string CTextTable::text() const
{
	auto rows = m_rows;
	rows.insert(rows.begin(), m_header);
	std::vector<std::string> rule;
	for (size_t c = 0; c < m_header.size(); c++) {
		size_t to = 0;
		for (const auto& row : rows)
			to = std::max(to, width(row[c]));
		const bool right = !m_rows.empty() && std::all_of(m_rows.begin(), m_rows.end(), [&](const auto& row) {
			return looksNumeric(row[c]);
		});
		for (auto& row : rows)
			row[c] = padded(row[c], to, right);
		rule.push_back(std::string(to, '-'));
	}
	rows.insert(rows.begin() + 1, rule);
	std::string text;
	for (const auto& row : rows)
		text += line(row);
	return text;
}
}  // namespace posidonia
