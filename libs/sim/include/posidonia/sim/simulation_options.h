#pragma once

#include <posidonia/obs/geodesy.h>
#include <posidonia/sim/relief.h>
#include <posidonia/sim/renderer.h>
#include <posidonia/sim/sensor_models.h>
#include <posidonia/sim/vehicle_dynamics.h>

namespace posidonia
{
/** Section [Simulation]. */
struct TRunOptions
{
	unsigned seed{1};
	double start_time{1420070400}, duration{0};
	int threads{2};
	std::string save_images{"nodes"};
	double node_distance{0.5};
	bool save_depth{false}, overview{false};
	bool imu{true}, ahrs{true}, dvl{true}, pressure{true}, gps{true}, stereo{true};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.seed("seed", seed, "Every random number follows from it");
		v.number("start_time", start_time, atLeast(0), "UTC of the start [s] (default: 2015-01-01)");
		v.number("duration", duration, atLeast(0), "Length of the log [s]; 0: the whole route");
		v.integer("threads", threads, between(1, 64), "Rendering threads; the bytes do not depend on it");
		v.choice(
			"save_images", save_images, {"all", "nodes"},
			"Keep every stereo pair, or one each node_distance");
		v.number("node_distance", node_distance, above(0), "True travel between kept pairs [m] (paper: 0.5)");
		v.flag("save_depth", save_depth, "Write true depths beside each kept pair: 16-bit PNG, mm, left eye");
		v.flag("overview", overview, "Write a picture of the world from above with the route");
		v.flag("imu", imu, "Simulate the IMU");
		v.flag("ahrs", ahrs, "Simulate the AHRS");
		v.flag("dvl", dvl, "Simulate the DVL");
		v.flag("pressure", pressure, "Simulate the pressure sensor");
		v.flag("gps", gps, "Simulate the GPS");
		v.flag("stereo", stereo, "Simulate the stereo rig");
	}
};

/** Every option of the simulator, by section of the ini. */
struct TSimulationOptions
{
	TRunOptions run;
	TWorldOptions world;
	TRouteOptions route;
	TMotionOptions motion;
	TFloorOptions floor;
	TReliefOptions relief;
	TWaterOptions water;
	TLampOptions lamp;
	TSnowOptions snow;
	TCameraOptions camera;
	TPortOptions port;
	TSimulatedImuOptions imu;
	TSimulatedAhrsOptions ahrs;
	TSimulatedDvlOptions dvl;
	TSimulatedPressureOptions pressure;
	TSimulatedGpsOptions gps;
	TCalibrationErrorOptions calibration_error;
	TVehicleOptions vehicle;
	TThrusterOptions thrusters;
	TCurrentOptions current;

	/** f(section name, options struct) for each section. */
	template <class F>
	void forEachSection(F&& f)
	{
		f("Simulation", run);
		f("World", world);
		f("Route", route);
		f("Motion", motion);
		f("Floor", floor);
		f("Relief", relief);
		f("Water", water);
		f("Lamp", lamp);
		f("MarineSnow", snow);
		f("Camera", camera);
		f("Port", port);
		f("SimulatedImu", imu);
		f("SimulatedAhrs", ahrs);
		f("SimulatedDvl", dvl);
		f("SimulatedPressure", pressure);
		f("SimulatedGps", gps);
		f("CalibrationError", calibration_error);
		f("Vehicle", vehicle);
		f("Thrusters", thrusters);
		f("Current", current);
	}
};
}  // namespace posidonia
