// What holds at the time of the replay, in words: beside the picture, with the key frame that was seen last.

import { h } from '../dom';
import { fixed } from '../format';
import { lastUpTo, floats, type Pose } from '../columns';
import type { ErrorCurve, Report } from '../schema';
import type { World } from './world';

export class Readout {
	readonly values = h('dl', { class: 'readout', id: 'replay-readout' });
	readonly picture: HTMLElement;
	private readonly image = h('img', { alt: '' });
	private readonly caption = h('figcaption');
	private readonly frames = new Map<number, string>();
	private readonly frameNodes: number[];
	private readonly error: { curve: ErrorCurve; t: Float64Array } | null;
	private shown = -1;

	constructor(report: Report, private readonly world: World) {
		for (const frame of report.key_frames) if (frame.jpeg) this.frames.set(frame.node, frame.jpeg);
		this.frameNodes = [...this.frames.keys()].sort((a, b) => a - b);
		const curve = ['slam', 'nodes'].map((name) => report.errors.find((other) => other.name === name)).find((found) => found);
		this.error = curve ? { curve, t: floats(curve.t) } : null;
		this.picture = h('figure', { class: 'last-frame', hidden: this.frameNodes.length === 0 }, this.image, this.caption);
	}

	show(time: number, pose: Pose): void {
		const node = this.world.nodeAt(time), rows: [string, string][] = [];
		if (node >= 0) rows.push(['Node', String(node)]);
		rows.push(['North', `${fixed(pose.n, 2)} m`], ['East', `${fixed(pose.e, 2)} m`], ['Depth', `${fixed(pose.d, 2)} m`]);
		const altitude = this.world.altitudeAt(node);
		if (altitude !== null) rows.push(['Altitude', `${fixed(altitude, 2)} m`]);
		rows.push(['Heading', `${fixed(((pose.yaw * 180) / Math.PI + 360) % 360, 0)}\u00b0`], ['Edges', String(this.world.edgeCount)]);
		if (this.error) rows.push(['SLAM error', `${fixed(this.error.curve.error[Math.max(0, lastUpTo(this.error.t, time))], 3)} m`]);
		this.values.replaceChildren(...rows.map(([what, value]) => h('div', {}, h('dt', {}, what), h('dd', {}, value))));
		this.showFrame(node);
	}

	private showFrame(node: number): void {
		const frame = this.frameNodes[Math.max(0, lastUpTo(this.frameNodes, node))];
		if (frame === undefined || frame === this.shown) return;
		this.shown = frame;
		this.image.src = `data:image/jpeg;base64,${this.frames.get(frame)}`;
		this.image.alt = `Left picture of node ${frame}`;
		this.caption.textContent = `Node ${frame}`;
	}
}
