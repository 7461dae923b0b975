// A plot's frame: heading, legend that switches curves on and off, a reset button, a note.

import { button, h } from '../dom';
import { swatch, type Look } from '../looks';

export interface Entry { label: string; look: Look; on: boolean }

/** Factor on the span that is shown, and a shift in parts of it. */
export type Move = (zoom: number, right: number, up: number) => void;

const MOVES: { [key: string]: Parameters<Move> } = {
	'+': [0.8, 0, 0], '=': [0.8, 0, 0], '-': [1.25, 0, 0],
	ArrowLeft: [1, -0.1, 0], ArrowRight: [1, 0.1, 0], ArrowUp: [1, 0, 0.1], ArrowDown: [1, 0, -0.1],
};

export class Figure {
	readonly element: HTMLElement;
	readonly canvas = h('div', { class: 'plot' });
	private readonly values: HTMLElement[] = [];

	/** `toggled` is called when an entry was switched, `reset` for the button, `move` for the keys. */
	constructor(title: string, entries: Entry[], toggled: (index: number) => void, reset: () => void, move: Move, note?: string) {
		const legend = h('ul', { class: 'legend' }, ...entries.map((entry, i) => h('li', {}, this.key(entry, i, toggled))));
		const resetButton = button('Reset zoom', reset, { class: 'quiet reset', 'aria-label': `Reset zoom: ${title}` });
		this.element = h('figure', { class: 'figure' },
			h('figcaption', {}, h('h3', {}, title), resetButton), legend, this.canvas, note ? h('p', { class: 'note' }, note) : null);
		this.canvas.setAttribute('role', 'group');
		this.canvas.setAttribute('aria-label', `Plot, ${title}: ${entries.map((entry) => entry.label).join(', ')}. Plus, minus and arrow keys zoom and shift, Home resets.`);
		this.canvas.title = 'Drag to zoom; with the keyboard: + \u2212 arrows, Home';
		this.canvas.tabIndex = 0;
		this.canvas.addEventListener('keydown', (event) => this.onKey(event, reset, move));
	}

	private onKey(event: KeyboardEvent, reset: () => void, move: Move): void {
		if (event.ctrlKey || event.metaKey || event.altKey) return;
		if (event.key === 'Home') reset();
		else if (MOVES[event.key]) move(...MOVES[event.key]);
		else return;
		event.preventDefault();
	}

	private key(entry: Entry, index: number, toggled: (index: number) => void): HTMLElement {
		const value = h('span', { class: 'value' });
		this.values.push(value);
		const key = h('button', {
			type: 'button', class: 'key', 'aria-pressed': String(entry.on), onclick: () => {
				entry.on = !entry.on;
				key.setAttribute('aria-pressed', String(entry.on));
				toggled(index);
			},
		}, swatch(entry.look), entry.label, value);
		return key;
	}

	/** Beside an entry of the legend: its value under the cursor. */
	setValue(index: number, text: string): void {
		if (this.values[index]) this.values[index].textContent = text;
	}
}

/** Calls back with the width whenever it changes. */
export function onWidth(element: HTMLElement, listener: (width: number) => void): void {
	let last = 0;
	new ResizeObserver(() => {
		const width = Math.floor(element.clientWidth);
		if (width === last || width < 50) return;
		last = width;
		listener(width);
	}).observe(element);
}
