// The two pictures of a pair with its inlier matches.

import { button, h, svg } from '../dom';
import { fixed, whole } from '../format';
import type { KeyFrame, Loops, Report } from '../schema';
import { isTurnedDown, matchCount, matchPoints } from './rows';

const GAP = 12;     // between the pictures, in their pixels

export class Pair {
	readonly element = h('div', { class: 'pair', id: 'loop-pair', 'aria-live': 'polite' });
	private readonly frames = new Map<number, KeyFrame>();
	/** Told when the pictures are wanted over the whole width, or no longer. */
	onLarger: (larger: boolean) => void = () => {};
	private row = -1;
	private readonly back: HTMLButtonElement;
	private readonly on: HTMLButtonElement;
	private readonly content = h('div');
	private upright = false;

	/** `step` asks for the previous or next row of the list, `replay` for the moment of a node. */
	constructor(private readonly report: Report, step: (by: number) => void, private readonly replay: ((node: number) => void) | null) {
		for (const frame of report.key_frames) this.frames.set(frame.node, frame);
		this.back = button('\u2190 Previous', () => step(-1));
		this.on = button('Next \u2192', () => step(1));
		this.element.append(this.content, h('div', { class: 'pager' }, this.back, this.on, this.largerButton()));
		new ResizeObserver(() => this.fitWidth()).observe(this.element);
	}

	private largerButton(): HTMLButtonElement {
		const made = button('Larger', () => {
			const larger = made.getAttribute('aria-pressed') !== 'true';
			made.setAttribute('aria-pressed', String(larger));
			this.onLarger(larger);
		}, { class: 'larger-button', 'aria-pressed': 'false' });
		return made;
	}

	/** Above each other where there is no room beside. */
	private fitWidth(): void {
		const upright = this.element.clientWidth < 480;
		if (upright === this.upright) return;
		this.upright = upright;
		if (this.row >= 0) this.draw();
	}

	show(row: number, first: boolean, last: boolean): void {
		this.row = row;
		this.back.disabled = first;
		this.on.disabled = last;
		this.draw();
	}

	private draw(): void {
		const { loops } = this.report, { row } = this, from = loops.from[row], to = loops.to[row];
		const count = matchCount(loops, row);
		this.content.replaceChildren(
			h('h3', {}, `Nodes ${from} and ${to}`),
			h('p', { class: 'verdict' }, `${loops.kind[row]}: ${loops.status[row]}${isTurnedDown(loops, row) ? ', less than half of its weight left' : ''}`),
			this.pictures(from, to),
			h('p', { class: 'note' }, count > 0 ? `${count} inlier matches drawn${this.thinned(count)}.` : 'The matches of this pair are not stored in the report.'),
			facts(loops, row), this.links(from, to));
	}

	private thinned(count: number): string {
		const all = this.report.loops.inliers[this.row];
		return all !== null && all > count ? ` of ${whole(all)}` : '';
	}

	private pictures(from: number, to: number): SVGElement {
		const size = this.report.camera ?? { width: 640, height: 480 }, { width, height } = size;
		const dx = this.upright ? 0 : width + GAP, dy = this.upright ? height + GAP : 0;
		const drawing = svg('svg', {
			class: 'matches', viewBox: `0 0 ${width + dx} ${height + dy}`, role: 'img',
			'aria-label': `Pictures of nodes ${from} and ${to} with their matches`,
		}, this.picture(from, 0, 0, width, height), this.picture(to, dx, dy, width, height));
		const points = matchPoints(this.report.loops, this.row, size);
		if (points) drawing.append(matchLines(points, dx, dy));
		return drawing;
	}

	private picture(node: number, x: number, y: number, width: number, height: number): SVGElement {
		const jpeg = this.frames.get(node)?.jpeg, group = svg('g');
		group.append(svg('rect', { x, y, width, height, class: 'no-picture' }));
		if (jpeg) group.append(svg('image', { x, y, width, height, preserveAspectRatio: 'none', href: `data:image/jpeg;base64,${jpeg}` }));
		else group.append(svg('text', { x: x + width / 2, y: y + height / 2, class: 'no-picture-text' }, 'picture not embedded'));
		group.append(svg('text', { x: x + 12, y: y + 34, class: 'node-name' }, String(node)));
		return group;
	}

	private links(from: number, to: number): HTMLElement {
		const list = h('p', { class: 'links' });
		for (const node of [from, to]) {
			const file = this.frames.get(node)?.file;
			if (file && !/^[a-z]+:|^\/\//i.test(file)) list.append(h('a', { href: file, target: '_blank', rel: 'noopener' }, `Full-size picture of node ${node}`), ' ');
		}
		const { replay } = this;
		if (replay) list.append(button('Show in the replay', () => replay(to), { class: 'quiet' }));
		return list;
	}
}

/** Points are in pixels of the full-size picture, as the drawing's own units are. */
function matchLines(points: number[], dx: number, dy: number): SVGElement {
	const lines = svg('g', { class: 'match-lines' });
	for (let i = 0; i + 3 < points.length; i += 4) {
		const [u0, v0, u1, v1] = points.slice(i, i + 4);
		lines.append(svg('line', { x1: u0, y1: v0, x2: u1 + dx, y2: v1 + dy }),
			svg('circle', { cx: u0, cy: v0, r: 4 }), svg('circle', { cx: u1 + dx, cy: v1 + dy, r: 4 }));
	}
	return lines;
}

function facts(loops: Loops, row: number): HTMLElement {
	const rows: [string, string][] = [
		['Inliers of matches', `${whole(loops.inliers[row])} of ${whole(loops.matches[row])}`],
		['RMSE', `${fixed(loops.rmse_px[row], 3)} px`],
		['Residual', `${fixed(loops.residual_m[row], 4)} m, ${fixed(loops.residual_deg[row], 3)}\u00b0`],
		['\u03c7\u00b2', fixed(loops.chi2[row], 2)],
		['Weight left', fixed(loops.weight[row], 2)],
		['Error against truth', loops.error_m[row] === null ? 'not known' : `${fixed(loops.error_m[row], 4)} m`],
	];
	return h('dl', { class: 'facts' }, ...rows.map(([what, value]) => h('div', {}, h('dt', {}, what), h('dd', {}, value))));
}
