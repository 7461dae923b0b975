// Renderer, camera and the frame that the vehicle lives in. Draws on request only.

import { Group, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { colour } from '../theme';

/** What the replay shows, north-east-down [m]. */
export interface Box { n0: number; n1: number; e0: number; e1: number; d0: number; d1: number }

export class Stage {
	readonly renderer: WebGLRenderer;
	readonly camera = new PerspectiveCamera(38, 1, 0.1, 1e6);
	readonly orbit: OrbitControls;
	readonly scene = new Scene();
	/** North, east, down below this one; the scene itself has z up: half a turn about north. */
	readonly ned = new Group();
	/** Called before each drawing, with the size of the canvas [px]. */
	readonly before: ((width: number, height: number) => void)[] = [];
	private pending = false;
	private size = '';

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
		this.resize();
		new ResizeObserver(() => { if (this.resize()) this.draw(); }).observe(holder);
	}

	/** Follows the size of its holder; false when there was nothing to follow. */
	resize(): boolean {
		const { clientWidth: width, clientHeight: height } = this.holder, ratio = Math.min(2, devicePixelRatio);
		const key = `${width} ${height} ${ratio}`;
		if (width === 0 || height === 0 || key === this.size) return false;
		this.size = key;
		this.renderer.setPixelRatio(ratio);
		this.renderer.setSize(width, height);
		this.camera.aspect = width / height;
		this.camera.updateProjectionMatrix();
		return true;
	}

	redraw(): void {
		if (this.pending) return;
		this.pending = true;
		requestAnimationFrame(() => { if (this.pending) this.draw(); });
	}

	/** At once; a drawing that was asked for is then not needed. */
	draw(): void {
		this.pending = false;
		const { clientWidth, clientHeight } = this.holder;
		for (const listener of this.before) listener(clientWidth, clientHeight);
		this.renderer.setClearColor(colour('stage'));
		this.renderer.render(this.scene, this.camera);
	}

	/** Draws once with another width and the same shape, for `use`. */
	picture(width: number, use: (canvas: HTMLCanvasElement) => void): void {
		const { clientWidth, clientHeight } = this.holder, shape = clientWidth > 0 ? clientHeight / clientWidth : 0.5;
		this.renderer.setPixelRatio(1);
		this.renderer.setSize(width, Math.round(shape * width), false);
		this.renderer.setClearColor(colour('stage'));
		this.renderer.render(this.scene, this.camera);
		use(this.renderer.domElement);
		this.size = '';
		this.resize();
		this.draw();
	}

	/** Looks along a direction (z up, towards the camera) at points of north, east, down: all of them in the picture, in its middle. */
	look(points: Vector3[], direction: Vector3, fov: number): void {
		const seen = points.map(({ x, y, z }) => new Vector3(x, -y, -z)), away = direction.clone().normalize();
		const target = seen.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(seen.length);
		this.setLens(fov);
		this.camera.position.copy(target).add(away);
		this.camera.lookAt(target);
		const turn = this.camera.quaternion, half = Math.tan((this.camera.fov * Math.PI) / 360);
		for (let round = 0; round < 4; ++round) {
			const local = seen.map((p) => p.clone().sub(target).applyQuaternion(turn.clone().invert()));
			target.add(this.centre(local, half).applyQuaternion(turn));
		}
		const local = seen.map((p) => p.clone().sub(target).applyQuaternion(turn.clone().invert()));
		this.orbit.target.copy(target);
		const distance = this.margin() * this.distance(local, half);
		this.camera.position.copy(target).addScaledVector(away, distance);
		this.setLens(fov, distance / 100);
		this.orbit.update();
		this.redraw();
	}

	/** Field of view [deg], and what is so near that it is not drawn. */
	setLens(fov: number, near = 0.1): void {
		this.camera.fov = fov;
		this.camera.near = near;
		this.camera.updateProjectionMatrix();
	}

	/** Room for labels beside what is shown. */
	private margin(): number {
		return 1.03 + 90 / Math.max(200, this.holder.clientWidth);
	}

	/** Distance from which points, as the camera sees them from the target, are just inside. */
	private distance(local: Vector3[], half: number): number {
		const { aspect } = this.camera;
		return Math.max(...local.map((p) => p.z + Math.max(Math.abs(p.x) / (half * aspect), Math.abs(p.y) / half)), 1);
	}

	/** How far the target is to move in the camera's plane for the picture to be centred. */
	private centre(local: Vector3[], half: number): Vector3 {
		const d = this.distance(local, half), middle = (values: number[]) => (Math.min(...values) + Math.max(...values)) / 2;
		return new Vector3(middle(local.map((p) => (p.x * d) / (d - p.z))), middle(local.map((p) => (p.y * d) / (d - p.z))), 0);
	}
}
