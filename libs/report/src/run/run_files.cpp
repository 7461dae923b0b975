#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/data_lines.h>
#include <posidonia/report/run_files.h>

#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>

namespace posidonia
{
namespace
{
std::string number(double value, const char* format)
{
	char text[64];
	std::snprintf(text, sizeof text, format, value);
	return text;
}

/** The lines below a header that must be `header`. */
std::vector<TDataLine> linesUnder(const std::string& header, const std::string& path)
{
	std::vector<TDataLine> lines = readDataLines(path);
	if (lines.empty() || lines[0].text != header)
		throw CError(path, "does not begin with the header " + header, "let the app write it again");
	lines.erase(lines.begin());
	return lines;
}

std::vector<std::string> cellsOf(const TDataLine& line, size_t wanted)
{
	const auto cells = line.cellsByComma();
	if (cells.size() != wanted)
		line.fail(
			std::to_string(cells.size()) + " cells instead of " + std::to_string(wanted),
			"let the app write it again");
	return cells;
}
}  // namespace

// ------------------------------------------------------------------------------------------------- run.json

std::string runInfoJson(const TRunInfo& i)
{
	const nlohmann::ordered_json json{
		{"app", i.app},
		{"title", i.title},
		{"versions", i.versions},
		{"truth", i.truth},
		{"interrupted", i.interrupted},
		{"start", i.start},
		{"duration", i.duration},
		{"latitude", i.datum.latitude},
		{"longitude", i.datum.longitude}};
	return json.dump(1, '\t') + "\n";
}

TRunInfo readRunInfo(const std::string& path)
{
	try {
		const auto json = nlohmann::json::parse(readFileText(path));
		TRunInfo i;
		json.at("app").get_to(i.app);
		json.at("title").get_to(i.title);
		json.at("versions").get_to(i.versions);
		json.at("truth").get_to(i.truth);
		json.at("interrupted").get_to(i.interrupted);
		json.at("start").get_to(i.start);
		json.at("duration").get_to(i.duration);
		json.at("latitude").get_to(i.datum.latitude);
		json.at("longitude").get_to(i.datum.longitude);
		return i;
	}
	catch (const nlohmann::json::exception& problem) {
		throw CError(path, problem.what(), "let the app write it again");
	}
}

// ------------------------------------------------------------------------------------------------ poses.csv

namespace
{
/** Names of the upper triangle of a covariance over north, east, down, and rotations about them. */
std::string covarianceHeader()
{
	const std::string axes[] = {"n", "e", "d", "rn", "re", "rd"};
	std::string text;
	for (int i = 0; i < 6; i++)
		for (int j = i; j < 6; j++)
			text += ",c_" + axes[i] + "_" + axes[j];
	return text;
}
const std::string kNodesHeader =
	"node,stamp,north,east,down,qx,qy,qz,qw,roll_deg,pitch_deg,yaw_deg,points,altitude,picture" +
	covarianceHeader();
constexpr size_t kFirstCovariance = 15, kNodeCells = kFirstCovariance + 21;
}  // namespace

Matrix6d covarianceInMap(const Eigen::Isometry3d& T_map_body, const Matrix6d& covariance)
{
	Matrix6d turn = Matrix6d::Zero();
	turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = T_map_body.linear();
	return turn * covariance * turn.transpose();
}

std::string nodesCsv(const std::vector<TNodeRow>& rows)
{
	std::string csv = kNodesHeader + "\n";
	for (const TNodeRow& row : rows) {
		csv += std::to_string(row.node) + number(row.stamp, ",%.9f");
		for (const double v : row.T_map_body.translation())
			csv += number(v, ",%.9f");
		Eigen::Quaterniond q(row.T_map_body.linear());
		if (q.w() < 0) q.coeffs() = -q.coeffs();
		for (const double v : q.coeffs())
			csv += number(v, ",%.12f");
		const Eigen::Vector3d ypr = yawPitchRoll(row.T_map_body.linear()) * (180 / M_PI);
		csv += number(ypr[2], ",%.6f") + number(ypr[1], ",%.6f") + number(ypr[0], ",%.6f");
		csv += "," + std::to_string(row.points) + number(row.altitude, ",%.4f") + "," + row.picture;
		for (int i = 0; i < 6; i++)
			for (int j = i; j < 6; j++)
				csv += number(row.covariance(i, j), ",%.9g");
		csv += "\n";
	}
	return csv;
}

std::vector<TNodeRow> readNodes(const std::string& path)
{
	std::vector<TNodeRow> rows;
	for (const TDataLine& line : linesUnder(kNodesHeader, path)) {
		const auto cells = cellsOf(line, kNodeCells);
		TNodeRow row;
		row.node = static_cast<int>(line.whole(cells[0]));
		row.stamp = line.real(cells[1]);
		for (size_t i = 0; i < 3; i++)
			row.T_map_body.translation()[static_cast<int>(i)] = line.real(cells[2 + i]);
		row.T_map_body.linear() =
			line.rotation(line.real(cells[5]), line.real(cells[6]), line.real(cells[7]), line.real(cells[8]));
		row.points = static_cast<int>(line.whole(cells[12]));
		row.altitude = line.real(cells[13]);
		row.picture = cells[14];
		size_t next = kFirstCovariance;
		for (int i = 0; i < 6; i++)
			for (int j = i; j < 6; j++)
				row.covariance(i, j) = row.covariance(j, i) = line.real(cells[next++]);
		rows.push_back(row);
	}
	return rows;
}

// ---------------------------------------------------------------------------------------------- matches.csv

namespace
{
const std::string kMatchesHeader = "from,to,chi2,points";
}

std::string matchesCsv(const std::vector<TMatchesRow>& rows)
{
	std::string csv = kMatchesHeader + "\n";
	for (const TMatchesRow& row : rows) {
		csv += std::to_string(row.from) + "," + std::to_string(row.to) + number(row.chi2, ",%.6g,");
		const char* separator = "";
		for (const auto& [a, b] : row.points) {
			csv += separator + number(a.x(), "%.0f") + number(a.y(), " %.0f") + number(b.x(), " %.0f") +
				   number(b.y(), " %.0f");
			separator = " ";
		}
		csv += "\n";
	}
	return csv;
}

std::vector<TMatchesRow> readMatches(const std::string& path)
{
	std::vector<TMatchesRow> rows;
	for (const TDataLine& line : linesUnder(kMatchesHeader, path)) {
		const auto cells = cellsOf(line, 4);
		TMatchesRow row;
		row.from = static_cast<int>(line.whole(cells[0]));
		row.to = static_cast<int>(line.whole(cells[1]));
		row.chi2 = line.real(cells[2]);
		const auto numbers = TDataLine{line.path, line.number, cells[3]}.cellsByBlank();
		if (numbers.size() % 4 != 0)
			line.fail("points are not four numbers each", "let the app write it again");
		for (size_t k = 0; k < numbers.size(); k += 4)
			row.points.push_back(
				{{line.real(numbers[k]), line.real(numbers[k + 1])},
				 {line.real(numbers[k + 2]), line.real(numbers[k + 3])}});
		rows.push_back(row);
	}
	return rows;
}

// -------------------------------------------------------------------------------- sensors.csv and the others

namespace
{
const std::string kSensorsHeader = "sensor,used,rate_hz,longest_gap_s,rejected",
				  kTimingsHeader = "stage,calls,mean_ms,max_ms,total_s,ms_per_node",
				  kEventsHeader = "t,kind,text";
}

std::string sensorsCsv(const std::vector<TSensorRow>& rows)
{
	std::string csv = kSensorsHeader + "\n";
	for (const TSensorRow& row : rows) {
		csv += row.name + "," + std::to_string(row.used) + number(row.rate, ",%.4g") +
			   number(row.longest_gap, ",%.4g,");
		const char* separator = "";
		for (const auto& [reason, count] : row.rejected) {
			csv += separator + reason + "=" + std::to_string(count);
			separator = ";";
		}
		csv += "\n";
	}
	return csv;
}

std::vector<TSensorRow> readSensorRows(const std::string& path)
{
	std::vector<TSensorRow> rows;
	for (const TDataLine& line : linesUnder(kSensorsHeader, path)) {
		const auto cells = cellsOf(line, 5);
		TSensorRow row{
			cells[0],
			static_cast<size_t>(line.whole(cells[1])),
			line.real(cells[2]),
			line.real(cells[3]),
			{}};
		for (size_t start = 0; start < cells[4].size();) {
			const size_t end = std::min(cells[4].find(';', start), cells[4].size());
			const std::string pair = cells[4].substr(start, end - start);
			const size_t equals = pair.find('=');
			if (equals == std::string::npos)
				line.fail("'" + pair + "' is not reason=count", "let the app write it again");
			row.rejected[pair.substr(0, equals)] = static_cast<size_t>(line.whole(pair.substr(equals + 1)));
			start = end + 1;
		}
		rows.push_back(row);
	}
	return rows;
}

std::vector<TTimingRow> readTimings(const std::string& path)
{
	std::vector<TTimingRow> rows;
	for (const TDataLine& line : linesUnder(kTimingsHeader, path)) {
		const auto cells = cellsOf(line, 6);
		rows.push_back(
			{cells[0], static_cast<size_t>(line.whole(cells[1])), line.real(cells[2]), line.real(cells[3]),
			 line.real(cells[4])});
	}
	return rows;
}

std::vector<TEventRow> readEvents(const std::string& path)
{
	std::vector<TEventRow> rows;
	for (const TDataLine& line : linesUnder(kEventsHeader, path)) {
		const size_t first = line.text.find(','), second = line.text.find(',', first + 1);
		if (second == std::string::npos || line.text.size() < second + 3)
			line.fail("is not t,kind,\"text\"", "let the app write it again");
		rows.push_back(
			{line.real(line.text.substr(0, first)), line.text.substr(first + 1, second - first - 1),
			 line.text.substr(second + 2, line.text.size() - second - 3)});
	}
	return rows;
}

const std::vector<double>& TNumberTable::column(const std::string& name) const
{
	const auto found = columns.find(name);
	if (found == columns.end()) throw CError("column " + name, "is not there", "let the app write it again");
	return found->second;
}

TNumberTable readNumberTable(const std::string& path)
{
	const std::vector<TDataLine> lines = readDataLines(path);
	if (lines.empty()) throw CError(path, "is empty", "let the app write it again");
	const auto names = lines[0].cellsByComma();
	std::vector<std::vector<double>> values(names.size());
	for (size_t k = 1; k < lines.size(); k++) {
		const auto cells = cellsOf(lines[k], names.size());
		for (size_t c = 0; c < cells.size(); c++) {
			double value = std::numeric_limits<double>::quiet_NaN();
			std::from_chars(cells[c].data(), cells[c].data() + cells[c].size(), value);
			values[c].push_back(value);
		}
	}
	TNumberTable table;
	for (size_t c = 0; c < names.size(); c++)
		table.columns[names[c]] = std::move(values[c]);
	return table;
}
}  // namespace posidonia
