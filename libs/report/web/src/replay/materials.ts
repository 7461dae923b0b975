// Materials of the replay. A browser compiles a shader for each combination of settings, and that is most of the
// time until the first picture: what can share one has the same settings here.

import { DoubleSide, LineBasicMaterial, LineDashedMaterial, MeshBasicMaterial, type Texture } from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';

const COMMON = { transparent: true, side: DoubleSide, forceSinglePass: true };

/** Order of drawing, from what lies lowest. */
export const ORDER = { floor: 0, grid: 1, edges: 2, truth: 3, path: 4, slam: 5, vehicle: 6 };

/** A picture is drawn behind whatever lies on it. */
export function face(opacity = 1, map?: Texture): MeshBasicMaterial {
	if (!map) return new MeshBasicMaterial({ ...COMMON, opacity, depthWrite: opacity === 1 });
	return new MeshBasicMaterial({ ...COMMON, map, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 });
}

export function thin(opacity = 1): LineBasicMaterial {
	return new LineBasicMaterial({ ...COMMON, opacity, depthWrite: false });
}

export function thinDashed(opacity: number, dashSize: number, gapSize: number): LineDashedMaterial {
	return new LineDashedMaterial({ ...COMMON, opacity, dashSize, gapSize, depthWrite: false });
}

/** Width in pixels; solid is dashed without gaps. */
export function broad(linewidth: number, opacity: number, dashSize: number, gapSize: number): LineMaterial {
	return new LineMaterial({ transparent: true, depthWrite: false, linewidth, opacity, dashed: true, dashSize, gapSize });
}
