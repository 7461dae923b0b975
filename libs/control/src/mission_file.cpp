#include "step_keys.h"

#include <posidonia/base/error.h>
#include <posidonia/base/ini_file.h>
#include <posidonia/control/mission.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
using Eigen::Vector2d;

namespace
{
/** Reads one [Step.N] after the other. */
class CStepReader
{
   public:
	CStepReader(CIniFile& ini, const TDatumConverter& fromGeodetic, TMission& mission)
		: m_ini(ini), m_from_geodetic(fromGeodetic), m_mission(mission)
	{
	}
	void read(const std::string& section);

   private:
	[[noreturn]] void fail(
		const std::string& key, const std::string& problem, const std::string& way_out) const
	{
		throw CError(m_ini.name(), "[" + m_section + "] " + key + ": " + problem, way_out);
	}
	void readVertical(TStep& step);
	std::vector<Vector2d> readPoints(size_t min, size_t max);
	std::vector<Vector2d> readLawnMower();
	void readLegs(const std::string& kind, TStep step);
	void readHold(TStep step);
	void append(const TStep& step) { m_mission.steps.push_back(step); }

	CIniFile& m_ini;
	const TDatumConverter& m_from_geodetic;
	TMission& m_mission;
	std::string m_section;
};

void CStepReader::readVertical(TStep& step)
{
	TStepKeys keys;
	keys.vertical_speed = m_mission.options.vertical_speed;
	keys.tolerance_z = m_mission.options.tolerance_z;
	m_ini.loadOnto(keys, m_section);
	step.vertical_speed = keys.vertical_speed;
	step.tolerance_z = keys.tolerance_z;
	if (keys.depth.size() > 1) fail("depth", "must be one number", "");
	if (keys.altitude.size() > 1) fail("altitude", "must be one number", "");
	if (!keys.depth.empty() && !keys.altitude.empty())
		fail("altitude", "is given besides depth", "give one of them");
	if (!keys.depth.empty()) {
		step.altitude_mode = false;
		step.depth = keys.depth[0];
	}
	if (!keys.altitude.empty()) {
		step.altitude_mode = true;
		step.altitude = keys.altitude[0];
	}
}

std::vector<Vector2d> CStepReader::readPoints(size_t min, size_t max)
{
	const auto keys = m_ini.load<TPointKeys>(m_section);
	const bool geodetic = !keys.geodetic_points.empty();
	const std::string key = geodetic ? "geodetic_points" : "points";
	if (geodetic && !keys.points.empty()) fail(key, "is given besides points", "give one of them");
	if (geodetic && !m_from_geodetic) fail(key, "there is no datum", "give points in north east [m]");
	const auto& numbers = geodetic ? keys.geodetic_points : keys.points;
	if (numbers.size() % 2 != 0)
		fail(key, std::to_string(numbers.size()) + " numbers are no list of pairs", "write two a point");
	std::vector<Vector2d> points;
	for (size_t i = 0; i < numbers.size(); i += 2)
		points.push_back(
			geodetic ? m_from_geodetic(numbers[i], numbers[i + 1]) : Vector2d(numbers[i], numbers[i + 1]));
	if (points.size() < min || points.size() > max)
		fail(
			key, std::to_string(points.size()) + " points",
			min == max ? "this kind of step takes one"
					   : "this kind takes at most one, or a route at least one");
	return points;
}

std::vector<Vector2d> CStepReader::readLawnMower()
{
	const Vector2d corner = readPoints(1, 1)[0];
	const auto keys = m_ini.load<TLawnMowerKeys>(m_section);
	const Vector2d ahead(std::cos(keys.heading), std::sin(keys.heading));
	const Vector2d starboard(-ahead.y(), ahead.x());
	std::vector<Vector2d> points;
	for (int track = 0; track < keys.tracks; track++) {
		const Vector2d near = corner + track * keys.spacing * starboard;
		const Vector2d far = near + keys.length * ahead;
		points.push_back(track % 2 == 0 ? near : far);
		points.push_back(track % 2 == 0 ? far : near);
	}
	return points;
}

void CStepReader::readLegs(const std::string& kind, TStep step)
{
	TLegKeys keys{m_mission.options.speed, m_mission.options.tolerance_xy};
	m_ini.loadOnto(keys, m_section);
	step.speed = keys.speed;
	step.tolerance_xy = keys.tolerance_xy;
	step.timeout = m_ini.load<TTimeoutKeys>(m_section).timeout;
	const bool single = kind == "goto" || kind == "section";
	const auto points = kind == "lawn-mower" ? readLawnMower() : readPoints(1, single ? 1 : 100000);
	step.kind = kind == "goto" ? EStepKind::GOTO : EStepKind::SECTION;
	step.has_end = true;
	for (size_t leg = 0; leg < points.size(); leg++) {
		step.end = points[leg];
		if (!single)
			step.name =
				m_section + " " + kind + " " + std::to_string(leg + 1) + "/" + std::to_string(points.size());
		append(step);
	}
}

void CStepReader::readHold(TStep step)
{
	step.duration = m_ini.load<THoldKeys>(m_section).duration;
	const auto points = readPoints(0, 1);
	step.has_end = !points.empty();
	if (step.has_end) step.end = points[0];
	append(step);
}

void CStepReader::read(const std::string& section)
{
	m_section = section;
	TStep step;
	if (!m_mission.steps.empty()) {
		const TStep& before = m_mission.steps.back();
		step.altitude_mode = before.altitude_mode;
		step.depth = before.depth;
		step.altitude = before.altitude;
	}
	readVertical(step);
	const std::string kind = m_ini.load<TStepKeys>(section).kind;
	step.name = section + " " + kind;
	if (kind == "hold") return readHold(step);
	if (kind != "dive" && kind != "surface") return readLegs(kind, step);
	step.kind = kind == "dive" ? EStepKind::DIVE : EStepKind::SURFACE;
	step.timeout = m_ini.load<TTimeoutKeys>(section).timeout;
	if (step.kind == EStepKind::SURFACE) {
		step.altitude_mode = false;
		step.depth = 0;
	}
	append(step);
}

/** Sections "Step.1" ... "Step.n"; throws when one is missing. */
size_t countSteps(const CIniFile& ini)
{
	const auto sections = ini.sections();
	const auto isStep = [](const std::string& name) { return name.compare(0, 5, "Step.") == 0; };
	const auto n = static_cast<size_t>(std::count_if(sections.begin(), sections.end(), isStep));
	for (size_t i = 1; i <= n; i++)
		if (std::find(sections.begin(), sections.end(), "Step." + std::to_string(i)) == sections.end())
			throw CError(
				ini.name(),
				"there are " + std::to_string(n) + " steps but no section [Step." + std::to_string(i) + "]",
				"number the steps 1, 2, 3 ...");
	return n;
}
}  // namespace

TMission loadMission(CIniFile& ini, const TDatumConverter& fromGeodetic)
{
	TMission mission;
	mission.file = ini.name();
	mission.options = ini.load<TMissionOptions>("Mission");
	CStepReader reader(ini, fromGeodetic, mission);
	const size_t n = countSteps(ini);
	for (size_t i = 1; i <= n; i++)
		reader.read("Step." + std::to_string(i));
	return mission;
}
}  // namespace posidonia
