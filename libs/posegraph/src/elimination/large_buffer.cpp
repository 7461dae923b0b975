#include <posidonia/posegraph/large_buffer.h>

#include <cstdint>
#include <cstdlib>
#include <new>
#include <utility>
#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace posidonia
{
namespace
{
constexpr size_t kHugePage = size_t(2) << 20, kMapped = size_t(1) << 20, kLine = 64;

size_t rounded(size_t bytes, size_t unit)
{
	return (bytes + unit - 1) / unit * unit;
}

#ifdef __linux__
size_t pageSize()
{
	static const size_t size = size_t(sysconf(_SC_PAGESIZE));
	return size;
}

/** Whole pages of the system's own, which go back to it when they are freed: in the heap, freed pieces
 * between small ones that stay would double the memory of a graph that grows. They start at a huge page; what
 * is mapped too much for that is given back. */
void* mapped(size_t bytes)
{
	const size_t reserved = bytes + kHugePage - pageSize();
	void* begin = mmap(nullptr, reserved, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
	if (begin == MAP_FAILED) throw std::bad_alloc();
	char* const first = static_cast<char*>(begin);
	const size_t skip =
		rounded(reinterpret_cast<uintptr_t>(first), kHugePage) - reinterpret_cast<uintptr_t>(first);
	const size_t over = reserved - skip - bytes;
	if (skip > 0) munmap(first, skip);
	if (over > 0) munmap(first + skip + bytes, over);
	madvise(first + skip, bytes, MADV_HUGEPAGE);  // a wish; small pages will do
	return first + skip;
}
#endif
}  // namespace

CLargeBuffer::CLargeBuffer() = default;
CLargeBuffer::~CLargeBuffer() = default;
CLargeBuffer::CLargeBuffer(CLargeBuffer&& other) noexcept
{
	*this = std::move(other);
}
CLargeBuffer& CLargeBuffer::operator=(CLargeBuffer&& other) noexcept
{
	m_data = std::move(other.m_data);
	m_size = std::exchange(other.m_size, 0);
	m_capacity = std::exchange(other.m_capacity, 0);
	return *this;
}

void CLargeBuffer::TFree::operator()(double* p) const
{
#ifdef __linux__
	if (mapped_bytes > 0) {
		munmap(p, mapped_bytes);
		return;
	}
#endif
	std::free(p);
}

void CLargeBuffer::resize(size_t count)
{
	m_size = count;
	if (count <= m_capacity) return;
	m_data.reset();
	m_capacity = 0;
	const size_t wanted = count * sizeof(double);
#ifdef __linux__
	if (wanted >= kMapped) {
		const size_t bytes = rounded(wanted, pageSize());
		m_data = TDoubles(static_cast<double*>(mapped(bytes)), TFree{bytes});
		m_capacity = bytes / sizeof(double);
		return;
	}
#endif
	const size_t bytes = rounded(wanted, kLine);
	m_data = TDoubles(static_cast<double*>(std::aligned_alloc(kLine, bytes)), TFree{0});
	if (!m_data) throw std::bad_alloc();
	m_capacity = bytes / sizeof(double);
}
}  // namespace posidonia
