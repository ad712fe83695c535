// Makes the page that walks by itself, one file without any other: `node build_walk.js WALKER.wasm PAGE.html`.
import { readFile, writeFile } from 'node:fs/promises';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const [walkerFile, pageFile] = process.argv.slice(2);
const here = new URL('.', import.meta.url).pathname;
const common = {
  absWorkingDir: here, bundle: true, minify: true, format: 'iife', target: ['es2022'], charset: 'utf8',
  legalComments: 'none', write: false, outdir: 'out',
};

/** The threads' programs, by the names by which the page imports them as texts. */
const THREADS = {
  walk_thread: 'src/walk_here/walk_thread.js', instrument_thread: 'src/instrument/instrument_thread.js',
};
const asText = {
  name: 'threads as texts',
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /^\w+_thread$/ }, ({ path }) => ({ path, namespace: 'text' }));
    onLoad({ filter: /.*/, namespace: 'text' }, async ({ path }) => {
      const thread = await build({ ...common, entryPoints: [THREADS[path]] });
      return { contents: thread.outputFiles[0].text, loader: 'text' };
    });
  },
};
const bundle = await build({ ...common, entryPoints: { page: 'src/walk_here/main.js' }, plugins: [asText] });
const output = (end) => bundle.outputFiles.find(({ path }) => path.endsWith(end)).text;

const text = (file) => readFile(`${here}${file}`, 'utf8');
const robots = (await text('../../crates/robots/src/built_in_robot.rs')).matchAll(/robot!\("(\w+)"/g);
const options = [...robots].map(([, name]) => `<option>${name}</option>`).join('');
const panel = (await text('src/walk_here/panel.html')).replace('</select></label>', `${options}</select></label>`);
const walker = gzipSync(await readFile(walkerFile), { level: 9 }).toString('base64');
const notices = await Promise.all(['three', 'uplot'].map(async (name) => (
  `${name}\n\n${(await text(`node_modules/${name}/LICENSE`)).trim()}\n`)));

/** Replaces what must be there; the replacement is taken as it is. */
const replaced = (page, from, to) => {
  if (!page.includes(from)) throw new Error(`index.html lacks ${from}`);
  return page.replace(from, () => to);
};
let page = await text('src/index.html');
page = replaced(page, '<title>halfstep view</title>', `<title>halfstep</title>\n<!--\n${notices.join('\n')}-->`);
page = replaced(page, '<link rel="stylesheet" href="view.css">', `<style>${output('.css')}</style>`);
page = replaced(page, '<button id="stop"', `${panel}<button id="stop"`);
page = replaced(page, '<div id="instance">', `${await text('src/walk_here/views.html')}<div id="instance">`);
page = replaced(page, '<script type="module"', `${await text('src/instrument/panel.html')}<script type="module"`);
page = replaced(page, '<script type="module" src="view.js"></script>', [
  `<script type="text/plain" id="walker">${walker}</script>`,
  `<script>${output('.js').replaceAll('</script', '<\\/script')}</script>`,
].join('\n'));
await writeFile(pageFile, page);
console.log(`${pageFile}: ${(Buffer.byteLength(page) / 1e6).toFixed(2)} MB`);
