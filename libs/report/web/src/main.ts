// Reads the report from the page and lays it out. Nothing is loaded from anywhere.

import { pick, Track } from './columns';
import { h } from './dom';
import { loopSection } from './loops/list';
import { contents, failure, header, section, type Section } from './page';
import { consistencyPlots, givenPlots } from './plots/further';
import { errorPlots, topViews } from './plots/paper';
import { startReplay, type Replay } from './replay/replay';
import type { Report } from './schema';
import { eventTable, metricSection, paperTable, refusedTable, sensorTable, timingTables } from './tables';
import { textBlock } from './texts';
import { startTheme } from './theme';

/** Of three.js and uPlot; put in by build.mjs. */
declare const __LICENSES__: string;

function read(): Report | string {
	const text = document.getElementById('run')?.textContent ?? '';
	try {
		const report = JSON.parse(text) as Report;
		return report.schema === 1 ? report : `This page reads reports of schema 1, not ${String(report.schema)}.`;
	} catch {
		return 'There is no run in this page: it is the template that reports are made from.';
	}
}

function grid(makers: (() => HTMLElement)[]): HTMLElement | null {
	return makers.length > 0 ? h('div', { class: 'figures' }, ...makers.map((make) => make())) : null;
}

function beside(...blocks: (HTMLElement | null)[]): HTMLElement | null {
	const there = blocks.filter((block): block is HTMLElement => block !== null);
	return there.length > 0 ? h('div', { class: 'tables' }, ...there) : null;
}

/** A section, or nothing where there is nothing to show. */
function maybe(id: string, title: string, ...children: (Node | null)[]): Section | null {
	return children.some((child) => child !== null) ? section(id, title, ...children) : null;
}

function replaySection(tracks: Track[]): Section | null {
	return tracks.some((track) => track.size > 0) ? section('replay', 'Replay') : null;
}

/** What is under the replay, in order; made after its first picture. */
function laterSections(report: Report, tracks: Track[], replay: () => Replay | null): Section[] {
	const seek = (time: number) => {
		replay()?.element.scrollIntoView({ block: 'center' });
		replay()?.seek(time);
	};
	const nodes = pick(tracks, 'nodes'), timings = timingTables(report);
	const toNode = nodes ? (node: number) => seek(nodes.t[Math.min(node, nodes.size - 1)]) : null;
	const made = [
		maybe('trajectories', 'Trajectories', grid([...topViews(report, tracks), ...errorPlots(report)])),
		maybe('consistency', 'Consistency', grid(consistencyPlots(report))),
		maybe('plots', 'Further plots', grid(givenPlots(report))),
		maybe('results', 'Results', beside(paperTable(report), metricSection(report))),
		report.loops.from.length > 0 ? section('loops', 'Loop candidates', loopSection(report, toNode)) : null,
		maybe('refused', 'Refused candidates', refusedTable(report)),
		maybe('timings', 'Timings', beside(...timings)),
		maybe('sensors', 'Sensors', sensorTable(report)),
		maybe('events', 'Events', eventTable(report, seek)),
		section('texts', 'Configuration', ...texts(report)),
	];
	return made.filter((one): one is Section => one !== null);
}

function texts(report: Report): HTMLElement[] {
	const blocks: [string, string | null, boolean][] = [
		['Configuration as used', report.config, true], ['Mission', report.mission, true], ['Log', report.log, false],
		['Versions', report.app_versions, false], ['Licences of what draws this page', __LICENSES__, false],
	];
	return blocks.filter(([, text]) => text).map(([title, text, ini]) => textBlock(title, text as string, ini));
}

/** Said, and shown from above instead. */
function withoutWebGl(report: Report, tracks: Track[]): HTMLElement[] {
	const said = h('p', { class: 'banner', role: 'note' }, 'This browser offers no WebGL: instead of the replay in three dimensions, the run from above.');
	const views = topViews(report, tracks);
	return views.length > 0 ? [said, views[views.length - 1]()] : [said];
}

/** Resolves when the browser has shown what is there. */
function painted(): Promise<void> {
	return new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
}

async function start(): Promise<void> {
	startTheme();
	const report = read();
	const root = document.getElementById('root')!;
	if (typeof report === 'string') {
		root.append(failure(report));
		performance.mark('complete');
		return;
	}
	document.title = report.title;
	const tracks = report.trajectories.map((source) => new Track(source));
	let replay: Replay | null = null;
	const first = replaySection(tracks), main = h('main', { id: 'main', tabindex: -1 });
	root.append(header(report), main);
	await painted();
	if (first) {
		main.append(first.element);
		replay = startReplay(first.body, report, tracks);
		if (!replay) first.body.append(...withoutWebGl(report, tracks));
	}
	await painted();
	performance.mark('first-drawing');
	const later = laterSections(report, tracks, () => replay);
	main.before(contents(first ? [first, ...later] : later));
	main.append(...later.map((one) => one.element));
	await painted();
	performance.mark('complete');
}

void start();
