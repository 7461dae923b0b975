// The replay on paper: its picture as it is, in light colours, with its labels painted in. A canvas of WebGL cannot
// be printed in another size or colour than the one last shown.

import { h } from '../dom';
import { colour, onPrint } from '../theme';
import type { Labels } from './labels';
import type { Stage } from './stage';

const WIDTH = 1800;     // [px]

/** A canvas that is seen in print only. */
export function printedReplay(stage: Stage, labels: Labels): HTMLCanvasElement {
	const canvas = h('canvas', { class: 'printed', 'aria-hidden': 'true' });
	onPrint((printing) => {
		if (printing) paint(canvas, stage, labels);
	});
	return canvas;
}

function paint(canvas: HTMLCanvasElement, stage: Stage, labels: Labels): void {
	stage.picture(WIDTH, (picture) => {
		canvas.width = picture.width;
		canvas.height = picture.height;
		const context = canvas.getContext('2d');
		if (!context) return;
		context.drawImage(picture, 0, 0);
		if (labels.element.hidden) return;
		context.font = '22px system-ui, sans-serif';
		context.textAlign = 'center';
		context.textBaseline = 'middle';
		context.fillStyle = colour('muted');
		labels.each(canvas.width, canvas.height, (text, x, y) => context.fillText(text, x, y));
	});
}
