#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace posidonia::testing
{
/** Are name="value" pairs, each after a blank, all there is in a tag after its name? */
inline bool attributesAreQuoted(std::string text)
{
	while (!text.empty()) {
		const size_t equals = text.find("=\""), end = text.find('"', equals + 2);
		if (text[0] != ' ' || equals == std::string::npos || end == std::string::npos) return false;
		if (text.find_first_of(" \"", 1) < equals) return false;
		text.erase(0, end + 1);
	}
	return true;
}

/** Empty when every tag is closed in order and attributes are quoted; else what is wrong.
 * By hand: std::regex recurses once a character and would overflow the stack on a long path. */
inline std::string wellFormednessProblem(const std::string& xml)
{
	std::vector<std::string> open;
	for (size_t i = 0; i < xml.size(); i++) {
		if (xml[i] == '>') return "bare > at " + std::to_string(i);
		if (xml[i] == '&') {
			const std::string entity = xml.substr(i, xml.find(';', i) - i);
			if (entity != "&amp" && entity != "&lt" && entity != "&gt" && entity != "&quot")
				return "bare &: " + entity;
		}
		if (xml[i] != '<') continue;
		const size_t end = xml.find('>', i);
		if (end == std::string::npos) return "an open tag at the end";
		std::string tag = xml.substr(i + 1, end - i - 1);
		i = end;
		if (tag[0] == '/') {
			if (open.empty() || "/" + open.back() != tag) return "<" + tag + "> closes nothing";
			open.pop_back();
			continue;
		}
		const bool closed = tag.back() == '/';
		if (closed) tag.pop_back();
		const std::string name = tag.substr(0, tag.find(' '));
		if (!attributesAreQuoted(tag.substr(name.size()))) return "attributes of <" + tag.substr(0, 60);
		if (!closed) open.push_back(name);
	}
	return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

/** Points of the n-th curve's path: M and L alike. */
inline std::vector<Eigen::Vector2d> curvePixels(const std::string& svg, int n)
{
	size_t at = svg.find("<path class=\"curve\"");
	for (int i = 0; i < n; i++)
		at = svg.find("<path class=\"curve\"", at + 1);
	const size_t start = svg.find(" d=\"", at) + 4;
	std::string d = svg.substr(start, svg.find('"', start) - start);
	for (char& c : d)
		if (c == 'M' || c == 'L') c = ' ';
	std::istringstream in(d);
	std::vector<Eigen::Vector2d> points;
	for (double x, y; in >> x >> y;)
		points.emplace_back(x, y);
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
