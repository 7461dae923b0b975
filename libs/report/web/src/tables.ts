// Tables: the paper's beside ours, metrics, refused candidates, timings, sensors, events.

import { h, scroller, type Child } from './dom';
import { clock, fixed, short, whole } from './format';
import type { Report } from './schema';
import { onPrint } from './theme';

type Cell = string | Node;

/** The first `words` columns are text, the others numbers. */
export function table(caption: string, header: string[], rows: Cell[][], words = 1): HTMLElement {
	const kind = (i: number) => (i < words ? 'words' : '');
	return scroller(caption, h('table', { class: 'rows' }, h('caption', {}, caption),
		h('thead', {}, h('tr', {}, ...header.map((text, i) => h(text ? 'th' : 'td', { scope: text ? 'col' : null, class: kind(i) }, text)))),
		h('tbody', {}, ...rows.map((cells) => h('tr', {}, ...cells.map((cell, i) => h('td', { class: kind(i) }, cell)))))));
}

/** A number with a bar behind it: `part` of the longest, 0..1. */
function bar(text: string, part: number): Node {
	const length = `${(100 * Math.max(0, Math.min(1, part))).toFixed(1)}%`;
	return h('span', { class: 'bar' }, h('span', { class: 'track', 'aria-hidden': 'true' }, h('span', { style: `width: ${length}` })), h('span', {}, text));
}

/** Columns from the left that hold no numbers. */
function leadingWords(rows: string[][]): number {
	const isWords = (i: number) => rows.some((row) => /\p{L}{2}/u.test(row[i] ?? ''));
	let count = 1;
	while (count < (rows[0]?.length ?? 0) && isWords(count)) ++count;
	return count;
}

/** The paper's rows and ours, which are bold. */
export function paperTable(report: Report): HTMLElement | null {
	const paper = report.paper_table;
	if (!paper) return null;
	const made = table(paper.title, paper.header, paper.rows, leadingWords(paper.rows));
	made.querySelectorAll('tbody tr').forEach((row, i) => { if (/^(ours|posidonia)/i.test(paper.rows[i][0] ?? '')) row.classList.add('ours'); });
	return h('div', { class: 'paper' }, made, paper.note ? h('p', { class: 'note' }, paper.note) : null);
}

function metricGroups(report: Report): Map<string, Report['metrics']> {
	const groups = new Map<string, Report['metrics']>();
	for (const metric of report.metrics) {
		const group = metric.what.split(/[. ]/)[0];
		if (!groups.has(group)) groups.set(group, []);
		groups.get(group)!.push(metric);
	}
	return groups;
}

function metricGroup(name: string, metrics: Report['metrics'], open: boolean): HTMLDetailsElement {
	const row = ({ what, value, unit }: Report['metrics'][number]) => h('tr', { 'data-what': what.toLowerCase() },
		h('th', { scope: 'row', class: 'words' }, what), h('td', {}, short(value)), h('td', { class: 'words unit' }, unit));
	return h('details', { open, class: 'group' }, h('summary', {}, name, h('span', { class: 'count' }, ` ${metrics.length}`)),
		h('table', { class: 'rows metrics' }, h('tbody', {}, ...metrics.map(row))));
}

/** Groups by the first part of the name, with a search over all of them. */
export function metricSection(report: Report): HTMLElement | null {
	if (report.metrics.length === 0) return null;
	const groups = [...metricGroups(report)].map(([name, metrics], i) => metricGroup(name, metrics, i === 0));
	const search = h('input', {
		type: 'search', placeholder: 'name of a metric', oninput: () => {
			const wanted = search.value.trim().toLowerCase();
			groups.forEach((group, i) => filterGroup(group, wanted, i === 0));
		},
	});
	openForPrint(groups);
	return h('div', { class: 'metric-groups' }, h('div', { class: 'filters' }, h('label', { class: 'field' }, h('span', {}, 'Find'), search)), ...groups);
}

/** On paper nothing can be opened. */
function openForPrint(groups: HTMLDetailsElement[]): void {
	let before: boolean[] = [];
	onPrint((printing) => {
		if (printing) before = groups.map((group) => group.open);
		groups.forEach((group, i) => { group.open = printing || before[i]; });
	});
}

function filterGroup(group: HTMLDetailsElement, wanted: string, openOtherwise: boolean): void {
	let hits = 0;
	group.querySelectorAll<HTMLElement>('tr').forEach((row) => {
		row.hidden = !row.dataset.what!.includes(wanted);
		if (!row.hidden) ++hits;
	});
	group.hidden = hits === 0;
	group.open = wanted ? hits > 0 : openOtherwise;
}

export function refusedTable(report: Report): HTMLElement | null {
	if (report.refused.length === 0) return null;
	const rows = [...report.refused].sort((a, b) => b.count - a.count), most = rows[0].count;
	const total = rows.reduce((sum, row) => sum + row.count, 0);
	return table(`${whole(total)} candidates that are not in the graph`, ['Reason', 'Kind', 'Count'],
		rows.map((row) => [row.status, row.kind, bar(whole(row.count), row.count / most)]), 2);
}

export function timingTables(report: Report): HTMLElement[] {
	const groups = [...new Set(report.timings.map((row) => row.group))];
	return groups.map((group) => {
		const rows = report.timings.filter((row) => row.group === group).sort((a, b) => b.total_s - a.total_s);
		const most = Math.max(...rows.map((row) => row.total_s), 1e-12);
		return table(group, ['Stage', 'Calls', 'Mean [ms]', 'Max [ms]', 'Total [s]'], rows.map((row) => [
			row.stage, whole(row.calls), short(row.mean_ms), short(row.max_ms), bar(fixed(row.total_s, 2), row.total_s / most)]));
	});
}

export function sensorTable(report: Report): HTMLElement | null {
	if (report.sensors.length === 0) return null;
	const rejected = (reasons: { [reason: string]: number }) => {
		const all = Object.entries(reasons).filter(([, count]) => count > 0);
		return all.length > 0 ? all.map(([reason, count]) => `${reason} ${whole(count)}`).join(', ') : 'none';
	};
	const made = table('Sensors', ['Sensor', 'Not used, by reason', 'Used', 'Rate [Hz]', 'Longest gap [s]'], report.sensors.map((sensor) => [
		sensor.name, rejected(sensor.rejected), whole(sensor.used), short(sensor.rate_hz), fixed(sensor.longest_gap_s, 2)]), 2);
	made.classList.add('said-above');
	return made;
}

/** Events move the replay to their time. */
export function eventTable(report: Report, seek: ((time: number) => void) | null): HTMLElement | null {
	if (report.events.length === 0) return null;
	const time = (t: number): Child & Cell => (seek ? h('button', { type: 'button', class: 'pick', onclick: () => seek(t) }, clock(t)) : clock(t));
	const made = table('Events', ['Time', 'Event', 'What'], report.events.map((event) => [time(event.t), event.kind, event.text]), 3);
	made.classList.add('tall', 'said-above');
	return made;
}
