// Bundles the page into crates/view/page, from where the binary gets it. The same sources give the same bytes.
import { readFile, writeFile } from 'node:fs/promises';
import { build } from 'esbuild';

const here = new URL('.', import.meta.url).pathname;
const page = new URL('../../crates/view/page/', import.meta.url).pathname;

await build({
  absWorkingDir: here,
  entryPoints: { view: 'src/main.js' },
  outdir: page,
  bundle: true,
  minify: true,
  format: 'esm',
  target: ['es2022'],
  charset: 'utf8',
  legalComments: 'none',
  banner: { js: '/* three.js and uPlot, MIT: see licenses.txt beside this file */' },
});
await writeFile(`${page}index.html`, await readFile(`${here}src/index.html`));

const notices = ['three', 'uplot'].map(async (name) => {
  const text = await readFile(`${here}node_modules/${name}/LICENSE`, 'utf8');
  return `${name}\n\n${text.trim()}\n`;
});
await writeFile(`${page}licenses.txt`, (await Promise.all(notices)).join('\n'));
