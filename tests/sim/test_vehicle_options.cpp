#include <posidonia/sim/simulation_options.h>

#include "vehicle_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
TSimulationOptions loaded(const std::string& text)
{
	CIniFile ini = CIniFile::fromText(text, "x.ini");
	TSimulationOptions o;
	o.forEachSection([&](const char* section, auto& options) { ini.loadOnto(options, section); });
	ini.refuseUnknown();
	return o;
}
}  // namespace

TEST(VehicleOptions, LoadFromTheirSections)
{
	const auto o = loaded(
		"[Vehicle]\nmass = 60\nadded_mass = 1 2 3 4 5 6\n[Thrusters]\ndead_band = 0.1\n"
		"[Current]\nspeed = 0.2\ndirection = 90\n");
	EXPECT_EQ(o.vehicle.mass, 60);
	EXPECT_EQ(o.vehicle.added_mass, (std::vector<double>{1, 2, 3, 4, 5, 6}));
	EXPECT_EQ(o.thrusters.dead_band, 0.1);
	EXPECT_NEAR(o.current.direction, M_PI / 2, 1e-15);
}

TEST(VehicleOptions, NonsenseIsRefusedWithSectionAndKey)
{
	const std::pair<const char*, const char*> cases[] = {
		{"[Vehicle]\nmass = 0\n", "[Vehicle] mass"},
		{"[Vehicle]\nquadratic_damping = 1 2 3 4 5 -6\n", "[Vehicle] quadratic_damping"},
		{"[Vehicle]\nadded_mass = 1 2 3\n", "[Vehicle] added_mass"},
		{"[Vehicle]\nstep = 1\n", "[Vehicle] step"},
		{"[Vehicle]\nhull_radius = -0.1\n", "[Vehicle] hull_radius"},
		{"[Thrusters]\ntime_constant = 0.8 0 0.4\n", "[Thrusters] time_constant"},
		{"[Thrusters]\ndead_band = 1\n", "[Thrusters] dead_band"},
		{"[Thrusters]\nslew_rate = 0\n", "[Thrusters] slew_rate"},
		{"[Current]\nspeed = -1\n", "[Current] speed"},
		{"[Current]\ngust_time = 0\n", "[Current] gust_time"},
		{"[Current]\ngust = 1\n", "unknown key 'gust'"},
	};
	for (const auto& [text, words] : cases)
		expectRefused([&, t = text] { loaded(t); }, {"x.ini", words});
}

/** Every key changes how the vehicle moves. */
TEST(VehicleOptions, EveryKeyChangesTheMotion)
{
	const auto end_of = [](const TSimulationOptions& o) {
		CVehicleDynamics vehicle(o.vehicle, o.thrusters, o.current, 0.5, 1, poseAt(0.15));
		vehicle.setVelocity({0.5, 0.1, 0.3}, {0.2, 0.1, 0.3});
		vehicle.setSetPoints({0.9, -0.4, 0.04});
		vehicle.advanceTo(3);
		vehicle.setAddedCurrent({0.1, 0, 0});
		vehicle.setSetPoints({0.9, -0.4, 1});
		const TVehicleState s = stateAfter(vehicle, 8);
		return std::vector<double>(s.T_map_body.data(), s.T_map_body.data() + 16);
	};
	const auto windy = [] {
		TSimulationOptions o;
		o.current.speed = 0.1, o.current.gust_speed = 0.05;
		return o;
	};
	const auto reference = end_of(windy());
	const std::pair<const char*, std::vector<const char*>> keys[] = {
		{"Vehicle",
		 {"mass = 53", "buoyancy_mass = 53", "centre_of_gravity = 0.01 0 0", "centre_of_buoyancy = 0 0 -0.03",
		  "inertia = 0.5 10.42 10.47", "inertia_xz = 0.1", "added_mass = 3 70.4 69.2 0.42 16.2 16.2",
		  "added_mass_sway_yaw = 0", "added_mass_heave_pitch = 0", "linear_damping = 9 30 30 1 5 5",
		  "quadratic_damping = 37 96 89 0.1 15 15", "stern_lift = 40", "stern_position = -0.5",
		  "hull_length = 1.5", "hull_radius = 0.12", "floor_stiffness = 1e4", "step = 0.004"}},
		{"Thrusters",
		 {"starboard_position = -0.573 0.15 0", "port_position = -0.573 -0.16 0",
		  "heave_position = 0.01 0 0.07", "max_forward = 70 71.5 55", "max_reverse = 30 31 28.5",
		  "time_constant = 0.7 0.8 0.4", "dead_band = 0.03", "slew_rate = 3", "zero_thrust_speed = 5"}},
		{"Current",
		 {"speed = 0.2", "direction = 10", "shear = 0.01", "gust_speed = 0.1", "gust_time = 20",
		  "onset = 1"}},
	};
	for (const auto& [section, lines] : keys)
		for (const char* line : lines) {
			CIniFile ini = CIniFile::fromText("[" + std::string(section) + "]\n" + line + "\n");
			TSimulationOptions o = windy();
			o.forEachSection([&](const char* name, auto& options) { ini.loadOnto(options, name); });
			EXPECT_NE(end_of(o), reference) << section << ": " << line;
		}
	TSimulationOptions all;
	size_t count = 0;
	all.forEachSection([&](const std::string& name, auto& options) {
		if (name == "Vehicle" || name == "Thrusters" || name == "Current")
			count += listOptions(options).size();
	});
	EXPECT_EQ(count, keys[0].second.size() + keys[1].second.size() + keys[2].second.size())
		<< "a key untested";
}
