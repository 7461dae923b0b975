// The floor's picture, and a level grid with metre labels, a depth scale and a north arrow.

import { BufferAttribute, BufferGeometry, Group, LineSegments, Mesh, SRGBColorSpace, TextureLoader, Vector3 } from 'three';
import type { Floor } from '../schema';
import { colour } from '../theme';
import type { Labels } from './labels';
import { face, ORDER, thin } from './materials';
import type { Box } from './stage';

/** 1, 2 or 5 times a power of ten, so that the span has about `count` steps. */
export function niceStep(span: number, count: number): number {
	const raw = Math.max(span, 1e-6) / count, power = Math.pow(10, Math.floor(Math.log10(raw)));
	return power * (raw / power < 1.5 ? 1 : raw / power < 3.5 ? 2 : raw / power < 7.5 ? 5 : 10);
}

/** The part of the picture over the grid. */
export function floorMesh(floor: Floor, box: Box, loaded: () => void): Mesh | null {
	const n0 = Math.max(box.n0, floor.north_min), n1 = Math.min(box.n1, floor.north_max);
	const e0 = Math.max(box.e0, floor.east_min), e1 = Math.min(box.e1, floor.east_max);
	if (n0 >= n1 || e0 >= e1 || !floor.image.startsWith('data:image/')) return null;
	const u = (e: number) => (e - floor.east_min) / (floor.east_max - floor.east_min);
	const v = (n: number) => (n - floor.north_min) / (floor.north_max - floor.north_min);
	const geometry = new BufferGeometry(), d = floor.depth;
	geometry.setAttribute('position', new BufferAttribute(new Float32Array([n0, e0, d, n0, e1, d, n1, e1, d, n1, e0, d]), 3));
	geometry.setAttribute('uv', new BufferAttribute(new Float32Array([u(e0), v(n0), u(e1), v(n0), u(e1), v(n1), u(e0), v(n1)]), 2));
	geometry.setIndex([0, 1, 2, 0, 2, 3]);
	const texture = new TextureLoader().load(floor.image, loaded);
	texture.colorSpace = SRGBColorSpace;
	texture.anisotropy = 4;
	const mesh = new Mesh(geometry, face(1, texture));
	mesh.renderOrder = ORDER.floor;
	return mesh;
}

export class Grid {
	readonly group = new Group();
	readonly box: Box;
	private readonly material = thin(0.55);
	private readonly arrow = face();
	private readonly step: number;

	/** Around `seen`, widened to whole steps, level at its lowest depth. */
	constructor(seen: Box, labels: Labels) {
		const step = this.step = niceStep(Math.max(seen.n1 - seen.n0, seen.e1 - seen.e0), 8);
		const down = (x: number) => step * Math.floor(x / step), up = (x: number) => step * Math.ceil(x / step);
		this.box = { n0: down(seen.n0), n1: up(seen.n1), e0: down(seen.e0), e1: up(seen.e1), d0: Math.min(0, seen.d0), d1: seen.d1 };
		this.group.add(this.lines(labels), this.northArrow(labels));
		for (const part of this.group.children) part.renderOrder = ORDER.grid;
		this.recolour();
	}

	recolour(): void {
		this.material.color.set(colour('grid3d'));
		this.arrow.color.set(colour('ink'));
	}

	private lines(labels: Labels): LineSegments {
		const { n0, n1, e0, e1, d0, d1 } = this.box, step = this.step, points: number[] = [];
		const off = 0.35 * step, name = (x: number) => String(+x.toFixed(6)).replace('-', '\u2212');
		for (let n = n0; n < n1 + step / 2; n += step) {
			points.push(n, e0, d1, n, e1, d1);
			labels.add(name(n) + (n + step / 2 > n1 ? ' m N' : ''), new Vector3(n, e0 - off, d1));
		}
		for (let e = e0; e < e1 + step / 2; e += step) {
			points.push(n0, e, d1, n1, e, d1);
			labels.add(name(e) + (e + step / 2 > e1 ? ' m E' : ''), new Vector3(n0 - off, e, d1));
		}
		this.depthScale(d0, d1, points, labels, name);
		const geometry = new BufferGeometry();
		geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
		return new LineSegments(geometry, this.material);
	}

	/** At the south-eastern corner, counted downwards; left out where it would be too short for its labels. */
	private depthScale(d0: number, d1: number, points: number[], labels: Labels, name: (x: number) => string): void {
		const { n0, e1 } = this.box, step = niceStep(d1 - d0, 3), tick = 0.12 * this.step;
		if (d1 - d0 < 0.8 * this.step) return;
		points.push(n0, e1, d0, n0, e1, d1);
		for (let d = step * Math.ceil(d0 / step); d < d1 - step / 3; d += step) {
			points.push(n0, e1, d, n0, e1 + tick, d);
			labels.add(`${name(d)} m${d === 0 ? ' D' : ''}`, new Vector3(n0, e1 + 4 * tick, d));
		}
	}

	private northArrow(labels: Labels): Mesh {
		const { n1, e1, d1 } = this.box, s = 0.3 * this.step, e = e1 + 2 * s, n = n1 - 3 * s;
		const geometry = new BufferGeometry();
		geometry.setAttribute('position', new BufferAttribute(new Float32Array([
			n + 2.4 * s, e, d1, n, e - 0.7 * s, d1, n + 0.6 * s, e, d1, n + 2.4 * s, e, d1, n, e + 0.7 * s, d1, n + 0.6 * s, e, d1,
		]), 3));
		labels.add('N', new Vector3(n + 3.4 * s, e, d1), 'strong');
		return new Mesh(geometry, this.arrow);
	}
}
