#include <posidonia/nav/nav_statistics.h>

#include <sstream>

namespace posidonia
{
std::string TNavStatistics::text() const
{
	std::ostringstream out;
	for (const auto& [label, n] : sensors)
		out << label << ": used " << n.used << ", gated " << n.gated << " (" << n.gated_in_row
			<< " in a row now), invalid " << n.invalid << ", late " << n.late << ", idle " << n.idle << "\n";
	return out.str();
}
}  // namespace posidonia
