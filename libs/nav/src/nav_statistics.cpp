#include <posidonia/nav/nav_statistics.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace posidonia
{
void TSensorCount::use(double stamp)
{
	used++;
	gated_in_row = 0;
	if (used > 1) longest_gap = std::max(longest_gap, stamp - last_used);
	last_used = stamp;
}

std::string TNavStatistics::text() const
{
	std::ostringstream out;
	for (const auto& [label, n] : sensors)
		out << label << ": used " << n.used << ", gated " << n.gated << " (" << n.gated_in_row
			<< " in a row now), gave way " << n.gave_way << ", invalid " << n.invalid << ", late " << n.late
			<< ", idle " << n.idle << ", longest gap " << std::fixed << std::setprecision(2) << n.longest_gap
			<< " s\n";
	return out.str();
}
}  // namespace posidonia
