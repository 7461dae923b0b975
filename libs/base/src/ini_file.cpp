#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/base/ini_file.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

namespace posidonia
{
namespace
{
std::string trimmed(const std::string& s)
{
	const auto first = s.find_first_not_of(" \t\r\n");
	if (first == std::string::npos) return {};
	return s.substr(first, s.find_last_not_of(" \t\r\n") - first + 1);
}

/** The whole of `raw` as a number, or NaN; locale-independent. */
double wholeNumber(const std::string& raw)
{
	double x = 0;
	const bool plus = raw.size() > 1 && raw[0] == '+' && raw[1] != '-';
	const char* first = raw.data() + (plus ? 1 : 0);
	const auto result = std::from_chars(first, raw.data() + raw.size(), x);
	const bool whole = result.ec == std::errc() && result.ptr == raw.data() + raw.size();
	return whole ? x : std::nan("");
}

/** Throws for what MRPT's parser passes over in silence: lines that are no assignment, and a key given twice.
 */
void checkLines(const std::string& text, const std::string& name)
{
	std::istringstream lines(text);
	std::set<std::string> seen;
	std::string section, line;
	bool continued = false;
	for (int number = 1; std::getline(lines, line); number++) {
		line = trimmed(line);
		const bool continues = !line.empty() && line.back() == '\\';
		const bool skip = std::exchange(continued, continues) || line.empty() || line[0] == '#' ||
						  line[0] == ';' || line[0] == '@' || line.compare(0, 2, "//") == 0;
		if (skip) continue;
		const auto equals = line.find('=');
		const std::string where = name + ":" + std::to_string(number);
		if (line[0] == '[')
			section = line.substr(0, line.find(']'));
		else if (equals == std::string::npos)
			throw CError(
				where, "'" + line + "' is no assignment", "write key = value, or // before a comment");
		else if (!seen.insert(section + "]" + trimmed(line.substr(0, equals))).second)
			throw CError(
				where, section + "] " + trimmed(line.substr(0, equals)) + " is given twice", "remove one");
	}
}

/** MRPT takes a comment line "// a = b" for the key "// a": such lines are blanked. */
std::string withoutSlashComments(const std::string& text)
{
	std::istringstream lines(text);
	std::string out;
	for (std::string line; std::getline(lines, line);)
		out += (trimmed(line).compare(0, 2, "//") == 0 ? "" : line) + "\n";
	return out;
}

/** The sentence of an MRPT exception, without its stack trace. */
std::string messageOf(const std::exception& problem)
{
	std::string text = problem.what();
	const auto from = text.find("Message:");
	if (from != std::string::npos) text = text.substr(from + 8);
	return trimmed(text.substr(0, text.find('\n', 1)));
}
}  // namespace

CIniFile CIniFile::fromFile(const std::string& path)
{
	requireFile(path, "give an existing ini file with -c/--config");
	return fromText(readFileText(path), path);
}

CIniFile CIniFile::fromText(const std::string& text, const std::string& name)
{
	CIniFile file;
	file.m_name = name;
	checkLines(text, name);
	try {
		file.m_config.setContent(withoutSlashComments(text));  // expands @define, ${} and $eval{}
	}
	catch (const std::exception& problem) {
		throw CError(name, messageOf(problem), "check its @define, ${...} and $eval{...}");
	}
	return file;
}

void CIniFile::set(const std::string& assignment)
{
	const auto equals = assignment.find('=');
	const auto dot = assignment.rfind('.', equals);	 // sections may hold dots: Sensor.DVL.sigma_velocity=...
	if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 >= equals)
		throw CUsageError("--set " + assignment, "is not an assignment", "write --set Section.key=value");
	m_config.write(
		trimmed(assignment.substr(0, dot)), trimmed(assignment.substr(dot + 1, equals - dot - 1)),
		trimmed(assignment.substr(equals + 1)));
}

std::vector<std::string> CIniFile::sections() const
{
	std::vector<std::string> names;
	m_config.getAllSections(names);
	return names;
}

