// What a row of the loops is.

import type { Loops } from '../schema';

/** "accepted", "accepted on retry", ... */
export function isAccepted(loops: Loops, row: number): boolean {
	return loops.status[row].startsWith('accepted');
}

/** In the graph, but the robust loss left less than half of it. */
export function isTurnedDown(loops: Loops, row: number): boolean {
	const weight = loops.weight[row];
	return isAccepted(loops, row) && weight !== null && weight < 0.5;
}

export function matchCount(loops: Loops, row: number): number {
	const points = loops.points[row];
	return points ? Math.floor(points.length / 4) : 0;
}

/** "sequential", "roi", ...: those that occur, in order of their first row. */
export function distinct(values: string[]): string[] {
	return [...new Set(values)];
}
