// Bundles the tests below a folder and runs them with node's own runner.
//
// usage: node run_tests.mjs FOLDER [ARGUMENT...]
import { spawnSync } from 'node:child_process';
import { readdirSync, rmSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const folder = process.argv[2];
const tests = readdirSync(join(here, folder)).filter((name) => name.endsWith('.test.ts')).sort();
if (tests.length === 0) throw new Error(`there is no test in ${folder}`);
const out = join(here, '.build', folder);
rmSync(out, { recursive: true, force: true });
await build({
  absWorkingDir: here,
  entryPoints: tests.map((name) => join(folder, name)),
  outdir: out,
  outExtension: { '.js': '.mjs' },
  bundle: true,
  platform: 'node',
  format: 'esm',
  packages: 'external',
  loader: { '.css': 'text' },
});
const run = spawnSync(process.execPath, ['--test', ...tests.map((name) => join(out, name.replace(/\.ts$/, '.mjs')))], { stdio: 'inherit', cwd: here });
process.exit(run.status ?? 1);
