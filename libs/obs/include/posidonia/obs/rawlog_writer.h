#pragma once

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservation.h>

#include <string>

namespace posidonia
{
/** Writes a rawlog of single observations (format 2), whole or not at all: "<path>.part" becomes `path` in
 * finish(). */
class CRawlogWriter
{
   public:
	/** Throws CError when the file can't be opened. */
	explicit CRawlogWriter(const std::string& path);
	/** Removes the part file when finish() was not reached. */
	~CRawlogWriter();
	CRawlogWriter(const CRawlogWriter&) = delete;
	CRawlogWriter& operator=(const CRawlogWriter&) = delete;

	void write(const mrpt::obs::CObservation& observation);
	void finish();
	size_t count() const { return m_count; }

   private:
	std::string m_path;
	mrpt::io::CFileGZOutputStream m_stream;
	size_t m_count{0};
	bool m_finished{false};
};
}  // namespace posidonia
