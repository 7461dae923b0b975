// Where the replay is looked at from.

import { Vector3 } from 'three';
import type { Pose } from '../columns';
import type { Stage } from './stage';

export type View = 'overview' | 'top' | 'side' | 'follow';

/** From the target to the camera, z up; top is a hair to the south, so that north is up in the picture. */
const DIRECTIONS: Record<View, [number, number, number]> = {
	overview: [-0.75, 0.45, 0.62], top: [-1e-4, 0, 1], side: [-1, 0, 0.12], follow: [-0.7, 0.4, 0.6],
};

/** [deg]; top and side are from afar, so that heights do not shift what is above the grid. */
const LENSES: Record<View, number> = { overview: 38, top: 3, side: 3, follow: 38 };

export class Views {
	current: View = 'overview';
	private readonly vehicle = new Vector3();

	constructor(private readonly stage: Stage, private readonly seen: Vector3[], private readonly close: number) {}

	show(view: View): void {
		this.current = view;
		if (view !== 'follow') {
			this.stage.look(this.seen, new Vector3(...DIRECTIONS[view]), LENSES[view]);
			return;
		}
		this.stage.setLens(LENSES.follow);
		this.stage.orbit.target.copy(this.vehicle);
		this.stage.camera.position.copy(this.vehicle).addScaledVector(new Vector3(...DIRECTIONS.follow).normalize(), this.close);
		this.stage.orbit.update();
	}

	/** Carries the camera along when it follows. */
	moveTo(pose: Pose): void {
		const next = new Vector3(pose.n, -pose.e, -pose.d), step = next.clone().sub(this.vehicle);
		this.vehicle.copy(next);
		if (this.current !== 'follow') return;
		this.stage.orbit.target.add(step);
		this.stage.camera.position.add(step);
		this.stage.orbit.update();
	}
}
