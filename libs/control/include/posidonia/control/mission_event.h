#pragma once

#include <string>

namespace posidonia
{
enum class EMissionEvent
{
	STEP_STARTED,
	STEP_REACHED,
	STEP_TIMED_OUT,
	MISSION_DONE,
	MISSION_ABORTED,
	SAFETY_LEVEL
};
std::string toString(EMissionEvent kind);

struct TMissionEvent
{
	double stamp{0};  ///< [s]
	EMissionEvent kind{EMissionEvent::STEP_STARTED};
	std::string text;
};
}  // namespace posidonia
