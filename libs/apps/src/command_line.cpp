#include <posidonia/apps/command_line.h>
#include <posidonia/base/error.h>

#include <filesystem>
#include <iostream>
#include <sstream>

namespace posidonia
{
namespace
{
constexpr const char* kVersion = POSIDONIA_VERSION;
}

std::string versionText()
{
	return std::string("Posidonia ") + kVersion +
		   ": stereo graph-SLAM for AUVs, on MRPT\n"
		   "BSD-3-Clause. SuiteSparse's AMD and CAMD (BSD-3) order the elimination; nothing of it that is "
		   "GPL "
		   "is linked.\n"
		   "Embree (Apache-2.0) traces the rays of simulated relief.\n";
}

namespace
{
constexpr size_t kWidth = 100, kColumn = 30;  // of a help line, and where its second column begins

/** "FILE.ini" of TCLAP's "[-c <FILE.ini>]"; empty for a switch. */
std::string valueOf(const TCLAP::Arg& arg)
{
	const std::string id = arg.shortID();
	const size_t from = id.find('<'), to = id.find('>');
	return from == std::string::npos ? "" : id.substr(from + 1, to - from - 1);
}

/** "RUN": given by its place, without a flag. */
bool isUnlabeled(const TCLAP::Arg& arg)
{
	return arg.shortID().find('-') == std::string::npos;
}

/** "-c, --config FILE.ini", or "RUN" for an argument without a flag. */
std::string flagsOf(const TCLAP::Arg& arg)
{
	const std::string value = valueOf(arg);
	if (isUnlabeled(arg)) return value;
	std::string text = arg.getFlag().empty() ? "    " : "-" + arg.getFlag() + ", ";
	text += "--" + arg.getName();
	return value.empty() ? text : text + " " + value;
}

/** The text in lines that fit, all but the first indented. */
std::string wrapped(const std::string& text, size_t indent)
{
	std::string out;
	size_t column = indent;
	std::istringstream words(text);
	for (std::string word; words >> word;) {
		if (column > indent && column + 1 + word.size() > kWidth) {
			out += "\n" + std::string(indent, ' ');
			column = indent;
		}
		else if (column > indent) {
			out += ' ';
			column++;
		}
		out += word;
		column += word.size();
	}
	return out;
}

std::string optionLine(const TCLAP::Arg& arg)
{
	const std::string flags = "  " + flagsOf(arg);
	const std::string gap = flags.size() + 2 > kColumn ? "\n" + std::string(kColumn, ' ')
													   : std::string(kColumn - flags.size(), ' ');
	return flags + gap + wrapped(arg.getDescription(), kColumn) + "\n";
}

/** One screen, as GNU programs have it; man pages are made of it. The message holds what the app does, then
 * its example and exit status, a line each. */
std::string helpText(TCLAP::CmdLineInterface& cmd)
{
	const std::string& message = cmd.getMessage();
	const size_t example = message.find("Example"), status = message.find("Exit status");
	const std::string program = std::filesystem::path(cmd.getProgramName()).filename().string();
	std::string usage = "Usage: " + program + " [OPTION]...", options;
	for (TCLAP::Arg* arg : cmd.getArgList()) {
		if (arg->getName() == "ignore_rest") continue;
		const std::string line = optionLine(*arg);
		if (isUnlabeled(*arg)) usage += arg->isRequired() ? " " + valueOf(*arg) : " [" + valueOf(*arg) + "]";
		options = line + options;  // TCLAP has the newest first
	}
	return usage + "\n" + wrapped(message.substr(0, example), 0) + "\n\nOptions:\n" + options + "\n" +
		   message.substr(example, status - example) + message.substr(status) + "\n";
}

/** TCLAP's --help and --version, ours. */
class CVersionOutput : public TCLAP::StdOutput
{
   public:
	void version(TCLAP::CmdLineInterface&) override { std::cout << versionText(); }
	void usage(TCLAP::CmdLineInterface& cmd) override { std::cout << helpText(cmd); }
	void failure(TCLAP::CmdLineInterface&, TCLAP::ArgException& e) override { throw e; }
};
}  // namespace

CCommandLine::CCommandLine(
	const std::string& app, const std::string& description, const std::string& output_text,
	const std::string& output_type, bool takes_config)
	: m_app(app),
	  m_cmd(description + "\nExit status: 0 done, 1 failed, 2 wrong command line.", ' ', kVersion),
	  m_config("c", "config", "Ini file; without it every key has its default", false, "", "FILE.ini"),
	  m_output("o", "output-dir", output_text, false, "", output_type, m_cmd),
	  m_set("", "set", "Override one key; may be repeated", false, "Section.key=value"),
	  m_verbosity("v", "verbosity", "0 quiet, 1 summary (default), 2 details", false, 1, "0|1|2", m_cmd),
	  m_dump("", "dump-config", "Print the configuration as used, with every key's meaning, and stop")
{
	if (takes_config)
		for (TCLAP::Arg* arg : std::initializer_list<TCLAP::Arg*>{&m_config, &m_set, &m_dump})
			m_cmd.add(arg);
	m_cmd.setExceptionHandling(false);
}

bool CCommandLine::parse(int argc, const char* const* argv)
{
	static CVersionOutput output;
	m_cmd.setOutput(&output);
	try {
		m_cmd.parse(argc, argv);
	}
	catch (const TCLAP::ExitException&) {
		return false;
	}
	catch (const TCLAP::ArgException& e) {
		throw CUsageError(
			e.argId() == " " ? "command line" : e.argId(), e.error(), "see " + m_app + " --help");
	}
	return true;
}

CIniFile CCommandLine::ini(const std::string& fallback) const
{
	const std::string path = m_config.isSet()					 ? m_config.getValue()
							 : std::filesystem::exists(fallback) ? fallback
																 : "";
	CIniFile ini =
		path.empty() && !m_config.isSet() ? CIniFile::fromText("", "defaults") : CIniFile::fromFile(path);
	for (const auto& assignment : m_set.getValue())
		ini.set(assignment);
	return ini;
}

std::string CCommandLine::configName() const
{
	return m_config.isSet() ? std::filesystem::path(m_config.getValue()).stem().string() : "defaults";
}

std::string CCommandLine::besideConfig(const std::string& path) const
{
	if (std::filesystem::exists(path) || !m_config.isSet()) return path;
	const auto beside = std::filesystem::path(m_config.getValue()).parent_path() / path;
	return std::filesystem::exists(beside) ? beside.string() : path;
}

namespace
{
/** MRPT's exceptions come with a call stack; a user needs the message. */
std::string firstParagraph(const std::string& text)
{
	const auto marker = text.find("Message:");
	std::string message = marker == std::string::npos ? text : text.substr(marker + 8);
	for (const char* end : {"\nLocation:", "\n==", "\nCall"})
		message = message.substr(0, message.find(end));
	const auto first = message.find_first_not_of(" \n"), last = message.find_last_not_of(" \n");
	return first == std::string::npos ? text : message.substr(first, last - first + 1);
}
}  // namespace

int reportProblem(const char* app, const std::exception& problem)
{
	std::cerr << app << ": error: " << firstParagraph(problem.what()) << "\n";
	return dynamic_cast<const CUsageError*>(&problem) ? 2 : 1;
}
}  // namespace posidonia
