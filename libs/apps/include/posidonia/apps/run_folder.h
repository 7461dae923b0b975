#pragma once

#include <posidonia/geometry/trajectory.h>

#include <sstream>
#include <string>

namespace posidonia
{
/** One run = one folder that explains itself. */
class CRunFolder
{
   public:
	/** `wanted` (-o) or, when empty, runs/<UTC time>-<name>/ with the link runs/latest. Makes it. */
	CRunFolder(const std::string& wanted, const std::string& name);

	const std::string& path() const { return m_path; }
	std::string file(const std::string& name) const { return m_path + "/" + name; }
	/** Writes a file of the folder whole. */
	void write(const std::string& name, const std::string& text) const;

	/** Adds a line to run.log (written by finish()) and, from `verbosity` 1 on, to the terminal. */
	void log(const std::string& text, int verbosity);
	void finish() const;

   private:
	std::string m_path;
	std::ostringstream m_log;
};
}  // namespace posidonia
