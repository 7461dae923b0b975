#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/dataset/sensor_yaml.h>
#include <posidonia/geometry/se3.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace posidonia
{
using Eigen::Isometry3d;

namespace
{
std::string trimmed(const std::string& s)
{
	const auto first = s.find_first_not_of(" \t\r\n");
	if (first == std::string::npos) return {};
	return s.substr(first, s.find_last_not_of(" \t\r\n") - first + 1);
}

std::optional<double> parsedNumber(const std::string& text)
{
	double x = 0;
	const auto result = std::from_chars(text.data(), text.data() + text.size(), x);
	if (result.ec != std::errc() || result.ptr != text.data() + text.size() || !std::isfinite(x)) return {};
	return x;
}

bool isTopLevel(const std::string& line)
{
	return line[0] != ' ' && line[0] != '\t';
}
bool isDirective(const std::string& line)
{
	return line[0] == '%' || line == "---" || line == "...";
}
}  // namespace

CSensorYaml::CSensorYaml(const std::string& path) : m_path(path)
{
	requireFile(path, "it says where the sensor is (T_BS) and how well it measures");
	parse(readFileText(path));
}

void CSensorYaml::insert(const std::string& key, const TValue& value)
{
	if (!m_values.emplace(key, value).second)
		throw CError(
			m_path + ":" + std::to_string(value.line), "key '" + key + "' is given twice", "remove one");
}

void CSensorYaml::parse(const std::string& text)
{
	std::istringstream lines(text);
	std::string parent, line;
	size_t number = 0;
	const auto nextLine = [&] {
		if (!std::getline(lines, line)) return false;
		number++;
		line = line.substr(0, line.find('#'));
		return true;
	};
	while (nextLine()) {
		if (trimmed(line).empty() || isDirective(trimmed(line))) continue;
		const size_t first = number;
		const std::string where = m_path + ":" + std::to_string(first);
		const auto colon = line.find(':');
		if (colon == std::string::npos)
			throw CError(where, "'" + trimmed(line) + "' is no 'key: value'", "mend it");
		const bool top = isTopLevel(line);
		const std::string key = trimmed(line.substr(0, colon));
		std::string value = trimmed(line.substr(colon + 1));
		if (value.compare(0, 2, "!!") == 0) value.clear();	// a type tag, as OpenCV writes
		while (!value.empty() && value[0] == '[' && value.find(']') == std::string::npos) {
			if (!nextLine()) throw CError(where, "the list of '" + key + "' has no end", "close it with ]");
			value += " " + trimmed(line);
		}
		if (top) parent = value.empty() ? key : "";
		if (!top && parent.empty())
			throw CError(where, "'" + key + "' is indented below a value", "mend the indent");
		insert(top ? key : parent + "." + key, {value, first});
	}
}

const CSensorYaml::TValue* CSensorYaml::find(const std::string& key) const
{
	const auto found = m_values.find(key);
	return found == m_values.end() ? nullptr : &found->second;
}

const CSensorYaml::TValue& CSensorYaml::at(const std::string& key) const
{
	if (const TValue* value = find(key)) return *value;
	throw CError(m_path, "has no key '" + key + "'", "add it");
}

std::string CSensorYaml::where(const std::string& key) const
{
	return m_path + ":" + std::to_string(at(key).line);
}

std::string CSensorYaml::text(const std::string& key) const
{
	std::string value = at(key).text;
	const bool quoted = value.size() > 1 && (value[0] == '"' || value[0] == '\'') && value.back() == value[0];
	return quoted ? value.substr(1, value.size() - 2) : value;
}

double CSensorYaml::number(const std::string& key) const
{
	const auto x = parsedNumber(at(key).text);
	if (!x) throw CError(where(key), key + ": '" + at(key).text + "' is not a number", "mend it");
	return *x;
}

std::vector<double> CSensorYaml::numbers(const std::string& key, size_t n) const
{
	const std::string value = at(key).text;
	const std::string wanted = key + ": a list of " + std::to_string(n) + " numbers [a, b, ...] was expected";
	if (value.size() < 2 || value[0] != '[' || value.back() != ']')
		throw CError(where(key), wanted, "mend it");
	std::istringstream words(value.substr(1, value.size() - 2));
	std::vector<double> list;
	for (std::string word; std::getline(words, word, ',');) {
		const auto x = parsedNumber(trimmed(word));
		if (!x) throw CError(where(key), key + ": '" + trimmed(word) + "' is not a number", "mend it");
		list.push_back(*x);
	}
	if (list.size() != n)
		throw CError(where(key), wanted + ", there are " + std::to_string(list.size()), "mend it");
	return list;
}

Isometry3d CSensorYaml::pose(const std::string& key) const
{
	const std::string data = at(key).text.empty() ? key + ".data" : key;
	const auto numbers16 = numbers(data, 16);
	Isometry3d T;
	T.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers16.data());
	const Eigen::Matrix3d R = T.matrix().topLeftCorner<3, 3>();
	const double off = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
	const bool bottom = T.matrix().row(3) == Eigen::RowVector4d(0, 0, 0, 1);
	if (off > 1e-3 || R.determinant() < 0 || !bottom)
		throw CError(
			where(data), key + " is no rigid transformation (rotation, translation, last row 0 0 0 1)",
			"mend it");
	return orthonormalized(T);	// written with few digits
}

std::vector<std::string> CSensorYaml::unknownKeys(const std::vector<std::string>& known) const
{
	std::vector<std::string> messages;
	for (const auto& [key, value] : m_values) {
		const bool is_known =
			std::find(known.begin(), known.end(), key.substr(0, key.find('.'))) != known.end();
		if (!is_known)
			messages.push_back(where(key) + ": key '" + key + "' has no effect; " + didYouMean(key, known));
	}
	return messages;
}
}  // namespace posidonia
