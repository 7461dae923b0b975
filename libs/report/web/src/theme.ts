// Light and dark. The colours are CSS variables (style.css), so that there is one list of them; what draws on a
// canvas asks colour() and is told when to draw anew.

type Theme = 'light' | 'dark';

const KEY = 'posidonia-report-theme';
const listeners: (() => void)[] = [];
let printing = false;
let cache: Record<string, string> = {};

export function colour(name: string): string {
	if (!(name in cache)) {
		cache[name] = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim() || '#888888';
	}
	return cache[name];
}

/** The same with an opacity; the variables are written as #rrggbb. */
export function faded(name: string, opacity: number): string {
	return colour(name) + Math.round(255 * opacity).toString(16).padStart(2, '0');
}

export function onTheme(listener: () => void): void {
	listeners.push(listener);
}

// Storage may be forbidden for pages from disk.
function stored(): string | null {
	try { return localStorage.getItem(KEY); } catch { return null; }
}

function store(theme: Theme): void {
	try { localStorage.setItem(KEY, theme); } catch { /* kept for this view only */ }
}

function wanted(): Theme {
	const saved = stored();
	if (saved === 'light' || saved === 'dark') return saved;
	return matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
}

let chosen: Theme | null = null;

function apply(): void {
	const theme = printing ? 'light' : chosen ?? wanted();
	if (document.documentElement.dataset.theme === theme) return;
	document.documentElement.dataset.theme = theme;
	cache = {};
	for (const listener of listeners) listener();
}

export function toggleTheme(): void {
	chosen = document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark';
	store(chosen);
	apply();
}

/** Paper is always light. */
export function startTheme(): void {
	apply();
	matchMedia('(prefers-color-scheme: dark)').addEventListener('change', apply);
	onPrint((now) => {
		printing = now;
		apply();
	});
}

/** Called with true before printing and false after it. */
export function onPrint(listener: (printing: boolean) => void): void {
	const media = matchMedia('print');
	let last = false;
	const tell = (now: boolean) => {
		if (now === last) return;
		last = now;
		listener(now);
	};
	media.addEventListener('change', () => tell(media.matches));
	addEventListener('beforeprint', () => tell(true));
	addEventListener('afterprint', () => tell(false));
}
