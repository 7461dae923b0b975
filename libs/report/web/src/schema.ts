// What libs/report (C++, run_report_json.cpp) writes and the page reads. The two change together: `schema` is
// raised whenever a reader of the older form would be wrong.
//
// Everything is SI and radians unless the name says otherwise (_deg, _ms, _px). Positions are north, east, down
// [m] in `map`; angles are roll, pitch, yaw [rad]. Times are seconds since the run's first stamp `start_stamp`.
// Lists of rows are columns of equal length. A number that is not there is null.

export type Column = (number | null)[];

/** A trajectory T_map_body. */
export interface Trajectory {
	/** truth | odometry | ekf | slam (handed out, causal) | nodes (final) | control (what a closed loop steered by) */
	name: string;
	label: string;              // "Ground truth", "Odometry", "SLAM, causal", "SLAM, final nodes", ...
	t: Column; n: Column; e: Column; d: Column;
	roll: Column; pitch: Column; yaw: Column;
}

/** 3D error, unaligned, of a trajectory. */
export interface ErrorCurve {
	name: string;               // as Trajectory.name
	label: string;
	t: Column;
	distance: Column;           // travelled along the truth [m]
	error: Column;              // [m]
}

/** The nodes' errors against what the graph claims; only where truth and marginals are known. */
export interface Consistency {
	node: Column;
	t: Column;
	error_n: Column; error_e: Column; error_d: Column;     // [m]
	sigma_n: Column; sigma_e: Column; sigma_d: Column;     // [m], 1 sigma
	nees: Column;               // of the position, 3 degrees of freedom, not divided
	anees: number | null;       // mean of nees / 3
}

/** Candidate pairs that were tried: a row each, accepted or not. Edges of the graph are the accepted ones. */
export interface Loops {
	from: number[]; to: number[];           // node numbers, from < to in time
	kind: string[];                         // "sequential" | "roi" | "appearance"
	status: string[];                       // "accepted" | "accepted on retry" | "too few matches" | ...
	matches: Column; inliers: Column; rmse_px: Column;
	residual_m: Column; residual_deg: Column;   // measurement against the final poses; null when not measured
	chi2: Column;                           // its part of the graph's chi2; null when not accepted
	weight: Column;                         // what the robust loss left of it, 0..1; below 0.5 it is drawn apart
	error_m: Column;                        // against the truth, where known
	/** Inlier matches, thinned, as bytes in base64, four a match: u_from, v_from, u_to, v_to, scaled to 0 ... 255
	 *  over width and height of the picture; null where not stored. */
	points: (string | null)[];
}

/** A node's picture, embedded once, small. */
export interface KeyFrame {
	node: number;
	jpeg: string | null;        // base64 of a JPEG about 320 px wide; null: left out for size
	file: string | null;        // relative link to the full-size left picture, "loops/000123.jpg"; null: not written
}

export interface Camera {
	width: number; height: number;          // [px]
	fx: number; fy: number; cx: number; cy: number;
	T_body_camera: number[];    // 16 numbers, row-major; camera is right-down-forward (z looks along the axis)
}

/** Sea floor under the replay: a picture lying level. Row 0 is the northern edge, column 0 the western one. */
export interface Floor {
	source: string;             // "mosaic of 360 key frames" | "texture of the simulated world"
	image: string;              // data: of any type the browser knows, transparent where nothing was seen
	north_max: number; north_min: number; east_min: number; east_max: number;
	depth: number;              // [m], of the level that it is drawn on
}

/** A picture of curves against time or against each other, for uPlot. */
export interface Plot {
	title: string;
	x: { label: string; values: Column };
	y_label: string;
	series: { label: string; values: Column; dash?: number[]; role?: string }[];   // role: truth|odometry|slam|... for the colour
	note?: string;
}

export interface Report {
	schema: 1;
	title: string;              // "paper-exp2-closed"
	app: string;                // "auv-mission"
	app_versions: string;       // text of --version
	start_utc: string;          // ISO 8601 of the first stamp
	start_stamp: number;        // UTC [s]
	duration: number;           // [s]
	interrupted: boolean;       // Ctrl-C: the run folder is whole but the run is not
	notes: string[];            // what was thinned or left out, and why; shown to the reader
	/** The few numbers that the reader looks for first. */
	headline: { label: string; value: string; hint?: string }[];
	metrics: { what: string; value: number | null; unit: string }[];
	paper_table: { title: string; header: string[]; rows: string[][]; note?: string } | null;
	trajectories: Trajectory[];
	errors: ErrorCurve[];
	/** Depth altitude at each node: metres from the camera to the floor (median of its points); for footprints. */
	nodes: { altitude: Column; points: Column };   // index = node; poses are the trajectory "nodes"; t as there
	consistency: Consistency | null;
	camera: Camera | null;
	floor: Floor | null;
	loops: Loops;
	/** Pairs never tried, and the refused, by kind and reason. */
	refused: { kind: string; status: string; count: number }[];
	key_frames: KeyFrame[];
	timings: { group: string; stage: string; calls: number; mean_ms: number; max_ms: number; total_s: number }[];
	sensors: { name: string; used: number; rate_hz: number | null; longest_gap_s: number | null; rejected: { [reason: string]: number } }[];
	events: { t: number; kind: string; text: string }[];     // of a mission; else empty
	plots: Plot[];              // control: cross-track error, commands, ...; may be empty
	config: string;             // ini text as used
	mission: string | null;     // mission ini text
	log: string;                // run.log
}
