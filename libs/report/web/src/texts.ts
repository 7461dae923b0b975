// Long texts: configuration, mission, log. Collapsed, with a list of their sections and a search.

import { button, h } from './dom';

function mark(line: string, wanted: string): (Node | string)[] {
	const parts: (Node | string)[] = [], low = line.toLowerCase();
	let from = 0;
	for (let at = low.indexOf(wanted); at >= 0; at = low.indexOf(wanted, from)) {
		parts.push(line.slice(from, at), h('mark', {}, line.slice(at, at + wanted.length)));
		from = at + wanted.length;
	}
	parts.push(line.slice(from));
	return parts;
}

function lineClass(line: string): string {
	const start = line.trim();
	return start.startsWith('[') ? 'ini-section' : start.startsWith('//') || start.startsWith('#') ? 'ini-comment' : '';
}

class TextView {
	readonly pre = h('pre', { tabindex: 0 });
	private readonly lines: string[];
	private elements: HTMLElement[] = [];
	private hit = -1;

	constructor(text: string, private readonly ini: boolean) {
		this.lines = text.replace(/\s+$/, '').split('\n');
		this.draw('');
	}

	get sections(): { name: string; line: number }[] {
		if (!this.ini) return [];
		return this.lines.map((text, line) => ({ name: (/^\[(.+)\]\s*$/.exec(text) ?? ['', ''])[1], line })).filter(({ name }) => name);
	}

	goTo(line: number): void {
		const target = this.elements[line];
		this.pre.scrollTop += target.getBoundingClientRect().top - this.pre.getBoundingClientRect().top - 8;
	}

	draw(wanted: string): void {
		this.elements = this.lines.map((line) => h('span', { class: this.ini ? lineClass(line) : '' },
			...(wanted ? mark(line, wanted) : [line]), '\n'));
		this.pre.replaceChildren(...this.elements);
		this.hit = -1;
	}

	/** Scrolls to the next line with the word, round and round; returns which of how many. */
	next(): string {
		const hits = this.elements.map((element, i) => (element.querySelector('mark') ? i : -1)).filter((i) => i >= 0);
		if (hits.length === 0) return 'not found';
		this.hit = (this.hit + 1) % hits.length;
		this.goTo(hits[this.hit]);
		return `${this.hit + 1} of ${hits.length} lines`;
	}
}

/** A collapsed text; made only when opened, as there may be many lines. */
export function textBlock(title: string, text: string, ini: boolean): HTMLElement {
	const lines = text.replace(/\s+$/, '').split('\n').length;
	const details = h('details', { class: 'text group' }, h('summary', {}, title, h('span', { class: 'count' }, ` ${lines} ${lines === 1 ? 'line' : 'lines'}`)));
	details.addEventListener('toggle', () => {
		if (details.open && details.childElementCount === 1) details.append(...contents(title, text, ini));
	});
	return details;
}

function contents(title: string, text: string, ini: boolean): HTMLElement[] {
	const view = new TextView(text, ini), found = h('span', { role: 'status', class: 'place' });
	view.pre.setAttribute('role', 'region');
	view.pre.setAttribute('aria-label', title);
	const go = () => { found.textContent = search.value ? view.next() : ''; };
	const search = h('input', {
		type: 'search', oninput: () => { view.draw(search.value.trim().toLowerCase()); go(); },
		onkeydown: (event: KeyboardEvent) => { if (event.key === 'Enter') go(); },
	});
	const bar = h('div', { class: 'filters' }, h('label', { class: 'field' }, h('span', {}, 'Find'), search), button('Next', go), found);
	const jumps = view.sections.map(({ name, line }) => button(name, () => view.goTo(line), { class: 'jump' }));
	return jumps.length > 1 ? [bar, h('div', { class: 'jumps', role: 'group', 'aria-label': `Sections of: ${title}` }, ...jumps), view.pre] : [bar, view.pre];
}
