#include <mrpt/serialization/CArchive.h>
#include <posidonia/base/error.h>
#include <posidonia/obs/rawlog_writer.h>

#include <filesystem>

namespace posidonia
{
CRawlogWriter::CRawlogWriter(const std::string& path) : m_path(path)
{
	if (!m_stream.open(path + ".part", 1 /* fast compression */))
		throw CError(
			path + ".part", "can't be opened for writing", "check that its folder exists and is writable");
}

CRawlogWriter::~CRawlogWriter()
{
	if (m_finished) return;
	m_stream.close();
	std::error_code ignored;
	std::filesystem::remove(m_path + ".part", ignored);
}

void CRawlogWriter::write(const mrpt::obs::CObservation& observation)
{
	auto archive = mrpt::serialization::archiveFrom(m_stream);
	archive << observation;
	m_count++;
}

void CRawlogWriter::finish()
{
	m_stream.close();
	std::error_code problem;
	std::filesystem::rename(m_path + ".part", m_path, problem);
	if (problem) throw CError(m_path, "can't be replaced: " + problem.message(), "check its permissions");
	m_finished = true;
}
}  // namespace posidonia
