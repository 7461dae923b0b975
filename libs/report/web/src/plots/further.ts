// Whether the graph knows how wrong it is, and the plots that come ready with the report.

import { floats } from '../columns';
import { short } from '../format';
import { lookOf, type Look } from '../looks';
import type { Consistency, Plot, Report } from '../schema';
import { curvePlot, level } from './curves';
import { planePlot } from './plane';

/** 95 % of a chi-square with 3 degrees of freedom are between these. */
const NEES_LOW = 0.216, NEES_HIGH = 9.348;

const ENVELOPE: Look = { colour: 'slam', width: 1, dash: [3, 3], opacity: 0.8 };
const ERROR: Look = { colour: 'ink', width: 1.4, dash: [], opacity: 1 };

function within(title: string, c: Consistency, errors: Float64Array, sigmas: Float64Array): HTMLElement {
	const x = floats(c.t);
	return curvePlot({
		title, x: 'Time [s]', y: 'Error [m]', between: [1, 2],
		curves: [
			{ label: 'Error', look: ERROR, x, y: errors },
			{ label: '+3\u03c3', look: ENVELOPE, x, y: sigmas.map((s) => 3 * s) },
			{ label: '\u22123\u03c3', look: ENVELOPE, x, y: sigmas.map((s) => -3 * s) },
		],
	});
}

function neesPlot(c: Consistency): HTMLElement {
	const x = floats(c.t), nees = floats(c.nees);
	const inside = nees.filter((v) => v >= NEES_LOW && v <= NEES_HIGH).length, known = nees.filter((v) => v === v).length;
	const mean = c.anees === null ? '' : ` Mean of NEES / 3: ${short(c.anees)}; 1 is consistent, above 1 is too sure of itself.`;
	return curvePlot({
		title: 'NEES of the position', x: 'Time [s]', y: 'NEES', band: { low: NEES_LOW, high: NEES_HIGH },
		curves: [
			{ label: 'NEES', look: ERROR, x, y: nees },
			level(`95 % band ${NEES_LOW} to ${NEES_HIGH}`, NEES_HIGH, x, ENVELOPE),
		],
		note: `${known > 0 ? ((100 * inside) / known).toFixed(0) : '\u2013'} % of the nodes are inside the band.${mean}`,
	});
}

export function consistencyPlots(report: Report): (() => HTMLElement)[] {
	const c = report.consistency;
	if (!c || c.t.length < 2) return [];
	return [
		() => within('North: error and \u00b13\u03c3', c, floats(c.error_n), floats(c.sigma_n)),
		() => within('East: error and \u00b13\u03c3', c, floats(c.error_e), floats(c.sigma_e)),
		() => within('Down: error and \u00b13\u03c3', c, floats(c.error_d), floats(c.sigma_d)),
		() => neesPlot(c),
	];
}

function rises(values: Float64Array): boolean {
	return values.every((v, i) => v === v && (i === 0 || v > values[i - 1]));
}

/** Against time as curves, against each other in the plane. */
function given(plot: Plot): HTMLElement {
	const x = floats(plot.x.values);
	let plain = 0;
	const curves = plot.series.map((series) => {
		const look = lookOf(series.role, series.role ? 0 : plain++);
		return { label: series.label, look: series.dash ? { ...look, dash: series.dash } : look, x, y: floats(series.values) };
	});
	const common = { title: plot.title, x: plot.x.label, y: plot.y_label, note: plot.note };
	return rises(x) ? curvePlot({ ...common, curves }) : planePlot({ ...common, shapes: curves, equal: false });
}

export function givenPlots(report: Report): (() => HTMLElement)[] {
	return report.plots.filter((plot) => plot.series.length > 0 && plot.x.values.length > 1).map((plot) => () => given(plot));
}
