#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/report/run_files.h>

#include <nlohmann/json.hpp>

#include "csv_lines.h"

namespace posidonia
{
std::string runInfoJson(const TRunInfo& i)
{
	const nlohmann::ordered_json json{
		{"app", i.app},
		{"title", i.title},
		{"versions", i.versions},
		{"truth", i.truth},
		{"interrupted", i.interrupted},
		{"start", i.start},
		{"duration", i.duration},
		{"latitude", i.datum.latitude},
		{"longitude", i.datum.longitude}};
	return json.dump(1, '\t') + "\n";
}

TRunInfo readRunInfo(const std::string& path)
{
	try {
		const auto json = nlohmann::json::parse(readFileText(path));
		TRunInfo i;
		json.at("app").get_to(i.app);
		json.at("title").get_to(i.title);
		json.at("versions").get_to(i.versions);
		json.at("truth").get_to(i.truth);
		json.at("interrupted").get_to(i.interrupted);
		json.at("start").get_to(i.start);
		json.at("duration").get_to(i.duration);
		json.at("latitude").get_to(i.datum.latitude);
		json.at("longitude").get_to(i.datum.longitude);
		return i;
	}
	catch (const nlohmann::json::exception& problem) {
		throw CError(path, problem.what(), kWriteAgain);
	}
}
}  // namespace posidonia
