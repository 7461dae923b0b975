// Text over the canvas, where points of the scene are.

import { Vector3 } from 'three';
import { h } from '../dom';
import type { Stage } from './stage';

function covers([x0, y0]: [number, number], [x1, y1]: [number, number]): boolean {
	return Math.abs(x1 - x0) < 22 && Math.abs(y1 - y0) < 14;
}

export class Labels {
	readonly element = h('div', { class: 'labels', 'aria-hidden': 'true' });
	private readonly items: { at: Vector3; text: HTMLElement }[] = [];

	constructor(private readonly stage: Stage) {
		stage.before.push((width, height) => this.place(width, height));
	}

	/** At north, east, down. Where two would cover each other, the one without units gives way. */
	add(text: string, at: Vector3, className = ''): void {
		const item = { at, text: h('span', { class: className }, text) };
		if (/[a-z]/i.test(text)) this.items.unshift(item);
		else this.items.push(item);
		this.element.append(item.text);
	}

	/** Where the camera sees a point of a picture of this size; null outside of it. */
	private project(at: Vector3, width: number, height: number): [x: number, y: number] | null {
		const p = at.clone().applyMatrix4(this.stage.ned.matrixWorld).project(this.stage.camera);
		const inside = p.z < 1 && Math.abs(p.x) < 1 && Math.abs(p.y) < 1;
		return inside ? [(0.5 + 0.5 * p.x) * width, (0.5 - 0.5 * p.y) * height] : null;
	}

	private place(width: number, height: number): void {
		this.stage.camera.updateMatrixWorld();
		this.stage.ned.updateMatrixWorld();
		const shown: [x: number, y: number][] = [];
		for (const { at, text } of this.items) {
			const seen = this.project(at, width, height), free = seen !== null && !shown.some((other) => covers(other, seen));
			text.style.visibility = free ? '' : 'hidden';
			if (!free) continue;
			shown.push(seen);
			text.style.transform = `translate(-50%, -50%) translate(${seen[0].toFixed(1)}px, ${seen[1].toFixed(1)}px)`;
		}
	}

	/** For a picture of another size. */
	each(width: number, height: number, use: (text: string, x: number, y: number) => void): void {
		for (const { at, text } of this.items) {
			const seen = this.project(at, width, height);
			if (seen) use(text.textContent ?? '', ...seen);
		}
	}
}
