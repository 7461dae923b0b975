#pragma once

#include <posidonia/obs/sensor_suite.h>

#include <filesystem>
#include <map>
#include <string>

#include "temp_folder.h"

namespace posidonia::testing
{
/** SPARUS II with pictures of 160 x 120. */
inline TSensorSuite smallCamera()
{
	TSensorSuite s = TSensorSuite::sparus2();
	TStereoCamera& c = s.stereo.at("STEREO").camera;
	c.width = 160, c.height = 120, c.fx = c.fy = 70.75, c.cx = 79.5, c.cy = 59.5;
	return s;
}
/** Every file of a folder with its bytes. */
inline std::map<std::string, std::string> contents(const std::string& folder)
{
	std::map<std::string, std::string> files;
	for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
		if (entry.is_regular_file())
			files[std::filesystem::relative(entry.path(), folder).string()] =
				fileBytes(entry.path().string());
	return files;
}
}  // namespace posidonia::testing
