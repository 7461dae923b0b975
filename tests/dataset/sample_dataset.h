#pragma once

#include <mrpt/obs/CObservation.h>
#include <posidonia/dataset/import_dataset.h>
#include <posidonia/obs/rawlog_reader.h>
#include <temp_folder.h>

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace posidonia::testing
{
/** Text of a T_BS entry. */
inline std::string yamlPose(const std::string& key, const std::string& numbers)
{
	return key + ":\n  cols: 4\n  rows: 4\n  data: [" + numbers + "]\n";
}

/** A small set with every sensor: world NWU, body forward-port-up, 1 s from t = 1000 s. */
class CSampleDataset
{
   public:
	static constexpr const char* kIdentity = "1, 0, 0, 0,\n 0, 1, 0, 0,\n 0, 0, 1, 0,\n 0, 0, 0, 1";

	CSampleDataset()
	{
		write(
			"body.yaml", "%YAML:1.0\nworld: NWU\ndatum: [41.5, 3.25]\n" +
							 yamlPose("T_FRD_body", "1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1"));
		const std::string mount = yamlPose("T_BS", "1, 0, 0, 0.5, 0, 1, 0, 0.25, 0, 0, 1, 0.125, 0, 0, 0, 1");
		write(
			"imu0/sensor.yaml",
			"sensor_type: imu\n" + mount +
				"rate_hz: 10\ngyroscope_noise_density: 1e-4\ngyroscope_random_walk: 2e-5\n"
				"accelerometer_noise_density: 3e-3\naccelerometer_random_walk: 4e-3\n");
		std::string imu = "#timestamp [ns],w_x,w_y,w_z [rad/s],a_x,a_y,a_z [m/s^2]\n";
		for (int i = 0; i < 20; i++)
			imu += stamp(i * 100) + ",0.1,0.2,0.3,0,0,9.81\n";
		write("imu0/data.csv", imu);
		write("ahrs0/sensor.yaml", mount + "rate_hz: 2\nsigma_roll_pitch: 0.01\nsigma_heading: 0.02\n");
		write(
			"ahrs0/data.csv", "#timestamp [ns],q_w,q_x,q_y,q_z\n" + stamp(50) +
								  ",0.70710678118,0,0,0.70710678118\n" + stamp(550) + ",1,0,0,0\n");
		write("dvl0/sensor.yaml", mount + "rate_hz: 2\nsigma_velocity: 0.015\nbeam_angle_deg: 25\n");
		write(
			"dvl0/data.csv", "#timestamp [ns],v_x,v_y,v_z,altitude [m],valid,b_1,b_2,b_3,b_4\n" + stamp(120) +
								 ",0.5,-0.25,0.125,2.5,1,0.1,0.2,nan,0.4\n" + stamp(620) +
								 ",nan,nan,nan,nan,0,nan,nan,nan,nan\n");
		write(
			"pressure0/sensor.yaml",
			mount + "rate_hz: 1\nsigma: 50\nsurface_pressure: 101000\nwater_density: 1027\n");
		write("pressure0/data.csv", "#timestamp [ns],pressure [Pa]\n" + stamp(130) + ",123456.5\n");
		write("gps0/sensor.yaml", mount + "rate_hz: 1\n");
		write(
			"gps0/data.csv", "#timestamp [ns],latitude,longitude,height,sigma_horizontal,fix\n" + stamp(140) +
								 ",nan,nan,nan,nan,0\n" + stamp(640) + ",41.6,3.3,1.5,0.75,1\n");
		write(
			"odom0/data.csv", "#timestamp [ns],p_x,p_y,p_z [m],q_w,q_x,q_y,q_z\n" + stamp(150) +
								  ",1,2,3,0.70710678118,0,0,0.70710678118\n");
		write(
			"state_groundtruth_estimate0/data.csv", "#timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z,v_x\n" +
														stamp(160) +
														",1,2,3,0.70710678118,0,0,0.70710678118,9\n");
		writeCameras("64, 48", "50, 50, 31.5, 23.5", "0, 0, 0, 0");
		for (int i = 0; i < 3; i++)
			for (const char* camera : {"cam0", "cam1"})
				writeImage(std::string(camera) + "/data/" + stamp(i * 300) + ".png", i);
		for (const char* camera : {"cam0", "cam1"}) {
			std::string csv = "#timestamp [ns],filename\n";
			for (int i = 0; i < 3; i++)
				csv += stamp(i * 300) + "," + stamp(i * 300) + ".png\n";
			write(std::string(camera) + "/data.csv", csv);
		}
	}

	/** Stamp [ns] as text, `ms` after the start. */
	static std::string stamp(int ms) { return std::to_string(1000000000000LL + ms * 1000000LL); }

	void write(const std::string& name, const std::string& text) const
	{
		m_folder.write("set/mav0/" + name, text);
	}
	void remove(const std::string& name) const
	{
		std::filesystem::remove_all(m_folder / ("set/mav0/" + name));
	}
	void writeImage(const std::string& name, int seed, int type = CV_8UC1, cv::Size size = {64, 48}) const
	{
		const std::string path = m_folder / ("set/mav0/" + name);
		std::filesystem::create_directories(std::filesystem::path(path).parent_path());
		cv::Mat image(size, type);
		cv::RNG rng(static_cast<uint64_t>(seed + 1));
		rng.fill(image, cv::RNG::UNIFORM, 0, 255);
		ASSERT_TRUE(cv::imwrite(path, image));
	}
	/** cam1 is 0.12 m to the right of cam0, which looks along the body's -z with x = port... of an up-looking
	 * body. */
	void writeCameras(
		const std::string& resolution, const std::string& intrinsics, const std::string& distortion) const
	{
		const std::string rest = "rate_hz: 4\nresolution: [" + resolution +
								 "]\ncamera_model: pinhole\nintrinsics: [" + intrinsics +
								 "]\ndistortion_model: radial-tangential\ndistortion_coefficients: [" +
								 distortion + "]\n";
		write(
			"cam0/sensor.yaml",
			yamlPose("T_BS", "0, -1, 0, 0.3, -1, 0, 0, 0.06, 0, 0, -1, 0, 0, 0, 0, 1") + rest);
		write(
			"cam1/sensor.yaml",
			yamlPose("T_BS", "0, -1, 0, 0.3, -1, 0, 0, -0.06, 0, 0, -1, 0, 0, 0, 0, 1") + rest);
	}

	TDatasetOptions options() const
	{
		TDatasetOptions o;
		o.input = m_folder / "set";
		o.output = m_folder / "dive.rawlog";
		return o;
	}
	TDatasetReport import() const { return importDataset(options()); }
	std::vector<mrpt::obs::CObservation::Ptr> observations() const
	{
		CRawlogReader reader(m_folder / "dive.rawlog");
		std::vector<mrpt::obs::CObservation::Ptr> all;
		while (auto o = reader.next())
			all.push_back(o);
		EXPECT_EQ(reader.damage(), "");
		return all;
	}
	/** The n-th observation of a kind. */
	template <class OBSERVATION>
	typename OBSERVATION::Ptr nth(const std::string& label, size_t n) const
	{
		for (const auto& o : observations())
			if (o->sensorLabel == label && n-- == 0) return std::dynamic_pointer_cast<OBSERVATION>(o);
		return {};
	}
	/** Names beside the set. */
	std::vector<std::string> outputs() const
	{
		std::vector<std::string> names;
		for (const auto& file : std::filesystem::directory_iterator(m_folder.path()))
			if (file.path().filename() != "set") names.push_back(file.path().filename().string());
		std::sort(names.begin(), names.end());
		return names;
	}
	const CTempFolder& folder() const { return m_folder; }

   private:
	CTempFolder m_folder;
};
}  // namespace posidonia::testing