void CIniFile::remember(const std::string& section, const std::vector<TOptionDoc>& rows)
{
	if (!m_known.count(section)) m_section_order.push_back(section);
	auto& known = m_known[section];
	for (const auto& row : rows)  // loaded again: the last value counts
	{
		const auto same = [&](const TOptionDoc& other) { return other.key == row.key; };
		const auto found = std::find_if(known.begin(), known.end(), same);
		if (found == known.end())
			known.push_back(row);
		else
			*found = row;
	}
}

void CIniFile::refuseUnknown() const
{
	for (const auto& section : sections()) {
		std::vector<std::string> keys;
		m_config.getAllKeys(section, keys);
		const auto known = m_known.find(section);
		if (known == m_known.end())
			throw CError(m_name, "unknown section [" + section + "]", didYouMean(section, m_section_order));
		std::vector<std::string> names;
		for (const auto& row : known->second)
			names.push_back(row.key);
		for (const auto& key : keys)
			if (std::find(names.begin(), names.end(), key) == names.end())
				throw CError(m_name, "[" + section + "] unknown key '" + key + "'", didYouMean(key, names));
	}
}

std::string CIniFile::dump() const
{
	std::ostringstream out;
	for (const auto& section : m_section_order) {
		out << "[" << section << "]\n";
		for (const auto& row : m_known.at(section))
			out << "// " << row.text << " (" << row.range << ")\n" << row.key << " = " << row.value << "\n";
		out << "\n";
	}
	return out.str();
}

bool CIniFile::CReader::find(const char* key, std::string& raw)
{
	if (!m_file.m_config.keyExists(m_section, key)) return false;
	raw = trimmed(m_file.m_config.read_string(m_section, key, ""));
	return true;
}

void CIniFile::CReader::fail(const char* key, const std::string& raw, const std::string& problem) const
{
	throw CError(m_file.m_name, "[" + m_section + "] " + key + " = " + raw + ": " + problem, "");
}

double CIniFile::CReader::parse(const char* key, const std::string& raw, const TRange& range) const
{
	const double x = wholeNumber(raw);
	if (!std::isfinite(x)) fail(key, raw, "is not a number");
	if (!range.holds(x)) fail(key, raw, range.text());
	return x;
}

void CIniFile::CReader::number(const char* key, double& value, const TRange& range, const char*)
{
	std::string raw;
	if (find(key, raw)) value = parse(key, raw, range);
}

void CIniFile::CReader::degrees(const char* key, double& radians, const TRange& range_deg, const char*)
{
	std::string raw;
	if (find(key, raw)) radians = parse(key, raw, range_deg) * M_PI / 180.0;
}

void CIniFile::CReader::integer(const char* key, int& value, const TRange& range, const char*)
{
	std::string raw;
	if (!find(key, raw)) return;
	const double x = parse(key, raw, range);
	if (x != std::floor(x) || std::abs(x) > 2e9) fail(key, raw, "must be a whole number");
	value = static_cast<int>(x);
}

void CIniFile::CReader::seed(const char* key, unsigned& value, const char*)
{
	std::string raw;
	if (!find(key, raw)) return;
	const double x = parse(key, raw, between(0, 4294967295.0));
	if (x != std::floor(x)) fail(key, raw, "must be a whole number");
	value = static_cast<unsigned>(x);
}

void CIniFile::CReader::flag(const char* key, bool& value, const char*)
{
	std::string raw;
	if (!find(key, raw)) return;
	if (raw != "true" && raw != "false") fail(key, raw, "must be true or false");
	value = raw == "true";
}

void CIniFile::CReader::text(const char* key, std::string& value, const char*)
{
	std::string raw;
	if (find(key, raw)) value = raw;
}

void CIniFile::CReader::choice(
	const char* key, std::string& value, const std::vector<std::string>& names, const char*)
{
	std::string raw;
	if (!find(key, raw)) return;
	if (std::find(names.begin(), names.end(), raw) == names.end()) fail(key, raw, didYouMean(raw, names));
	value = raw;
}

void CIniFile::CReader::numbers(
	const char* key, std::vector<double>& values, size_t n, const TRange& range, const char*)
{
	std::string raw;
	if (!find(key, raw)) return;
	std::istringstream words(raw);
	std::vector<double> read;
	for (std::string word; words >> word;)
		read.push_back(parse(key, word, range));
	if (n && read.size() != n) fail(key, raw, "must be " + std::to_string(n) + " numbers");
	values = read;
}
}  // namespace posidonia
