// The numbers of a made-up lawn-mower survey: where the vehicle is, how odometry drifts, which pairs match.

/** The same numbers every time. */
export function random(seed) {
	let a = seed >>> 0;
	const uniform = () => {
		a = (a + 0x6d2b79f5) >>> 0;
		let t = Math.imul(a ^ (a >>> 15), 1 | a);
		t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
		return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
	};
	const normal = () => Math.sqrt(-2 * Math.log(uniform() + 1e-12)) * Math.cos(2 * Math.PI * uniform());
	return { uniform, normal };
}

export const CAMERA = {
	width: 640, height: 480, fx: 500, fy: 500, cx: 319.5, cy: 239.5,
	// Looks straight down, top of the picture forwards: right = starboard, down = aft.
	T_body_camera: [0, -1, 0, 0.6, 1, 0, 0, 0, 0, 0, 1, 0.1, 0, 0, 0, 1],
};

export const SPEED = 0.3, DEPTH = 3.5, FLOOR = 6.0, SPACING = 0.5;

/** Corners of legs east and back, then a transect across them all. */
function corners(size) {
	const made = [], legs = 8, gap = size / (legs - 1);
	for (let leg = 0; leg < legs; ++leg) {
		const ends = leg % 2 === 0 ? [0, size] : [size, 0];
		made.push([leg * gap, ends[0]], [leg * gap, ends[1]]);
	}
	made.push([size, 0.3 * size], [0, 0.3 * size], [0, 0.7 * size], [size, 0.7 * size]);
	return made;
}

/** One pose each SPACING along the corners. */
export function truePath(count) {
	const points = corners(1), lengths = points.slice(1).map((p, i) => Math.hypot(p[0] - points[i][0], p[1] - points[i][1]));
	const size = ((count - 1) * SPACING) / lengths.reduce((a, b) => a + b, 0), poses = [];
	let leg = 0, from = 0;
	for (let i = 0; i < count; ++i) {
		const s = (i * SPACING) / size;
		while (leg < lengths.length - 1 && s > from + lengths[leg]) from += lengths[leg++];
		const k = Math.min(1, (s - from) / lengths[leg]), [a, b] = [points[leg], points[leg + 1]];
		const yaw = Math.atan2(b[1] - a[1], b[0] - a[0]), d = DEPTH + 0.02 * Math.sin(0.2 * i);
		poses.push({
			t: (i * SPACING) / SPEED, n: size * (a[0] + k * (b[0] - a[0])), e: size * (a[1] + k * (b[1] - a[1])), d,
			roll: 0.02 * Math.sin(0.7 * i), pitch: 0.015 * Math.sin(0.45 * i + 1), yaw,
		});
	}
	return poses;
}

/** Truth with an error that grows to `worst` [m] (odometry) or stays about `noise` (SLAM). */
export function estimate(truth, worst, noise, seed) {
	const { normal } = random(seed), last = truth.length - 1;
	const walk = { n: 0, e: 0 }, wobble = { n: 0, e: 0, d: 0 };
	return truth.map((pose, i) => {
		for (const key of ['n', 'e']) walk[key] += 0.012 * worst * normal();
		for (const key of ['n', 'e', 'd']) wobble[key] = 0.92 * wobble[key] + 0.39 * noise * normal();
		const s = i / last;
		return {
			...pose, n: pose.n + worst * 0.65 * s + walk.n + wobble.n, e: pose.e - worst * 0.45 * s + walk.e + wobble.e,
			d: pose.d + 0.4 * wobble.d, yaw: pose.yaw + 0.02 * worst * s,
		};
	});
}

export function columns(name, label, poses) {
	const column = (key) => poses.map((pose) => Number(pose[key].toFixed(5)));
	return { name, label, t: column('t'), n: column('n'), e: column('e'), d: column('d'), roll: column('roll'), pitch: column('pitch'), yaw: column('yaw') };
}

/** Pixel of a point on the floor in the camera of a pose (roll and pitch left out). */
export function project(pose, n, e) {
	const c = Math.cos(pose.yaw), s = Math.sin(pose.yaw), dn = n - pose.n, de = e - pose.e;
	const x = c * dn + s * de - 0.6, y = -s * dn + c * de, z = FLOOR - pose.d - 0.1;
	return [CAMERA.cx + (CAMERA.fx * y) / z, CAMERA.cy - (CAMERA.fy * x) / z];
}
