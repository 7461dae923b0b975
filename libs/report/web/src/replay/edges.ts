// Loop edges between the nodes, each appearing at the time of its later node: sorted by it, so that a time is a
// length of the buffer.

import { BufferAttribute, BufferGeometry, LineSegments, type LineBasicMaterial } from 'three';
import { lastUpTo, Track } from '../columns';
import { isAccepted, isTurnedDown } from '../loops/rows';
import { loopLook, lookOf, type Look } from '../looks';
import type { Loops } from '../schema';
import { colour } from '../theme';
import { ORDER, thin, thinDashed } from './materials';

export interface EdgeLayer { key: string; label: string; look: Look; rows: number[] }

/** Rows of the loops by what they are drawn as. */
export function edgeLayers(loops: Loops): EdgeLayer[] {
	const layers = new Map<string, EdgeLayer>();
	const put = (key: string, label: string, look: Look, row: number) => {
		if (!layers.has(key)) layers.set(key, { key, label, look, rows: [] });
		layers.get(key)!.rows.push(row);
	};
	for (let row = 0; row < loops.from.length; ++row) {
		const kind = loops.kind[row];
		if (!isAccepted(loops, row)) put('refused', 'Refused candidates', lookOf('refused'), row);
		else if (isTurnedDown(loops, row)) put('turned-down', 'Weight below half', lookOf('turned-down'), row);
		else put(kind, `Loops: ${kind}`, loopLook(kind), row);
	}
	const order = ['sequential', 'roi', 'appearance', 'turned-down', 'refused'];
	return [...layers.values()].sort((a, b) => order.indexOf(a.key) - order.indexOf(b.key));
}

/** Many lines over each other hide what is under them: the more, the fainter. */
function crowded(count: number): number {
	return Math.max(0.12, Math.min(0.9, 30 / Math.sqrt(count + 1)));
}

export class Edges {
	readonly lines: LineSegments;
	private readonly times: Float64Array;
	private readonly material: LineBasicMaterial;

	constructor(readonly layer: EdgeLayer, loops: Loops, nodes: Track, dashLength: number) {
		const rows = layer.rows.filter((row) => loops.to[row] < nodes.size && loops.from[row] < nodes.size);
		rows.sort((a, b) => loops.to[a] - loops.to[b]);
		this.times = Float64Array.from(rows, (row) => nodes.t[loops.to[row]]);
		const points = new Float32Array(6 * rows.length);
		rows.forEach((row, k) => [loops.from[row], loops.to[row]].forEach((node, end) =>
			points.set([nodes.n[node], nodes.e[node], nodes.d[node]], 6 * k + 3 * end)));
		const geometry = new BufferGeometry();
		geometry.setAttribute('position', new BufferAttribute(points, 3));
		this.material = this.makeMaterial(dashLength);
		this.lines = new LineSegments(geometry, this.material);
		this.lines.frustumCulled = false;
		this.lines.renderOrder = ORDER.edges;
		if (layer.look.dash.length > 0) this.lines.computeLineDistances();
		this.recolour();
	}

	private makeMaterial(dashLength: number): LineBasicMaterial {
		const { dash, opacity } = this.layer.look, unit = dashLength / 5, seen = opacity * crowded(this.layer.rows.length);
		return dash.length > 0 ? thinDashed(seen, dash[0] * unit, dash[1] * unit) : thin(seen);
	}

	recolour(): void {
		this.material.color.set(colour(this.layer.look.colour));
	}

	/** Shows those found up to now; returns how many. */
	show(time: number): number {
		const count = lastUpTo(this.times, time) + 1;
		this.lines.geometry.setDrawRange(0, 2 * count);
		return count;
	}
}
