// The loop candidates: filters, the table, and the pair that is looked at.

import { h, select } from '../dom';
import type { Report } from '../schema';
import { Pair } from './pair';
import { distinct, isAccepted, matchCount } from './rows';
import { LoopTable, statusText } from './table';

interface Filter { kind: string; status: string; text: string }

function passes(report: Report, row: number, filter: Filter): boolean {
	const { loops } = report;
	if (filter.kind && loops.kind[row] !== filter.kind) return false;
	if (filter.status && statusText(loops, row) !== filter.status) return false;
	const words = filter.text.toLowerCase().split(/\s+/).filter((word) => word);
	return words.every((word) => (/^\d+$/.test(word)
		? loops.from[row] === Number(word) || loops.to[row] === Number(word)
		: `${loops.kind[row]} ${statusText(loops, row)} ${loops.status[row]}`.toLowerCase().includes(word)));
}

function options(all: string, values: string[]): [string, string][] {
	return [['', all], ...distinct(values).map((value): [string, string] => [value, value])];
}

export function loopSection(report: Report, replay: ((node: number) => void) | null): HTMLElement {
	const { loops } = report, filter: Filter = { kind: '', status: '', text: '' };
	const every = Array.from(loops.from, (_, row) => row);
	const open = (row: number) => {
		table.select(row);
		const at = table.rows.indexOf(row);
		pair.show(row, at <= 0, at < 0 || at === table.rows.length - 1);
	};
	const table = new LoopTable(loops, open);
	const step = (by: number) => open(table.rows[Math.max(0, Math.min(table.rows.length - 1, table.rows.indexOf(table.selected) + by))]);
	const pair = new Pair(report, step, replay);
	const refilter = () => table.set(every.filter((row) => passes(report, row, filter)));
	const kinds = select('Kind', options('all kinds', loops.kind), (value) => { filter.kind = value; refilter(); });
	const states = select('Status', options('any status', every.map((row) => statusText(loops, row))), (value) => { filter.status = value; refilter(); });
	states.element.id = 'loop-status';
	const text = h('input', { type: 'search', placeholder: 'node number or words', oninput: () => { filter.text = text.value; refilter(); } });
	refilter();
	const first = table.rows.find((row) => loops.kind[row] !== 'sequential' && isAccepted(loops, row) && matchCount(loops, row) > 0) ?? every[0];
	open(first);
	const columns = h('div', { class: 'loop-columns' }, table.element, pair.element);
	pair.onLarger = (larger) => columns.classList.toggle('larger', larger);
	return h('div', { class: 'loops' },
		h('div', { class: 'filters' }, kinds.field, states.field, h('label', { class: 'field' }, h('span', {}, 'Find'), text)),
		columns);
}
