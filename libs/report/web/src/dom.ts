// Elements without a framework.

type Attribute = string | number | boolean | null | ((event: never) => void);
export type Attributes = Record<string, Attribute>;
export type Child = Node | string | null;

function setAttribute(element: Element, name: string, value: Attribute): void {
	if (typeof value === 'function') {
		element.addEventListener(name.slice(2), value as unknown as EventListener);
	} else if (value !== null && value !== false) {
		element.setAttribute(name, value === true ? '' : String(value));
	}
}

function fill<E extends Element>(element: E, attributes: Attributes, children: Child[]): E {
	for (const name of Object.keys(attributes)) setAttribute(element, name, attributes[name]);
	for (const child of children) if (child !== null) element.append(child);
	return element;
}

/** An HTML element; attributes named "onclick" etc. take a function. Text is text, never markup. */
export function h<K extends keyof HTMLElementTagNameMap>(
	tag: K, attributes: Attributes = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
	return fill(document.createElement(tag), attributes, children);
}

export function svg(tag: string, attributes: Attributes = {}, ...children: Child[]): SVGElement {
	return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

export function button(text: string, onclick: () => void, attributes: Attributes = {}): HTMLButtonElement {
	return h('button', { type: 'button', onclick, ...attributes }, text);
}

/** A <select> with its label before it. */
export function select(label: string, options: [value: string, text: string][], onchange: (value: string) => void) {
	const element = h('select', { onchange: () => onchange(element.value) });
	for (const [value, text] of options) element.append(h('option', { value }, text));
	return { element, field: h('label', { class: 'field' }, h('span', {}, label), element) };
}

/** What scrolls sideways on its own, so that the page does not; reachable with the keyboard. */
export function scroller(label: string, ...children: Child[]): HTMLElement {
	return h('div', { class: 'scroller', role: 'region', 'aria-label': `${label}, table`, tabindex: 0 }, ...children);
}
