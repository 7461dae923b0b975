#pragma once

#include <string>
#include <vector>

namespace posidonia
{
/** A table for terminals: columns aligned by their widest cell (UTF-8 characters count as one).
 * A column of numbers is set right, any other left. */
class CTextTable
{
   public:
	explicit CTextTable(std::vector<std::string> header) : m_header(std::move(header)) {}

	/** As many cells as the header has; throws CError otherwise. */
	void add(std::vector<std::string> cells);

	/** Header, a rule, the rows; two blanks between columns, no trailing blanks, each line ends with \n. */
	std::string text() const;

   private:
	std::vector<std::string> m_header;
	std::vector<std::vector<std::string>> m_rows;
};
}  // namespace posidonia
