// The vehicle: a plain torpedo with fins, its nose along x, y to starboard, z down.

import { BoxGeometry, CapsuleGeometry, Group, Mesh } from 'three';
import type { Pose } from '../columns';
import { colour } from '../theme';
import { face, ORDER } from './materials';

const LENGTH = 1.6, RADIUS = 0.12;     // [m], SPARUS II

export class Vehicle {
	readonly group = new Group();
	private readonly hull = face();
	private readonly trim = face();

	constructor(scale: number) {
		const hull = new Mesh(new CapsuleGeometry(RADIUS, LENGTH - 2 * RADIUS, 6, 16), this.hull);
		hull.rotation.z = -Math.PI / 2;
		const nose = new Mesh(new CapsuleGeometry(1.04 * RADIUS, 0.02, 6, 16), this.trim);
		nose.rotation.z = -Math.PI / 2;
		nose.position.x = LENGTH / 2 - 0.99 * RADIUS;
		const fin = new Mesh(new BoxGeometry(0.22, 0.02, 0.3), this.trim);
		fin.position.set(-0.6, 0, -0.2);
		const wing = new Mesh(new BoxGeometry(0.2, 0.62, 0.03), this.trim);
		wing.position.set(-0.62, 0, 0);
		this.group.add(hull, nose, fin, wing);
		for (const part of this.group.children) part.renderOrder = ORDER.vehicle;
		this.group.scale.setScalar(scale);
		this.recolour();
	}

	recolour(): void {
		this.hull.color.set(colour('vehicle'));
		this.trim.color.set(colour('vehicle-trim'));
	}

	place(pose: Pose): void {
		this.group.position.set(pose.n, pose.e, pose.d);
		this.group.rotation.set(pose.roll, pose.pitch, pose.yaw, 'ZYX');
	}
}
