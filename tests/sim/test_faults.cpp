#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/sim/faults.h>
#include <posidonia/sim/sensor_bank.h>

#include "sensor_test_tools.h"
#include "vehicle_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector3d;
using mrpt::obs::CObservation;

namespace
{
constexpr double kStart = 1420070400;
constexpr double kDegree = M_PI / 180;

CFaults faultsOf(const std::string& text, uint64_t seed = 1)
{
	CIniFile ini = CIniFile::fromText(text, "x.ini");
	const auto faults = loadFaults(ini);
	ini.refuseUnknown();
	return {faults, TSensorSuite::sparus2(), seed};
}
std::vector<CObservation::Ptr> makeLog(double seconds)
{
	TSimulationOptions options;
	options.gps.max_depth = 100;  // fixes all the way
	CSensorBank bank(options, TSensorSuite::sparus2());
	std::vector<CObservation::Ptr> log;
	while (bank.nextTime() < seconds)
		log.push_back(bank.measure(livelyMotion().at(bank.nextTime())));
	return log;
}
/** 60 s of all sensors. */
const std::vector<CObservation::Ptr>& cleanLog()
{
	static const std::vector<CObservation::Ptr> log = makeLog(60);
	return log;
}
double timeOf(const CObservation::Ptr& o)
{
	return stampOf(*o) - kStart;
}
/** What comes of each observation of `label`, with its time. */
struct TPair
{
	double t;
	CObservation::Ptr before, after;
};
std::vector<TPair> through(CFaults faults, const std::string& label)
{
	std::vector<TPair> pairs;
	for (const auto& o : cleanLog()) {
		const auto after = faults.apply(o, timeOf(o));
		if (o->sensorLabel == label)
			pairs.push_back({timeOf(o), o, after});
		else
			EXPECT_EQ(after, o) << o->sensorLabel << " is none of its business";
	}
	return pairs;
}
std::vector<bool> lostOf(const std::vector<TPair>& pairs)
{
	std::vector<bool> lost;
	for (const auto& p : pairs)
		lost.push_back(!p.after);
	return lost;
}

/** The error of a reading in the units of the ini, as far as the sensor has numbers. */
Vector3d errorOf(const CObservation& before, const CObservation& after);

template <class T>
const T& as(const CObservation& o)
{
	return dynamic_cast<const T&>(o);
}
Vector3d imuError(const CObservation& a, const CObservation& b)
{
	const auto &before = as<mrpt::obs::CObservationIMU>(a), &after = as<mrpt::obs::CObservationIMU>(b);
	if (const auto R = attitudeOf(before))
		return {wrapAngle(yawPitchRoll(*attitudeOf(after) * R->transpose())[0]) / kDegree, 0, 0};
	EXPECT_EQ(imuReadingOf(after)->force, imuReadingOf(before)->force);
	const Eigen::Matrix3d R_body_imu = fromMrpt(before.sensorPose).linear();
	return R_body_imu * (imuReadingOf(after)->rate - imuReadingOf(before)->rate) / kDegree;
}
Vector3d dvlError(const CObservationDVL& before, const CObservationDVL& after)
{
	return fromMrpt(before.sensorPose).linear() * (velocityOf(after) - velocityOf(before));
}
Vector3d gpsError(const mrpt::obs::CObservationGPS& before, const mrpt::obs::CObservationGPS& after)
{
	const auto ned = [](const mrpt::obs::CObservationGPS& gps) {
		const auto& f = gps.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
		return nedFromGeodetic({f.latitude_degrees, f.longitude_degrees, f.altitude_meters}, {});
	};
	return ned(after) - ned(before);
}
Vector3d errorOf(const CObservation& before, const CObservation& after)
{
	if (before.sensorLabel == "DVL") return dvlError(as<CObservationDVL>(before), as<CObservationDVL>(after));
	if (before.sensorLabel == "GPS")
		return gpsError(as<mrpt::obs::CObservationGPS>(before), as<mrpt::obs::CObservationGPS>(after));
	if (before.sensorLabel == "PRESSURE")
		return {as<CObservationPressure>(after).pressure - as<CObservationPressure>(before).pressure, 0, 0};
	return imuError(before, after);
}
}  // namespace

