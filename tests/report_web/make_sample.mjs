// Writes a report of a made-up lawn-mower survey, as JSON and as a page.
//   node make_sample.mjs OUT.html [NODES=360] [LOOPS=3000] [KEY_FRAMES=300] [DENSE=NODES]

import { readFileSync, writeFileSync } from 'node:fs';
import { WEB } from './browser.mjs';
import { makeLoops, refusedOf } from './sample_loops.mjs';
import { makePictures } from './sample_pictures.mjs';
import { CAMERA, columns, estimate, FLOOR, random, truePath } from './sample_run.mjs';

const [out, nodes = '360', loopCount = '3000', frames = '300', dense = nodes] = process.argv.slice(2);

const round = (value) => Number(value.toFixed(5));

function errorCurve(name, label, truth, poses) {
	let distance = 0;
	const error = poses.map((p, i) => round(Math.hypot(p.n - truth[i].n, p.e - truth[i].e, p.d - truth[i].d)));
	const travelled = truth.map((p, i) => round(distance += i ? Math.hypot(p.n - truth[i - 1].n, p.e - truth[i - 1].e) : 0));
	return { name, label, t: poses.map((p) => p.t), distance: travelled, error };
}

function consistency(truth, slam) {
	const { uniform } = random(3), sigma = truth.map(() => round(0.0022 + 0.0004 * uniform()));
	const error = (key) => slam.map((p, i) => round(p[key] - truth[i][key]));
	const [n, e, d] = ['n', 'e', 'd'].map(error), sigmaDown = sigma.map((s) => round(0.5 * s));
	const nees = n.map((_, i) => round((n[i] / sigma[i]) ** 2 + (e[i] / sigma[i]) ** 2 + (d[i] / sigmaDown[i]) ** 2));
	return {
		node: truth.map((_, i) => i), t: truth.map((p) => p.t), error_n: n, error_e: e, error_d: d,
		sigma_n: sigma, sigma_e: sigma, sigma_d: sigmaDown, nees, anees: round(nees.reduce((a, b) => a + b, 0) / nees.length / 3),
	};
}

/** As of a closed loop: cross-track error and depth, and one picture of a quantity against another. */
function plots(truth) {
	const { normal } = random(9), t = [], cross = [], wanted = [], depth = [], surge = [], yawRate = [];
	for (let i = 0; i < 2000; ++i) {
		t.push(round((i * truth[truth.length - 1].t) / 1999));
		cross.push(round(0.08 * Math.exp(-((i % 180) / 25)) + 0.004 * normal()));
		wanted.push(3.5);
		depth.push(round(3.5 + 0.01 * Math.sin(i / 30) + 0.002 * normal()));
		surge.push(round(0.3 + 0.01 * normal() - (i % 180 < 12 ? 0.15 : 0)));
		yawRate.push(round((i % 180 < 12 ? 0.2 : 0) + 0.01 * normal()));
	}
	return [
		{ title: 'Cross-track error', x: { label: 'Time [s]', values: t }, y_label: 'Error [m]', series: [{ label: 'True cross-track error', values: cross }] },
		{ title: 'Depth', x: { label: 'Time [s]', values: t }, y_label: 'Depth [m]', series: [{ label: 'Wanted', values: wanted, role: 'limit' }, { label: 'True', values: depth }] },
		{ title: 'Surge against yaw rate', x: { label: 'Yaw rate [rad/s]', values: yawRate }, y_label: 'Surge [m/s]', series: [{ label: 'Commands', values: surge }], note: 'It slows down where it turns.' },
	];
}

function events(truth) {
	const made = [{ t: 0, kind: 'step started', text: 'Step.1 dive' }, { t: 19.3, kind: 'step reached', text: 'Step.1 dive' }];
	for (let i = 1; i <= 19; ++i) made.push({ t: 19.3 + (i * (truth[truth.length - 1].t - 25)) / 19, kind: i < 19 ? 'step reached' : 'mission done', text: `Step.2 route ${i}/19` });
	return made;
}

const TIMINGS = [
	['SLAM', 'key_frame', 360, 56.8718, 109.908, 20.474], ['SLAM', 'register_candidates', 720, 20.2505, 112.315, 14.58], ['SLAM', 'optimize', 359, 3.9462, 37.036, 1.417],
	['SLAM', 'predict_for_gate', 1063, 0.6834, 5.548, 0.726], ['SLAM', 'odometry', 63976, 0.0084, 0.11, 0.539], ['SLAM', 'make_exact', 1, 24.0732, 24.073, 0.024],
	['Closed loop', 'rendering', 360, 16.3048, 25.588, 5.87], ['Closed loop', 'vehicle and sensors', 66002, 0.0077, 0.374, 0.511], ['Closed loop', 'control', 7953, 0.0243, 0.594, 0.193],
];

const SENSORS = [
	['IMU', 39760, 50, 0.02, {}], ['AHRS', 15891, 20, 0.1, { gated: 13 }], ['DVL', 3963, 5, 0.4, { gated: 7, 'inconsistent beams': 6 }],
	['Pressure', 3969, 5, 0.4, { gated: 7 }], ['Stereo', 360, 0.45, 12.33, {}], ['GPS', 0, null, null, {}],
];

