#pragma once

#include <posidonia/dataset/import_dataset.h>
#include <posidonia/obs/rawlog_writer.h>

#include "row_sources.h"

namespace posidonia
{
/** <name>.gt.tum beside <name>.rawlog. */
std::string groundTruthPathOf(const std::string& rawlog);

/** Throws CError when the name is no rawlog's, or a file is there that must not be replaced. */
void checkOutput(const TDatasetOptions& options);

/** What an earlier import left (only with `overwrite`): its parts must not be taken for those of this one. */
void removeEarlier(const std::string& rawlog);

/** k-way merge by stamp; of equal stamps the earlier source comes first. */
void mergeInto(CRawlogWriter& writer, const std::vector<TSource>& sources, TDatasetReport& report);
}  // namespace posidonia
