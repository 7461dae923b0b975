#pragma once

#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace posidonia
{
/** f(0) ... f(n-1) on at most `threads` threads; f(k) must write its own output only, so that the result does
 * not depend on the number of threads. The first exception is passed on. */
template <class F>
void parallelFor(size_t n, int threads, F&& f)
{
	std::atomic<size_t> next{0};
	std::vector<std::exception_ptr> problems(n);
	const auto work = [&] {
		for (size_t k = next++; k < n; k = next++) {
			try {
				f(k);
			}
			catch (...) {
				problems[k] = std::current_exception();
			}
		}
	};
	std::vector<std::thread> helpers;
	for (size_t t = 1; t < std::min(n, static_cast<size_t>(threads)); t++)
		helpers.emplace_back(work);
	work();
	for (auto& t : helpers)
		t.join();
	for (const auto& p : problems)
		if (p) std::rethrow_exception(p);
}
}  // namespace posidonia