TEST(Faults, NoneLeavesEverythingAsItIs)
{
	CFaults none = faultsOf("");
	for (const auto& o : cleanLog())
		ASSERT_EQ(none.apply(o, timeOf(o)), o);
	EXPECT_FALSE(none.blackout(5));
	EXPECT_EQ(none.turbidity(5), 1);
	EXPECT_EQ(none.current(5), Vector3d(0, 0, 0));
	EXPECT_EQ(none.thrusterEfficiency(5), Vector3d(1, 1, 1));
	EXPECT_TRUE(none.active(5).empty());
}

TEST(Faults, DropOutLosesTheSensorForItsTime)
{
	for (const char* label : {"IMU", "AHRS", "DVL", "PRESSURE", "GPS", "STEREO"}) {
		const auto pairs = through(
			faultsOf(
				std::string("[Fault.a]\nkind = drop_out\nlabel = ") + label + "\ntime = 20\nduration = 10\n"),
			label);
		EXPECT_GE(pairs.size(), 59u) << label;
		for (const auto& p : pairs)
			EXPECT_EQ(p.after, p.t >= 20 && p.t < 30 ? nullptr : p.before) << label << " t = " << p.t;
	}
}

TEST(Faults, WithoutADurationItLastsToTheEnd)
{
	const auto pairs = through(faultsOf("[Fault.a]\nkind = drop_out\nlabel = IMU\ntime = 30\n"), "IMU");
	for (const auto& p : pairs)
		EXPECT_EQ(!p.after, p.t >= 30) << p.t;
}

TEST(Faults, DropOutsComeAtTheirRate)
{
	const std::string text = "[Fault.a]\nkind = drop_out\nlabel = IMU\nrate = 0.2\n";
	const auto lost = lostOf(through(faultsOf(text), "IMU"));
	const double n = static_cast<double>(lost.size());
	const double part = static_cast<double>(std::count(lost.begin(), lost.end(), true)) / n;
	EXPECT_NEAR(part, 0.2, 4 * std::sqrt(0.2 * 0.8 / n));
	EXPECT_EQ(lost, lostOf(through(faultsOf(text), "IMU"))) << "same seed";
	EXPECT_NE(lost, lostOf(through(faultsOf(text, 2), "IMU"))) << "the run's seed";
	EXPECT_NE(lost, lostOf(through(faultsOf(text + "seed = 2\n"), "IMU"))) << "its own seed";
}

TEST(Faults, BiasIsAddedInTheUnitsOfTheIni)
{
	struct TCase
	{
		const char *label, *size;
		Vector3d error;
		double tolerance;
	};
	const TCase cases[] = {
		{"DVL", "0.1 -0.2 0.05", {0.1, -0.2, 0.05}, 1e-12},
		{"IMU", "0.5 -0.25 1", {0.5, -0.25, 1}, 1e-12},
		{"AHRS", "-7", {-7, 0, 0}, 1e-9},
		{"PRESSURE", "2500", {2500, 0, 0}, 1e-9},
		{"GPS", "3 -4", {3, -4, 0}, 1e-3},
	};
	for (const auto& c : cases) {
		const std::string text = std::string("[Fault.a]\nkind = bias\ntime = 30\nlabel = ") + c.label +
								 "\nsize = " + c.size + "\n";
		for (const auto& p : through(faultsOf(text), c.label)) {
			if (p.t < 30) {
				EXPECT_EQ(p.after, p.before) << c.label;
				continue;
			}
			ASSERT_NE(p.after, p.before) << "a copy";
			EXPECT_EQ(p.after->timestamp, p.before->timestamp) << c.label;
			EXPECT_EQ(p.after->sensorLabel, c.label);
			EXPECT_LT((errorOf(*p.before, *p.after) - c.error).norm(), c.tolerance) << c.label << p.t;
		}
	}
}

TEST(Faults, DvlsBeamsSayWhatItsVectorSays)
{
	const auto pairs = through(faultsOf("[Fault.a]\nkind = bias\nlabel = DVL\nsize = 0.3 0.1 -0.2\n"), "DVL");
	const TDvlSpec spec = TSensorSuite::sparus2().dvl.at("DVL");
	const auto beams = spec.beams();
	for (const auto& p : pairs) {
		const auto &before = as<CObservationDVL>(*p.before), &after = as<CObservationDVL>(*p.after);
		const Vector3d error = velocityOf(after) - velocityOf(before);
		for (int i = 0; i < 4; i++)
			EXPECT_NEAR(after.beam_velocities[i] - before.beam_velocities[i], beams.col(i).dot(error), 1e-12)
				<< "beam " << i;
	}
}

