#include <posidonia/posegraph/large_buffer.h>

#include <cstdlib>
#include <new>
#include <utility>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace posidonia
{
namespace
{
constexpr size_t kHugePage = size_t(2) << 20, kLine = 64;

size_t rounded(size_t bytes, size_t unit)
{
	return (bytes + unit - 1) / unit * unit;
}
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
	std::free(p);
}

void CLargeBuffer::resize(size_t count)
{
	m_size = count;
	if (count <= m_capacity) return;
	m_data.reset();
	const size_t wanted = count * sizeof(double);
	const size_t unit = wanted >= kHugePage / 2 ? kHugePage : kLine;
	const size_t bytes = rounded(wanted, unit);
	m_data.reset(static_cast<double*>(std::aligned_alloc(unit, bytes)));
	if (!m_data) throw std::bad_alloc();
	m_capacity = bytes / sizeof(double);
#ifdef __linux__
	if (unit == kHugePage) madvise(m_data.get(), bytes, MADV_HUGEPAGE);	 // a wish; small pages will do
#endif
}
}  // namespace posidonia
