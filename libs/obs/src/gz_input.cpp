#include "gz_input.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace posidonia
{
CGzInput::CGzInput(const std::string& path) : m_file(gzopen(path.c_str(), "rb"))
{
	std::error_code ignored;
	const auto size = std::filesystem::file_size(path, ignored);
	if (!ignored) m_size = size;
	if (m_file) gzbuffer(m_file, 1 << 16);
}

CGzInput::~CGzInput()
{
	if (m_file) gzclose(m_file);
}

size_t CGzInput::Read(void* buffer, size_t count)
{
	char* to = static_cast<char*>(buffer);
	size_t done = 0;
	while (done < count) {
		const size_t chunk = std::min<size_t>(count - done, 1u << 30);
		const int got = gzread(m_file, to + done, static_cast<unsigned>(chunk));
		if (got != static_cast<int>(chunk)) {  // the end, or trouble
			int status = Z_OK;
			gzerror(m_file, &status);
			m_broken = m_broken || got < 0 || (status != Z_OK && status != Z_STREAM_END);
		}
		if (got <= 0) break;
		done += static_cast<size_t>(got);
	}
	return done;
}

bool CGzInput::atEnd()
{
	char byte = 0;
	if (Read(&byte, 1) == 0) return true;
	gzungetc(static_cast<unsigned char>(byte), m_file);
	return false;
}

uint64_t CGzInput::bytesConsumed() const
{
	const auto offset = gzoffset(m_file);
	return offset < 0 ? m_size : static_cast<uint64_t>(offset);
}

uint64_t CGzInput::getPosition() const
{
	return static_cast<uint64_t>(std::max<z_off_t>(0, gztell(m_file)));
}
size_t CGzInput::Write(const void*, size_t)
{
	throw std::logic_error("CGzInput only reads");
}
uint64_t CGzInput::Seek(int64_t, TSeekOrigin)
{
	throw std::logic_error("CGzInput can't seek");
}
}  // namespace posidonia
