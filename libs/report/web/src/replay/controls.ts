// Buttons, slider and layers under the picture, and the same from the keyboard.

import { button, h, select } from '../dom';
import { clock } from '../format';
import { swatch } from '../looks';
import type { Stage } from './stage';
import type { Timeline } from './timeline';
import type { View, Views } from './views';
import type { Layer, World } from './world';

const SPEEDS = [1, 10, 50, 100, 500];
const KEYS: [keys: string, what: string][] = [
	['Space', 'play or pause'], ['\u2190 \u2192', 'one second back or on'], ['Shift + \u2190 \u2192', 'ten seconds'],
	['PgUp PgDn', 'a tenth of the run'], ['Home End', 'first or last moment'], ['O T S F', 'overview, top, side, follow'], ['?', 'this help'],
];

export class Controls {
	readonly bar = h('div', { class: 'replay-bar' });
	readonly layers: HTMLElement;
	readonly help = h('dl', { class: 'keys', id: 'replay-keys', hidden: true });
	private readonly playButton: HTMLButtonElement;
	private readonly slider: HTMLInputElement;
	private readonly label = h('output', { class: 'time', id: 'replay-time', for: 'replay-scrub' });
	private readonly viewButtons = new Map<View, HTMLButtonElement>();
	private helpButton!: HTMLButtonElement;

	constructor(private readonly timeline: Timeline, private readonly views: Views, stage: Stage, world: World) {
		this.playButton = button('', () => timeline.toggle(), { class: 'play', id: 'replay-play' });
		this.slider = h('input', {
			type: 'range', id: 'replay-scrub', min: timeline.start, max: timeline.end, step: 0.1, 'aria-label': 'Time in the run',
			oninput: () => timeline.seek(Number(this.slider.value)),
		});
		this.layers = layerList(stage, world);
		this.fill();
		timeline.onChange(() => this.update());
		this.update();
	}

	private fill(): void {
		const speed = select('Speed', SPEEDS.map((s) => [String(s), `${s}\u00d7`]), (value) => { this.timeline.speed = Number(value); });
		speed.element.value = String(this.timeline.speed);
		this.helpButton = button('Keys', () => this.toggleHelp(), { 'aria-expanded': 'false', 'aria-controls': 'replay-keys', class: 'quiet' });
		for (const [keys, what] of KEYS) this.help.append(h('dt', {}, keys), h('dd', {}, what));
		this.bar.append(this.playButton, this.slider, this.label,
			h('div', { class: 'replay-options' }, speed.field, this.viewGroup(), this.helpButton));
	}

	private viewGroup(): HTMLElement {
		const group = h('div', { class: 'segments', role: 'group', 'aria-label': 'View' });
		const names: [View, string][] = [['overview', 'Overview'], ['top', 'Top'], ['side', 'Side'], ['follow', 'Follow']];
		for (const [view, text] of names) {
			const made = button(text, () => this.setView(view), { 'aria-pressed': String(view === this.views.current) });
			this.viewButtons.set(view, made);
			group.append(made);
		}
		return group;
	}

	private setView(view: View): void {
		this.views.show(view);
		this.viewButtons.forEach((element, key) => element.setAttribute('aria-pressed', String(key === view)));
	}

	private toggleHelp(): void {
		this.help.hidden = !this.help.hidden;
		this.helpButton.setAttribute('aria-expanded', String(!this.help.hidden));
	}

	private update(): void {
		const { time, playing, end } = this.timeline;
		this.playButton.textContent = playing ? 'Pause' : 'Play';
		this.slider.value = String(time);
		this.slider.setAttribute('aria-valuetext', `${clock(time)} of ${clock(end)}`);
		this.label.textContent = `${clock(time)} / ${clock(end)}`;
	}

	/** For when the picture has the focus. Returns whether the key was one of ours. */
	key(event: KeyboardEvent): boolean {
		if (event.ctrlKey || event.altKey || event.metaKey) return false;
		const { timeline } = this, step = event.shiftKey ? 10 : 1, part = (timeline.end - timeline.start) / 10;
		const actions: Record<string, () => void> = {
			' ': () => timeline.toggle(), '?': () => this.toggleHelp(),
			ArrowLeft: () => timeline.seek(timeline.time - step), ArrowRight: () => timeline.seek(timeline.time + step),
			PageUp: () => timeline.seek(timeline.time - part), PageDown: () => timeline.seek(timeline.time + part),
			Home: () => timeline.seek(timeline.start), End: () => timeline.seek(timeline.end),
			o: () => this.setView('overview'), t: () => this.setView('top'), s: () => this.setView('side'), f: () => this.setView('follow'),
		};
		const action = actions[event.key] ?? actions[event.key.toLowerCase()];
		action?.();
		return action !== undefined;
	}
}

function layerItem(layer: Layer, stage: Stage, world: World): HTMLElement {
	const box = h('input', {
		type: 'checkbox', 'data-layer': layer.key, onchange: () => {
			world.setLayer(layer, box.checked);
			stage.redraw();
		},
	});
	box.checked = layer.on;
	return h('label', { class: 'layer' }, box, layer.look ? swatch(layer.look) : null, layer.label);
}

/** The legend: what is shown is chosen there. */
function layerList(stage: Stage, world: World): HTMLElement {
	return h('fieldset', { class: 'layers' }, h('legend', {}, 'Shown'), ...world.layers.map((layer) => layerItem(layer, stage, world)));
}
