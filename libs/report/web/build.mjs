// Checks the types, bundles, and writes dist/report-template.html and dist/LICENSES.txt.
//   node build.mjs            writes dist/
//   node build.mjs --check    builds elsewhere and fails when dist/ differs

import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build, transform } from 'esbuild';

const HERE = dirname(fileURLToPath(import.meta.url));
const LIBRARIES = ['three', 'uplot'];
const FILES = ['report-template.html', 'LICENSES.txt'];

const text = (...path) => readFileSync(join(HERE, ...path), 'utf8');

function checkTypes() {
	const { status } = spawnSync(process.execPath, [join(HERE, 'node_modules/typescript/bin/tsc'), '-p', HERE], { stdio: 'inherit' });
	if (status !== 0) process.exit(1);
}

function licenses() {
	const parts = LIBRARIES.map((name) => {
		const { version } = JSON.parse(text('node_modules', name, 'package.json'));
		return `${name} ${version}\n\n${text('node_modules', name, 'LICENSE').trim()}\n`;
	});
	return `The page contains the following libraries.\n\n${parts.join('\n\n')}`;
}

async function script(licenceTexts) {
	const { outputFiles } = await build({
		entryPoints: [join(HERE, 'src/main.ts')],
		absWorkingDir: HERE,
		bundle: true, minify: true, write: false,
		format: 'iife', target: 'es2019', charset: 'utf8', legalComments: 'none', logLevel: 'warning',
		define: { __LICENSES__: JSON.stringify(licenceTexts) },
	});
	return outputFiles[0].text.trim();
}

async function style() {
	const css = text('node_modules/uplot/dist/uPlot.min.css') + text('src/style.css');
	return (await transform(css, { loader: 'css', minify: true, target: 'es2019', legalComments: 'none' })).code.trim();
}

/** The two that the writer of reports fills in must each be there once. */
function checkPlaceholders(page) {
	for (const name of ['__RUN_JSON__', '__TITLE__']) {
		if (page.split(name).length !== 2) throw new Error(`${name} must be in the template exactly once`);
	}
}

async function make(folder) {
	const licenceTexts = licenses();
	const filled = { __STYLE__: await style(), __SCRIPT__: await script(licenceTexts) };
	const page = text('src/page.html').replace(/__STYLE__|__SCRIPT__/g, (name) => filled[name]);
	checkPlaceholders(page);
	mkdirSync(folder, { recursive: true });
	writeFileSync(join(folder, FILES[0]), page);
	writeFileSync(join(folder, FILES[1]), licenceTexts);
	return page.length;
}

/** Names of the files that are not what the sources give. */
function differing(folder) {
	const read = (path) => { try { return readFileSync(path); } catch { return Buffer.alloc(0); } };
	return FILES.filter((name) => !read(join(folder, name)).equals(read(join(HERE, 'dist', name))));
}

checkTypes();
if (process.argv.includes('--check')) {
	const folder = mkdtempSync(join(tmpdir(), 'report-web-'));
	await make(folder);
	const wrong = differing(folder);
	rmSync(folder, { recursive: true });
	for (const name of wrong) console.error(`dist/${name} is not what the sources give: npm run build`);
	process.exitCode = wrong.length > 0 ? 1 : 0;
} else {
	const size = await make(join(HERE, 'dist'));
	console.log(`dist/${FILES[0]}: ${(size / 1024).toFixed(0)} KiB`);
}
