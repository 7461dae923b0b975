// Loop candidates of the made-up survey, with matches that fit its pictures.

import { CAMERA, project, random } from './sample_run.mjs';

const REASONS = ['too few matches', 'too few inliers', 'RANSAC failed', 'refinement failed', 'inliers clustered', 'gate', 'over budget'];

/** Pairs of nodes within 3 m, nearest in time first; thinned to `count`. */
function pairs(truth, count, rng) {
	const found = [];
	for (let to = 1; to < truth.length; ++to) {
		for (let from = Math.max(0, to - 4); from < to; ++from) found.push({ from, to, kind: 'sequential' });
		for (let from = 0; from < to - 12; ++from) {
			if (Math.hypot(truth[from].n - truth[to].n, truth[from].e - truth[to].e) < 3) {
				found.push({ from, to, kind: rng.uniform() < 0.04 ? 'appearance' : 'roi' });
			}
		}
	}
	while (found.length < count) found.push(found[Math.floor(rng.uniform() * found.length)]);
	const keep = count / found.length;
	return found.filter(() => rng.uniform() < keep).slice(0, count);
}

function matches(a, b, wanted, rng) {
	const points = [];
	for (let tries = 0; tries < 40 * wanted && points.length < 4 * wanted; ++tries) {
		const n = (a.n + b.n) / 2 + 4 * (rng.uniform() - 0.5), e = (a.e + b.e) / 2 + 4 * (rng.uniform() - 0.5);
		const pixels = [...project(a, n, e), ...project(b, n, e)].map(Math.round);
		const inside = (u, v) => u >= 0 && v >= 0 && u < CAMERA.width && v < CAMERA.height;
		if (inside(pixels[0], pixels[1]) && inside(pixels[2], pixels[3])) points.push(...pixels);
	}
	const scaled = points.map((p, i) => Math.round((255 * p) / (i % 2 === 0 ? CAMERA.width : CAMERA.height)));
	return points.length >= 20 ? Buffer.from(scaled).toString('base64') : null;
}

function candidate(pair, truth, rng) {
	const a = truth[pair.from], b = truth[pair.to], far = Math.hypot(a.n - b.n, a.e - b.e) / 3;
	const refused = rng.uniform() < (pair.kind === 'sequential' ? 0.004 : 0.06 + 0.25 * far);
	const down = !refused && pair.kind !== 'sequential' && rng.uniform() < 0.02;
	const inliers = Math.max(0, Math.round((refused ? 9 : 230) * (1 - 0.7 * far) + 15 * rng.normal()));
	const status = refused ? REASONS[Math.floor(rng.uniform() ** 2 * REASONS.length)] : rng.uniform() < 0.01 ? 'accepted on retry' : 'accepted';
	const tried = status !== 'over budget', size = down ? 0.12 : 0.004;
	return {
		status, matches: tried ? Math.round(inliers * 1.25 + 12) : null, inliers: tried ? inliers : null,
		rmse_px: tried ? round(0.16 + 0.04 * Math.abs(rng.normal())) : null,
		residual_m: refused ? null : round(size * Math.abs(rng.normal())), residual_deg: refused ? null : round(0.05 * Math.abs(rng.normal())),
		chi2: refused ? null : round((down ? 60 : 6) * rng.uniform()), weight: refused ? null : round(down ? 0.4 * rng.uniform() : 1 - 0.4 * rng.uniform()),
		error_m: refused ? null : round(size * Math.abs(rng.normal())),
		points: refused && inliers < 8 ? null : matches(a, b, Math.min(60, Math.max(8, inliers)), rng),
	};
}

const round = (value) => Number(value.toFixed(5));

export function makeLoops(truth, count, pointsOf) {
	const rng = random(7), names = ['from', 'to', 'kind', 'status', 'matches', 'inliers', 'rmse_px', 'residual_m', 'residual_deg', 'chi2', 'weight', 'error_m', 'points'];
	const loops = Object.fromEntries(names.map((name) => [name, []]));
	pairs(truth, count, rng).forEach((pair, i) => {
		const row = { ...pair, ...candidate(pair, truth, rng) };
		if (i >= pointsOf) row.points = null;
		for (const name of names) loops[name].push(row[name]);
	});
	return loops;
}

export function refusedOf(loops) {
	const counts = new Map();
	loops.status.forEach((status, i) => {
		if (status.startsWith('accepted')) return;
		const key = `${loops.kind[i]}|${status}`;
		counts.set(key, (counts.get(key) ?? 0) + 1);
	});
	return [...counts].map(([key, count]) => ({ kind: key.split('|')[0], status: key.split('|')[1], count }));
}
