#include <posidonia/apps/process_meter.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>

namespace posidonia
{
namespace
{
double wallSeconds()
{
	return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
}  // namespace

double processCpuSeconds()
{
	timespec t{};
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double peakMemoryMb()
{
	rusage usage{};
	getrusage(RUSAGE_SELF, &usage);
	return static_cast<double>(usage.ru_maxrss) * 1024e-6;	// Linux counts in KiB
}

CStageMeter::CStageMeter() : m_cpu(processCpuSeconds()), m_wall(wallSeconds()) {}

void CStageMeter::end(const std::string& stage)
{
	const double cpu = processCpuSeconds(), wall = wallSeconds();
	m_stages.push_back({stage, cpu - m_cpu, wall - m_wall});
	m_cpu = cpu;
	m_wall = wall;
}

CStageMeter::TStage CStageMeter::sum(const std::vector<std::string>& names) const
{
	TStage total;
	for (const TStage& stage : m_stages) {
		if (std::find(names.begin(), names.end(), stage.name) == names.end()) continue;
		total.cpu += stage.cpu;
		total.wall += stage.wall;
	}
	return total;
}
}  // namespace posidonia
