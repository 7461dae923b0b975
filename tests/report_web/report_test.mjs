// Opens a report from disk in chromium and checks what a reader does with it.
//   node report_test.mjs REPORT.html SCREENSHOT_FOLDER
// A line per check; exit code 1 when one failed.

import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch, requireWeb } from './browser.mjs';

const [reportPath, folder] = process.argv.slice(2);
if (!reportPath || !folder) {
	console.error('usage: node report_test.mjs REPORT.html SCREENSHOT_FOLDER');
	process.exit(2);
}
const ADDRESS = pathToFileURL(resolve(reportPath)).href;
mkdirSync(folder, { recursive: true });

let failures = 0;

function check(what, good, detail = '') {
	if (!good) ++failures;
	console.log(`${good ? 'ok  ' : 'FAIL'} ${what}${detail === '' ? '' : `: ${detail}`}`);
}

/** The whole page in slices: pictures of many thousands of pixels are more than software WebGL draws. */
async function shot(page, name) {
	const before = page.viewportSize(), height = 2000;
	await page.setViewportSize({ width: before.width, height });
	const total = await page.evaluate(() => document.documentElement.scrollHeight);
	for (let i = 0; i * height < total; ++i) {
		await page.evaluate((top) => scrollTo({ top, behavior: 'instant' }), i * height);
		await page.waitForTimeout(250);
		await page.screenshot({ path: join(folder, `${name}-${i + 1}.png`) });
	}
	await page.setViewportSize(before);
	await page.evaluate(() => scrollTo({ top: 0, behavior: 'instant' }));
	await page.waitForTimeout(250);
}

/** A page whose errors and requests are counted. */
async function open(browser, options, address = ADDRESS) {
	const context = await browser.newContext(options), page = await context.newPage(), faults = [];
	page.on('console', (message) => { if (['error', 'warning'].includes(message.type()) && !/GPU stall due to ReadPixels|GL Driver Message/.test(message.text())) faults.push(message.text()); });
	page.on('pageerror', (error) => faults.push(String(error)));
	page.on('request', (request) => { if (request.url() !== address && !/^(data|blob):/.test(request.url())) faults.push(`request of ${request.url()}`); });
	await page.addInitScript(() => {
		const real = window.requestAnimationFrame;
		window.frameCount = 0;
		window.requestAnimationFrame = (callback) => { ++window.frameCount; return real.call(window, callback); };
	});
	await page.goto(address);
	await page.waitForFunction(() => performance.getEntriesByName('complete').length > 0, null, { timeout: 120000 });
	await page.waitForTimeout(500);
	return { page, faults, close: () => context.close() };
}

/** Colours of the replay's picture: how many, which part is not background, and a sum to compare by. */
function replayPixels(page) {
	return page.evaluate(() => {
		const canvas = document.querySelector('#replay-view canvas');
		if (!canvas) return { colours: 0, drawn: 0, sum: 0 };
		const copy = Object.assign(document.createElement('canvas'), { width: 400, height: 250 }), g = copy.getContext('2d');
		g.drawImage(canvas, 0, 0, 400, 250);
		const { data } = g.getImageData(0, 0, 400, 250), seen = new Map();
		let sum = 0;
		for (let i = 0; i < data.length; i += 4) {
			const key = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
			seen.set(key, (seen.get(key) ?? 0) + 1);
			sum = (sum * 31 + key) % 1000000007;
		}
		return { colours: seen.size, drawn: 1 - Math.max(...seen.values()) / (400 * 250), sum };
	});
}

const timeLabel = (page) => page.textContent('#replay-time');

async function checkFirstDrawing(page) {
	const times = await page.evaluate(() => ['first-drawing', 'complete'].map((name) => performance.getEntriesByName(name)[0]?.startTime ?? null));
	check('first drawing is marked', times[0] !== null, times.map((time) => `${time === null ? 'never' : Math.round(time)} ms`).join(', complete '));
	const pixels = await replayPixels(page);
	check('the replay is drawn', pixels.colours > 50 && pixels.drawn > 0.05, `${pixels.colours} colours, ${(100 * pixels.drawn).toFixed(0)} % not background`);
}

async function checkReplay(page) {
	const before = { label: await timeLabel(page), ...(await replayPixels(page)) };
	await page.click('#replay-play');
	await page.waitForTimeout(600);
	const during = { ...(await pixelsOtherThan(before.sum, page)), label: await timeLabel(page) };
	await page.click('#replay-play');
	check('playing changes picture and time', during.label !== before.label && during.sum !== before.sum, `${before.label} -> ${during.label}`);
	await page.waitForTimeout(100);
	const held = await timeLabel(page);
	await page.evaluate(() => { window.frames0 = window.frameCount; });
	await page.waitForTimeout(300);
	check('nothing is drawn while it stands', await page.evaluate(() => window.frameCount === window.frames0));
	check('pausing holds the time', held === (await timeLabel(page)), held);
	await page.focus('#replay-view');
	await page.keyboard.press('Home');
	const first = { label: await timeLabel(page), ...(await pixelsSoon(page)) };
	check('Home is the start', first.label.startsWith('0:00.0'), first.label);
	for (let i = 0; i < 5; ++i) await page.keyboard.press('Shift+ArrowRight');
	const later = { label: await timeLabel(page), ...(await pixelsOtherThan(first.sum, page)) };
	check('arrow keys scrub', later.label.startsWith('0:50.0') && later.sum !== first.sum, later.label);
	for (const key of ['t', 's', 'f', 'o', 'End']) await page.keyboard.press(key);
	await page.focus('#replay-scrub');
	await page.keyboard.press('PageDown');
	check('the slider scrubs', (await timeLabel(page)) !== later.label, await timeLabel(page));
	await page.focus('#replay-view');
	await page.keyboard.press('End');
}

