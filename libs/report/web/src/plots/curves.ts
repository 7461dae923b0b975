// Curves over a common rising quantity: time or distance.

import uPlot from 'uplot';
import { short } from '../format';
import type { Look } from '../looks';
import { faded, onTheme } from '../theme';
import { axes, PADDING } from './axes';
import { Figure, onWidth, type Entry } from './figure';

export interface Curve { label: string; look: Look; x: Float64Array; y: Float64Array }

export interface Curves {
	title: string;
	x: string;
	y: string;
	curves: Curve[];
	/** A level band between two values, behind the curves. */
	band?: { low: number; high: number };
	/** Between the curves of two numbers, e.g. an envelope. */
	between?: [upper: number, lower: number];
	note?: string;
}

/** One x for all. uPlot's join marks what a curve does not have as undefined, so that its line goes on. */
function aligned(curves: Curve[]): uPlot.AlignedData {
	const first = curves[0].x;
	if (curves.every((curve) => curve.x === first)) return [first, ...curves.map((curve) => gaps(curve.y))] as uPlot.AlignedData;
	return uPlot.join(curves.map((curve) => [Array.from(curve.x), gaps(curve.y)] as uPlot.AlignedData));
}

function gaps(values: Float64Array): (number | null)[] {
	return Array.from(values, (v) => (v === v ? v : null));
}

function drawBand(plot: uPlot, band: { low: number; high: number }): void {
	const { ctx, bbox } = plot, top = plot.valToPos(band.high, 'y', true), bottom = plot.valToPos(band.low, 'y', true);
	ctx.save();
	ctx.beginPath();
	ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
	ctx.clip();
	ctx.fillStyle = faded('slam', 0.13);
	ctx.fillRect(bbox.left, top, bbox.width, bottom - top);
	ctx.restore();
}

function seriesOf(curve: Curve, on: boolean): uPlot.Series {
	const { look } = curve;
	return {
		label: curve.label, show: on, stroke: () => faded(look.colour, look.opacity), width: look.width, dash: look.dash,
		points: { show: false }, spanGaps: false,
	};
}

function options(spec: Curves, entries: Entry[], figure: Figure): uPlot.Options {
	return {
		width: 300, height: 260, padding: PADDING,
		legend: { show: false },
		cursor: { y: false, points: { size: 7 }, drag: { x: true, y: false } },
		scales: { x: { time: false } },
		axes: axes(spec.x, spec.y),
		series: [{}, ...spec.curves.map((curve, i) => seriesOf(curve, entries[i].on))],
		bands: spec.between ? [{ series: [spec.between[0] + 1, spec.between[1] + 1], fill: () => faded('slam', 0.13) }] : [],
		hooks: {
			drawAxes: [(plot) => { if (spec.band) drawBand(plot, spec.band); }],
			setCursor: [(plot) => showValues(plot, figure, spec.curves.length)],
		},
	};
}

/** The last value up to the cursor, as joined curves have holes. */
function showValues(plot: uPlot, figure: Figure, count: number): void {
	const index = plot.cursor.idx;
	for (let i = 0; i < count; ++i) {
		const column = plot.data[i + 1];
		let k = index === null || index === undefined ? -1 : index;
		while (k >= 0 && column[k] === undefined) --k;
		const value = k >= 0 ? column[k] : null;
		figure.setValue(i, value === null || value === undefined ? '' : short(value));
	}
}

function shiftTime(plot: uPlot, zoom: number, right: number): void {
	const { min, max } = plot.scales.x;
	if (min === undefined || max === undefined) return;
	const span = max - min, middle = (min + max) / 2 + right * span;
	plot.setScale('x', { min: middle - (zoom * span) / 2, max: middle + (zoom * span) / 2 });
}

export function curvePlot(spec: Curves): HTMLElement {
	const entries: Entry[] = spec.curves.map(({ label, look }) => ({ label, look, on: true }));
	let plot: uPlot | null = null;
	const data = aligned(spec.curves);
	const figure = new Figure(spec.title, entries, (i) => plot?.setSeries(i + 1, { show: entries[i].on }),
		() => plot?.setData(data), (zoom, right) => { if (plot) shiftTime(plot, zoom, right); }, spec.note);
	onWidth(figure.canvas, (width) => {
		const height = Math.round(Math.min(300, Math.max(220, 0.5 * width)));
		if (plot) plot.setSize({ width, height });
		else plot = new uPlot({ ...options(spec, entries, figure), width, height }, data, figure.canvas);
	});
	onTheme(() => plot?.redraw(false));
	return figure.element;
}

/** For curves that have no role: a level to compare with. */
export function level(label: string, value: number, x: Float64Array, look: Look): Curve {
	const ends = Float64Array.of(x[0], x[x.length - 1]);
	return { label, look, x: ends, y: Float64Array.of(value, value) };
}

