// Everything that the replay draws, made from the report once and then shown at a time.

import { Vector3, type Object3D } from 'three';
import { extent, floats, lastUpTo, pick, Pose, Track } from '../columns';
import { lookOf, type Look } from '../looks';
import type { Report } from '../schema';
import { onTheme } from '../theme';
import { edgeLayers, Edges } from './edges';
import { Footprint } from './footprint';
import { floorMesh, Grid } from './ground';
import { Labels } from './labels';
import { Path } from './path';
import type { Box, Stage } from './stage';
import { Vehicle } from './vehicle';

/** Something that can be hidden. */
export interface Layer { key: string; label: string; look: Look | null; on: boolean; parts: (Object3D | HTMLElement)[] }

const HIDDEN_AT_FIRST = ['nodes', 'ekf', 'control', 'refused', 'sequential'];

export class World {
	readonly layers: Layer[] = [];
	readonly labels: Labels;
	readonly grid: Grid;
	readonly vehicle: Vehicle;
	readonly span: number;
	/** Loops and edges that have appeared up to now. */
	edgeCount = 0;
	private readonly paths: Path[] = [];
	private readonly edges: Edges[] = [];
	private readonly footprint: Footprint | null;
	private readonly nodes: Track | null;
	private readonly altitude: Float64Array;
	private readonly mover: Track;

	constructor(private readonly stage: Stage, report: Report, tracks: Track[]) {
		this.mover = moverOf(tracks);
		this.nodes = pick(tracks, 'nodes');
		this.altitude = floats(report.nodes.altitude);
		const box = boxOf(tracks, floorDepth(report, this.nodes, this.altitude));
		this.span = Math.max(box.n1 - box.n0, box.e1 - box.e0, 1);
		this.labels = new Labels(stage);
		this.grid = new Grid(box, this.labels);
		this.vehicle = new Vehicle(Math.max(1, this.span / 22));
		this.footprint = report.camera ? new Footprint(report.camera) : null;
		this.addPaths(tracks);
		this.addEdges(report);
		this.addPlace(report);
		onTheme(() => this.recolour());
	}

	private add(key: string, label: string, look: Look | null, ...parts: (Object3D | HTMLElement)[]): void {
		const layer = { key, label, look, on: !HIDDEN_AT_FIRST.includes(key), parts };
		for (const part of parts) if (!(part instanceof HTMLElement)) this.stage.ned.add(part);
		this.layers.push(layer);
		this.setLayer(layer, layer.on);
	}

	setLayer(layer: Layer, on: boolean): void {
		layer.on = on;
		for (const part of layer.parts) {
			if (part instanceof HTMLElement) part.hidden = !on;
			else part.visible = on;
		}
	}

	/** Where there is no causal trajectory, the final nodes are what is shown. */
	private addPaths(tracks: Track[]): void {
		const causal = pick(tracks, 'slam', 'nodes');
		tracks.filter((track) => track.size > 1).forEach((track, i) => {
			const look = track.name === 'slam' ? lookOf('nodes') : lookOf(track.name, i);
			const path = new Path(track, look, this.span / 90);
			this.paths.push(path);
			this.add(track === causal ? 'slam' : track.name, track.label, { ...look, dash: track.name === 'odometry' ? look.dash : [] }, path.group);
		});
	}

	private addEdges(report: Report): void {
		if (!this.nodes) return;
		for (const layer of edgeLayers(report.loops)) {
			const edges = new Edges(layer, report.loops, this.nodes, this.span / 60);
			this.edges.push(edges);
			this.add(layer.key, `${layer.label} (${layer.rows.length})`, layer.look, edges.lines);
		}
	}

	private addPlace(report: Report): void {
		this.add('vehicle', 'Vehicle', null, this.vehicle.group);
		if (this.footprint) this.add('footprint', 'Camera footprint', null, this.footprint.group);
		const floor = report.floor ? floorMesh(report.floor, this.grid.box, () => this.stage.redraw()) : null;
		if (floor) this.add('floor', 'Sea floor', null, floor);
		this.add('grid', 'Grid and labels', null, this.grid.group, this.labels.element);
	}

	private recolour(): void {
		for (const part of [...this.paths, ...this.edges, this.grid, this.vehicle]) part.recolour();
		this.footprint?.recolour();
		this.stage.redraw();
	}

	/** What a view has to show: the grid, the level at which the vehicle mostly is, and the top of the depth scale. */
	get outline(): Vector3[] {
		const { n0, n1, e0, e1, d0, d1 } = this.grid.box, level = median(this.mover.d);
		const corners = (d: number) => [[n0, e0], [n0, e1], [n1, e0], [n1, e1]].map(([n, e]) => new Vector3(n, e, d));
		return [...corners(d1), ...corners(level), new Vector3(n0, e1, d0)];
	}

	nodeAt(time: number): number {
		return this.nodes ? lastUpTo(this.nodes.t, time) : -1;
	}

	altitudeAt(node: number): number | null {
		return node >= 0 && this.altitude[node] > 0 ? this.altitude[node] : null;
	}

	show(time: number): Pose {
		for (const path of this.paths) path.show(time);
		this.edgeCount = 0;
		for (const edges of this.edges) {
			const count = edges.show(time);
			if (edges.layer.key !== 'refused') this.edgeCount += count;
		}
		const pose = this.mover.at(time);
		this.vehicle.place(pose);
		this.footprint?.place(pose, this.altitudeAt(this.nodeAt(time)));
		this.stage.redraw();
		return pose;
	}
}

/** The vehicle rides on the best that there is. */
export function moverOf(tracks: Track[]): Track {
	const track = pick(tracks, 'slam', 'nodes', 'control', 'ekf', 'odometry', 'truth') ?? tracks.find((other) => other.size > 0);
	if (!track) throw new Error('no trajectory');
	return track;
}

function median(values: Float64Array): number {
	return values.slice().sort()[values.length >> 1];
}

/** Of its picture, or what the nodes' depths and altitudes add up to. */
function floorDepth(report: Report, nodes: Track | null, altitude: Float64Array): number | null {
	if (report.floor) return report.floor.depth;
	const sums = nodes ? nodes.d.map((d, i) => d + altitude[i]).filter((depth) => depth === depth) : new Float64Array();
	return sums.length > 0 ? median(sums) : null;
}

/** What the trajectories and the floor under them fill. */
function boxOf(tracks: Track[], floor: number | null): Box {
	const box: Box = { n0: Infinity, n1: -Infinity, e0: Infinity, e1: -Infinity, d0: Infinity, d1: -Infinity };
	for (const track of tracks) {
		const [n0, n1] = extent(track.n), [e0, e1] = extent(track.e), [d0, d1] = extent(track.d);
		box.n0 = Math.min(box.n0, n0); box.n1 = Math.max(box.n1, n1);
		box.e0 = Math.min(box.e0, e0); box.e1 = Math.max(box.e1, e1);
		box.d0 = Math.min(box.d0, d0); box.d1 = Math.max(box.d1, d1);
	}
	const pad = 1 + 0.03 * Math.max(box.n1 - box.n0, box.e1 - box.e0);
	return { n0: box.n0 - pad, n1: box.n1 + pad, e0: box.e0 - pad, e1: box.e1 + pad, d0: box.d0, d1: Math.max(floor ?? box.d1 + 1, box.d1) };
}
