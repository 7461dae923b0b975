// Renderer, camera and the frame that the vehicle lives in. Draws on request only.

import { Group, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { colour } from '../theme';

/** What the replay shows, north-east-down [m]. */
export interface Box { n0: number; n1: number; e0: number; e1: number; d0: number; d1: number }

export class Stage {
	readonly renderer: WebGLRenderer;
	readonly camera = new PerspectiveCamera(38, 1, 0.1, 1e5);
	readonly orbit: OrbitControls;
	readonly scene = new Scene();
	/** North, east, down below this one; the scene itself has z up: half a turn about north. */
	readonly ned = new Group();
	/** Called before each drawing, with the size of the canvas [px]. */
	readonly before: ((width: number, height: number) => void)[] = [];
	private pending = false;

	/** Throws where there is no WebGL. */
	constructor(private readonly holder: HTMLElement) {
		// The drawing is kept for printing and for saving the canvas.
		this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
		this.renderer.domElement.setAttribute('aria-hidden', 'true');
		holder.prepend(this.renderer.domElement);
		this.ned.rotation.x = Math.PI;
		this.scene.add(this.ned);
		this.camera.up.set(0, 0, 1);
		this.orbit = new OrbitControls(this.camera, this.renderer.domElement);
		this.orbit.addEventListener('change', () => this.redraw());
		new ResizeObserver(() => this.resize()).observe(holder);
		this.resize();
	}

	resize(): void {
		const { clientWidth: width, clientHeight: height } = this.holder;
		if (width === 0 || height === 0) return;
		this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
		this.renderer.setSize(width, height);
		this.camera.aspect = width / height;
		this.camera.updateProjectionMatrix();
		this.draw();
	}

	redraw(): void {
		if (this.pending) return;
		this.pending = true;
		requestAnimationFrame(() => this.draw());
	}

	draw(): void {
		this.pending = false;
		const { clientWidth, clientHeight } = this.holder;
		for (const listener of this.before) listener(clientWidth, clientHeight);
		this.renderer.setClearColor(colour('stage'));
		this.renderer.render(this.scene, this.camera);
	}

	/** Looks at the middle of the box from a direction (z up), from where all of it is in the picture. */
	look(box: Box, direction: Vector3): void {
		const middle = new Vector3((box.n0 + box.n1) / 2, -(box.e0 + box.e1) / 2, -(box.d0 + box.d1) / 2);
		this.orbit.target.copy(middle);
		this.camera.position.copy(middle).add(direction);
		this.camera.lookAt(middle);
		this.camera.position.copy(middle).addScaledVector(direction.normalize(), this.distanceFor(box, middle));
		this.orbit.update();
		this.redraw();
	}

	/** Distance from which every corner of the box is inside the picture, with a margin. */
	private distanceFor(box: Box, middle: Vector3): number {
		const half = Math.tan((this.camera.fov * Math.PI) / 360);
		const turn = this.camera.quaternion.clone().invert();
		let distance = 1;
		for (let corner = 0; corner < 8; ++corner) {
			const p = new Vector3(corner & 1 ? box.n0 : box.n1, -(corner & 2 ? box.e0 : box.e1), -(corner & 4 ? box.d0 : box.d1));
			p.sub(middle).applyQuaternion(turn);
			distance = Math.max(distance, p.z + Math.max(Math.abs(p.x) / (half * this.camera.aspect), Math.abs(p.y) / half));
		}
		return 1.06 * distance;
	}
}
