#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>

#include <deque>
#include <memory>
#include <string>

namespace posidonia
{
class CGzInput;

/** Reads a rawlog observation by observation, in the file's order (that of arrival; never sorted).
 * Format 2 (single observations) and format 1 (actions and sensory frames: the frames' observations are given
 * out, robot actions are counted and left aside, since the odometry here comes from the sensors). */
class CRawlogReader
{
   public:
	/** Throws CError when the file does not exist or is no rawlog. */
	explicit CRawlogReader(const std::string& path);
	~CRawlogReader();

	/** The next observation, or null at the end. Throws CError for an unknown class (names it and the entry).
	 * A truncated file ends the log early: see damage(). */
	mrpt::obs::CObservation::Ptr next();

	const std::string& path() const { return m_path; }
	size_t entry() const { return m_entry; }  ///< Objects read so far
	size_t actionsLeftAside() const { return m_actions; }
	/** What was lost, in words for the user; empty while the file is whole. */
	const std::string& damage() const { return m_damage; }
	/** How much of the file has been read, 0 to 1. */
	double progress() const;

   private:
	mrpt::serialization::CSerializable::Ptr readObject();
	void refuseUnknownClass(const std::string& archive_error) const;
	void endDamaged();
	void unpack(const mrpt::serialization::CSerializable::Ptr& object);

	std::string m_path;
	std::unique_ptr<CGzInput> m_stream;
	std::deque<mrpt::obs::CObservation::Ptr> m_pending;
	size_t m_entry{0}, m_actions{0};
	bool m_ended{false};
	std::string m_damage;
};
}  // namespace posidonia
