#include <posidonia/apps/progress.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace posidonia
{
CProgress::CProgress(const std::string& what, bool quiet)
	: m_what(what), m_quiet(quiet), m_terminal(isatty(STDERR_FILENO) == 1)
{
}

CProgress::~CProgress()
{
	if (!m_quiet && m_terminal && m_shown >= 0) std::fputc('\n', stderr);
}

void CProgress::update(double fraction, const std::string& detail)
{
	if (m_quiet) return;
	const int step = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * (m_terminal ? 200 : 10));
	if (step <= m_shown) return;
	m_shown = step;
	if (m_terminal)
		drawBar(fraction, detail);
	else
		std::fprintf(stderr, "%s: %3d %% %s\n", m_what.c_str(), step * 10, detail.c_str());
}

void CProgress::drawBar(double fraction, const std::string& detail)
{
	constexpr int kWidth = 30;
	const int full = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kWidth);
	const std::string bar =
		std::string(static_cast<size_t>(full), '#') + std::string(static_cast<size_t>(kWidth - full), '.');
	std::fprintf(
		stderr, "\r%s [%s] %3d %% %s%s\033[K", m_what.c_str(), bar.c_str(),
		static_cast<int>(std::clamp(fraction, 0.0, 1.0) * 100), detail.c_str(), timeLeft(fraction).c_str());
	std::fflush(stderr);
}

std::string CProgress::timeLeft(double fraction) const
{
	if (fraction < 0.02 || fraction >= 1) return {};
	const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - m_begun).count();
	const int left = static_cast<int>(spent * (1 - fraction) / fraction + 0.5);
	char text[40];
	std::snprintf(text, sizeof text, ", %d:%02d left", left / 60, left % 60);
	return text;
}
}  // namespace posidonia
