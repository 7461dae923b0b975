#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/obs/rawlog_reader.h>
#include <posidonia/obs/register_observations.h>

using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CRawlog;
using mrpt::obs::CSensoryFrame;
using mrpt::serialization::CSerializable;

namespace posidonia
{
CRawlogReader::CRawlogReader(const std::string& path) : m_path(path)
{
	registerObservations();
	requireFile(path, "give an existing rawlog with -r/--rawlog");
	if (!m_stream.open(path)) throw CError(path, "can't be opened", "check its permissions");
	const auto first = next();
	if (!first)
		throw CError(path, m_damage.empty() ? "holds no observation" : "is no rawlog: " + m_damage, "check the file");
	m_pending.push_front(first);
}

double CRawlogReader::progress() const
{
	const auto total = m_stream.getTotalBytesCount();
	return total ? static_cast<double>(m_stream.getPosition()) / static_cast<double>(total) : 0;
}

CObservation::Ptr CRawlogReader::next()
{
	while (m_pending.empty())
	{
		const auto object = readObject();
		if (!object) return {};
		unpack(object);
	}
	const auto observation = m_pending.front();
	m_pending.pop_front();
	return observation;
}

CSerializable::Ptr CRawlogReader::readObject()
{
	if (m_ended) return {};
	try
	{
		CSerializable::Ptr object;
		auto archive = mrpt::serialization::archiveFrom(m_stream);
		archive >> object;
		m_entry++;
		return object;
	}
	catch (const mrpt::serialization::CExceptionEOF&)
	{
		m_ended = true;	 // at an object's first byte: the regular end
	}
	catch (const std::exception& problem)
	{
		const std::string text = problem.what();
		if (text.find("not registered") != std::string::npos)
		{
			const auto from = text.find('\''), to = text.find('\'', from + 1);
			throw CError(
				m_path, "entry " + std::to_string(m_entry) + ": class " + text.substr(from, to - from + 1) + " is not known",
				"remove it with rawlog-edit --remove-label, or load its plug-in");
		}
		m_ended = true;
		m_damage = "damaged after entry " + std::to_string(m_entry) + " (cut off or corrupt); what stands before is used";
	}
	return {};
}

void CRawlogReader::unpack(const CSerializable::Ptr& object)
{
	if (auto observation = std::dynamic_pointer_cast<CObservation>(object))
	{
		m_pending.push_back(observation);
	}
	else if (auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object))
	{
		for (const auto& o : *frame) m_pending.push_back(o);
	}
	else if (auto log = std::dynamic_pointer_cast<CRawlog>(object))
	{
		for (size_t i = 0; i < log->size(); i++)
			unpack(std::dynamic_pointer_cast<CSerializable>(log->getAsGeneric(i)));
	}
	else if (std::dynamic_pointer_cast<CActionCollection>(object))
	{
		m_actions++;
	}
	else
	{
		throw CError(
			m_path,
			"entry " + std::to_string(m_entry - 1) + " is a " + object->GetRuntimeClass()->className +
				", neither an observation nor a sensory frame",
			"convert the log to single observations");
	}
}
}  // namespace posidonia
