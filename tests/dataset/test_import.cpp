#include <gtest/gtest.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/CObservationPressure.h>
#include <posidonia/obs/observations.h>

#include "sample_dataset.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector3d;
using mrpt::obs::CObservationGPS;
using mrpt::obs::CObservationIMU;
using mrpt::obs::CObservationStereoImages;

namespace
{
Eigen::Isometry3d poseOf(const mrpt::obs::CObservation& o)
{
	mrpt::poses::CPose3D pose;
	o.getSensorPose(pose);
	return fromMrpt(pose);
}
/** Where every sensor of the sample sits: (0.5, 0.25, 0.125) forward-port-up, its axes forward-port-up. */
void expectSampleMount(const mrpt::obs::CObservation& o)
{
	EXPECT_LT((poseOf(o).translation() - Vector3d(0.5, -0.25, -0.125)).norm(), 1e-12);
	EXPECT_LT((poseOf(o).linear() - Eigen::Matrix3d(Vector3d(1, -1, -1).asDiagonal())).norm(), 1e-12);
}
}  // namespace

TEST(ImportDataset, EverySensorArrivesInStampOrder)
{
	const CSampleDataset set;
	const TDatasetReport report = set.import();
	const std::map<std::string, size_t> expected{{"IMU", 20}, {"AHRS", 2},	   {"DVL", 2},	 {"PRESSURE", 1},
												 {"GPS", 2},  {"ODOMETRY", 1}, {"STEREO", 3}};
	EXPECT_EQ(report.observations, expected);
	EXPECT_EQ(report.ground_truth_poses, 1u);
	EXPECT_EQ(report.warnings, std::vector<std::string>());
	EXPECT_EQ(report.absent, std::vector<std::string>());
	EXPECT_NEAR(report.first_stamp, 1000, 1e-9);
	EXPECT_NEAR(report.last_stamp, 1001.9, 1e-9);
	const auto all = set.observations();
	ASSERT_EQ(all.size(), 31u);
	for (size_t i = 1; i < all.size(); i++)
		EXPECT_GE(all[i]->timestamp, all[i - 1]->timestamp) << "i=" << i;
	EXPECT_EQ(
		set.outputs(),
		(std::vector<std::string>{"dive.gt.tum", "dive.rawlog", "dive.sensors.ini", "dive_Images"}));
}

TEST(ImportDataset, ImuAndAhrs)
{
	const CSampleDataset set;
	set.import();
	const auto imu = set.nth<CObservationIMU>("IMU", 3);
	EXPECT_EQ(imuReadingOf(*imu)->rate, Vector3d(0.1, 0.2, 0.3));
	EXPECT_EQ(imuReadingOf(*imu)->force, Vector3d(0, 0, 9.81));
	EXPECT_NEAR(stampOf(*imu), 1000.3, 1e-6);
	expectSampleMount(*imu);
	const auto ahrs = set.nth<CObservationIMU>("AHRS", 0);
	expectSampleMount(*ahrs);
	// bow to the west: R_map_body = R_map_sensor R_sensor_body has yaw -90 deg, level
	const Eigen::Matrix3d R_map_body = *attitudeOf(*ahrs) * poseOf(*ahrs).linear().transpose();
	EXPECT_LT((yawPitchRoll(R_map_body) - Vector3d(-M_PI / 2, 0, 0)).norm(), 1e-9);
	EXPECT_LT((*attitudeOf(*ahrs) * Vector3d::UnitX() - Vector3d(0, -1, 0)).norm(), 1e-9);
}

TEST(ImportDataset, DvlPressureAndGps)
{
	const CSampleDataset set;
	set.import();
	const auto dvl = set.nth<CObservationDVL>("DVL", 0), lost = set.nth<CObservationDVL>("DVL", 1);
	EXPECT_EQ(dvl->velocity, mrpt::math::TVector3D(0.5, -0.25, 0.125));
	EXPECT_TRUE(dvl->velocity_valid && dvl->altitude_valid);
	EXPECT_EQ(dvl->altitude, 2.5);
	ASSERT_EQ(dvl->beam_velocities.size(), 4u);
	EXPECT_EQ(dvl->beam_velocities[3], 0.4);
	EXPECT_TRUE(std::isnan(dvl->beam_velocities[2]));
	expectSampleMount(*dvl);
	EXPECT_FALSE(lost->velocity_valid || lost->altitude_valid);
	const auto pressure = set.nth<CObservationPressure>("PRESSURE", 0);
	EXPECT_EQ(pressure->pressure, 123456.5);
	expectSampleMount(*pressure);
	const auto no_fix = set.nth<CObservationGPS>("GPS", 0), fix = set.nth<CObservationGPS>("GPS", 1);
	EXPECT_EQ(no_fix->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields.fix_quality, 0);
	const auto& gga = fix->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
	EXPECT_EQ(gga.fix_quality, 1);
	EXPECT_EQ(gga.latitude_degrees, 41.6);
	EXPECT_EQ(gga.longitude_degrees, 3.3);
	EXPECT_EQ(gga.altitude_meters, 1.5);
	expectSampleMount(*fix);
}

