// The second view of the page that walks by itself, the paper as an instrument: verdicts and figure follow the sliders.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { Browser, until } from './harness.js';

const repository = new URL('../../../', import.meta.url).pathname;
const file = process.env.HALFSTEP_PAGE ?? join(repository, 'target', 'halfstep.html');
/** Where pictures of the page go, if anywhere. */
const pictures = process.env.HALFSTEP_PICTURES;
let browser;

before(async () => {
  browser = await Browser.open();
});

after(() => browser?.browser.close());

afterEach(() => browser.closePages());

/** The page with the paper, once it has answered. */
async function opened(size = { width: 1440, height: 900 }) {
  const page = await browser.openPage(`file://${file}#paper`, size);
  await settled(page);
  return page;
}

const settled = (page) => until(() => page.evaluate(() => window.halfstep.here.instrument.isSettled
  && Boolean(window.halfstep.here.instrument.answer || !document.getElementById('refusal').hidden)));

/** Moves a slider or chooses of a list, and waits for the answer. */
async function turn(page, name, value) {
  await page.evaluate(([id, wanted]) => {
    const control = document.getElementById(`dial-${id}`);
    control.value = wanted;
    control.dispatchEvent(new Event(control.tagName === 'SELECT' ? 'change' : 'input'));
  }, [name, value]);
  await settled(page);
}

/** What the page shows. */
const seen = (page) => page.evaluate(() => ({
  agree: document.getElementById('agree').textContent,
  compared: document.getElementById('compared').textContent,
  rows: [...document.querySelectorAll('#verdicts tbody tr')].map((row) => row.innerText),
  misses: [...document.querySelectorAll('#verdicts .misses')].map((row) => Number(row.dataset.figure)),
  // Each picture has other names for its parts.
  picture: document.getElementById('drawn').innerHTML.replaceAll(/kuva-clip-\d+/g, 'clip'),
}));

async function photograph(page, name) {
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  await page.screenshot({ path: join(pictures, `${name}.png`) });
}

test('the paper opens with 38 verdicts, and follows a slider there and back', async () => {
  const page = await opened();
  const ours = await seen(page);
  assert.deepEqual([ours.rows.length, ours.agree, ours.misses], [38, '36 of 38', [7, 32]]);
  assert.match(ours.picture, /^<svg/);
  await photograph(page, 'ours');

  await turn(page, 'heel_m', 0.081);
  await turn(page, 'duration_s', 0.55);
  const better = await seen(page);
  assert.deepEqual([better.rows.length, better.agree, better.misses], [38, '37 of 38', [7]]);
  assert.match(better.compared, /1 more than with our numbers/);
  assert.notDeepEqual(better.rows, ours.rows);
  assert.notEqual(better.picture, ours.picture);
  await photograph(page, 'heel');

  await page.click('#reset-dials');
  await settled(page);
  assert.deepEqual(await seen(page), ours);
  assert.ok(await page.isDisabled('#reset-dials'));
});

test('ramps, axes and figures are chosen', async () => {
  const page = await opened();
  await turn(page, 'turn_ramp', 'linear');
  assert.deepEqual((await seen(page)).misses, [6, 7, 32]);
  await turn(page, 'axes', 'mechanism_other_reading.toml');
  await turn(page, 'turn_ramp', 'quintic');
  assert.equal((await seen(page)).agree, '27 of 38');
  const before = (await seen(page)).picture;
  await page.click('#verdicts tr[data-figure="48"]');
  await settled(page);
  assert.equal(await page.inputValue('#figure'), '48');
  assert.notEqual((await seen(page)).picture, before);
  assert.equal(await page.locator('#figure option').count(), 45);
  await photograph(page, 'axes');
});

test('numbers with which nothing walks are told, in place of a table of others', async () => {
  const page = await opened();
  await turn(page, 'hip_height_share', 1.08);
  await turn(page, 'step_length_m', 0.5);
  const { rows, picture } = await seen(page);
  assert.deepEqual([rows.length, picture], [0, '']);
  assert.match(await page.textContent('#refusal-text'), /cannot walk: row \d+ of 60: the \w+ leg cannot reach/);
  await photograph(page, 'no_walk');
  await turn(page, 'hip_height_share', 1);
  assert.equal((await seen(page)).rows.length, 0);
  await turn(page, 'step_length_m', 0.2);
  assert.equal((await seen(page)).rows.length, 38);
  assert.ok(!await page.isVisible('#refusal'));
});

test('dragging a slider stays fluid: of all its places the last is answered', async () => {
  const page = await opened();
  const { times, asked } = await page.evaluate(async () => {
    const slider = document.getElementById('dial-step_length_m');
    const times = [];
    for (let place = 0; place < 60; place += 1) {
      slider.value = 0.2 + place * 0.002;
      const began = performance.now();
      slider.dispatchEvent(new Event('input'));
      times.push(performance.now() - began);
      await new Promise((resolve) => { setTimeout(resolve, 5); });
    }
    return { times: times.sort((one, other) => one - other), asked: Number(slider.value) };
  });
  await settled(page);
  const [seconds, fresh] = await page.evaluate(() => {
    const { seconds: last, panel } = window.halfstep.here.instrument;
    return [last, panel.question.numbers.step_length_m];
  });
  // The median, since other programs interrupt some: if the page itself computed, each would take as long as an answer.
  const [median, longest] = [times[times.length / 2], times[times.length - 1]];
  const answer = 1e3 * seconds;
  const told = `${median.toFixed(1)} ms a movement, at most ${longest.toFixed(1)}; ${answer.toFixed(0)} ms an answer`;
  console.log(`# ${told}`);
  assert.ok(median < answer / 3, told);
  assert.equal(fresh, asked);
});

test('the switch leads to the walk, which begins there, and back', async () => {
  const page = await opened();
  await page.keyboard.press('KeyW', { delay: 50 });
  assert.equal(await page.evaluate(() => window.halfstep.here.news?.ticks ?? 0), 0, 'what is not seen does not walk');
  await page.click('#view-walk');
  await until(() => page.evaluate(() => window.halfstep.here.news?.ticks > 500));
  assert.ok(await page.isVisible('#viewport') && !await page.isVisible('#instrument'));
  await photograph(page, 'walk');
  await page.click('#view-paper');
  const ticks = () => page.evaluate(() => window.halfstep.here.news.ticks);
  // What is under way ends.
  await page.waitForTimeout(500);
  const halted = await ticks();
  await page.waitForTimeout(300);
  assert.equal(await ticks(), halted);
  assert.equal((await seen(page)).agree, '36 of 38');
});

test('narrow screens show all of it, below each other', async () => {
  for (const [width, height] of [[1024, 768], [420, 860]]) {
    const page = await opened({ width, height });
    await photograph(page, `${width}`);
    const wide = await page.evaluate(() => document.getElementById('instrument').scrollWidth - innerWidth);
    assert.ok(wide <= 0, `${width}: ${wide} px too wide`);
  }
});

test('no page has written an error to its console', () => {
  assert.deepEqual(browser.consoleErrors, []);
});
