#pragma once

#include <mrpt/system/CTimeLogger.h>
#include <posidonia/eval/metrics.h>
#include <posidonia/graphslam/slam_map.h>
#include <posidonia/obs/rawlog_reader.h>

#include <string>
#include <vector>

namespace posidonia
{
/** timings.csv: stage,calls,mean_ms,max_ms,total_s,ms_per_node. */
std::string timingsCsv(mrpt::system::CTimeLogger& timer, int nodes);

/** "key_frame 20.5 s, rendering 5.9 s": what took the most time first, CPU or waiting, of several timers. */
std::string stagesText(const std::vector<mrpt::system::CTimeLogger*>& timers);

/** "312 candidates: 201 too few matches, 74 RANSAC failed, 37 accepted", by kind. */
std::string candidateCounts(const std::vector<TCandidateRow>& rows);

/** The few numbers of a score that a terminal needs. */
std::string scoreSummary(const TMetrics& metrics);

/** What a replay lost or left aside, in words; empty when nothing. */
std::string replayLosses(const CRawlogReader& reader);

/** "816.0 s of log in 62.1 s (13 x real time), peak memory 210 MB"; the memory is this process's so far. */
std::string speedText(double log_seconds, double seconds);

/** What a run that was interrupted says of itself. */
std::string interruptedText();

/** The truth to score by: `given` (must exist), else <name>.gt.tum beside the rawlog, else empty. */
std::string truthFor(const std::string& rawlog, const std::string& given);
}  // namespace posidonia
