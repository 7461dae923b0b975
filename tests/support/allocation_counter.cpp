#include "allocation_counter.h"

#include <cstdlib>
#include <new>

namespace
{
size_t g_allocations = 0;
}
size_t posidonia::testing::allocations()
{
	return g_allocations;
}

// In a file of their own: inlined into their callers, malloc and delete would look mismatched to the
// compiler.
void* operator new(size_t n)
{
	g_allocations++;
	if (void* p = std::malloc(n)) return p;
	throw std::bad_alloc();
}
void* operator new(size_t n, const std::nothrow_t&) noexcept  // std::stable_sort's
{
	g_allocations++;
	return std::malloc(n);
}
void operator delete(void* p) noexcept
{
	std::free(p);
}
void operator delete(void* p, size_t) noexcept
{
	std::free(p);
}
