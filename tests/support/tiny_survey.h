#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace posidonia::testing
{
/** A survey of 4.5 m over rock with small pictures: about 10 nodes, the way back overlaps the way out. It is
 * dead on course: the truth starts where [InitialPose] says. */
inline std::string tinySurveyIni()
{
	return R"([Simulation]
gps = false
[InitialPose]
yaw = 90
z = 3.5
[Route]
start = 0 0 3.5 90
way_points = 0 0  0 2  0.5 2  0.5 0
speed = 0.5
turn_rate = 60
dwell = 1
[Floor]
texture = rock
extent_north = 12
extent_east = 14
resolution = 0.01
[Sensor.STEREO]
width = 320
height = 240
fx = 141.5
fy = 141.5
cx = 159.5
cy = 119.5
)";
}

/** A folder of the test program, removed when it ends. */
class CProgramFolder
{
   public:
	explicit CProgramFolder(const std::string& name)
		: m_path((std::filesystem::temp_directory_path() /
				  ("posidonia-" + name + "-" + std::to_string(getpid())))
					 .string())
	{
		std::filesystem::remove_all(m_path);
		std::filesystem::create_directories(m_path);
	}
	~CProgramFolder()
	{
		std::error_code ignored;
		std::filesystem::remove_all(m_path, ignored);
	}
	CProgramFolder(const CProgramFolder&) = delete;
	CProgramFolder& operator=(const CProgramFolder&) = delete;

	std::string operator/(const std::string& name) const { return m_path + "/" + name; }

   private:
	std::string m_path;
};

/** Copies NAME.rawlog with its sensors, pictures and truth (unless `truth` is false) to another prefix. */
inline void copySurvey(const std::string& from, const std::string& to, bool truth = true)
{
	namespace fs = std::filesystem;
	fs::create_directories(fs::path(to).parent_path());
	for (const char* end : {".rawlog", ".sensors.ini", "_Images", ".gt.tum"})
		if (truth || std::string(end) != ".gt.tum")
			fs::copy(from + end, to + end, fs::copy_options::recursive);
}

/** The first `share` of a file's bytes are kept. */
inline void truncateFile(const std::string& path, double share)
{
	const auto size = std::filesystem::file_size(path);
	std::filesystem::resize_file(path, static_cast<std::uintmax_t>(static_cast<double>(size) * share));
}
}  // namespace posidonia::testing
