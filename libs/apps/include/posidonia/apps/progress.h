#pragma once

#include <chrono>
#include <string>

namespace posidonia
{
/** A bar with the time that is left on a terminal, a plain line each tenth in a pipe, nothing when quiet.
 * Goes to stderr. */
class CProgress
{
   public:
	CProgress(const std::string& what, bool quiet);
	~CProgress();
	/** @param fraction 0 to 1, never decreasing @param detail e.g. "120 nodes, 34 loops" */
	void update(double fraction, const std::string& detail = "");

   private:
	void drawBar(double fraction, const std::string& detail);
	/** "1:05 left", by the pace so far; empty at either end. */
	std::string timeLeft(double fraction) const;

	std::string m_what;
	bool m_quiet, m_terminal;
	int m_shown{-1};
	std::chrono::steady_clock::time_point m_begun{std::chrono::steady_clock::now()};
};
}  // namespace posidonia
