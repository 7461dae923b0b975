#include <posidonia/nav/reading_history.h>

#include <algorithm>

namespace posidonia
{
CReadingHistory::CReadingHistory(double length, const CNavigator& navigator)
	: m_length(length),
	  m_ring(64),
	  m_slots(
		  length > 0 ? static_cast<size_t>(std::ceil(length / kSnapshotPeriod)) + 2 : 0,
		  TSlot{navigator.snapshot(), 0})
{
}

void CReadingHistory::append(const TSensorReading& reading, const CNavigator& navigator)
{
	if (m_slots.empty()) return;
	takeSnapshotIfDue(reading.stamp, m_end, navigator);
	push(reading);
}

void CReadingHistory::takeSnapshotIfDue(double stamp, size_t next, const CNavigator& navigator)
{
	if (m_slot_count > 0 && stamp - slot(m_slot_count - 1).snapshot.stamp() < kSnapshotPeriod) return;
	if (std::isnan(navigator.stamp())) return;	// nothing has been applied yet
	if (m_slot_count == m_slots.size()) {
		m_first_slot = (m_first_slot + 1) % m_slots.size();
		m_slot_count--;
		m_begin = slot(0).next;	 // nobody can go back beyond
	}
	TSlot& newest = slot(m_slot_count++);
	navigator.save(newest.snapshot);
	newest.next = next;
}

void CReadingHistory::push(const TSensorReading& reading)
{
	if (m_end - m_begin == m_ring.size()) grow();
	at(m_end++) = reading;
}

void CReadingHistory::grow()
{
	std::vector<TSensorReading> bigger(2 * m_ring.size());
	for (size_t i = m_begin; i < m_end; i++)
		bigger[i % bigger.size()] = at(i);
	m_ring.swap(bigger);
}

double CReadingHistory::horizon() const
{
	if (m_slot_count == 0) return std::numeric_limits<double>::infinity();
	return std::max(slot(0).snapshot.stamp(), at(m_end - 1).stamp - m_length);
}

size_t CReadingHistory::placeOf(const TSensorReading& reading) const
{
	size_t place = m_end;
	while (place > m_begin && reading.isBefore(at(place - 1)))
		place--;
	return place;
}

bool CReadingHistory::contains(const TSensorReading& reading) const
{
	for (size_t i = placeOf(reading); i > m_begin && at(i - 1).stamp == reading.stamp; i--)
		if (at(i - 1).sensor == reading.sensor && at(i - 1).what.index() == reading.what.index()) return true;
	return false;
}

const CReadingHistory::TSlot& CReadingHistory::insert(const TSensorReading& reading)
{
	const size_t place = std::max(placeOf(reading), slot(0).next);	// what the oldest snapshot holds stays
	push(reading);
	for (size_t i = m_end - 1; i > place; i--)
		std::swap(at(i), at(i - 1));
	m_slot_count = slotBefore(place) + 1;  // later ones have not seen it; replaying takes them anew
	return slot(m_slot_count - 1);
}

size_t CReadingHistory::slotBefore(size_t place) const
{
	size_t i = m_slot_count - 1;
	while (i > 0 && slot(i).next > place)
		i--;
	return i;
}

void CReadingHistory::rewind(const TSensorReading& tick, CNavigator& view) const
{
	const size_t place = placeOf(tick);
	const TSlot& from = slot(slotBefore(place));
	view.restore(from.snapshot);
	for (size_t i = from.next; i < place; i++)
		view.apply(at(i));
	view.apply(tick);
}

void CReadingHistory::clear()
{
	m_begin = m_end = 0;
	m_first_slot = m_slot_count = 0;
}
}  // namespace posidonia
