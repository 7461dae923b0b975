#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <posidonia/obs/frames.h>
#include <posidonia/obs/register_observations.h>
#include <random_pose.h>
#include <temp_folder.h>

#include "sample_observations.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
template <class OBSERVATION>
typename OBSERVATION::Ptr thereAndBack(const OBSERVATION& observation)
{
	registerObservations();
	mrpt::io::CMemoryStream memory;
	auto archive = mrpt::serialization::archiveFrom(memory);
	archive << observation;
	memory.Seek(0);
	mrpt::serialization::CSerializable::Ptr object;
	archive >> object;
	return std::dynamic_pointer_cast<OBSERVATION>(object);
}

void expectSame(const std::vector<double>& a, const std::vector<double>& b)
{
	ASSERT_EQ(a.size(), b.size());
	for (size_t i = 0; i < a.size(); i++)
		EXPECT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]))) << "i=" << i;
}

double poseDistance(const mrpt::poses::CPose3D& a, const mrpt::poses::CPose3D& b)
{
	return (fromMrpt(a).matrix() - fromMrpt(b).matrix()).norm();
}

std::vector<std::string> words(const std::string& line)
{
	std::istringstream in(line);
	std::vector<std::string> list;
	for (std::string word; in >> word;)
		list.push_back(word);
	return list;
}
}  // namespace

TEST(Observations, DvlComesBackInAllFields)
{
	const CObservationDVL dvl = sampleDvl(1.6e9 + 0.25);
	const auto back = thereAndBack(dvl);
	ASSERT_TRUE(back);
	EXPECT_EQ(back->sensorLabel, "DVL");
	EXPECT_EQ(back->timestamp, dvl.timestamp);
	EXPECT_EQ(back->velocity, dvl.velocity);
	EXPECT_TRUE(back->velocity_valid);
	EXPECT_EQ(back->velocity_covariance, dvl.velocity_covariance);
	EXPECT_EQ(back->altitude, dvl.altitude);
	EXPECT_TRUE(back->altitude_valid);
	expectSame(back->beam_velocities, dvl.beam_velocities);
	expectSame(back->beam_ranges, dvl.beam_ranges);
	EXPECT_LT(poseDistance(back->sensorPose, dvl.sensorPose), 1e-15);
}

TEST(Observations, DvlFlagsAreIndependent)
{
	for (int flags = 0; flags < 4; flags++) {
		CObservationDVL dvl;
		dvl.velocity_valid = flags & 1;
		dvl.altitude_valid = flags & 2;
		const auto back = thereAndBack(dvl);
		EXPECT_EQ(back->velocity_valid, dvl.velocity_valid) << "flags=" << flags;
		EXPECT_EQ(back->altitude_valid, dvl.altitude_valid) << "flags=" << flags;
		EXPECT_TRUE(back->beam_velocities.empty()) << "flags=" << flags;
	}
}

TEST(Observations, PressureComesBackInAllFields)
{
	const CObservationPressure pressure = samplePressure(1.6e9 + 0.5);
	const auto back = thereAndBack(pressure);
	ASSERT_TRUE(back);
	EXPECT_EQ(back->sensorLabel, "PRESSURE");
	EXPECT_EQ(back->timestamp, pressure.timestamp);
	EXPECT_EQ(back->pressure, pressure.pressure);
	EXPECT_LT(poseDistance(back->sensorPose, pressure.sensorPose), 1e-15);
}

TEST(Observations, ALaterVersionIsRefused)
{
	registerObservations();
	mrpt::io::CMemoryStream memory;
	auto archive = mrpt::serialization::archiveFrom(memory);
	archive << samplePressure(1);
	std::string bytes(static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount());
	const size_t version_at = 1 + std::string("posidonia::CObservationPressure").size();
	ASSERT_EQ(bytes[version_at], 0);
	bytes[version_at] = 1;
	mrpt::io::CMemoryStream patched;
	patched.Write(bytes.data(), bytes.size());
	patched.Seek(0);
	mrpt::serialization::CSerializable::Ptr object;
	EXPECT_THROW(mrpt::serialization::archiveFrom(patched) >> object, std::exception);
}

