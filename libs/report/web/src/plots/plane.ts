// Curves in a plane, in any order: top views (equal scales) and quantities against each other.

import uPlot from 'uplot';
import { fixed, short } from '../format';
import type { Look } from '../looks';
import { faded, onTheme } from '../theme';
import { areaOf, axes, PADDING, type Size } from './axes';
import { Figure, onWidth, type Entry } from './figure';

/** A line through points, or separate segments of two points each. */
export interface Shape { label: string; look: Look; x: Float64Array; y: Float64Array; segments?: boolean }

export interface Plane { title: string; x: string; y: string; shapes: Shape[]; equal: boolean; start?: [x: number, y: number]; note?: string }

interface View { x0: number; x1: number; y0: number; y1: number }

/** Dashes of very many short segments are slow and show nothing. */
const DASHED_AT_MOST = 6000;

function trace(plot: uPlot, shape: Shape): void {
	const { ctx } = plot, { x, y } = shape;
	ctx.beginPath();
	let pen = false;
	for (let i = 0; i < x.length; ++i) {
		if (x[i] !== x[i] || y[i] !== y[i]) { pen = false; continue; }
		const px = plot.valToPos(x[i], 'x', true), py = plot.valToPos(y[i], 'y', true);
		if (pen && !(shape.segments && i % 2 === 0)) ctx.lineTo(px, py);
		else ctx.moveTo(px, py);
		pen = true;
	}
}

function drawShape(plot: uPlot, shape: Shape): void {
	const { ctx } = plot, ratio = uPlot.pxRatio, { look } = shape;
	const many = shape.segments === true && shape.x.length > 2 * DASHED_AT_MOST;
	trace(plot, shape);
	ctx.strokeStyle = faded(look.colour, many ? 0.3 * look.opacity : look.opacity);
	ctx.lineWidth = look.width * ratio;
	ctx.setLineDash(many ? [] : look.dash.map((d) => d * ratio));
	ctx.lineJoin = 'round';
	ctx.stroke();
}

function drawStart(plot: uPlot, [x, y]: [number, number]): void {
	const { ctx } = plot, ratio = uPlot.pxRatio, px = plot.valToPos(x, 'x', true), py = plot.valToPos(y, 'y', true);
	ctx.setLineDash([]);
	ctx.beginPath();
	ctx.arc(px, py, 4.5 * ratio, 0, 2 * Math.PI);
	ctx.fillStyle = faded('page', 1);
	ctx.fill();
	ctx.lineWidth = 1.75 * ratio;
	ctx.strokeStyle = ctx.fillStyle = faded('ink', 1);
	ctx.stroke();
	ctx.textAlign = 'left';
	ctx.font = `${12 * ratio}px system-ui, sans-serif`;
	ctx.lineWidth = 4 * ratio;
	ctx.strokeStyle = faded('page', 0.85);
	ctx.strokeText('start', px + 8 * ratio, py - 7 * ratio);
	ctx.fillText('start', px + 8 * ratio, py - 7 * ratio);
}

function drawAll(plot: uPlot, spec: Plane, entries: Entry[]): void {
	const { ctx, bbox } = plot;
	ctx.save();
	ctx.beginPath();
	ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
	ctx.clip();
	spec.shapes.forEach((shape, i) => { if (entries[i].on) drawShape(plot, shape); });
	if (spec.start) drawStart(plot, spec.start);
	ctx.restore();
}

function boundsOf(shapes: Shape[]): View {
	const view = { x0: Infinity, x1: -Infinity, y0: Infinity, y1: -Infinity };
	for (const { x, y } of shapes) {
		for (let i = 0; i < x.length; ++i) {
			if (x[i] < view.x0) view.x0 = x[i];
			if (x[i] > view.x1) view.x1 = x[i];
			if (y[i] < view.y0) view.y0 = y[i];
			if (y[i] > view.y1) view.y1 = y[i];
		}
	}
	return view.x0 <= view.x1 && view.y0 <= view.y1 ? view : { x0: 0, x1: 1, y0: 0, y1: 1 };
}

