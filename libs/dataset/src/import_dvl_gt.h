#pragma once

#include <posidonia/dataset/import_dataset.h>

namespace posidonia
{
/** importDataset() of EDatasetFormat::DVL_GT_CSV, with the output checked. */
TDatasetReport importDvlGt(const TDatasetOptions& options, const dataset_progress_t& progress);
}  // namespace posidonia
