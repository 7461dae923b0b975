#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace posidonia
{
/** Writes a whole file or none: `write` fills a stream on "<path>.part", which is renamed to `path` only
 * when everything was written. Throws CError (with the path) when the disk refuses. */
void writeFileWhole(const std::string& path, const std::function<void(std::ostream&)>& write);

/** The text of a file; throws CError naming `path` when it can't be read. */
std::string readFileText(const std::string& path);

/** Throws CError "<path>: no such file; <way_out>" unless `path` is a readable file. */
void requireFile(const std::string& path, const std::string& way_out);

/** A folder beside `path` made if absent (as `mkdir -p`); throws CError when it can't be made. */
void makeFolder(const std::string& path);

/** `name` and its closest neighbour among `known`: "did you mean 'x'?", or the list when none is close. */
std::string didYouMean(const std::string& name, const std::vector<std::string>& known);
}  // namespace posidonia
