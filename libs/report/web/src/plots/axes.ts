// Axes that look the same in every plot and follow the theme.

import type uPlot from 'uplot';
import { colour } from '../theme';

const FONT = '12px system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';

export interface Size { width: number; height: number }

const X_SIZE = 28, Y_SIZE = 54, LABEL = 18;

export const PADDING: uPlot.Padding = [10, 10, 0, 0];

function axis(label: string, size: number): uPlot.Axis {
	const line = { stroke: () => colour('rule'), width: 1 };
	return {
		label, size, labelSize: LABEL, labelGap: 0, gap: 5, font: FONT, labelFont: FONT, stroke: () => colour('muted'),
		grid: line, ticks: { ...line, size: 4 }, border: { show: false },
		values: (_, splits) => splits.map((value) => (value === null ? '' : String(+value.toPrecision(8)).replace('-', '\u2212'))),
	};
}

export function axes(x: string, y: string): uPlot.Axis[] {
	return [axis(x, X_SIZE), axis(y, Y_SIZE)];
}

/** Of the part inside the axes; uPlot itself knows it only after its first drawing. */
export function areaOf(plot: uPlot): Size {
	return { width: plot.width - Y_SIZE - LABEL - 10, height: plot.height - X_SIZE - LABEL - 10 };
}
