#pragma once

#include <cstddef>
#include <memory>

namespace posidonia
{
/** Uninitialised doubles. Large ones lie on huge pages where the system has them: a solver touches tens of
 * megabytes for some milliseconds, and faulting them in page by page costs as much as the arithmetic. Grows
 * only; growing loses what it held. */
class CLargeBuffer
{
   public:
	CLargeBuffer();
	~CLargeBuffer();
	CLargeBuffer(CLargeBuffer&&) noexcept;
	CLargeBuffer& operator=(CLargeBuffer&&) noexcept;

	/** Throws std::bad_alloc. */
	void resize(size_t count);
	size_t size() const { return m_size; }
	double* data() { return m_data.get(); }
	const double* data() const { return m_data.get(); }

   private:
	struct TFree
	{
		size_t mapped_bytes;  ///< 0: from the heap

		void operator()(double* p) const;
	};
	using TDoubles = std::unique_ptr<double[], TFree>;
	TDoubles m_data{nullptr, TFree{0}};
	size_t m_size{0}, m_capacity{0};
};
}  // namespace posidonia
