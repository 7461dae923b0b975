// Text over the canvas, where points of the scene are.

import { Vector3 } from 'three';
import { h } from '../dom';
import type { Stage } from './stage';

export class Labels {
	readonly element = h('div', { class: 'labels', 'aria-hidden': 'true' });
	private readonly items: { at: Vector3; text: HTMLElement }[] = [];

	constructor(private readonly stage: Stage) {
		stage.before.push((width, height) => this.place(width, height));
	}

	/** At north, east, down. */
	add(text: string, at: Vector3, className = ''): void {
		const item = { at, text: h('span', { class: className }, text) };
		this.items.push(item);
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
		for (const { at, text } of this.items) {
			const seen = this.project(at, width, height);
			text.style.visibility = seen ? '' : 'hidden';
			if (seen) text.style.transform = `translate(-50%, -50%) translate(${seen[0].toFixed(1)}px, ${seen[1].toFixed(1)}px)`;
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