/** Widened by a margin, and in the shorter direction until a metre is as long in both. */
function fitted(view: View, { width, height }: Size, equal: boolean, margin: number): View {
	let dx = Math.max(1e-9, view.x1 - view.x0) * margin, dy = Math.max(1e-9, view.y1 - view.y0) * margin;
	if (equal) {
		const unit = Math.max(dx / width, dy / height);
		dx = unit * width;
		dy = unit * height;
	}
	const x = (view.x0 + view.x1) / 2, y = (view.y0 + view.y1) / 2;
	return { x0: x - dx / 2, x1: x + dx / 2, y0: y - dy / 2, y1: y + dy / 2 };
}

function moved(view: View, zoom: number, right: number, up: number): View {
	const dx = view.x1 - view.x0, dy = view.y1 - view.y0;
	const x = (view.x0 + view.x1) / 2 + right * dx, y = (view.y0 + view.y1) / 2 + up * dy;
	return { x0: x - (zoom * dx) / 2, x1: x + (zoom * dx) / 2, y0: y - (zoom * dy) / 2, y1: y + (zoom * dy) / 2 };
}

/** As high as what is shown asks for, within reason. */
function heightFor(width: number, ratio: number): number {
	return Math.round(Math.min(480, Math.max(220, width * Math.min(1, ratio || 0.5) * 0.86 + 60)));
}

/** The rectangle that was dragged over. */
function selected(plot: uPlot): View {
	const { left, top, width, height } = plot.select;
	return {
		x0: plot.posToVal(left, 'x'), x1: plot.posToVal(left + width, 'x'),
		y0: plot.posToVal(top + height, 'y'), y1: plot.posToVal(top, 'y'),
	};
}

export function planePlot(spec: Plane): HTMLElement {
	const entries: Entry[] = spec.shapes.map(({ label, look }) => ({ label, look, on: true }));
	const bounds = boundsOf(spec.shapes);
	let plot: uPlot | null = null, view: View | null = null;
	let seen = bounds;
	const refit = () => {
		if (!plot) return;
		seen = fitted(view ?? bounds, areaOf(plot), spec.equal, view ? 1 : 1.08);
		plot.setData([[seen.x0, seen.x1], [null, null]]);
	};
	const reset = () => { view = null; refit(); };
	const move = (zoom: number, right: number, up: number) => {
		view = moved(seen, zoom, right, up);
		refit();
	};
	const figure = new Figure(spec.title, entries, () => plot?.redraw(false), reset, move, spec.note);
	const position = figure.canvas.appendChild(document.createElement('span'));
	position.className = 'position';
	const zoom = (of: uPlot) => {
		if (of.select.width < 5 || of.select.height < 5) return;
		view = selected(of);
		of.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
		refit();
	};
	const follow = (of: uPlot) => {
		const { left, top } = of.cursor;
		const inside = left !== undefined && top !== undefined && left >= 0 && top >= 0;
		const text = (value: number) => (spec.equal ? fixed(value, 2) : short(value));
		position.textContent = inside ? `${text(of.posToVal(top, 'y'))}, ${text(of.posToVal(left, 'x'))}` : '';
	};
	const options = (width: number, height: number): uPlot.Options => ({
		width, height, padding: PADDING, legend: { show: false },
		cursor: {
			points: { show: false }, drag: { x: true, y: true, setScale: false },
			bind: { dblclick: () => () => { reset(); return null; } },
		},
		scales: { x: { time: false }, y: { range: () => [seen.y0, seen.y1] } },
		axes: axes(spec.x, spec.y), series: [{}, { show: true, points: { show: false } }],
		hooks: { draw: [(of) => drawAll(of, spec, entries)], setSelect: [zoom], setCursor: [follow] },
	});
	onWidth(figure.canvas, (width) => {
		const height = heightFor(width, spec.equal ? (bounds.y1 - bounds.y0) / (bounds.x1 - bounds.x0) : 0.5);
		if (plot) plot.setSize({ width, height });
		else plot = new uPlot(options(width, height), [[seen.x0, seen.x1], [null, null]], figure.canvas);
		refit();
	});
	onTheme(() => plot?.redraw(false));
	return figure.element;
}
