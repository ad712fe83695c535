// What the tests of the page share: a robot that walks in lockstep, `halfstep view`, and a browser.
import { spawn, execFile } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { promisify } from 'node:util';
import { chromium } from 'playwright-core';

const repository = new URL('../../../', import.meta.url).pathname;
const BROWSERS = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
/** Longest wait for anything (ms): whatever takes longer hangs. */
export const PATIENCE = 300_000;

/** The program under test: `HALFSTEP`, or the one that was built last. */
function halfstep() {
  const built = ['release', 'debug'].map((profile) => join(repository, 'target', profile, 'halfstep'));
  const found = [process.env.HALFSTEP, ...built].find((path) => path && existsSync(path));
  if (!found) throw new Error('build halfstep first: cargo build -p halfstep');
  return found;
}

/** A folder and an instance of its own, with all processes that are started in it. */
export class Workplace {
  static #count = 0;

  constructor() {
    this.folder = mkdtempSync(join(tmpdir(), 'halfstep-page-'));
    mkdirSync(join(this.folder, 'runtime'), { mode: 0o700 });
    this.instance = `page-${process.pid}-${Workplace.#count}`;
    Workplace.#count += 1;
    this.processes = [];
  }

  get #options() {
    return { cwd: this.folder, env: { ...process.env, XDG_RUNTIME_DIR: join(this.folder, 'runtime') } };
  }

  /** Starts a command, out of the browser's way: it may take what the browser leaves. */
  start(...words) {
    const options = { ...this.#options, stdio: ['ignore', 'pipe', 'pipe'] };
    const child = spawn('nice', ['-n', '19', halfstep(), ...words], options);
    child.text = '';
    child.stdout.on('data', (data) => { child.text += data; });
    child.stderr.on('data', (data) => { child.text += data; });
    child.ended = new Promise((resolve) => { child.on('exit', resolve); });
    this.processes.push(child);
    return child;
  }

  /** Runs a command to its end. */
  async run(...words) {
    return (await promisify(execFile)(halfstep(), words, this.#options)).stdout;
  }

  /** A folder of parameters: the committed ones, with another text of plant.toml. */
  config(changed) {
    const folder = join(this.folder, 'config');
    cpSync(join(repository, 'config'), folder, { recursive: true });
    const file = join(folder, 'plant.toml');
    writeFileSync(file, changed(readFileSync(file, 'utf8')));
    return folder;
  }

  /** Starts a robot that stands. In lockstep a recording of it grows by some 15 MB per second. */
  robot(...options) {
    const common = ['--instance', this.instance, '--lockstep', '--from-stand', ...options];
    return ['controller', 'plant'].map((role) => this.start(role, ...common));
  }

  /** Starts `halfstep view`, and gives the address of its page. */
  async view(...words) {
    const child = this.start('view', '--listen', '127.0.0.1:0', '--json', ...words);
    await until(() => child.text.includes('}') || child.exitCode !== null);
    if (child.exitCode !== null) throw new Error(child.text);
    return { child, url: JSON.parse(child.text.slice(child.text.indexOf('{'))).url };
  }

  async end(children = this.processes) {
    children.forEach((child) => child.kill('SIGTERM'));
    await Promise.all(children.map(({ ended }) => ended));
  }

  async close() {
    await this.end();
    rmSync(this.folder, { recursive: true, force: true });
  }
}

/** Waits until something is so. */
export async function until(is, what = is.toString()) {
  const began = Date.now();
  for (;;) {
    const value = await is();
    if (value) return value;
    if (Date.now() - began > PATIENCE) throw new Error(`waited in vain for: ${what}`);
    await new Promise((resolve) => { setTimeout(resolve, 50); });
  }
}

/** A browser that keeps what its pages write to the console as errors or warnings. */
export class Browser {
  static async open() {
    const executablePath = process.env.CHROMIUM ?? BROWSERS.find((path) => existsSync(path));
    const browser = await chromium.launch({
      executablePath,
      args: [
        '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist',
        '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
        '--disable-sync',
      ],
    });
    return Object.assign(new Browser(), { browser, consoleErrors: [] });
  }

  /** Opens a page. */
  async openPage(url, viewport) {
    const page = await this.browser.newPage({ viewport });
    page.setDefaultTimeout(PATIENCE);
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type()) && !message.text().includes('GPU stall')) {
        this.consoleErrors.push(message.text());
      }
    });
    page.on('pageerror', (error) => this.consoleErrors.push(error.message));
    await page.goto(url);
    return page;
  }

  /** Opens a page, and waits until it shows a robot. */
  async page(url) {
    const page = await this.openPage(url, { width: 880, height: 640 });
    // Software draws here: as little as may be.
    await page.evaluate(() => window.halfstep.viewport.setQuality(9));
    await until(() => page.evaluate(() => Boolean(window.halfstep.frame && window.halfstep.runs[0].robot.angles)));
    return page;
  }

  async closePages() {
    await Promise.all(this.browser.contexts().flatMap((context) => context.pages()).map((page) => page.close()));
  }
}

/** The frame that a page shows. */
export const shown = (page) => page.evaluate(() => window.halfstep.frame);

/** Waits until the frame that a page shows is as it should be, and gives that frame. */
export function untilShown(page, is) {
  return until(async () => {
    const frame = await shown(page);
    return frame && is(frame) ? frame : null;
  }, is.toString());
}

/** The picture in the viewport as the browser has drawn it. */
export const picture = (page) => page.evaluate(() => {
  const { renderer } = window.halfstep.viewport;
  window.halfstep.viewport.draw();
  return renderer.domElement.toDataURL();
});

/** Pushes the robot's chest to the right of the picture with the mouse, and gives the label of the push. */
export async function push(page) {
  const [x, y] = await page.evaluate(() => {
    const { robot } = window.halfstep.runs[0];
    const { camera } = window.halfstep.viewport;
    const chest = robot.joints[robot.drawing.trunk].node.getWorldPosition(robot.middle());
    chest.z += 0.25 * robot.scale;
    chest.project(camera);
    return [((chest.x + 1) / 2) * innerWidth, ((1 - chest.y) / 2) * innerHeight];
  });
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 30, y, { steps: 4 });
  await page.mouse.move(x + 80, y, { steps: 4 });
  const label = await page.textContent('#push-label');
  await page.mouse.up();
  return label;
}