TEST(ImportDataset, OdometryAndGroundTruthInNorthEastDown)
{
	const CSampleDataset set;
	set.import();
	const auto odometry = set.nth<mrpt::obs::CObservationRobotPose>("ODOMETRY", 0);
	const Eigen::Isometry3d T = fromMrpt(odometry->pose.mean);
	EXPECT_LT((T.translation() - Vector3d(1, -2, -3)).norm(), 1e-12);
	EXPECT_LT((yawPitchRoll(T.linear()) - Vector3d(-M_PI / 2, 0, 0)).norm(), 1e-9);
	std::istringstream line(fileBytes(set.folder() / "dive.gt.tum"));
	std::string stamp;
	double x, y, z, qx, qy, qz, qw;
	line >> stamp >> x >> y >> z >> qx >> qy >> qz >> qw;
	EXPECT_EQ(stamp, "1000.160000000");
	EXPECT_EQ(Vector3d(x, y, z), Vector3d(1, -2, -3));
	const Eigen::Quaterniond q(qw, qx, qy, qz);
	EXPECT_LT((q.toRotationMatrix() - T.linear()).norm(), 1e-8);
}

TEST(ImportDataset, SensorsIniHoldsTheYamls)
{
	const CSampleDataset set;
	set.import();
	const TSensorSuite suite = readSensors(set.folder() / "dive.sensors.ini");
	EXPECT_EQ(suite.imu.at("IMU").gyro_noise_density, 1e-4);
	EXPECT_EQ(suite.imu.at("IMU").gyro_random_walk, 2e-5);
	EXPECT_EQ(suite.imu.at("IMU").accel_noise_density, 3e-3);
	EXPECT_EQ(suite.imu.at("IMU").accel_random_walk, 4e-3);
	EXPECT_EQ(suite.imu.at("IMU").rate, 10);
	EXPECT_NEAR(suite.ahrs.at("AHRS").sigma_roll_pitch, 0.01, 1e-15);
	EXPECT_NEAR(suite.ahrs.at("AHRS").sigma_heading, 0.02, 1e-15);
	EXPECT_EQ(suite.dvl.at("DVL").sigma_velocity, 0.015);
	EXPECT_NEAR(suite.dvl.at("DVL").beam_angle, 25 * M_PI / 180, 1e-15);
	EXPECT_EQ(suite.pressure.at("PRESSURE").sigma, 50);
	EXPECT_EQ(suite.pressure.at("PRESSURE").surface_pressure, 101000);
	EXPECT_EQ(suite.pressure.at("PRESSURE").water_density, 1027);
	EXPECT_EQ(suite.gps.at("GPS").sigma_horizontal, 0.75);
	EXPECT_NEAR(suite.stereo.at("STEREO").camera.baseline, 0.12, 1e-12);
	EXPECT_EQ(suite.stereo.at("STEREO").camera.fx, 50);
	const auto pair = set.nth<CObservationStereoImages>("STEREO", 0);
	EXPECT_LT(
		(stereoSpecOf(*pair).T_body_sensor().matrix() - suite.stereo.at("STEREO").T_body_sensor().matrix())
			.norm(),
		1e-9);
}

TEST(ImportDataset, RectifiedPicturesAreCopiedAndTheRigLooksDown)
{
	const CSampleDataset set;
	const TDatasetReport report = set.import();
	EXPECT_FALSE(report.rectified);
	const auto pair = set.nth<CObservationStereoImages>("STEREO", 1);
	EXPECT_EQ(pair->imageLeft.getExternalStorageFile(), "STEREO_000001_left.png");
	EXPECT_EQ(
		fileBytes(set.folder() / "dive_Images/STEREO_000001_left.png"),
		fileBytes(set.folder() / ("set/mav0/cam0/data/" + CSampleDataset::stamp(300) + ".png")));
	const Eigen::Isometry3d T = poseOf(*pair);
	EXPECT_LT((T.linear() - TStereoSpec().T_body_sensor().linear()).norm(), 1e-12);
	EXPECT_LT((T.translation() - Vector3d(0.3, -0.06, 0)).norm(), 1e-12);  // port of the middle
	const TGreyPair pictures = CStereoImageLoader(set.folder() / "dive.rawlog").load(*pair);
	EXPECT_EQ(pictures.right.cols, 64);
}

TEST(ImportDataset, ColourAndJpegBecomeGreyPng)
{
	const CSampleDataset set;
	set.writeImage("cam0/data/" + CSampleDataset::stamp(0) + ".png", 1, CV_8UC3);
	set.writeImage("cam1/data/a.jpg", 1, CV_8UC1);
	set.write("cam1/data.csv", "#timestamp [ns],filename\n" + CSampleDataset::stamp(0) + ",a.jpg\n");
	const TDatasetReport report = set.import();
	EXPECT_EQ(report.observations.at("STEREO"), 1u);
	for (const char* side : {"left", "right"}) {
		const cv::Mat image = cv::imread(
			set.folder() / ("dive_Images/STEREO_000000_" + std::string(side) + ".png"), cv::IMREAD_UNCHANGED);
		EXPECT_EQ(image.type(), CV_8UC1) << side;
	}
	EXPECT_HOLDS(report.text(), "2 images of cam0 or cam1 have no partner");
}

