// A made-up sea floor and what the camera sees of it, drawn in the browser.

import { launch } from './browser.mjs';
import { CAMERA, FLOOR } from './sample_run.mjs';

/** Runs in the browser: draws the floor, then a picture for each pose. */
function draw({ camera, floorDepth, box, poses }) {
	const size = 2400, scale = size / Math.max(box.north_max - box.north_min, box.east_max - box.east_min);
	const floor = Object.assign(document.createElement('canvas'), {
		width: Math.round(scale * (box.east_max - box.east_min)), height: Math.round(scale * (box.north_max - box.north_min)),
	});
	const g = floor.getContext('2d');
	let state = 12345;
	const rnd = () => { state = (Math.imul(state, 1103515245) + 12345) & 0x7fffffff; return state / 0x7fffffff; };
	g.fillStyle = '#4d6a5e';
	g.fillRect(0, 0, floor.width, floor.height);
	for (let i = 0; i < 26000; ++i) {
		const big = i < 900, r = big ? 20 + 70 * rnd() : 1 + 9 * rnd() * rnd(), light = 55 + 95 * rnd();
		g.globalAlpha = big ? 0.16 : 0.75;
		g.fillStyle = `rgb(${light * 0.85 | 0},${light * 1.02 | 0},${light * (0.75 + 0.3 * rnd()) | 0})`;
		g.beginPath();
		g.ellipse(floor.width * rnd(), floor.height * rnd(), r, r * (0.4 + 0.6 * rnd()), 3 * rnd(), 0, 7);
		g.fill();
	}
	g.globalAlpha = 1;
	const eye = Object.assign(document.createElement('canvas'), { width: 320, height: 240 }), k = eye.getContext('2d');
	const jpeg = (canvas, quality) => canvas.toDataURL('image/jpeg', quality);
	const pictures = poses.map((pose) => {
		const z = floorDepth - pose.d - 0.1, perMetre = camera.fx / z * (320 / camera.width);
		k.setTransform(1, 0, 0, 1, camera.cx / 2, camera.cy / 2);
		k.translate(0, perMetre * 0.6);
		k.rotate(-pose.yaw);
		k.scale(perMetre / scale, perMetre / scale);
		k.drawImage(floor, -(pose.e - box.east_min) * scale, -(box.north_max - pose.n) * scale);
		return jpeg(eye, 0.6).split(',')[1];
	});
	const small = Object.assign(document.createElement('canvas'), { width: 1200, height: Math.round(1200 * floor.height / floor.width) });
	small.getContext('2d').drawImage(floor, 0, 0, small.width, small.height);
	return { pictures, floor: jpeg(small, 0.7) };
}

/** JPEG of each pose in base64, and the floor as a data URL with its edges. */
export async function makePictures(truth, count) {
	const n = truth.map((pose) => pose.n), e = truth.map((pose) => pose.e);
	const box = { north_max: Math.max(...n) + 3, north_min: Math.min(...n) - 3, east_min: Math.min(...e) - 3, east_max: Math.max(...e) + 3 };
	const browser = await launch();
	try {
		const page = await browser.newPage();
		const made = await page.evaluate(draw, { camera: CAMERA, floorDepth: FLOOR, box, poses: truth.slice(0, count) });
		return { pictures: made.pictures, floor: { source: 'texture of the simulated world', image: made.floor, ...box, depth: FLOOR } };
	} finally {
		await browser.close();
	}
}
