#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace posidonia
{
using TJson = nlohmann::ordered_json;

/** The number with so many decimals, null when it is none. */
inline TJson rounded(double value, int decimals)
{
	if (!std::isfinite(value)) return nullptr;
	const double scale = std::pow(10.0, decimals);
	return std::round(value * scale) / scale;
}

/** A column: value(item) of every item. */
template <class ITEMS, class F>
TJson column(const ITEMS& items, int decimals, const F& value)
{
	TJson out = TJson::array();
	for (const auto& item : items)
		out.push_back(rounded(value(item), decimals));
	return out;
}

/** At most `most` of the items, evenly spread, first and last kept. */
template <class T>
std::vector<T> thinned(const std::vector<T>& items, size_t most)
{
	if (items.size() <= most || most < 2) return items;
	std::vector<T> out;
	for (size_t k = 0; k < most; k++)
		out.push_back(items[k * (items.size() - 1) / (most - 1)]);
	return out;
}

/** RFC 4648. */
std::string base64(const std::vector<unsigned char>& bytes);
}  // namespace posidonia