/** The picture once it differs, or after three seconds as it is: a busy machine draws late. */
async function pixelsOtherThan(sum, page) {
	for (let tries = 0; tries < 30; ++tries) {
		const pixels = await pixelsSoon(page);
		if (pixels.sum !== sum) return pixels;
		await page.waitForTimeout(100);
	}
	return pixelsSoon(page);
}

async function pixelsSoon(page) {
	await page.waitForTimeout(200);
	return replayPixels(page);
}

async function checkPlots(page) {
	const plots = await page.evaluate(() => [...document.querySelectorAll('.u-wrap canvas')].map((canvas) => {
		const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
		let inked = 0;
		for (let i = 3; i < data.length; i += 4) if (data[i] > 0) ++inked;
		return inked;
	}));
	check('every plot is drawn', plots.length > 0 && plots.every((inked) => inked > 500), `${plots.length} plots`);
	const over = page.locator('.u-over').first();
	await over.scrollIntoViewIfNeeded();
	const box = await over.boundingBox(), picture = () => over.evaluate((el) => el.parentElement.querySelector('canvas').toDataURL().length);
	const before = await picture();
	await page.mouse.move(box.x + 0.3 * box.width, box.y + 0.3 * box.height);
	await page.mouse.down();
	await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.6 * box.height, { steps: 4 });
	await page.mouse.up();
	await page.waitForTimeout(150);
	const zoomed = await picture();
	await page.locator('.figure .reset').first().click();
	await page.waitForTimeout(150);
	check('dragging zooms and the button resets', zoomed !== before && (await picture()) === before);
	await page.locator('.figure .plot').first().focus();
	for (const key of ['+', '+', 'ArrowRight']) await page.keyboard.press(key);
	await page.waitForTimeout(150);
	const byKeys = await picture();
	await page.keyboard.press('Home');
	await page.waitForTimeout(150);
	check('keys zoom and reset a plot', byKeys !== before && (await picture()) === before);
}

async function checkLoops(page) {
	const rows = () => page.locator('.loop-rows tbody tr[data-row]').count();
	if ((await page.locator('#loops').count()) === 0) return check('loops', true, 'none in this report');
	await page.selectOption('#loop-status', 'accepted');
	await page.fill('#loops input[type=search]', (await page.locator('#loops select option[value=roi]').count()) > 0 ? 'roi' : '');
	const states = await page.locator('.loop-rows tbody td:nth-child(3)').allTextContents();
	check('filter by status', states.length > 0 && states.every((state) => state === 'accepted'), `${states.length} rows on the page`);
	await page.getByRole('button', { name: /with matches$/ }).first().click();
	await page.waitForTimeout(300);
	const pair = await page.evaluate(() => ({
		images: document.querySelectorAll('#loop-pair image').length, lines: document.querySelectorAll('#loop-pair line').length,
		width: document.querySelector('#loop-pair svg').getBoundingClientRect().width,
	}));
	check('a pair shows both pictures and its matches', pair.images === 2 && pair.lines > 5 && pair.width > 100, `${pair.lines} lines, ${Math.round(pair.width)} px wide`);
	await page.locator('#loop-pair').scrollIntoViewIfNeeded();
	await page.locator('#loops').screenshot({ path: join(folder, 'loop-pair.png') });
	const title = await page.textContent('#loop-pair h3');
	await page.getByRole('button', { name: 'Next \u2192' }).click();
	check('next pair', (await page.textContent('#loop-pair h3')) !== title, await page.textContent('#loop-pair h3'));
	await page.fill('#loops input[type=search]', 'no such words');
	check('a filter that nothing passes', (await rows()) === 0);
	await page.fill('#loops input[type=search]', '');
	await page.selectOption('#loop-status', '');
	check('without filters again', (await rows()) > 0);
}

async function checkTexts(page) {
	const pre = await page.evaluate(() => {
		document.querySelectorAll('details.text').forEach((details) => { details.open = true; });
		return new Promise((done) => setTimeout(() => done(document.querySelectorAll('details.text pre').length), 300));
	});
	check('texts open', pre >= 3, `${pre} texts`);
	await page.evaluate(() => document.querySelectorAll('details.text').forEach((details) => { details.open = false; }));
}

