#include "gz_input.h"

#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/obs/rawlog_reader.h>
#include <posidonia/obs/register_observations.h>

#include <algorithm>
#include <cctype>

using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CRawlog;
using mrpt::obs::CSensoryFrame;
using mrpt::serialization::CSerializable;

namespace posidonia
{
namespace
{
bool looksLikeClassName(const std::string& name)
{
	const auto fits = [](unsigned char c) {
		return std::isalnum(c) || c == '_' || c == ':' || c == '<' || c == '>';
	};
	return !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
		   std::all_of(name.begin(), name.end(), fits);
}
}  // namespace

CRawlogReader::CRawlogReader(const std::string& path) : m_path(path)
{
	registerObservations();
	requireFile(path, "give an existing rawlog with -r/--rawlog");
	m_stream = std::make_unique<CGzInput>(path);
	if (!m_stream->isOpen()) throw CError(path, "can't be opened", "check its permissions");
	const auto first = next();
	if (!first && m_damage.empty()) throw CError(path, "holds no observation", "check the file");
	if (!first)
		throw CError(path, "is no rawlog, or is cut off before its first observation ends", "check the file");
	m_pending.push_front(first);
}

CRawlogReader::~CRawlogReader() = default;

double CRawlogReader::progress() const
{
	const auto total = m_stream->getTotalBytesCount();
	return total ? static_cast<double>(m_stream->bytesConsumed()) / static_cast<double>(total) : 1;
}

CObservation::Ptr CRawlogReader::next()
{
	while (m_pending.empty()) {
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
	m_ended = m_stream->atEnd();
	if (m_ended && m_stream->broken()) endDamaged();
	if (m_ended) return {};
	try {
		CSerializable::Ptr object;
		auto archive = mrpt::serialization::archiveFrom(*m_stream);
		archive >> object;
		m_entry++;
		return object;
	}
	catch (const std::exception& problem)  // also the end of the file, within an object
	{
		refuseUnknownClass(problem.what());
		endDamaged();
	}
	return {};
}

void CRawlogReader::refuseUnknownClass(const std::string& text) const
{
	if (text.find("not registered") == std::string::npos) return;
	const auto from = text.find('\'') + 1, to = text.find('\'', from);
	const std::string name = text.substr(from, to - from);
	if (!looksLikeClassName(name)) return;	// rubbish, read as a name
	throw CError(
		m_path, "entry " + std::to_string(m_entry) + ": class '" + name + "' is not known",
		"remove it with rawlog-edit --remove-label, or load its plug-in");
}

void CRawlogReader::endDamaged()
{
	m_ended = true;
	m_damage = m_path + ": damaged after entry " + std::to_string(m_entry) +
			   " (cut off or corrupt); what stands before is used";
}

void CRawlogReader::unpack(const CSerializable::Ptr& object)
{
	if (auto observation = std::dynamic_pointer_cast<CObservation>(object)) {
		m_pending.push_back(observation);
	}
	else if (auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object)) {
		for (const auto& o : *frame)
			m_pending.push_back(o);
	}
	else if (auto log = std::dynamic_pointer_cast<CRawlog>(object)) {
		for (size_t i = 0; i < log->size(); i++)
			unpack(std::dynamic_pointer_cast<CSerializable>(log->getAsGeneric(i)));
	}
	else if (std::dynamic_pointer_cast<CActionCollection>(object)) {
		m_actions++;
	}
	else {
		throw CError(
			m_path,
			"entry " + std::to_string(m_entry - 1) + " is a " + object->GetRuntimeClass()->className +
				", neither an observation nor a sensory frame",
			"convert the log to single observations");
	}
}
}  // namespace posidonia
