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

	private place(width: number, height: number): void {
		const { camera, ned } = this.stage, p = new Vector3();
		camera.updateMatrixWorld();
		ned.updateMatrixWorld();
		for (const { at, text } of this.items) {
			p.copy(at).applyMatrix4(ned.matrixWorld).project(camera);
			const inside = p.z < 1 && Math.abs(p.x) < 1 && Math.abs(p.y) < 1;
			text.style.visibility = inside ? '' : 'hidden';
			if (!inside) continue;
			const x = (0.5 + 0.5 * p.x) * width, y = (0.5 - 0.5 * p.y) * height;
			text.style.transform = `translate(-50%, -50%) translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
		}
	}
}