async function checkAccess(page, name) {
	await page.evaluate(() => document.querySelectorAll('details').forEach((details) => { details.open = true; }));
	await page.waitForTimeout(300);
	await page.evaluate(requireWeb('axe-core').source);
	const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
	const bad = found.violations.filter((violation) => ['serious', 'critical'].includes(violation.impact));
	await page.evaluate(() => document.querySelectorAll('details').forEach((details) => { details.open = false; }));
	for (const violation of found.violations) console.log(`     ${violation.impact}: ${violation.id} at ${violation.nodes.slice(0, 3).map((node) => node.target.join(' ')).join(' | ')}`);
	check(`accessibility, ${name}`, bad.length === 0, `${found.passes.length} rules passed`);
}

async function checkWidth(page, name) {
	const wide = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
	check(`nothing overflows sideways, ${name}`, wide[0] <= wide[1], `${wide[0]} of ${wide[1]} px`);
}

async function desktop(browser) {
	const { page, faults, close } = await open(browser, { viewport: { width: 1360, height: 900 }, colorScheme: 'light' });
	check('there is a report in the page', (await page.locator('#replay').count()) === 1);
	await checkFirstDrawing(page);
	await shot(page, 'desktop-light');
	await checkReplay(page);
	await checkPlots(page);
	await checkLoops(page);
	await checkTexts(page);
	await checkWidth(page, 'desktop');
	await checkAccess(page, 'light');
	await page.emulateMedia({ colorScheme: 'dark' });
	await page.waitForTimeout(400);
	await shot(page, 'desktop-dark');
	await checkAccess(page, 'dark');
	await page.emulateMedia({ media: 'print', colorScheme: 'dark' });
	await page.setViewportSize({ width: 760, height: 1000 });
	await page.waitForTimeout(700);
	check('paper is light', (await page.evaluate(() => getComputedStyle(document.body).backgroundColor)) === 'rgb(255, 255, 255)');
	await page.screenshot({ path: join(folder, 'print.png'), fullPage: true });
	await page.pdf({ path: join(folder, 'print.pdf'), format: 'A4' });
	check('no errors, no requests, desktop', faults.length === 0, faults.slice(0, 5).join('; '));
	await close();
}

async function phone(browser, colorScheme) {
	const { page, faults, close } = await open(browser, {
		viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true, colorScheme,
	});
	await checkWidth(page, `phone ${colorScheme}`);
	await shot(page, `phone-${colorScheme}`);
	check(`no errors, no requests, phone ${colorScheme}`, faults.length === 0, faults.slice(0, 5).join('; '));
	await close();
}

/** Without WebGL the page says so and shows the rest. */
async function withoutWebGl(browser) {
	const context = await browser.newContext(), page = await context.newPage(), faults = [];
	page.on('pageerror', (error) => faults.push(String(error)));
	await page.addInitScript(() => {
		const real = HTMLCanvasElement.prototype.getContext;
		HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return /webgl/.test(kind) ? null : real.call(this, kind, ...rest); };
	});
	await page.goto(ADDRESS);
	await page.waitForFunction(() => performance.getEntriesByName('complete').length > 0);
	const said = await page.locator('#replay .banner').count();
	check('without WebGL it says so and shows the view from above', said === 1 && (await page.locator('#replay .uplot canvas').count()) > 0 && faults.length === 0, faults.join('; '));
	await context.close();
}

/** The same report with everything left out that may be. */
async function bareReport(browser) {
	const html = readFileSync(reportPath, 'utf8'), [open0, close0] = ['<script id="run" type="application/json">', '</script>'];
	const start = html.indexOf(open0) + open0.length, end = html.indexOf(close0, start), report = JSON.parse(html.slice(start, end));
	const loops = Object.fromEntries(Object.keys(report.loops).map((name) => [name, []]));
	const bare = {
		...report, headline: [], notes: [], metrics: [], paper_table: null, trajectories: report.trajectories.filter(({ name }) => name === 'slam'), errors: [],
		nodes: { altitude: [], points: [] }, consistency: null, camera: null, floor: null, loops, refused: [], key_frames: [], timings: [], sensors: [],
		events: [], plots: [], config: '', mission: null, log: '', interrupted: true,
	};
	for (const [name, made] of [['bare', bare], ['empty', { ...bare, trajectories: [] }]]) {
		const path = join(folder, `${name}.html`);
		writeFileSync(path, html.slice(0, start) + JSON.stringify(made).replace(/</g, '\\u003c') + html.slice(end));
		const { page, faults, close } = await open(browser, { viewport: { width: 1360, height: 900 } }, pathToFileURL(resolve(path)).href);
		check(`${name} report opens`, faults.length === 0 && (await page.locator('h1').count()) === 1, faults.join('; '));
		await page.screenshot({ path: join(folder, `${name}.png`), fullPage: true });
		await close();
	}
}

const browser = await launch();
try {
	await desktop(browser);
	await phone(browser, 'light');
	await phone(browser, 'dark');
	await withoutWebGl(browser);
	await bareReport(browser);
} catch (error) {
	check('the test went through', false, String(error));
} finally {
	await browser.close();
}
console.log(failures === 0 ? 'all passed' : `${failures} failed`);
process.exitCode = failures === 0 ? 0 : 1;
