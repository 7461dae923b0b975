#include <posidonia/apps/interrupt.h>

#include <csignal>

namespace posidonia
{
namespace
{
volatile std::sig_atomic_t g_requested = 0;

extern "C" void rememberInterrupt(int)
{
	g_requested = 1;
}

void handle(int signal, void (*handler)(int))
{
	struct sigaction action = {};
	action.sa_handler = handler;
	action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);	// the second one ends the program
	sigaction(signal, &action, nullptr);
}
}  // namespace

CInterrupt::CInterrupt()
{
	g_requested = 0;
	handle(SIGINT, rememberInterrupt);
	handle(SIGTERM, rememberInterrupt);
}

CInterrupt::~CInterrupt()
{
	handle(SIGINT, SIG_DFL);
	handle(SIGTERM, SIG_DFL);
}

bool CInterrupt::requested() const
{
	return g_requested != 0;
}
}  // namespace posidonia
