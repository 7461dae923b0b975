// The pictures of the paper's figure 5: trajectories from above, and the error over the distance travelled.

import { floats, pick, Track } from '../columns';
import { isAccepted, isTurnedDown } from '../loops/rows';
import { loopLook, lookOf } from '../looks';
import type { ErrorCurve, Loops, Report } from '../schema';
import { curvePlot, type Curve } from './curves';
import { planePlot, type Shape } from './plane';

function path(track: Track): Shape {
	return { label: track.label, look: lookOf(track.name), x: track.e, y: track.n };
}

function segments(label: string, rows: number[], loops: Loops, nodes: Track, look = lookOf('roi')): Shape {
	const x = new Float64Array(2 * rows.length), y = new Float64Array(2 * rows.length);
	rows.forEach((row, k) => [loops.from[row], loops.to[row]].forEach((node, end) => {
		x[2 * k + end] = nodes.e[node];
		y[2 * k + end] = nodes.n[node];
	}));
	return { label: `${label} (${rows.length})`, look, x, y, segments: true };
}

/** Loop closings by kind, without the edges to the previous nodes, and those turned down. */
function closings(loops: Loops, nodes: Track): Shape[] {
	const byKind = new Map<string, number[]>(), down: number[] = [];
	for (let row = 0; row < loops.from.length; ++row) {
		const kind = loops.kind[row];
		if (!isAccepted(loops, row) || loops.from[row] >= nodes.size || loops.to[row] >= nodes.size) continue;
		if (isTurnedDown(loops, row)) {
			down.push(row);
		} else if (kind !== 'sequential') {
			if (!byKind.has(kind)) byKind.set(kind, []);
			byKind.get(kind)!.push(row);
		}
	}
	const shapes = [...byKind].map(([kind, rows]) => segments(`Loop closings: ${kind}`, rows, loops, nodes, loopLook(kind)));
	return down.length > 0 ? [...shapes, segments('Weight below half', down, loops, nodes, lookOf('turned-down'))] : shapes;
}

function topView(title: string, shapes: Shape[], start: Track | null): HTMLElement {
	return planePlot({ title, x: 'East [m]', y: 'North [m]', shapes, equal: true, start: start ? [start.e[0], start.n[0]] : undefined });
}

export function topViews(report: Report, tracks: Track[]): (() => HTMLElement)[] {
	const truth = pick(tracks, 'truth'), odometry = pick(tracks, 'odometry', 'ekf');
	const nodes = pick(tracks, 'nodes'), slam = nodes ?? pick(tracks, 'slam'), against = truth ? [path(truth)] : [];
	const made: (() => HTMLElement)[] = [];
	if (odometry) made.push(() => topView(truth ? 'Odometry and truth' : 'Odometry', [...against, path(odometry)], truth ?? odometry));
	if (slam) {
		const loops = nodes ? closings(report.loops, nodes) : [];
		const title = `${truth ? 'SLAM and truth' : 'SLAM'}${loops.length > 0 ? ', with loop closings' : ''}`;
		made.push(() => topView(title,
			[...against, ...loops, { ...path(slam), look: lookOf('nodes') }], truth ?? slam));
	}
	return made;
}

/** Rows without a distance or an error are left out; distances only grow. */
function curveOf(error: ErrorCurve, index: number): Curve {
	const distance = floats(error.distance), value = floats(error.error), keep: number[] = [];
	let furthest = -Infinity;
	for (let i = 0; i < distance.length; ++i) {
		if (!(distance[i] > furthest) || value[i] !== value[i]) continue;
		furthest = distance[i];
		keep.push(i);
	}
	return {
		label: error.label, look: lookOf(error.name, index),
		x: Float64Array.from(keep, (i) => distance[i]), y: Float64Array.from(keep, (i) => value[i]),
	};
}

export function errorPlots(report: Report): (() => HTMLElement)[] {
	// The one at the rate of control is dense: under the others.
	const errors = [...report.errors].sort((a, b) => Number(b.name === 'control') - Number(a.name === 'control'));
	const drawn = (some: ErrorCurve[]) => some.map(curveOf).filter((curve) => curve.x.length > 1);
	const curves = drawn(errors), ours = drawn(errors.filter(({ name }) => ['slam', 'nodes', 'control'].includes(name)));
	const made: (() => HTMLElement)[] = [], x = 'Distance travelled [m]', y = '3D error [m]';
	if (curves.length > 0) made.push(() => curvePlot({ title: '3D error', x, y, curves }));
	if (ours.length > 0 && ours.length < curves.length) made.push(() => curvePlot({ title: '3D error, SLAM alone', x, y, curves: ours }));
	return made;
}
