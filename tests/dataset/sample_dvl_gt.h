#pragma once

#include <posidonia/dataset/import_dataset.h>
#include <posidonia/geometry/se3.h>
#include <posidonia/obs/geodesy.h>
#include <temp_folder.h>

#include <cstdio>

namespace posidonia::testing
{
/** A vehicle on a circle of 30 m that descends, rolled and pitched, as DVL.csv and GT.csv: `n` rows, `dt` [s]
 * apart. */
class CSampleDvlGt
{
   public:
	static constexpr const char* kDvlHeader = "Time [s],DVL X [m/s],DVL Y [m/s],DVL Z [m/s]\n";
	static constexpr const char* kTruthHeader =
		"Time [s],Longitude [rad],Latitude [rad],Altitude [m],V North [m/s],V East [m/s],V Down [m/s],"
		"Roll [rad],Pitch [rad],Yaw [rad]\n";
	static constexpr double kRadius = 30, kRate = 0.05, kDescent = 0.1, kRoll = 0.05, kPitch = -0.1;
	static TWorldOptions datum() { return {32.5, 34.75}; }

	explicit CSampleDvlGt(int rows = 60, double dt_s = 1) : n(rows), dt(dt_s) { write(); }

	/** T_map_body at a time; it starts at the datum, 5 m deep, to the north. */
	static Eigen::Isometry3d pose(double t)
	{
		Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
		const double yaw = kRate * t;
		T.translation() << kRadius * std::sin(yaw), kRadius * (1 - std::cos(yaw)), 5 + kDescent * t;
		T.linear() = rotationFromYawPitchRoll(yaw, kPitch, kRoll);
		return T;
	}
	/** In map [m/s]. */
	static Eigen::Vector3d velocity(double t)
	{
		const double yaw = kRate * t, speed = kRadius * kRate;
		return {speed * std::cos(yaw), speed * std::sin(yaw), kDescent};
	}
	static std::string dvlRow(double t)
	{
		const Eigen::Vector3d v = pose(t).linear().transpose() * velocity(t);
		return row({t, v.x(), v.y(), v.z()});
	}
	static std::string truthRow(double t)
	{
		const Eigen::Isometry3d T = pose(t);
		const TGeodetic g = geodeticFromNed(T.translation(), datum());
		const Eigen::Vector3d v = velocity(t);
		constexpr double kDegree = M_PI / 180;
		return row(
			{t, g.longitude * kDegree, g.latitude * kDegree, -T.translation().z(), v.x(), v.y(), v.z(), kRoll,
			 kPitch, wrapAngle(kRate * t)});
	}
	static std::string row(const std::vector<double>& numbers)
	{
		std::string text;
		char number[40];
		for (double x : numbers) {
			std::snprintf(number, sizeof number, "%s%.17g", text.empty() ? "" : ",", x);
			text += number;
		}
		return text + "\n";
	}
	void write() const
	{
		std::string dvl = kDvlHeader, truth = kTruthHeader;
		for (int i = 0; i < n; i++) {
			dvl += dvlRow(i * dt);
			truth += truthRow(i * dt);
		}
		folder.write("log/DVL.csv", dvl);
		folder.write("log/GT.csv", truth);
	}
	TDatasetOptions options(const std::string& name = "dive") const
	{
		TDatasetOptions o;
		o.format = EDatasetFormat::DVL_GT_CSV;
		o.input = folder / "log";
		o.output = folder / (name + ".rawlog");
		return o;
	}
	TDatasetReport import() const { return importDataset(options()); }

	const CTempFolder folder;
	const int n;
	const double dt;
};
}  // namespace posidonia::testing
