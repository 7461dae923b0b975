#pragma once

namespace posidonia
{
/** While it lives, Ctrl-C (SIGINT) and SIGTERM ask the app to stop and to write what it has. A second one
 * ends the program at once. One at a time. */
class CInterrupt
{
   public:
	CInterrupt();
	~CInterrupt();
	CInterrupt(const CInterrupt&) = delete;
	CInterrupt& operator=(const CInterrupt&) = delete;

	/** Was it asked for? */
	bool requested() const;
	/** Exit status of a run that was interrupted (128 + SIGINT, as shells have it). */
	static constexpr int kStatus = 130;
};
}  // namespace posidonia
