#include <posidonia/apps/run_folder.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>

#include <ctime>
#include <filesystem>
#include <iostream>

namespace fs = std::filesystem;

namespace posidonia
{
namespace
{
std::string utcNow()
{
	const std::time_t now = std::time(nullptr);
	char text[32];
	std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", std::gmtime(&now));
	return text;
}

/** runs/latest -> the newest run; replaced in one step. */
void linkLatest(const fs::path& run)
{
	std::error_code ignored;
	const fs::path part = run.parent_path() / "latest.part";
	fs::remove(part, ignored);
	fs::create_directory_symlink(run.filename(), part, ignored);
	fs::rename(part, run.parent_path() / "latest", ignored);
}
}  // namespace

CRunFolder::CRunFolder(const std::string& wanted, const std::string& name)
{
	m_path = wanted.empty() ? "runs/" + utcNow() + "-" + name : wanted;
	while (m_path.size() > 1 && m_path.back() == '/')
		m_path.pop_back();
	makeFolder(m_path);
	if (wanted.empty()) linkLatest(m_path);
}

void CRunFolder::write(const std::string& name, const std::string& text) const
{
	writeFileWhole(file(name), [&](std::ostream& out) { out << text; });
}

void CRunFolder::log(const std::string& text, int verbosity)
{
	m_log << text << "\n";
	if (verbosity >= 1) std::cout << text << "\n";
}

void CRunFolder::finish() const
{
	write("run.log", m_log.str());
}
}  // namespace posidonia
