// Axes that look the same in every plot and follow the theme.

import type uPlot from 'uplot';
import { colour } from '../theme';

const FONT = '12px system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';

export function axis(label: string, size: number, side?: uPlot.Axis.Side): uPlot.Axis {
	const line = { stroke: () => colour('rule'), width: 1 };
	return {
		label, side, size, labelSize: 18, labelGap: 0, gap: 5, font: FONT, labelFont: FONT, stroke: () => colour('muted'),
		grid: line, ticks: { ...line, size: 4 }, border: { show: false },
		values: (_, splits) => splits.map((value) => (value === null ? '' : String(+value.toPrecision(8)).replace('-', '\u2212'))),
	};
}