TEST(Faults, OutliersHaveTheirRateAndLengthInAnyDirection)
{
	for (const std::string label : {"IMU", "AHRS", "DVL", "PRESSURE"}) {
		const std::string text = "[Fault.a]\nkind = outlier\nrate = 0.3\nsize = 2\nlabel = " + label + "\n";
		const auto pairs = through(faultsOf(text), label);
		const double n = static_cast<double>(pairs.size());
		double hits = 0;
		Vector3d sum(0, 0, 0);
		for (const auto& p : pairs) {
			if (p.after == p.before) continue;
			const Vector3d error = errorOf(*p.before, *p.after);
			EXPECT_NEAR(error.norm(), 2, 1e-6) << label;
			sum += error, hits++;
		}
		EXPECT_NEAR(hits / n, 0.3, 4 * std::sqrt(0.21 / n)) << label;
		EXPECT_LT(sum.norm(), 4 * 2 * std::sqrt(hits)) << label << ": no direction is preferred";
	}
}

TEST(Faults, GpsOutliersAreHorizontal)
{
	const auto pairs = through(faultsOf("[Fault.a]\nkind = outlier\nlabel = GPS\nsize = 50\n"), "GPS");
	for (const auto& p : pairs) {
		const Vector3d error = errorOf(*p.before, *p.after);
		EXPECT_NEAR(error.head<2>().norm(), 50, 0.01);
		EXPECT_NEAR(error.z(), 0, 0.01);
	}
}

TEST(Faults, OneMoreLeavesTheOthersAlone)
{
	const std::string drop = "[Fault.m]\nkind = drop_out\nlabel = DVL\nrate = 0.3\n";
	const auto alone = lostOf(through(faultsOf(drop), "DVL"));
	const char* others[] = {
		"[Fault.a]\nkind = drop_out\nlabel = IMU\nrate = 0.5\n",
		"[Fault.z]\nkind = outlier\nlabel = DVL\nsize = 1\n",
		"[Fault.a]\nkind = bias\nlabel = DVL\nsize = 1 1 1\n",
		"[Fault.b]\nkind = current\nvelocity = 1 0 0\n"};
	for (const char* other : others) {
		CFaults faults = faultsOf(drop + other);
		std::vector<bool> lost;
		for (const auto& o : cleanLog()) {
			const auto after = faults.apply(o, timeOf(o));
			if (o->sensorLabel == "DVL") lost.push_back(!after);
		}
		EXPECT_EQ(lost, alone) << other;
	}
	// And an outlier draws the same whether its observation was lost before or not.
	const std::string outlier = "[Fault.z]\nkind = outlier\nlabel = DVL\nrate = 0.5\nsize = 1\n";
	const auto clean = through(faultsOf(outlier), "DVL"), thinned = through(faultsOf(drop + outlier), "DVL");
	for (size_t i = 0; i < clean.size(); i++) {
		if (!thinned[i].after) continue;
		const Vector3d difference =
			errorOf(*clean[i].before, *clean[i].after) - errorOf(*thinned[i].before, *thinned[i].after);
		EXPECT_LT(difference.norm(), 1e-12) << i;
	}
}

TEST(Faults, SpreadPutsTheStartOffByTheSeed)
{
	const std::string text = "[Fault.a]\nkind = blackout\ntime = 10\nduration = 5\nspread = 20\n";
	std::vector<double> starts;
	for (uint64_t seed = 1; seed <= 200; seed++) {
		const CFaults faults = faultsOf(text, seed);
		double start = 0;
		while (!faults.blackout(start))
			start += 0.01;
		EXPECT_TRUE(faults.blackout(start + 4.98));
		EXPECT_FALSE(faults.blackout(start + 5.02));
		starts.push_back(start);
	}
	const auto [first, last] = std::minmax_element(starts.begin(), starts.end());
	EXPECT_GE(*first, 10 - 1e-9);
	EXPECT_LE(*last, 30 + 0.02);
	EXPECT_NEAR(momentsOf(starts).mean, 20, 4 * 20 / std::sqrt(12 * 200.0));
	EXPECT_NEAR(momentsOf(starts).sigma, 20 / std::sqrt(12), 1);
}

