#pragma once

#include <string>

namespace posidonia
{
/** A bar on a terminal, a plain line each tenth in a pipe, nothing when quiet. Goes to stderr. */
class CProgress
{
   public:
	CProgress(const std::string& what, bool quiet);
	~CProgress();
	/** @param fraction 0 to 1, never decreasing @param detail e.g. "120 nodes, 34 loops" */
	void update(double fraction, const std::string& detail = "");

   private:
	void drawBar(double fraction, const std::string& detail);

	std::string m_what;
	bool m_quiet, m_terminal;
	int m_shown{-1};
};
}  // namespace posidonia
