// Header, table of contents and the sections' frames.

import { button, h, type Child } from './dom';
import { lasting, utc } from './format';
import type { Report } from './schema';
import { toggleTheme } from './theme';

export function header(report: Report): HTMLElement {
	const tiles = report.headline.map(({ label, value, hint }) => h('div', { class: 'tile' },
		h('dt', {}, label), h('dd', {}, value), hint ? h('dd', { class: 'tile-hint' }, hint) : null));
	return h('header', { class: 'top' },
		h('div', { class: 'top-line' },
			h('p', { class: 'app' }, 'Posidonia run report'),
			button('Light / dark', toggleTheme, { class: 'quiet', id: 'theme' })),
		h('h1', {}, report.title),
		h('p', { class: 'when' }, h('span', {}, report.app), h('time', { datetime: report.start_utc }, utc(report.start_utc)), h('span', {}, lasting(report.duration))),
		report.interrupted ? h('p', { class: 'banner', role: 'note' }, h('strong', {}, 'Interrupted. '), 'The files of this run are whole, but the run was stopped before its end.') : null,
		tiles.length > 0 ? h('dl', { class: 'tiles' }, ...tiles) : null,
		report.notes.length > 0 ? h('ul', { class: 'notes' }, ...report.notes.map((note) => h('li', {}, note))) : null);
}

export interface Section { id: string; title: string; element: HTMLElement; body: HTMLElement }

export function section(id: string, title: string, ...children: Child[]): Section {
	const body = h('div', { class: 'section-body' }, ...children);
	const element = h('section', { id, 'aria-labelledby': `${id}-title` }, h('h2', { id: `${id}-title` }, title), body);
	return { id, title, element, body };
}

export function contents(sections: Section[]): HTMLElement {
	return h('nav', { class: 'contents', 'aria-label': 'Contents' },
		h('ul', {}, ...sections.map(({ id, title }) => h('li', {}, h('a', { href: `#${id}` }, title)))));
}

export function failure(message: string): HTMLElement {
	return h('main', { class: 'failure', id: 'main' }, h('h1', {}, 'Posidonia run report'), h('p', {}, message));
}
