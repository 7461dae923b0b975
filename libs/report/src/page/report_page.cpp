#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/report/exports.h>
#include <posidonia/report/run_pictures.h>
#include <posidonia/report/run_report.h>
#include <posidonia/report/svg_plot.h>

#include <ostream>
#include <string_view>

extern "C" {
extern const char posidonia_report_template[];
extern const char posidonia_report_template_end[];
}

namespace posidonia
{
namespace
{
std::string_view pageTemplate()
{
	return {
		posidonia_report_template,
		static_cast<size_t>(posidonia_report_template_end - posidonia_report_template)};
}

/** JSON inside a script element must not end it. */
std::string escaped(const std::string& json)
{
	std::string out;
	out.reserve(json.size());
	for (const char c : json)
		if (c == '<')
			out += "\\u003c";
		else
			out += c;
	return out;
}

void replaceOnce(std::string& text, const std::string& mark, const std::string& by)
{
	const size_t at = text.find(mark);
	if (at == std::string::npos)
		throw CError("report template", "has no " + mark, "build libs/report/web again");
	text.replace(at, mark.size(), by);
}
}  // namespace

std::string reportPage(const std::string& title, const std::string& json)
{
	std::string page(pageTemplate());
	replaceOnce(page, "__TITLE__", xmlEscaped(title));
	replaceOnce(page, "__RUN_JSON__", escaped(json));
	return page;
}

std::string writeReport(const TRunData& run, const std::string& folder)
{
	const auto floor = floorMosaic(run);
	writeRunPictures(run, folder);
	writeExports(run, folder + "/exports", floor);
	const std::string page = reportPage(run.info.title, runReportJson(run, floor));
	writeFileWhole(run.file("report.html"), [&](std::ostream& out) { out << page; });
	return run.file("report.html");
}
}  // namespace posidonia
