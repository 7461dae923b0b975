#pragma once

#include <mrpt/io/CStream.h>
#include <zlib.h>

#include <string>

namespace posidonia
{
/** A file, gzip-compressed or plain, as an MRPT stream. Unlike MRPT's own it tells a file that was cut off or
 * whose checksum fails from one that ends, and how much of the compressed file has been read. */
class CGzInput : public mrpt::io::CStream
{
   public:
	explicit CGzInput(const std::string& path);
	~CGzInput() override;
	CGzInput(const CGzInput&) = delete;
	CGzInput& operator=(const CGzInput&) = delete;

	bool isOpen() const { return m_file != nullptr; }
	/** No byte left, be it the regular end or a break: see broken(). */
	bool atEnd();
	/** Cut off within the compressed data, or a wrong checksum. */
	bool broken() const { return m_broken; }
	/** Bytes of the file on disk that have been consumed. */
	uint64_t bytesConsumed() const;

	size_t Read(void* buffer, size_t count) override;
	uint64_t getTotalBytesCount() const override { return m_size; }
	uint64_t getPosition() const override;
	/** Not for this stream: they throw std::logic_error. */
	size_t Write(const void*, size_t) override;
	uint64_t Seek(int64_t, TSeekOrigin) override;

   private:
	gzFile m_file{nullptr};
	uint64_t m_size{0};
	bool m_broken{false};
};
}  // namespace posidonia
