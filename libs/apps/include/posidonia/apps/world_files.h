#pragma once

#include <posidonia/apps/command_line.h>
#include <posidonia/sim/simulation_options.h>

namespace posidonia
{
/** The pictures that the world is made of are named from the ini's folder. */
inline void findWorldFiles(TSimulationOptions& world, const CCommandLine& line)
{
	for (std::string* image : {&world.floor.image, &world.relief.image})
		*image = line.besideConfig(*image);
}
}  // namespace posidonia
