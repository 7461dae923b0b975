// What the left camera sees of the floor: its four corner rays cut at the node's altitude.

import { BufferAttribute, BufferGeometry, Euler, Group, LineSegments, Matrix4, Mesh, Vector3 } from 'three';
import type { Pose } from '../columns';
import type { Camera } from '../schema';
import { colour } from '../theme';
import { face, ORDER, thin } from './materials';

const RAYS = [0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1];
const FACE = [1, 2, 3, 1, 3, 4];

export class Footprint {
	readonly group = new Group();
	/** Camera, then the corners clockwise. */
	private readonly points = new BufferAttribute(new Float32Array(15), 3);
	private readonly fill = face(0.35);
	private readonly edge = thin();
	private readonly bodyFromCamera: Matrix4;
	private known = false;

	constructor(private readonly camera: Camera) {
		this.bodyFromCamera = new Matrix4().fromArray(camera.T_body_camera).transpose();
		const geometry = (index: number[]) => {
			const made = new BufferGeometry();
			made.setAttribute('position', this.points);
			made.setIndex(index);
			return made;
		};
		const seen = new Mesh(geometry(FACE), this.fill), rays = new LineSegments(geometry(RAYS), this.edge);
		seen.frustumCulled = rays.frustumCulled = false;
		// It lies in the floor: over it, under everything else.
		this.fill.depthTest = false;
		seen.renderOrder = ORDER.grid;
		rays.renderOrder = ORDER.vehicle;
		this.group.add(seen, rays);
		this.recolour();
	}

	recolour(): void {
		this.fill.color.set(colour('vehicle'));
		this.edge.color.set(colour('footprint'));
	}

	/** Altitude: from the camera to the floor [m], null when not known. */
	place(pose: Pose, altitude: number | null): void {
		this.known = altitude !== null && altitude > 0;
		this.group.children.forEach((child) => { child.visible = this.known; });
		if (!this.known) return;
		const map = new Matrix4().makeRotationFromEuler(new Euler(pose.roll, pose.pitch, pose.yaw, 'ZYX'));
		map.setPosition(pose.n, pose.e, pose.d).multiply(this.bodyFromCamera);
		this.corners(altitude as number).forEach((p, i) => {
			p.applyMatrix4(map);
			this.points.setXYZ(i, p.x, p.y, p.z);
		});
		this.points.needsUpdate = true;
	}

	private corners(altitude: number): Vector3[] {
		const { width, height, fx, fy, cx, cy } = this.camera;
		const pixels = [[0, 0], [width, 0], [width, height], [0, height]];
		const rays = pixels.map(([u, v]) => new Vector3((u - cx) / fx, (v - cy) / fy, 1).multiplyScalar(altitude));
		return [new Vector3(), ...rays];
	}
}
