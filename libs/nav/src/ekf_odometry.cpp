#include <posidonia/nav/ekf_odometry.h>

#include <algorithm>

namespace posidonia
{
CEkfOdometry::CEkfOdometry(
	const TEkfOptions& options, const TInitialPoseOptions& start, const TSensorSuite& sensors,
	const TWorldOptions& datum, const TDragOptions& drag)
	: m_setup(std::make_shared<const TNavigatorSetup>(options, drag, start, sensors, datum)),
	  m_decoder(m_setup),
	  m_navigator(m_setup),
	  m_past(m_setup),
	  m_history(options.history, m_navigator),
	  m_guard(options.max_stamp_jump)
{
}

void CEkfOdometry::add(const mrpt::obs::CObservation& observation)
{
	m_in_past = false;
	m_decoder.decode(observation, [this](const TSensorReading& reading) { take(reading); });
}

void CEkfOdometry::take(const TSensorReading& reading)
{
	TSensorCount dummy;	 // a picture of a rig without an entry
	TSensorCount& count = reading.sensor < 0 ? dummy : m_decoder.count(reading.sensor);
	const EArrival arrival = m_guard.judge(reading.stamp, m_navigator.stamp(), m_history.horizon());
	if (arrival == EArrival::TOO_LATE)
		count.late++;
	else if (arrival == EArrival::JUMPED)
		count.jumped++;
	else if (arrival == EArrival::CLOCK_RESET)
		resetClock(reading);
	else if (m_history.contains(reading))
		count.duplicate++;
	else if (arrival == EArrival::LATE || !m_history.isNewest(reading)) {
		count.replayed++;
		m_in_past = std::holds_alternative<TTick>(reading.what);
		m_in_past ? m_history.rewind(reading, m_past) : replay(reading);
	}
	else
		append(reading);
}

void CEkfOdometry::append(const TSensorReading& reading)
{
	if (m_kept && reading.sensor >= 0) m_kept->push_back(reading);
	m_history.append(reading, m_navigator);
	m_navigator.apply(reading);
}

void CEkfOdometry::replay(const TSensorReading& late)
{
	m_counts.replays++;
	if (m_kept && late.sensor >= 0) m_kept->push_back(late);
	const double newest = m_navigator.stamp();
	m_history.insertAndReplay(
		late, m_navigator, [&](double stamp, const TCloneMark& mark) { reviseEdge(stamp, mark, newest); });
}

void CEkfOdometry::reviseEdge(double stamp, const TCloneMark& mark, double newest)
{
	if (mark.index == m_clones) return;	 // it is being made
	if (newest - stamp > m_setup->options.edge_hold) {
		m_counts.edges_kept++;
		return;
	}
	const auto known = std::find_if(
		m_revised.begin(), m_revised.end(), [&](const auto& r) { return r.clone == mark.index; });
	if (known == m_revised.end()) {
		m_counts.edges_revised++;
		m_revised.push_back({mark.index, m_navigator.sinceClone(), m_navigator.now().T});
	}
	else
		*known = {mark.index, m_navigator.sinceClone(), m_navigator.now().T};
}

void CEkfOdometry::resetClock(const TSensorReading& reading)
{
	m_counts.clock_resets++;
	m_history.clear();
	m_navigator.resetClock(reading.stamp);
	append(reading);
}

void CEkfOdometry::clone()
{
	const TSensorReading mark{stamp(), -1, TCloneMark{m_clones}};
	if (m_in_past) {
		m_past.apply(mark);
		replay(mark);
	}
	else
		append(mark);
	m_clones++;
}

std::vector<TRevisedEdge> CEkfOdometry::takeRevisedEdges()
{
	std::vector<TRevisedEdge> taken;
	taken.swap(m_revised);
	return taken;
}

TDeclaredDrift CEkfOdometry::declaredDrift() const
{
	return {std::sqrt(navigationFilter().variance(kDvlScale)), 0};
}

TNavStatistics CEkfOdometry::statistics() const
{
	TNavStatistics s = m_counts;
	s.drag_time = m_navigator.dragTime();
	for (size_t i = 0; i < m_setup->sensor.size(); i++) {
		const int sensor = static_cast<int>(i);
		s.sensors[m_setup->sensor[i].label] = m_navigator.count(sensor).plus(m_decoder.count(sensor));
	}
	return s;
}
}  // namespace posidonia
