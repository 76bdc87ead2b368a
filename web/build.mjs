// Builds the front end into dist/, or into the folder that is given: report.js (one script, with style and notices in it), report.html
// (the page around it), live.html (that of web_node) and THIRD_PARTY_NOTICES.txt. The same sources and lock file give the same bytes.
//
// usage: node build.mjs [FOLDER]
import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const folder = resolve(process.argv[2] ?? join(here, 'dist'));
const MOST_BYTES = 1.5e6;

/** The licences of what is in the bundle, whole. */
function notices() {
  const { dependencies } = JSON.parse(readFileSync(join(here, 'package.json'), 'utf8'));
  const texts = Object.keys(dependencies).sort().map((name) => {
    const { version, license } = JSON.parse(readFileSync(join(here, 'node_modules', name, 'package.json'), 'utf8'));
    const text = readFileSync(join(here, 'node_modules', name, 'LICENSE'), 'utf8').replaceAll('\r', '').trim();
    return `${name} ${version} (${license})\n\n${text}\n`;
  });
  return `Parts of this page are the work of others:\n\n${texts.join('\n')}`;
}

const text = notices();
const result = await build({
  absWorkingDir: here,
  entryPoints: ['src/main.ts'],
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: ['es2021', 'chrome100', 'firefox100', 'safari15'],
  charset: 'ascii',
  legalComments: 'none',
  loader: { '.css': 'text' },
  banner: { js: `/*!\n${text.replaceAll('*/', '* /')}*/` },
});
const script = result.outputFiles[0].text;
if (script.length > MOST_BYTES) throw new Error(`report.js has ${script.length} bytes: at most ${MOST_BYTES}`);
if (/<\/script/i.test(script)) throw new Error('report.js holds an end of a script');

const hash = createHash('sha256').update(script).digest('base64');
const page = readFileSync(join(here, 'src', 'page.html'), 'utf8').replace('SCRIPT_HASH', hash);
mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, 'report.js'), script);
writeFileSync(join(folder, 'report.html'), page);
writeFileSync(join(folder, 'live.html'), readFileSync(join(here, 'src', 'live.html')));
writeFileSync(join(folder, 'THIRD_PARTY_NOTICES.txt'), text);
