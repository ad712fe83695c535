// The page that walks by itself, opened from a disk: it walks, obeys, and commands the bits of `halfstep walk`.
import assert from 'node:assert/strict';
import { readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { Browser, Workplace, picture, push, until, untilShown } from './harness.js';

const repository = new URL('../../../', import.meta.url).pathname;
const file = process.env.HALFSTEP_PAGE ?? join(repository, 'target', 'halfstep.html');
/** Largest size of the page (bytes). */
const SIZE_MAX = 3e6;
const RATE = 1000;

const place = new Workplace();
let browser;

before(async () => {
  browser = await Browser.open();
});

after(async () => {
  await browser?.browser.close();
  await place.close();
});

afterEach(() => browser.closePages());

/** The page, once it shows a robot. */
const opened = () => browser.page(`file://${file}`);

/** Chooses a robot of the list, and waits until it walks. */
async function choose(page, name) {
  await page.selectOption('#robot', name);
  await until(() => page.evaluate((robot) => window.halfstep.here.robot?.in_the_box === robot, name));
  return untilWalks(page);
}

/** Waits until the robot that was begun last is in stride. */
async function untilWalks(page) {
  return untilShown(page, ({ mode, half_step: steps, t }) => mode === 'walking' && steps >= 4 && t < 60);
}

/** Halts the walk some seconds later, after a whole second, and gives what the page says of it. */
async function haltAfter(page, more) {
  return page.evaluate(async ([seconds, rate]) => {
    const { here } = window.halfstep;
    here.connection.setPace(0);
    // The thread hears one message after the other: from here on it walks no more by itself.
    await here.connection.walk(0);
    const time = Math.ceil(here.news.ticks / rate) + seconds;
    const walked = await here.connection.walk(time * rate - here.news.ticks);
    return { ...here.news, time, factor: walked.ticks / rate / walked.seconds };
  }, [more, RATE]);
}

/** The summary of the same walk by the processes of `halfstep walk`. */
async function walked(name, seed, { time, commands, disturbances }) {
  const [script, pushes] = ['jsonl', 'toml'].map((end) => join(place.folder, `${name}.${end}`));
  writeFileSync(script, commands);
  writeFileSync(pushes, disturbances);
  const words = ['--robot', name, '--seed', `${seed}`, '--for', `${time}s`, '--commands', script];
  const more = ['--disturbances', pushes, '--lockstep', '--from-stand', '--json', '--out', `run_${name}`];
  return JSON.parse(await place.run('walk', ...words, ...more));
}

/** Drops files on the page. */
async function drop(page, files) {
  const transfer = await page.evaluateHandle((all) => {
    const data = new DataTransfer();
    all.forEach(([name, text]) => data.items.add(new File([text], name)));
    return data;
  }, files);
  await page.dispatchEvent('body', 'drop', { dataTransfer: transfer });
}

test('the page is one file of at most 3 MB that asks for nothing else', async () => {
  const { size } = statSync(file);
  console.log(`# ${(size / 1e6).toFixed(2)} MB`);
  assert.ok(size <= SIZE_MAX, `${size} bytes`);
  const page = await browser.browser.newPage();
  const asked = [];
  page.on('request', (request) => asked.push(request.url()));
  await page.goto(`file://${file}`);
  await until(() => page.evaluate(() => Boolean(window.halfstep?.frame)));
  assert.deepEqual(asked.filter((url) => !/^(file|blob|data):/.test(url)), []);
});

test('a robot walks, obeys a slider, survives a push, and commands the bits of two processes', async () => {
  const page = await opened();
  await page.fill('#seed', '3');
  await page.click('#again');
  await untilShown(page, ({ t }) => t < 2);
  const first = await picture(page);
  await untilWalks(page);
  assert.notEqual(await picture(page), first, 'the picture has changed');

  await page.evaluate(() => {
    const [, turn] = document.querySelectorAll('#sliders input');
    turn.value = 20;
    turn.dispatchEvent(new Event('change'));
  });
  await untilShown(page, ({ gait, velocity }) => gait[1] > 0.2 && velocity[2] > 0.1);

  const begun = () => page.locator('#answers .push').count();
  while (await begun() === 0) await push(page);
  const { t: pushed } = await page.evaluate(() => window.halfstep.frame);
  await page.waitForFunction((since) => window.halfstep.frame.t > since + 5, pushed);
  const later = await page.evaluate(() => window.halfstep.frame);
  assert.equal(later.mode, 'walking', 'after the push');

  const here = await haltAfter(page, 20);
  console.log(`# paper: ${here.factor.toFixed(1)} × real time`);
  assert.match(here.commands, /"turn_deg":20/);
  assert.match(here.disturbances, /impulse_n_s/);
  assert.equal(await page.textContent('#hash'), here.hash);
  const there = await walked('paper', 3, here);
  assert.equal(there.setpoint_hash, here.hash);
  assert.equal(there.falls, 0);
});

test('another robot is chosen, walks, and commands the bits of two processes', async () => {
  const page = await opened();
  const name = () => page.evaluate(() => window.halfstep.runs[0].timeline.robot.name);
  const before = await name();
  await choose(page, 'g1');
  assert.notEqual(await name(), before);
  await page.keyboard.press('KeyW', { delay: 300 });
  const here = await haltAfter(page, 20);
  console.log(`# g1: ${here.factor.toFixed(1)} × real time`);
  assert.match(here.commands, /"vx":/);
  const there = await walked('g1', 0, here);
  assert.equal(there.setpoint_hash, here.hash);
});

test('a URDF that is dropped on the page walks, and one that cannot is told', async () => {
  const page = await opened();
  await drop(page, [['table.urdf', '<robot name="table"><link name="top"/></robot>']]);
  await until(() => page.isVisible('#problem'));
  assert.match(await page.textContent('#problem-text'), /^table\.urdf/);
  await page.click('#problem-close');

  await place.run('export', 'urdf', '--mechanism', join(repository, 'config/robots/t1/mechanism.toml'), '--out', 'my.urdf');
  await drop(page, [['my.urdf', readFileSync(join(place.folder, 'my.urdf'), 'utf8')]]);
  await until(() => page.isVisible('#found'));
  await untilWalks(page);
  assert.ok(!await page.isVisible('#problem'), await page.textContent('#problem-text'));
  const here = await haltAfter(page, 20);
  const { mode } = await page.evaluate(() => window.halfstep.runs[0].timeline.last);
  assert.equal(mode, 'walking');
  console.log(`# from a URDF: ${here.factor.toFixed(1)} × real time`);
});

test('no page has written an error to its console', () => {
  assert.deepEqual(browser.consoleErrors, []);
});
