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
	return Math.floor(matchBytes(loops, row).length / 4);
}

function matchBytes(loops: Loops, row: number): string {
	return atob(loops.points[row] ?? '');
}

/** [u_from, v_from, u_to, v_to, ...] in pixels of a picture of that size; null where none are stored. */
export function matchPoints(loops: Loops, row: number, size: { width: number; height: number }): number[] | null {
	if (loops.points[row] === null) return null;
	return Array.from(matchBytes(loops, row), (c, i) => (c.charCodeAt(0) / 255) * (i % 2 === 0 ? size.width : size.height));
}

/** "sequential", "roi", ...: those that occur, in order of their first row. */
export function distinct(values: string[]): string[] {
	return [...new Set(values)];
}
