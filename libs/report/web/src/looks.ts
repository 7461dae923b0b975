// How a curve looks, the same in every picture: told apart by dash and width as well as by colour.

import { svg } from './dom';

export interface Look {
	colour: string;             // name of a CSS variable
	width: number;              // [px]
	dash: number[];
	opacity: number;
}

const LOOKS: Record<string, Look> = {
	truth: { colour: 'truth', width: 5, dash: [], opacity: 0.5 },
	odometry: { colour: 'odometry', width: 1.75, dash: [7, 4], opacity: 1 },
	ekf: { colour: 'ekf', width: 1.5, dash: [2, 3], opacity: 1 },
	nodes: { colour: 'slam', width: 1.6, dash: [], opacity: 1 },
	slam: { colour: 'slam-causal', width: 1.5, dash: [6, 2], opacity: 1 },
	control: { colour: 'control', width: 1, dash: [], opacity: 0.6 },
	limit: { colour: 'muted', width: 1, dash: [3, 3], opacity: 1 },
	sequential: { colour: 'sequential', width: 1, dash: [], opacity: 0.8 },
	roi: { colour: 'roi', width: 1, dash: [4, 3], opacity: 0.85 },
	appearance: { colour: 'appearance', width: 1.25, dash: [1, 3], opacity: 1 },
	'turned-down': { colour: 'turned-down', width: 1.25, dash: [2, 2], opacity: 1 },
	refused: { colour: 'turned-down', width: 1, dash: [1, 4], opacity: 0.9 },
};

const OTHERS: Look[] = [
	{ colour: 'slam', width: 1.5, dash: [], opacity: 1 },
	{ colour: 'odometry', width: 1.5, dash: [7, 4], opacity: 1 },
	{ colour: 'truth', width: 1.5, dash: [2, 3], opacity: 1 },
	{ colour: 'turned-down', width: 1.5, dash: [9, 3, 2, 3], opacity: 1 },
	{ colour: 'ekf', width: 1.5, dash: [4, 2], opacity: 1 },
	{ colour: 'control', width: 1.5, dash: [12, 4], opacity: 1 },
];

export function lookOf(role: string | undefined, index = 0): Look {
	return (role && LOOKS[role]) || OTHERS[index % OTHERS.length];
}

/** Sequential edges and loop closings of any other name look like the region of interest's. */
export function loopLook(kind: string): Look {
	return LOOKS[kind] && ['sequential', 'roi', 'appearance'].includes(kind) ? LOOKS[kind] : LOOKS.roi;
}

/** A short piece of the curve, for legends. */
export function swatch(look: Look): SVGElement {
	return svg('svg', { class: 'swatch', width: 30, height: 10, viewBox: '0 0 30 10', 'aria-hidden': 'true' },
		svg('line', {
			x1: 0, y1: 5, x2: 30, y2: 5, style: `stroke: var(--${look.colour})`, 'stroke-width': Math.max(1.5, look.width),
			'stroke-dasharray': look.dash.join(' ') || null, opacity: look.opacity,
		}));
}
