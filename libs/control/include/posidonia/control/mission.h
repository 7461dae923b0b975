#pragma once

#include <posidonia/base/options.h>
#include <posidonia/control/safety_options.h>

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

namespace posidonia
{
class CIniFile;

/** What the vehicle does in a step. */
enum class EStepKind
{
	GOTO,	  ///< To a point, along the line from wherever it is when the step starts
	SECTION,  ///< To a point, along the line from the end of the step before
	DIVE,	  ///< To a depth or altitude, on the spot
	HOLD,	  ///< Keeps station for a time
	SURFACE	  ///< Up to the surface, on the spot
};
std::string toString(EStepKind kind);

/** One step of a mission, after routes and lawn-mowers were expanded. */
struct TStep
{
	EStepKind kind{EStepKind::HOLD};
	std::string name;							  ///< Where it comes from: "Step.2 (route, leg 5)"
	Eigen::Vector2d end{0, 0};					  ///< GOTO, SECTION, HOLD with a point: north east [m]
	bool has_end{false};						  ///< False: stays where it is when the step starts
	bool altitude_mode{false};					  ///< Keeps `altitude` over the floor instead of `depth`
	double depth{0}, altitude{0};				  ///< [m]
	double speed{0.3};							  ///< Over ground along the line [m/s]
	double vertical_speed{0.2};					  ///< Of the depth reference [m/s]
	double tolerance_xy{0.15}, tolerance_z{0.1};  ///< [m]
	double timeout{0};							  ///< [s]; 0: defaultTimeout() when the step starts
	double duration{0};							  ///< HOLD [s]

	bool isLeg() const { return kind == EStepKind::GOTO || kind == EStepKind::SECTION; }
};

/** Section [Mission]: defaults of all steps, and limits. */
struct TMissionOptions
{
	double speed{0.3}, vertical_speed{0.2}, tolerance_xy{0.15}, tolerance_z{0.1};
	double timeout{3600}, max_distance{300};
	std::string on_timeout{"next"};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("speed", speed, above(0), "Speed over ground of steps that give none [m/s] (paper: 0.3)");
		v.number("vertical_speed", vertical_speed, above(0), "Vertical speed of steps that give none [m/s]");
		v.number(
			"tolerance_xy", tolerance_xy, above(0), "A point is reached within this horizontal distance [m]");
		v.number("tolerance_z", tolerance_z, above(0), "... and within this vertical distance [m]");
		v.number("timeout", timeout, above(0), "The whole mission is aborted after this time [s]");
		v.number(
			"max_distance", max_distance, above(0),
			"Longest leg allowed [m]: catches a wrong datum (COLA2: 300)");
		v.choice(
			"on_timeout", on_timeout, {"next", "abort"},
			"A step that times out: go on, or abort and surface");
	}
};

struct TMission
{
	std::string file;  ///< Where it was read, for errors
	TMissionOptions options;
	std::vector<TStep> steps;
};

/** Time-out of a step over `distance` and `climb` [m]: 2 max(sqrt2 d / u, dz / min(0.3, w)) + 30 s (COLA2
 * G2), and as long as a HOLD lasts. */
double defaultTimeout(const TStep& step, double distance, double climb);

/** North east [m] in map of latitude and longitude [deg]. */
using TDatumConverter = std::function<Eigen::Vector2d(double latitude, double longitude)>;

/** Reads [Mission], [Step.1], [Step.2] ... of `ini` (which may hold other sections too; the caller calls
 * refuseUnknown()). Kinds: goto, section, route, lawn-mower, dive, hold, surface (README.md lists their
 * keys). Routes and lawn-mowers become sections. A step without depth or altitude keeps that of the step
 * before. Throws CError naming file, section and key. */
TMission loadMission(CIniFile& ini, const TDatumConverter& fromGeodetic);

/** Before the start: steps there are, all points inside the cage, no set-point below max_depth or under
 * min_altitude, no leg longer than max_distance. `start`: where the mission begins, north east [m].
 * Throws CError naming the step. */
void checkMission(const TMission& mission, const TSafetyOptions& limits, const Eigen::Vector2d& start);
}  // namespace posidonia
