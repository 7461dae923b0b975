// The replay: the run over time in 3D, or from above where there is no WebGL.

import { Track } from '../columns';
import { h } from '../dom';
import type { Report } from '../schema';
import { Controls } from './controls';
import { printedReplay } from './paper';
import { Readout } from './readout';
import { Stage } from './stage';
import { Timeline } from './timeline';
import { Views } from './views';
import { moverOf, World } from './world';

/** How others move the replay. */
export interface Replay { seek(time: number): void; element: HTMLElement }

/** The canvas needs its size: `parent` is in the page. Null where there is no WebGL. */
export function startReplay(parent: HTMLElement, report: Report, tracks: Track[]): Replay | null {
	const viewport = h('div', {
		class: 'viewport', id: 'replay-view', tabindex: 0, role: 'application', 'aria-describedby': 'replay-hint',
		'aria-label': 'Replay in three dimensions. Space plays, arrow keys move in time.',
	});
	parent.append(viewport);
	let stage: Stage;
	try {
		stage = new Stage(viewport);
	} catch {
		viewport.remove();
		return null;
	}
	return wire(parent, viewport, stage, report, tracks);
}

function timelineOf(report: Report, tracks: Track[]): Timeline {
	const { t } = moverOf(tracks);
	return new Timeline(Math.min(0, t[0]), Math.max(report.duration, t[t.length - 1]));
}

function wire(parent: HTMLElement, viewport: HTMLElement, stage: Stage, report: Report, tracks: Track[]): Replay {
	const world = new World(stage, report, tracks), timeline = timelineOf(report, tracks);
	const views = new Views(stage, world.outline, Math.max(9, world.span / 3)), readout = new Readout(report, world);
	const controls = new Controls(timeline, views, stage, world);
	viewport.append(world.labels.element, readout.picture);
	viewport.after(printedReplay(stage, world.labels));
	parent.append(controls.bar, readout.values, controls.layers, controls.help, h('p', { class: 'hint', id: 'replay-hint' },
		'Drag turns, right drag or two fingers move, wheel or pinch zooms. With the picture in focus: space plays, arrow keys step, Home and End jump; ? lists all keys.'));
	const update = () => {
		const pose = world.show(timeline.time);
		views.moveTo(pose);
		readout.show(timeline.time, pose);
	};
	timeline.onChange(update);
	viewport.addEventListener('keydown', (event) => {
		if (controls.key(event)) event.preventDefault();
	});
	update();
	views.show('overview');
	stage.draw();
	return { seek: (time) => timeline.seek(time), element: viewport };
}
