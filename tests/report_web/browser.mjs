// Debian's chromium with software WebGL, by playwright-core of libs/report/web.

import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

export const WEB = fileURLToPath(new URL('../../libs/report/web/', import.meta.url));
export const requireWeb = createRequire(`${WEB}package.json`);

export function launch() {
	const { chromium } = requireWeb('playwright-core');
	return chromium.launch({
		executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
		args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
	});
}