TEST(Faults, OfTheWorldAddUpWhileTheyLast)
{
	const CFaults faults = faultsOf(
		"[Fault.cloud]\nkind = turbidity\ntime = 10\nduration = 10\nfactor = 3\n"
		"[Fault.cloud2]\nkind = turbidity\ntime = 15\nduration = 10\nfactor = 2\n"
		"[Fault.stream]\nkind = current\ntime = 10\nduration = 10\nvelocity = 0.1 0 0\n"
		"[Fault.tide]\nkind = current\nvelocity = 0 -0.2 0.01\n"
		"[Fault.weed]\nkind = thruster\ntime = 12\nduration = 1\nthruster = port\nefficiency = 0.25\n"
		"[Fault.dead]\nkind = thruster\ntime = 12\nthruster = heave\n"
		"[Fault.dark]\nkind = blackout\ntime = 5\nduration = 1\n");
	EXPECT_EQ(faults.turbidity(9.9), 1);
	EXPECT_EQ(faults.turbidity(12), 3);
	EXPECT_EQ(faults.turbidity(16), 6);
	EXPECT_EQ(faults.turbidity(21), 2);
	EXPECT_LT((faults.current(12) - Vector3d(0.1, -0.2, 0.01)).norm(), 1e-15);
	EXPECT_LT((faults.current(22) - Vector3d(0, -0.2, 0.01)).norm(), 1e-15);
	EXPECT_EQ(faults.thrusterEfficiency(11), Vector3d(1, 1, 1));
	EXPECT_EQ(faults.thrusterEfficiency(12.5), Vector3d(1, 0.25, 0));
	EXPECT_EQ(faults.thrusterEfficiency(14), Vector3d(1, 1, 0));
	EXPECT_TRUE(faults.blackout(5.5));
	EXPECT_FALSE(faults.blackout(6));
	EXPECT_EQ(faults.active(5.5), (std::vector<std::string>{"dark", "tide"}));
}

TEST(Faults, NonsenseIsRefusedWithSectionAndKey)
{
	const std::pair<const char*, std::vector<std::string>> cases[] = {
		{"[Fault.a]\ntime = 5\n", {"x.ini", "[Fault.a]", "kind"}},
		{"[Fault.a]\nkind = dropout\n", {"[Fault.a] kind", "drop_out"}},
		{"[Fault.a]\nkind = drop_out\nlabel = DVL\nrate = 2\n", {"[Fault.a] rate"}},
		{"[Fault.a]\nkind = drop_out\nlabel = DVL2\n",
		 {"[Fault.a] label = DVL2", "IMU AHRS DVL PRESSURE GPS STEREO"}},
		{"[Fault.a]\nkind = drop_out\n", {"[Fault.a] label", "known"}},
		{"[Fault.a]\nkind = outlier\nlabel = STEREO\nsize = 1\n", {"[Fault.a] label = STEREO", "outlier"}},
		{"[Fault.a]\nkind = outlier\nlabel = DVL\nsize = 1 2 3\n", {"[Fault.a] size", "1 number"}},
		{"[Fault.a]\nkind = bias\nlabel = DVL\nsize = 1\n", {"[Fault.a] size", "3 number"}},
		{"[Fault.a]\nkind = bias\nlabel = PRESSURE\n", {"[Fault.a] size", "1 number"}},
		{"[Fault.a]\nkind = current\nvelocity = 1 2\n", {"[Fault.a] velocity"}},
		{"[Fault.a]\nkind = thruster\n", {"[Fault.a] thruster", "port"}},
		{"[Fault.a]\nkind = thruster\nthruster = port\nefficiency = 1.5\n", {"[Fault.a] efficiency"}},
		{"[Fault.a]\nkind = turbidity\nfactor = -1\n", {"[Fault.a] factor"}},
		{"[Fault.a]\nkind = blackout\ntime = -1\n", {"[Fault.a] time"}},
		{"[Fault.a]\nkind = blackout\nlabel = STEREO\n", {"[Fault.a]", "unknown key 'label'"}},
	};
	for (const auto& [text, words] : cases)
		expectRefused([&, t = text] { faultsOf(t); }, words);
}
