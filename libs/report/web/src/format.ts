// Numbers for readers.

const NONE = '\u2013';

function grouped(digits: string): string {
	const [whole, fraction] = digits.split('.');
	const spaced = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, '\u202f') : whole;
	return fraction === undefined ? spaced : `${spaced}.${fraction}`;
}

function isNumber(value: number | null | undefined): value is number {
	return value !== null && value !== undefined && Number.isFinite(value);
}

export function fixed(value: number | null | undefined, digits: number): string {
	if (!isNumber(value)) return NONE;
	const text = value.toFixed(digits);
	return grouped(Number(text) === 0 ? text.replace('-', '') : text).replace('-', '\u2212');
}

export function whole(value: number | null | undefined): string {
	return fixed(value, 0);
}

/** Four significant digits; whole numbers whole; powers of ten only where nothing else is readable. */
export function short(value: number | null | undefined): string {
	if (!isNumber(value)) return NONE;
	const size = Math.abs(value);
	if (Number.isInteger(value) && size < 1e9) return whole(value);
	if (size >= 1e7 || size < 1e-5) return value.toExponential(2).replace(/-/g, '\u2212');
	const text = fixed(value, Math.max(0, Math.min(8, 3 - Math.floor(Math.log10(size)))));
	return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

/** 75.25 -> "1:15.2", with hours only where there are some. */
export function clock(seconds: number): string {
	const tenths = Math.floor(Math.max(0, seconds) * 10 + 1e-6);
	const two = (n: number) => String(n).padStart(2, '0');
	const hours = Math.floor(tenths / 36000), minutes = Math.floor(tenths / 600) % 60;
	const rest = `${two(Math.floor(tenths / 10) % 60)}.${tenths % 10}`;
	return hours > 0 ? `${hours}:${two(minutes)}:${rest}` : `${minutes}:${rest}`;
}

/** 795.2 -> "13 min 15 s". */
export function lasting(seconds: number): string {
	const s = Math.round(seconds), hours = Math.floor(s / 3600), minutes = Math.floor(s / 60) % 60;
	if (hours > 0) return `${hours} h ${minutes} min`;
	return minutes > 0 ? `${minutes} min ${s % 60} s` : `${s} s`;
}

/** ISO 8601 -> "2015-01-01 00:00:00 UTC". */
export function utc(iso: string): string {
	return `${iso.replace('T', ' ').replace(/(\.\d+)?Z?$/, '')} UTC`;
}
