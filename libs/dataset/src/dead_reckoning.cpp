#include <posidonia/base/error.h>
#include <posidonia/dataset/dead_reckoning.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/observations.h>
#include <posidonia/obs/rawlog_reader.h>

#include <algorithm>
#include <optional>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
struct TAttitude
{
	double stamp;
	Matrix3d R_map_body;
};
struct TPing
{
	double stamp;
	Vector3d velocity;	///< In body axes [m/s]
	Vector3d lever;		///< t_body_dvl [m]
};
struct TReadings
{
	std::vector<TAttitude> attitudes;
	std::vector<TPing> pings;
};

Isometry3d mountOf(const mrpt::obs::CObservation& o)
{
	mrpt::poses::CPose3D pose;
	o.getSensorPose(pose);
	return fromMrpt(pose);
}

/** Of both sensors, in the order of their stamps. */
TReadings readingsOf(const std::string& rawlog, const std::string& dvl, const std::string& ahrs)
{
	TReadings readings;
	CRawlogReader reader(rawlog);
	while (const auto o = reader.next()) {
		const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(o.get());
		const auto* ping = dynamic_cast<const CObservationDVL*>(o.get());
		const Isometry3d T_body_sensor = mountOf(*o);
		if (imu && o->sensorLabel == ahrs)
			if (const auto R = attitudeOf(*imu))
				readings.attitudes.push_back({stampOf(*o), *R * T_body_sensor.linear().transpose()});
		if (ping && o->sensorLabel == dvl && ping->velocity_valid) {
			const Vector3d v(ping->velocity.x, ping->velocity.y, ping->velocity.z);
			readings.pings.push_back({stampOf(*o), T_body_sensor.linear() * v, T_body_sensor.translation()});
		}
	}
	const auto earlier = [](const auto& a, const auto& b) { return a.stamp < b.stamp; };
	std::stable_sort(readings.attitudes.begin(), readings.attitudes.end(), earlier);
	std::stable_sort(readings.pings.begin(), readings.pings.end(), earlier);
	return readings;
}

/** R_map_body at a time; empty before the first attitude and after the last. */
std::optional<Matrix3d> attitudeAt(const std::vector<TAttitude>& attitudes, double stamp)
{
	const auto after = std::lower_bound(
		attitudes.begin(), attitudes.end(), stamp, [](const TAttitude& a, double t) { return a.stamp < t; });
	if (after == attitudes.end()) return {};
	if (after->stamp == stamp) return after->R_map_body;
	if (after == attitudes.begin()) return {};
	const TAttitude &a = *(after - 1), &b = *after;
	const double part = (stamp - a.stamp) / (b.stamp - a.stamp);
	return a.R_map_body * expSO3(part * logSO3(a.R_map_body.transpose() * b.R_map_body));
}
}  // namespace

TTrajectory deadReckoning(
	const std::string& rawlog, const Vector3d& start, const std::string& dvl, const std::string& ahrs)
{
	const TReadings readings = readingsOf(rawlog, dvl, ahrs);
	TTrajectory trajectory;
	Vector3d p_dvl = start, last_velocity = Vector3d::Zero();
	for (const TPing& ping : readings.pings) {
		const auto R = attitudeAt(readings.attitudes, ping.stamp);
		if (!R) continue;
		const Vector3d velocity = *R * ping.velocity;
		if (trajectory.empty())
			p_dvl += *R * ping.lever;
		else
			p_dvl += (velocity + last_velocity) / 2 * (ping.stamp - trajectory.back().stamp);
		last_velocity = velocity;
		TStampedPose pose;
		pose.stamp = ping.stamp;
		pose.T.linear() = *R;
		pose.T.translation() = p_dvl - *R * ping.lever;
		trajectory.push_back(pose);
	}
	if (trajectory.empty())
		throw CError(
			rawlog, "holds no velocity labelled '" + dvl + "' between attitudes labelled '" + ahrs + "'",
			"see its labels with rawlog-edit --info");
	return trajectory;
}
}  // namespace posidonia
