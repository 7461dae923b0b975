#include <posidonia/apps/CReportApp.h>

#include <iostream>

namespace posidonia
{
bool CReportApp::initialize(int argc, const char* const* argv)
{
	CCommandLine line(
		name,
		"Makes the report of a run anew from its folder: report.html, which opens offline in any browser,\n"
		"plots for papers (SVG), and files for other programs in exports/ (KML, GeoJSON, CSV, simplemap, "
		"scene).\n"
		"Example: auv-report runs/latest",
		"Folder for the plots and exports (default: RUN); report.html stays in RUN, beside its pictures",
		"DIR", false);
	TCLAP::UnlabeledValueArg<std::string> folder(
		"run", "Folder of a run of auv-graphslam, auv-mission or auv-ekf (default: runs/latest)", false,
		"runs/latest", "RUN", line.cmd());
	if (!line.parse(argc, argv)) return false;
	m_folder = folder.getValue();
	m_output = line.outputDir().empty() ? m_folder : line.outputDir();
	m_verbosity = line.verbosity();
	return true;
}

void CReportApp::run()
{
	m_results = {};
	m_results.page = writeReport(readRun(m_folder), m_output);
	if (m_verbosity > 0)
		std::cout << "report: " << m_results.page << "\nexports: " << m_output << "/exports\n";
}
}  // namespace posidonia
