// Makes a sample report and tests the page with it.
//   node run.mjs [FOLDER]     where the report and the screenshots go (default: a new one in the temporary folder)

import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const folder = process.argv[2] ?? mkdtempSync(join(tmpdir(), 'report-web-')), report = join(folder, 'report.html');
mkdirSync(folder, { recursive: true });
for (const [script, ...args] of [['make_sample.mjs', report], ['report_test.mjs', report, folder]]) {
	const { status } = spawnSync(process.execPath, [fileURLToPath(new URL(script, import.meta.url)), ...args], { stdio: 'inherit' });
	if (status !== 0) process.exit(status ?? 1);
}
console.log(`screenshots: ${folder}`);
