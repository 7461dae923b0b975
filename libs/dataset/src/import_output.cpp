#include "import_output.h"

#include <posidonia/base/error.h>
#include <posidonia/obs/observations.h>

#include <filesystem>

namespace fs = std::filesystem;

namespace posidonia
{
std::string groundTruthPathOf(const std::string& rawlog)
{
	return rawlog.substr(0, rawlog.rfind(".rawlog")) + ".gt.tum";
}

void checkOutput(const TDatasetOptions& options)
{
	const fs::path path(options.output);
	if (path.extension() != ".rawlog" || path.stem().empty())
		throw CError(options.output, "must end in .rawlog", "give -o NAME.rawlog");
	if (options.overwrite) return;
	for (const auto& file :
		 {options.output, imagesFolderOf(options.output), sensorsPathOf(options.output),
		  groundTruthPathOf(options.output)})
		if (fs::exists(file))
			throw CError(file, "exists already", "choose another name, or give --overwrite");
}

void removeEarlier(const std::string& rawlog)
{
	std::error_code ignored;
	for (const auto& file :
		 {rawlog, imagesFolderOf(rawlog), sensorsPathOf(rawlog), groundTruthPathOf(rawlog)})
		fs::remove_all(file, ignored);
}

void mergeInto(CRawlogWriter& writer, const std::vector<TSource>& sources, TDatasetReport& report)
{
	std::vector<std::optional<TStampedObservation>> heads;
	for (const auto& source : sources)
		heads.push_back(source.next());
	for (;;) {
		size_t first = heads.size();
		for (size_t i = 0; i < heads.size(); i++)
			if (heads[i] && (first == heads.size() || heads[i]->stamp < heads[first]->stamp)) first = i;
		if (first == heads.size()) return;
		writer.write(*heads[first]->observation);
		report.last_stamp = double(heads[first]->stamp) * 1e-9;
		if (writer.count() == 1) report.first_stamp = report.last_stamp;
		report.observations[sources[first].label]++;
		heads[first] = sources[first].next();
	}
}
}  // namespace posidonia