TEST(Observations, TextExportHasOneNumberAColumn)
{
	const CObservationDVL dvl = sampleDvl(1.6e9);
	ASSERT_TRUE(dvl.exportTxtSupported());
	const auto head = words(dvl.exportTxtHeader()), row = words(dvl.exportTxtDataRow());
	EXPECT_EQ(head.size(), 10u);
	ASSERT_EQ(row.size(), head.size());
	EXPECT_EQ(row[0], "0.125000000");
	EXPECT_EQ(row[1], "-0.250000000");
	EXPECT_EQ(row[3], "1");
	EXPECT_EQ(row[4], "2.515625000");
	EXPECT_EQ(row[6], "0.100000000");
	EXPECT_EQ(words(CObservationDVL().exportTxtDataRow()).size(), head.size());
	const CObservationPressure pressure = samplePressure(1.6e9);
	EXPECT_EQ(words(pressure.exportTxtHeader()).size(), 1u);
	EXPECT_EQ(words(pressure.exportTxtDataRow()), std::vector<std::string>{"136789.437500"});
}

TEST(Observations, DescriptionsHoldTheNumbers)
{
	std::ostringstream text;
	sampleDvl(1.6e9).getDescriptionAsText(text);
	EXPECT_HOLDS(text.str(), "0.125 -0.25 0.0625 (valid)");
	EXPECT_HOLDS(text.str(), "2.51562");
	EXPECT_HOLDS(text.str(), "beam 4: range");
}

TEST(Observations, StampsKeepTheirTicks)
{
	const double stamp = 1403715273.2621429;
	EXPECT_NEAR(stampOf(samplePressure(stamp)), stamp, 2.5e-7);
}

TEST(Observations, ImuReadingsComeBack)
{
	const TImuReading reading{{0.1, -0.2, 0.3}, {0.01, 0.02, -9.81}};
	const auto imu = makeImu("IMU", 1e9, Eigen::Isometry3d::Identity(), reading);
	const auto back = imuReadingOf(*thereAndBack(*imu));
	ASSERT_TRUE(back);
	EXPECT_EQ(back->rate, reading.rate);
	EXPECT_EQ(back->force, reading.force);
	EXPECT_FALSE(attitudeOf(*imu));
}

TEST(Observations, AttitudesComeBackAsQuaternionOrAngles)
{
	std::mt19937 rng(4);
	for (int i = 0; i < 20; i++) {
		const Eigen::Matrix3d R = randomPose(rng, 1, 1).linear();
		auto ahrs = makeAhrs("AHRS", 1e9, Eigen::Isometry3d::Identity(), R);
		EXPECT_LT((*attitudeOf(*ahrs) - R).norm(), 1e-12) << "i=" << i;
		EXPECT_FALSE(imuReadingOf(*ahrs)) << "i=" << i;
		mrpt::obs::CObservationIMU angles;
		for (auto index : {mrpt::obs::IMU_YAW, mrpt::obs::IMU_PITCH, mrpt::obs::IMU_ROLL})
			angles.set(index, ahrs->get(index));
		EXPECT_LT((*attitudeOf(angles) - R).norm(), 1e-12) << "i=" << i;
	}
}

TEST(Frames, TheDownLookingCameraIsARotationThatLooksDown)
{
	const Eigen::Matrix3d R = downLookingCamera();
	EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
	EXPECT_DOUBLE_EQ(R.determinant(), 1);
	EXPECT_EQ(R * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ());	 // looks down
	EXPECT_EQ(R * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY());	 // image right = starboard
	EXPECT_EQ(R * -Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX());	 // image top = bow
	EXPECT_LT((TStereoSpec().T_body_sensor().linear() - R).norm(), 1e-15);
}