function config() {
	const sections = { Odometry: ['source = ekf', 'process_noise = 0.002'], 'Loop search': ['radius = 3.0', 'max_candidates = 12'], Registration: ['max_rmse_px = 1.0', 'min_inliers = 20'], Optimiser: ['loss = huber', 'delta = 1.345'] };
	return Object.entries(sections).map(([name, lines]) => `[${name}]\n${lines.map((line) => `// Meaning of the option (default as here)\n${line}`).join('\n')}\n`).join('\n');
}

function metrics(loops) {
	const rows = [['graph.nodes', Number(nodes), ''], ['graph.chi2', 7177.72463, ''], ['graph.chi2_dijkstra', 5116529, ''], ['mission.path_length', 184.361712, 'm'], ['mission.cross_track.mean', 0.0104863623, 'm'], ['mission.cross_track.max', 0.0806755949, 'm'], ['nodes.error.mean', 0.0035, 'm'], ['nodes.error.max', 0.0091, 'm'], ['odometry.error.mean', 1.5525, 'm'], ['odometry.error.max', 3.1, 'm'], ['loops.accepted', loops.status.filter((s) => s.startsWith('accepted')).length, ''], ['loops.false', 0, ''], ['loops.recall', null, ''], ['loops.rotation_error.median', 0.0306712556, 'deg']];
	return rows.map(([what, value, unit]) => ({ what, value, unit }));
}

/** Index of the coarse path's rows in a dense one: straight lines between nodes. */
function densified(poses, count) {
	return Array.from({ length: count }, (_, k) => {
		const s = (k * (poses.length - 1)) / (count - 1), i = Math.min(poses.length - 2, Math.floor(s)), f = s - i, mixed = {};
		for (const key of Object.keys(poses[0])) mixed[key] = key === 'yaw' ? poses[i].yaw : poses[i][key] + f * (poses[i + 1][key] - poses[i][key]);
		return mixed;
	});
}

async function report() {
	const truth = truePath(Number(nodes)), odometry = estimate(truth, 3, 0, 1), slam = estimate(truth, 0, 0.003, 2), final = estimate(truth, 0, 0.0022, 4);
	const loops = makeLoops(truth, Number(loopCount), 20000), { pictures, floor } = await makePictures(truth, Number(frames));
	const fine = (poses) => densified(poses, Number(dense));
	return {
		schema: 1, title: 'paper-exp2-closed', app: 'auv-mission', app_versions: 'Posidonia 0.1.0: stereo graph-SLAM for AUVs, on MRPT\nMRPT 2.14.9, Eigen 3.4.0, OpenCV 4.6.0',
		start_utc: '2015-01-01T00:00:00Z', start_stamp: 1420070400, duration: truth[truth.length - 1].t + 12, interrupted: false,
		notes: ['Matches are thinned to 60 per pair; the inliers of all pairs are in loops.csv.', `Pictures of ${frames} of ${nodes} key frames are embedded.`],
		headline: [
			{ label: 'SLAM, mean 3D error', value: '0.004 m', hint: 'odometry: 1.55 m' }, { label: 'Path', value: '179.5 m', hint: `${nodes} nodes` },
			{ label: 'Loop closings', value: '2 104', hint: '0 false' }, { label: 'Cross-track error', value: '0.010 m', hint: 'worst 0.081 m' },
			{ label: 'Speed', value: '17\u00d7', hint: 'of real time' },
		],
		metrics: metrics(loops),
		paper_table: {
			title: 'Experiment 2', header: ['', 'Trajectory', 'Path length [m]', 'Mean 3D error [m]'],
			rows: [['paper', 'Odometry', '183.14', '1.61'], ['paper', 'SLAM', '182.71', '0.40'], ['paper', 'Ground truth', '182.65', '\u2013'], ['ours', 'Odometry', '180.38', '1.553'], ['ours', 'Posidonia, nodes', '180.50', '0.002'], ['ours', 'Posidonia, causal', '180.50', '0.002'], ['ours', 'Ground truth', '180.52', '\u2013']],
			note: 'Errors are not aligned.',
		},
		trajectories: [columns('truth', 'Ground truth', fine(truth)), columns('odometry', 'Odometry', fine(odometry)), columns('slam', 'SLAM, causal', slam), columns('nodes', 'SLAM, final nodes', final)],
		errors: [errorCurve('odometry', 'Odometry', truth, odometry), errorCurve('slam', 'SLAM, causal', truth, slam), errorCurve('nodes', 'SLAM, final nodes', truth, final)],
		nodes: { altitude: truth.map((p) => round(FLOOR - p.d - 0.1)), points: truth.map(() => 800) },
		consistency: consistency(truth, final), camera: CAMERA, floor, loops, refused: refusedOf(loops),
		key_frames: truth.map((_, node) => ({ node, jpeg: pictures[node] ?? null, file: node % 2 ? null : `loops/${String(node).padStart(6, '0')}.jpg` })),
		timings: TIMINGS.map(([group, stage, calls, mean_ms, max_ms, total_s]) => ({ group, stage, calls, mean_ms, max_ms, total_s })),
		sensors: SENSORS.map(([name, used, rate_hz, longest_gap_s, rejected]) => ({ name, used, rate_hz, longest_gap_s, rejected })),
		events: events(truth), plots: plots(truth), config: config(), mission: '[Mission]\nspeed = 0.3\n\n[Step.1]\nkind = dive\ndepth = 3.5\n',
		log: 'paper: Odometry                         183.14           1.61\nours:  Odometry                         180.38          1.553\n</script><!-- text of a log is text -->\n',
	};
}

/** As the C++ writer does: "<" cannot end the script that the JSON is in. */
function page(made) {
	const template = readFileSync(`${WEB}dist/report-template.html`, 'utf8');
	const json = JSON.stringify(made).replace(/</g, '\\u003c');
	return template.replace('__TITLE__', () => made.title).replace('__RUN_JSON__', () => json);
}

const html = page(await report());
writeFileSync(out, html);
console.log(`${out}: ${(html.length / 1e6).toFixed(1)} MB`);
