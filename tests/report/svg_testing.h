#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

namespace posidonia::testing
{
/** Empty when every tag is closed in order and attributes are quoted; else what is wrong. */
inline std::string wellFormednessProblem(const std::string& xml)
{
	static const std::regex tag(R"re(^<(/?)([A-Za-z]+)((?: [A-Za-z0-9-]+="[^"<]*")*)(/?)>)re");
	static const std::regex entity(R"re(^&(amp|lt|gt|quot);)re");
	std::vector<std::string> open;
	for (size_t i = 0; i < xml.size(); i++) {
		std::smatch m;
		const auto at = xml.begin() + static_cast<long>(i);
		if (xml[i] == '&' && !std::regex_search(at, xml.end(), m, entity))
			return "bare & at " + std::to_string(i);
		if (xml[i] == '>') return "bare > at " + std::to_string(i);
		if (xml[i] != '<') continue;
		if (!std::regex_search(at, xml.end(), m, tag)) return "no tag at " + xml.substr(i, 60);
		i += static_cast<size_t>(m.length()) - 1;
		if (m[1].length() > 0) {
			if (open.empty() || open.back() != m[2]) return "</" + m[2].str() + "> closes nothing";
			open.pop_back();
		}
		else if (m[4].length() == 0)
			open.push_back(m[2]);
	}
	return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

/** Points of the n-th curve's path: M and L alike. */
inline std::vector<Eigen::Vector2d> curvePixels(const std::string& svg, int n)
{
	static const std::regex path(R"re(<path class="curve"[^>]* d="([^"]*)")re");
	static const std::regex point(R"re([ML]([-0-9.]+) ([-0-9.]+))re");
	auto it = std::sregex_iterator(svg.begin(), svg.end(), path);
	std::advance(it, n);
	const std::string d = (*it)[1];
	std::vector<Eigen::Vector2d> points;
	for (auto p = std::sregex_iterator(d.begin(), d.end(), point); p != std::sregex_iterator(); ++p)
		points.emplace_back(std::stod((*p)[1]), std::stod((*p)[2]));
	return points;
}

/** Pixel as a straight line of the data, from the first and last tick labels: independent of the plot's own
 * mapping. */
struct TAxisReader
{
	double value0, value1, pixel0, pixel1;
	int count{0};

	/** axis: 'x' or 'y' */
	TAxisReader(const std::string& svg, char axis)
	{
		const std::regex tick(
			std::string(R"re(<text x="([-0-9.]+)" y="([-0-9.]+)"[^>]*class=")re") + axis +
			R"re(tick">([-0-9.]+)<)re");
		for (auto t = std::sregex_iterator(svg.begin(), svg.end(), tick); t != std::sregex_iterator();
			 ++t, ++count) {
			value1 = std::stod((*t)[3]);
			// The baseline of a vertical tick's number is 4 px below its line.
			pixel1 = axis == 'x' ? std::stod((*t)[1]) : std::stod((*t)[2]) - 4;
			if (count > 0) continue;
			value0 = value1;
			pixel0 = pixel1;
		}
		if (count < 2) throw std::runtime_error("fewer than two ticks");
	}
	double scale() const { return (pixel1 - pixel0) / (value1 - value0); }
	double pixel(double value) const { return pixel0 + (value - value0) * scale(); }
};
}  // namespace posidonia::testing