TEST(ImportDataset, UnequalStampsPairWithinHalfAPeriod)
{
	const CSampleDataset set;
	const std::string name = CSampleDataset::stamp(0) + ".png";
	set.write(
		"cam1/data.csv", "#t,f\n" + CSampleDataset::stamp(20) + "," + name + "\n" +
							 CSampleDataset::stamp(424) + "," + name + "\n" + CSampleDataset::stamp(730) +
							 "," + name + "\n");
	const TDatasetReport report = set.import();	 // period 250 ms: 0-20 and 300-424 pair, 600-730 do not
	EXPECT_EQ(report.observations.at("STEREO"), 2u);
	EXPECT_HOLDS(report.text(), "2 stereo pairs have unequal time stamps");
	EXPECT_HOLDS(report.text(), "2 images of cam0 or cam1 have no partner");
	EXPECT_NEAR(stampOf(*set.nth<CObservationStereoImages>("STEREO", 1)), 1000.3, 1e-6);
}

TEST(ImportDataset, EachFolderIsOptionalAndItsAbsenceIsSaid)
{
	for (const std::string name :
		 {"cam0", "cam1", "imu0", "ahrs0", "dvl0", "pressure0", "gps0", "odom0",
		  "state_groundtruth_estimate0"})
	{
		const CSampleDataset set;
		set.remove(name);
		const TDatasetReport report = set.import();
		ASSERT_EQ(report.absent.size(), 1u) << name;
		EXPECT_HOLDS(report.absent[0], name);
		EXPECT_HOLDS(report.text(), "absent: " + name);
		EXPECT_EQ(std::filesystem::exists(set.folder() / "dive_Images"), name.substr(0, 3) != "cam") << name;
		EXPECT_EQ(std::filesystem::exists(set.folder() / "dive.gt.tum"), name[0] != 's') << name;
	}
}

TEST(ImportDataset, TheDatumComesFromBodyIniOrFirstFix)
{
	const CSampleDataset set;
	TDatasetReport report = set.import();
	EXPECT_EQ(report.datum_source, "body.yaml");
	EXPECT_EQ(report.datum->latitude, 41.5);
	set.write("body.yaml", "world: NED\n");
	TDatasetOptions options = set.options();
	options.overwrite = true;
	options.datum = TWorldOptions{40.0, 2.0};
	report = importDataset(options);
	EXPECT_EQ(report.datum_source, "ini");
	EXPECT_EQ(report.datum->latitude, 40);
	options.datum.reset();
	report = importDataset(options);
	EXPECT_EQ(report.datum_source, "first fix");
	EXPECT_EQ(report.datum->latitude, 41.6);
	EXPECT_HOLDS(report.text(), "warning: no datum in body.yaml or ini");
}

TEST(ImportDataset, LevellingTurnsTheBodyAndPrintsTheMatrix)
{
	const CSampleDataset set;
	set.write("body.yaml", "world: NWU\n");	 // the body's axes are not said: z is up
	TDatasetOptions options = set.options();
	options.level = true;
	const TDatasetReport report = importDataset(options);
	EXPECT_LT((report.T_FRD_body.linear() * Vector3d(0, 0, 9.81) - Vector3d(0, 0, -9.81)).norm(), 1e-9);
	EXPECT_HOLDS(report.text(), "T_FRD_body: [1.000000000, ");
	const auto imu = set.nth<CObservationIMU>("IMU", 0);
	EXPECT_LT((poseOf(*imu).linear() * imuReadingOf(*imu)->force - Vector3d(0, 0, -9.81)).norm(), 1e-9);
}

TEST(ImportDataset, TwiceTheSameBytes)
{
	const CSampleDataset set;
	set.writeCameras("64, 48", "50, 50, 31.5, 23.5", "-0.1, 0.01, 0, 0");
	EXPECT_TRUE(set.import().rectified);
	TDatasetOptions options = set.options();
	options.output = set.folder() / "again.rawlog";
	importDataset(options);
	for (const std::string end : {".rawlog", ".gt.tum", ".sensors.ini", "_Images/STEREO_000002_right.png"})
		EXPECT_EQ(fileBytes(set.folder() / ("dive" + end)), fileBytes(set.folder() / ("again" + end))) << end;
}

TEST(ImportDataset, ProgressRunsToTheEnd)
{
	const CSampleDataset set;
	std::vector<std::pair<std::string, double>> steps;
	importDataset(set.options(), [&](const std::string& stage, double f) { steps.emplace_back(stage, f); });
	ASSERT_FALSE(steps.empty());
	EXPECT_EQ(steps.front().first, "stereo pairs");
	EXPECT_EQ(steps.back(), (std::pair<std::string, double>("rawlog", 1)));
}
