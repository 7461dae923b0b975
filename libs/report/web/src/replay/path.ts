// A trajectory: drawn up to now, the rest faint.

import { Group, InstancedInterleavedBuffer, InterleavedBufferAttribute } from 'three';
import { Line2 } from 'three/examples/jsm/lines/Line2.js';
import { LineGeometry } from 'three/examples/jsm/lines/LineGeometry.js';
import type { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { lastUpTo, Track } from '../columns';
import type { Look } from '../looks';
import { colour } from '../theme';
import { broad, ORDER } from './materials';

function positions(track: Track): Float32Array {
	const out = new Float32Array(3 * track.size);
	for (let i = 0; i < track.size; ++i) out.set([track.n[i], track.e[i], track.d[i]], 3 * i);
	return out;
}

/** Attributes are shared: the line up to now and the whole one are one buffer. */
function sharing(whole: LineGeometry): LineGeometry {
	const part = new LineGeometry();
	for (const name of ['instanceStart', 'instanceEnd', 'instanceDistanceStart', 'instanceDistanceEnd']) {
		const attribute = whole.getAttribute(name);
		if (attribute) part.setAttribute(name, attribute);
	}
	return part;
}

export class Path {
	readonly group = new Group();
	private readonly done: LineGeometry;
	private readonly tip: LineGeometry;
	private readonly materials: LineMaterial[];

	constructor(private readonly track: Track, private readonly look: Look, dashLength: number) {
		const whole = new LineGeometry();
		whole.setPositions(positions(track));
		this.tip = new LineGeometry();
		this.tip.setPositions([0, 0, 0, 0, 0, 0]);
		const gap = track.name === 'odometry' ? 0.6 * dashLength : 0;
		const faint = broad(Math.max(1, look.width - 1), 0.2 * look.opacity, dashLength, 0);
		const full = broad(look.width + 0.4, look.opacity, dashLength, gap);
		this.materials = [faint, full];
		const rest = new Line2(whole, faint);
		rest.computeLineDistances();
		this.done = sharing(whole);
		const tip = new Line2(this.tip, full);
		tip.computeLineDistances();
		// Bounds of the part up to now are not known to the renderer.
		for (const line of [rest, new Line2(this.done, full), tip]) {
			line.frustumCulled = false;
			line.renderOrder = track.name === 'truth' ? ORDER.truth : look.colour === 'slam' ? ORDER.slam : ORDER.path;
			this.group.add(line);
		}
		this.recolour();
	}

	recolour(): void {
		for (const material of this.materials) material.color.set(colour(this.look.colour));
	}

	/** Whole segments up to the last row, and a piece of the one that is being travelled. */
	show(time: number): void {
		const last = lastUpTo(this.track.t, time);
		this.done.instanceCount = Math.max(0, last);
		const now = this.track.at(time), i = Math.max(0, last);
		const start = this.tip.getAttribute('instanceStart') as InterleavedBufferAttribute;
		const buffer = start.data as InstancedInterleavedBuffer;
		buffer.array.set([this.track.n[i], this.track.e[i], this.track.d[i], now.n, now.e, now.d]);
		buffer.needsUpdate = true;
	}
}
