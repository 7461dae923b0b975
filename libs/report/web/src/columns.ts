// Columns of the report as typed arrays, and looking them up by time.

import type { Column, Trajectory } from './schema';

/** Nulls become NaN. */
export function floats(column: Column): Float64Array {
	const out = new Float64Array(column.length);
	for (let i = 0; i < out.length; ++i) {
		const v = column[i];
		out[i] = v === null ? NaN : v;
	}
	return out;
}

/** Index of the last entry <= value of an ascending array, -1 when there is none. */
export function lastUpTo(sorted: ArrayLike<number>, value: number): number {
	let low = 0, high = sorted.length;
	while (low < high) {
		const middle = (low + high) >> 1;
		if (sorted[middle] <= value) low = middle + 1;
		else high = middle;
	}
	return low - 1;
}

/** Smallest and largest of the finite numbers; [Infinity, -Infinity] of none. */
export function extent(values: ArrayLike<number>): [number, number] {
	let low = Infinity, high = -Infinity;
	for (let i = 0; i < values.length; ++i) {
		const v = values[i];
		if (v < low) low = v;
		if (v > high) high = v;
	}
	return [low, high];
}

export interface Pose { n: number; e: number; d: number; roll: number; pitch: number; yaw: number }

/** A trajectory with its gaps taken out. */
export class Track {
	readonly name: string;
	readonly label: string;
	readonly t: Float64Array; readonly n: Float64Array; readonly e: Float64Array; readonly d: Float64Array;
	private readonly angles: Float64Array[];

	constructor(source: Trajectory) {
		this.name = source.name;
		this.label = source.label;
		const columns = [source.t, source.n, source.e, source.d, source.roll, source.pitch, source.yaw].map(floats);
		const keep = columns[0].map((_, i) => (columns.slice(0, 4).every((c) => c[i] === c[i]) ? 1 : 0));
		const [t, n, e, d, ...angles] = columns.map((c) => c.filter((_, i) => keep[i] === 1));
		this.t = t; this.n = n; this.e = e; this.d = d;
		this.angles = angles;
	}

	get size(): number { return this.t.length; }

	/** Straight between two rows; the first and last pose hold before and after. */
	at(time: number): Pose {
		const i = Math.max(0, lastUpTo(this.t, time)), j = Math.min(i + 1, this.size - 1);
		const span = this.t[j] - this.t[i];
		const s = span > 0 ? Math.min(1, Math.max(0, (time - this.t[i]) / span)) : 0;
		const mix = (c: Float64Array) => c[i] + s * (c[j] - c[i]);
		const turn = (c: Float64Array) => (c[i] || 0) + s * Math.atan2(Math.sin(c[j] - c[i]), Math.cos(c[j] - c[i]));
		const [roll, pitch, yaw] = this.angles.map(turn).map((a) => a || 0);
		return { n: mix(this.n), e: mix(this.e), d: mix(this.d), roll, pitch, yaw };
	}
}

/** The first trajectory of these names that has rows. */
export function pick(tracks: Track[], ...names: string[]): Track | null {
	for (const name of names) {
		const found = tracks.find((track) => track.name === name && track.size > 0);
		if (found) return found;
	}
	return null;
}
