#include "consistency.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace posidonia::testing
{
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

void TAnees::add(size_t instant, double nees)
{
	if (sum.size() <= instant) sum.resize(instant + 1, 0);
	sum[instant] += nees;
}

double TAnees::mean() const
{
	double total = 0;
	for (size_t i = 0; i < sum.size(); i++)
		total += at(i);
	return total / static_cast<double>(sum.size());
}

namespace
{
/** Chi-square quantile over its degrees of freedom, z the normal's quantile. */
double wilsonHilferty(double dof, double z)
{
	const double a = 2 / (9 * dof);
	return std::pow(1 - a + z * std::sqrt(a), 3);
}
}  // namespace

double TAnees::low() const
{
	return wilsonHilferty(runs * degrees_of_freedom, -1.96);
}
double TAnees::high() const
{
	return wilsonHilferty(runs * degrees_of_freedom, 1.96);
}

double TAnees::shareInside() const
{
	int inside = 0;
	for (size_t i = 0; i < sum.size(); i++)
		inside += at(i) > low() && at(i) < high();
	return inside / static_cast<double>(sum.size());
}

void TNis::add(const TInnovation& i)
{
	const double x = i.distance / i.degrees_of_freedom - 1;	 // its mean is zero when all is well
	sum += i.distance;
	dof += i.degrees_of_freedom;
	count++;
	squares += x * x;
	if (last != -1) products += x * last;
	last = x;
}

double TNis::lag1() const
{
	const double m = mean() - 1;
	return (products / static_cast<double>(count) - m * m) / (squares / static_cast<double>(count) - m * m);
}

TConsistency& TConsistency::operator+=(const TConsistency& other)
{
	runs += other.runs;
	for (const auto& [what, from] : other.anees) {
		TAnees& to = anees[what];
		to.degrees_of_freedom = from.degrees_of_freedom;
		to.runs += from.runs;
		for (size_t i = 0; i < from.sum.size(); i++)
			to.add(i, from.sum[i]);
	}
	for (const auto& [label, from] : other.nis) {
		TNis& to = nis[label];
		to.sum += from.sum, to.squares += from.squares, to.products += from.products;
		to.dof += from.dof, to.count += from.count;
	}
	return *this;
}

namespace
{
double neesOf(const VectorXd& error, const MatrixXd& cov)
{
	return error.dot(cov.ldlt().solve(error));
}

/** Errors of the navigation filter's states, with their rows. The filter navigates the IMU's place. */
void addStates(TConsistency& c, size_t instant, const CEkfOdometry& odometry, const TSurveyTruth& truth)
{
	const auto& [label, spec] = *odometry.setup().sensors.imu.begin();
	const Eigen::Isometry3d& T = truth.vehicle.T_map_body;
	const Vector3d lever = spec.T_body_sensor().translation();
	const TNavigationState& x = odometry.navigationFilter().state();
	const MatrixNav P = odometry.navigationFilter().covariance();
	const auto add = [&](const char* what, int row, const Vector3d& error) {
		c.anees[what].add(instant, neesOf(error, P.block<3, 3>(row, row)));
	};
	const Vector3d position = T * lever - x.position;
	c.anees["position"].degrees_of_freedom = 2;
	c.anees["position"].add(instant, neesOf(position.head<2>(), P.block<2, 2>(kPosition, kPosition)));
	// Nothing observes the pressure's offset: a run has one error of depth.
	c.anees["depth"].degrees_of_freedom = 1;
	c.anees["depth"].add(instant, neesOf(position.tail<1>(), P.block<1, 1>(kPosition + 2, kPosition + 2)));
	add("attitude", kAttitude, logSO3(x.R_odom_body.transpose() * T.linear()));
	Eigen::Matrix<double, 3, kNavigationSize> J = Eigen::Matrix<double, 3, kNavigationSize>::Zero();
	J.block<3, 3>(0, kVelocity) = Eigen::Matrix3d::Identity() / (1 + x.dvl_scale);
	J.col(kDvlScale) = -x.trueVelocity() / (1 + x.dvl_scale);
	c.anees["velocity"].add(
		instant, neesOf(
					 truth.vehicle.v_body + truth.vehicle.omega_body.cross(lever) - x.trueVelocity(),
					 J * P * J.transpose()));
	const Vector3d bias = spec.T_body_sensor().linear() * truth.models.imu.at(label)->gyroBias();
	add("gyro bias", kGyroBias, bias - x.gyro_bias);
}
}  // namespace

void addRun(TConsistency& c, const TSurveyScene& scene, double period, double edge_time)
{
	addRun(c, scene, scene.sensors, period, edge_time);
}

namespace
{
/** A time when no sensor but the IMU reads: nodes at others' stamps would make late readings of these. */
double afterOthers(double t)
{
	return std::round(t * 20) / 20 + 0.005;
}
}  // namespace

void addRun(
	TConsistency& c, const TSurveyScene& told, const TSensorSuite& world, double period, double edge_time)
{
	CEkfOdometry odometry = odometryFor(told);
	TSurveyScene scene = told;
	scene.sensors = world;
	Eigen::Isometry3d T_map_clone;
	double next_clone = -1;
	size_t instant = 0;
	runSurvey(scene, [&](const mrpt::obs::CObservation::Ptr& o, const TSurveyTruth& truth) {
		odometry.add(*o);
		const TInnovation& innovation = odometry.navigator().lastInnovation();
		if (innovation.sensor >= 0)
			c.nis[odometry.setup().sensor[static_cast<size_t>(innovation.sensor)].label].add(innovation);
		// A stamp is complete with its IMU reading; others come between.
		if (!odometry.ready() || o->sensorLabel != "IMU") return;
		const double t = truth.vehicle.t;
		const bool due = t >= afterOthers(period * static_cast<double>(instant + 1));
		if (due) {
			addStates(c, instant, odometry, truth);
			const TPoseEstimate edge = odometry.sinceClone();
			const Vector6d error = localCoordinates(edge.T, T_map_clone.inverse() * truth.vehicle.T_map_body);
			TAnees& edges = c.anees["edge"];
			edges.degrees_of_freedom = 6;
			edges.add(instant++, neesOf(error, edge.cov));
		}
		if (!due && t < next_clone) return;
		odometry.clone();
		T_map_clone = truth.vehicle.T_map_body;
		// The edge that ends at the next instant shall be a whole one.
		const double to_instant = period * static_cast<double>(instant + 1) - t;
		const bool last = to_instant < 2 * edge_time;
		next_clone = afterOthers(t + (last ? to_instant + edge_time : edge_time));
	});
	c.runs++;
	for (auto& [what, anees] : c.anees)
		anees.runs = c.runs;
	for (auto& [label, nis] : c.nis)
		nis.endOfRun();
}

std::string text(const TConsistency& c)
{
	std::string out = mrpt::format(
		"%-10s %8s %8s %15s %10s %8s\n", "ANEES", "mean", "inside", "95 % band", "smallest", "largest");
	for (const auto& [what, a] : c.anees) {
		std::vector<double> all;
		for (size_t i = 0; i < a.sum.size(); i++)
			all.push_back(a.at(i));
		const auto [low, high] = std::minmax_element(all.begin(), all.end());
		out += mrpt::format(
			"%-10s %8.3f %6.1f %% %7.3f %7.3f %10.3f %8.3f\n", what.c_str(), a.mean(), 100 * a.shareInside(),
			a.low(), a.high(), *low, *high);
	}
	out += mrpt::format("%-10s %8s %8s %12s\n", "NIS", "mean", "lag-1", "readings");
	for (const auto& [label, n] : c.nis)
		out += mrpt::format("%-10s %8.3f %8.3f %12ld\n", label.c_str(), n.mean(), n.lag1(), n.count);
	return out;
}
}  // namespace posidonia::testing
