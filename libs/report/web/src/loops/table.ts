// The rows of the loops: filtered, sorted, a page at a time.

import { button, h, scroller } from '../dom';
import { fixed, whole } from '../format';
import type { Loops } from '../schema';
import { isAccepted, isTurnedDown, matchCount } from './rows';

interface Head { text: string; of: (loops: Loops, row: number) => number | string | null; show: (loops: Loops, row: number) => string; words?: boolean }

function numbers(text: string, pick: (loops: Loops) => (number | null)[], digits: number): Head {
	return { text, of: (l, r) => pick(l)[r], show: (l, r) => fixed(pick(l)[r], digits) };
}

const HEADS: Head[] = [
	{ text: 'Nodes', of: (l, r) => l.from[r] * 1e6 + l.to[r], show: (l, r) => `${l.from[r]} \u2013 ${l.to[r]}` },
	{ text: 'Kind', of: (l, r) => l.kind[r], show: (l, r) => l.kind[r], words: true },
	{ text: 'Status', of: (l, r) => statusText(l, r), show: (l, r) => statusText(l, r), words: true },
	{ text: 'Inliers', of: (l, r) => l.inliers[r], show: (l, r) => `${whole(l.inliers[r])} / ${whole(l.matches[r])}` },
	numbers('RMSE [px]', (l) => l.rmse_px, 3),
	numbers('Residual [m]', (l) => l.residual_m, 4),
	numbers('\u03c7\u00b2', (l) => l.chi2, 2),
	numbers('Weight', (l) => l.weight, 2),
	numbers('Error [m]', (l) => l.error_m, 4),
];

export function statusText(loops: Loops, row: number): string {
	return isTurnedDown(loops, row) ? 'weight below half' : loops.status[row];
}

function compare(a: number | string | null, b: number | string | null): number {
	if (typeof a === 'string' || typeof b === 'string') return String(a).localeCompare(String(b));
	return (a as number) - (b as number);
}

const PAGE = 50;

export class LoopTable {
	readonly element: HTMLElement;
	rows: number[] = [];
	selected = -1;
	private page = 0;
	private sorted = 0;
	private falling = false;
	private readonly body = h('tbody');
	private readonly heads: HTMLElement[];
	private readonly place = h('span', { class: 'place', role: 'status' });
	private readonly back = button('Previous page', () => this.turn(-1));
	private readonly on = button('Next page', () => this.turn(1));

	constructor(private readonly loops: Loops, private readonly chosen: (row: number) => void) {
		this.heads = HEADS.map((head, i) => h('th', { scope: 'col', class: head.words ? 'words' : '' },
			button(head.text, () => this.sortBy(i), { class: 'sort' })));
		const table = h('table', { class: 'rows loop-rows' }, h('thead', {}, h('tr', {}, ...this.heads)), this.body);
		this.element = h('div', { class: 'loop-table' }, scroller('Loop candidates', table),
			h('div', { class: 'pager' }, this.back, this.on, this.place));
	}

	/** Other rows; those without the sorted quantity come last, whichever the order. */
	set(rows: number[]): void {
		const { of } = HEADS[this.sorted], sign = this.falling ? -1 : 1;
		const has = rows.filter((row) => of(this.loops, row) !== null), none = rows.filter((row) => of(this.loops, row) === null);
		has.sort((a, b) => sign * compare(of(this.loops, a), of(this.loops, b)) || a - b);
		this.rows = has.concat(none);
		this.page = 0;
		this.heads.forEach((head, i) => head.setAttribute('aria-sort', i !== this.sorted ? 'none' : this.falling ? 'descending' : 'ascending'));
		this.draw();
	}

	private sortBy(column: number): void {
		this.falling = column === this.sorted && !this.falling;
		this.sorted = column;
		this.set(this.rows);
	}

	private turn(by: number): void {
		this.page += by;
		this.draw();
	}

	/** Marks the row and turns to its page. */
	select(row: number): void {
		this.selected = row;
		const at = this.rows.indexOf(row);
		if (at >= 0) this.page = Math.floor(at / PAGE);
		this.draw();
		this.uncover(this.body.querySelector('[aria-current]'));
	}

	/** Scrolls inside the table only. */
	private uncover(line: HTMLElement | null): void {
		const holder = this.body.closest('.scroller');
		if (!line || !holder) return;
		const top = line.offsetTop - 2 * line.offsetHeight, bottom = line.offsetTop + 2 * line.offsetHeight;
		if (holder.scrollTop > top) holder.scrollTop = top;
		else if (holder.scrollTop < bottom - holder.clientHeight) holder.scrollTop = bottom - holder.clientHeight;
	}

	private draw(): void {
		const first = this.page * PAGE, shown = this.rows.slice(first, first + PAGE), total = this.rows.length;
		this.body.replaceChildren(...shown.map((row) => this.line(row)));
		if (total === 0) this.body.append(h('tr', {}, h('td', { colspan: HEADS.length, class: 'words' }, 'Nothing passes these filters.')));
		this.back.disabled = this.page === 0;
		this.on.disabled = first + PAGE >= total;
		this.place.textContent = total === 0 ? '0 candidates' : `${whole(first + 1)}\u2013${whole(first + shown.length)} of ${whole(total)}`;
	}

	private line(row: number): HTMLElement {
		const { loops } = this, state = !isAccepted(loops, row) ? 'refused' : isTurnedDown(loops, row) ? 'turned-down' : '';
		const cells = HEADS.map((head, i) => {
			const text = head.show(loops, row);
			if (i > 0) return h('td', { class: head.words ? 'words' : '' }, text);
			const label = `Pair ${text}, ${matchCount(loops, row) > 0 ? 'with matches' : 'matches not stored'}`;
			return h('td', {}, button(text, () => this.chosen(row), { class: 'pick', 'aria-label': label }));
		});
		return h('tr', {
			class: state, 'data-row': row, 'aria-current': row === this.selected ? 'true' : null,
			onclick: (event: MouseEvent) => { if (!(event.target instanceof HTMLButtonElement)) this.chosen(row); },
		}, ...cells);
	}
}
