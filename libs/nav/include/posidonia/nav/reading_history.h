#pragma once

#include <posidonia/nav/navigator.h>

#include <vector>

namespace posidonia
{
/** The last seconds of readings in order of their stamps, with snapshots of a navigator on the way: a reading
 * that comes late is put in its place and everything after it is replayed. Allocates only while it grows to
 * its length. */
class CReadingHistory
{
   public:
	/** `length` [s]; 0: nothing can be replayed. */
	CReadingHistory(double length, const CNavigator& navigator);

	/** The newest reading, about to be applied to `navigator`. */
	void append(const TSensorReading& reading, const CNavigator& navigator);
	/** Earliest stamp that insert() takes [s]. */
	double horizon() const;
	/** Does it belong behind all others? */
	bool isNewest(const TSensorReading& reading) const
	{
		return m_begin == m_end || !reading.isBefore(at(m_end - 1));
	}
	bool contains(const TSensorReading& reading) const;
	/** Puts a late reading in its place, takes `navigator` back and applies everything after; `before(mark)`
	 * is called before each clone mark on the way. */
	template <class BEFORE_MARK>
	void insertAndReplay(const TSensorReading& reading, CNavigator& navigator, BEFORE_MARK&& before);
	/** Takes `view` to the state that the readings up to `tick`, itself included, lead to. */
	void rewind(const TSensorReading& tick, CNavigator& view) const;
	void clear();

   private:
	static constexpr double kSnapshotPeriod = 0.5;	///< [s]
	struct TSlot
	{
		CNavigator::CSnapshot snapshot;
		size_t next;  ///< Sequence number of the first reading that is not in it
	};

	TSensorReading& at(size_t sequence) { return m_ring[sequence % m_ring.size()]; }
	const TSensorReading& at(size_t sequence) const { return m_ring[sequence % m_ring.size()]; }
	TSlot& slot(size_t i) { return m_slots[(m_first_slot + i) % m_slots.size()]; }
	const TSlot& slot(size_t i) const { return m_slots[(m_first_slot + i) % m_slots.size()]; }
	void push(const TSensorReading& reading);
	void grow();
	void takeSnapshotIfDue(double stamp, size_t next, const CNavigator& navigator);
	/** Where a late reading belongs. */
	size_t placeOf(const TSensorReading& reading) const;
	/** The newest snapshot that has not seen the reading at `place`. */
	size_t slotBefore(size_t place) const;
	/** Puts it there; returns the snapshot to start from. */
	const TSlot& insert(const TSensorReading& reading);

	double m_length;
	std::vector<TSensorReading> m_ring;
	size_t m_begin{0}, m_end{0};  ///< Sequence numbers
	std::vector<TSlot> m_slots;
	size_t m_first_slot{0}, m_slot_count{0};
};

template <class BEFORE_MARK>
void CReadingHistory::insertAndReplay(
	const TSensorReading& reading, CNavigator& navigator, BEFORE_MARK&& before)
{
	const TSlot& from = insert(reading);
	navigator.restore(from.snapshot);
	for (size_t i = from.next; i < m_end; i++) {
		const TSensorReading& r = at(i);
		takeSnapshotIfDue(r.stamp, i, navigator);
		if (const auto* mark = std::get_if<TCloneMark>(&r.what)) before(r.stamp, *mark);
		navigator.apply(r);
	}
}
}  // namespace posidonia
