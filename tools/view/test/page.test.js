// The page in a real browser: what it shows is what was measured, and what a hand does on it happens to the robot.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { Browser, Workplace, picture, push, shown, until, untilShown } from './harness.js';

/** The controller's command timeout while a page drives (s): of the simulated time, which passes faster here. */
const AGE_LIMIT = 30;

const place = new Workplace();
/** Of a robot that records: no longer than it must, since in lockstep that is much. */
const recording = new Workplace();
/** Of a robot on a floor that is no plane. */
const uneven = new Workplace();
let browser;
let url;
let robot;

before(async () => {
  browser = await Browser.open();
  robot = place.robot();
  ({ url } = await place.view('--instance', place.instance, '--age-limit', `${AGE_LIMIT}s`));
});

after(async () => {
  await browser?.browser.close();
  await Promise.all([place, recording, uneven].map((each) => each.close()));
});

afterEach(() => browser.closePages());

/** Angles of the joints as they are drawn: taken from the pose of each drawn body. */
const drawnAngles = (page) => page.evaluate(() => {
  const { joints } = window.halfstep.runs[0].robot;
  const { player } = window.halfstep;
  player.seek(window.halfstep.frame.t);
  return new Promise((resolve) => {
    requestAnimationFrame(() => requestAnimationFrame(() => {
      const angles = joints.map(({ node, axis }) => {
        const { x, y, z, w } = node.quaternion;
        return 2 * Math.atan2(x * axis.x + y * axis.y + z * axis.z, w);
      });
      const time = player.time;
      player.follows = true;
      resolve({ angles, time });
    }));
  });
});

async function drive(page) {
  await page.click('#take-control');
  await until(() => page.evaluate(() => window.halfstep.teleoperation.drives));
}

/** Where a point of the floor is in the window. */
const onScreen = (page, point) => page.evaluate(([x, y, z]) => {
  const { camera } = window.halfstep.viewport;
  const at = camera.position.clone().set(x, y, z).project(camera);
  return [((at.x + 1) / 2) * innerWidth, ((1 - at.y) / 2) * innerHeight];
}, point);

test('a key drives the robot, its release stops it, and a second page only looks on', async () => {
  const page = await browser.page(url);
  const onlooker = await browser.page(url);
  await untilShown(page, ({ mode }) => mode === 'standing');
  const standing = await picture(page);

  const before = await shown(page);
  await page.keyboard.down('KeyW');
  const after = await untilShown(page, ({ t }) => t > before.t + 3);
  assert.equal(after.mode, 'standing', 'a page that does not drive moves nothing');
  await page.keyboard.up('KeyW');

  await drive(page);
  await until(() => onlooker.evaluate(() => document.getElementById('take-control').disabled));
  await page.keyboard.down('KeyW');
  const walking = await untilShown(page, ({ mode, velocity }) => mode === 'walking' && velocity[0] > 0.1);
  assert.notEqual(await picture(page), standing, 'the picture has changed');
  await untilShown(onlooker, ({ t, velocity }) => velocity[0] > 0.1 && t > 0);
  await page.keyboard.up('KeyW');
  const stopped = await untilShown(page, ({ mode }) => mode === 'standing');
  assert.ok(stopped.pose[0] > walking.pose[0] - 0.05, 'it went ahead');
});

test('a page that is lost while a key is held stops the robot', async () => {
  const page = await browser.page(url);
  const onlooker = await browser.page(url);
  await drive(page);
  await page.keyboard.down('KeyW');
  await untilShown(onlooker, ({ mode, velocity }) => mode === 'walking' && velocity[0] > 0.1);
  // Nothing is said any more: neither a release nor a farewell.
  await page.evaluate(() => { window.halfstep.teleoperation.send = () => {}; });
  const { t: lost } = await shown(onlooker);
  // Of the robot's time: in lockstep a loaded machine may make it pass slowly.
  const later = await untilShown(onlooker, ({ mode, t }) => mode === 'standing' || t > lost + 2 * AGE_LIMIT);
  assert.equal(later.mode, 'standing', `${later.t - lost} s later it still walks`);
});

test('a click on the floor is walked to', async () => {
  const page = await browser.page(url);
  await drive(page);
  const from = (await shown(page)).pose;
  const goal = [from[0] + 0.6 * Math.cos(from[2]), from[1] + 0.6 * Math.sin(from[2]), 0];
  // Seen from the side the floor ahead is free.
  await page.evaluate(([x, y, heading]) => {
    const { viewport } = window.halfstep;
    const [c, s] = [Math.cos(heading), Math.sin(heading)];
    viewport.camera.position.set(x - 1.5 * c + 2 * s, y - 1.5 * s - 2 * c, 3);
    viewport.draw();
  }, from);
  await page.mouse.click(...await onScreen(page, goal));
  await untilShown(page, ({ destination }) => destination !== null);
  const there = await untilShown(page, ({ mode, destination }) => mode === 'standing' && destination?.[0] === 0);
  const marked = await page.evaluate(() => window.halfstep.goal);
  const off = Math.hypot(marked[0] - goal[0], marked[1] - goal[1]);
  assert.ok(off < 0.1, `${off} m from the point that was clicked`);
  const away = Math.hypot(there.pose[0] - marked[0], there.pose[1] - marked[1]);
  assert.ok(away < 0.05, `${away} m from the goal`);
});

/** Pushes a robot that stands until the push is seen: between two frames half a second of it may pass in lockstep. */
async function pushUntilSeen(page) {
  // When the last push began, as its answer says.
  const begun = () => page.evaluate(() => {
    const [answer] = [...document.querySelectorAll('#answers .push')].slice(-1);
    return answer && Number(/from ([\d.]+) s/.exec(answer.textContent)[1]);
  });
  for (let isSeen = false; !isSeen;) {
    const calm = await untilShown(page, ({ mode }) => mode === 'standing');
    const last = await begun();
    assert.match(await push(page), /^9\.\d N·s$/);
    await until(async () => {
      assert.equal(await page.locator('#answers .refused').count(), 0);
      return await begun() !== last;
    });
    const later = await untilShown(page, ({ t, mode }) => t > calm.t + 10 && mode === 'standing');
    const moved = Math.hypot(later.pose[0] - calm.pose[0], later.pose[1] - calm.pose[1]);
    assert.ok(moved < 0.5, `the push moved it by ${moved} m`);
    isSeen = await page.evaluate(([from, to, support, [x, y]]) => window.halfstep.runs[0].timeline.between(from, to)
      .some(({ dcm, support: side }) => dcm && side === support && Math.hypot(dcm[0] - x, dcm[1] - y) > 0.006),
    [calm.t, later.t, calm.support, calm.dcm]);
  }
}

test('a push with the mouse is seen and survived', async () => {
  const page = await browser.page(url);
  await drive(page);
  await pushUntilSeen(page);
});

test('joints are drawn as they were measured, live and from the recording', async () => {
  await place.end(robot);
  const recorder = recording.robot('--out', 'run');
  const running = await recording.view('--instance', recording.instance, '--age-limit', `${AGE_LIMIT}s`);
  const page = await browser.page(running.url);
  await drive(page);
  await pushUntilSeen(page);
  await page.keyboard.down('KeyW');
  await untilShown(page, ({ velocity }) => velocity[0] > 0.1);
  const live = [];
  for (let count = 0; count < 4; count += 1) live.push(await drawnAngles(page));
  await page.keyboard.up('KeyW');
  await untilShown(page, ({ mode }) => mode === 'standing');
  await recording.end(recorder);

  // The truth, not what the sensors said of it: every 5 ms.
  await recording.run('plot', 'run', '--csv');
  const [head, ...rows] = readFileSync(join(recording.folder, 'run', 'plant.csv'), 'utf8').trim().split('\n')
    .map((line) => line.split(','));
  const first = head.indexOf('joint_01_angle_rad');
  const times = rows.map(([t]) => Number(t));
  const compare = ({ angles, time }, what) => {
    const row = rows[times.findIndex((t) => t >= time - 0.003)];
    const most = Math.max(...angles.slice(2).map((angle, index) => Math.abs(angle - Number(row[first + 2 + index]))));
    assert.ok(most < 0.02, `${what} at ${time} s: ${most} rad off`);
  };
  live.forEach((drawn) => compare(drawn, 'live'));

  const played = await recording.view('run');
  const again = await browser.page(played.url);
  await until(() => again.evaluate(() => !window.halfstep.player.isLive));
  const seen = [];
  for (const share of [0.1, 0.35, 0.8]) {
    await again.evaluate((part) => {
      const slider = document.getElementById('time');
      slider.value = Number(slider.min) + part * (Number(slider.max) - Number(slider.min));
      slider.dispatchEvent(new Event('input'));
    }, share);
    compare(await drawnAngles(again), 'recorded');
    seen.push(await picture(again));
  }
  assert.equal(new Set(seen).size, 3, 'each time has a picture of its own');
  const { notes, frames } = await again.evaluate(() => window.halfstep.runs[0].timeline);
  const pushed = notes.find(({ kind, text }) => kind === 'push' && text.startsWith('push on the trunk'));
  const calm = frames.findLast(({ t }) => t <= pushed.t);
  const away = frames.filter(({ t, support }) => t > pushed.t && t < pushed.t + 0.5 && support === calm.support)
    .map(({ dcm: [x, y] }) => Math.hypot(x - calm.dcm[0], y - calm.dcm[1]));
  assert.ok(Math.max(...away) > 0.006, 'the divergent component moves when the robot is pushed');
  assert.ok(notes.some(({ kind, text }) => kind === 'accepted' && text.startsWith('teleop: ')), 'a request');
});

test('two runs are drawn over each other', async () => {
  await place.run('walk', '--lockstep', '--for', '4s', '--out', 'one');
  await place.run('walk', '--lockstep', '--for', '4s', '--out', 'two', '--seed', '7');
  const { url: both } = await place.view('one', 'two');
  const page = await browser.page(both);
  await until(() => page.evaluate(() => window.halfstep.runs.length === 2
    && window.halfstep.runs.every(({ robot }) => robot.group.parent !== null)));
});

/** Tiles, and steps up and down on the way. */
const UNEVEN = `
[[floor.step]]
from_m = 0.6
height_m = 0.012
length_m = 0.9
`;

test('the floor has its shape, and the soles stand on it, live and from the recording', async () => {
  const config = uneven.config((plant) => plant.replace(/^height_m = 0$/m, 'height_m = 0.003') + UNEVEN);
  const floor = (page) => page.evaluate(() => {
    const [{ timeline, floor: shape }] = window.halfstep.runs;
    const over = timeline.frames.filter((frame) => frame.floor).map((frame) => {
      shape.place(frame);
      const [x, y] = frame.support_sole;
      return { ...frame, over: shape.at(x, y).height, at: frame.floor[3] };
    });
    return { pieces: shape.buckets.size, over };
  });

  await uneven.run('walk', '--lockstep', '--for', '8s', '--out', 'uneven', '--config', config);
  const { url: recorded } = await uneven.view('uneven');
  const page = await browser.page(recorded);
  const walked = await until(async () => {
    const { pieces, over } = await floor(page);
    return pieces && over.length > 350 && over;
  });
  // In the middle of a half-step one foot alone bears, flat.
  const stood = walked.filter(({ progress, mode }) => mode === 'walking' && progress > 0.4 && progress < 0.6);
  assert.ok(stood.length > 50, `${stood.length} frames`);
  const off = Math.max(...stood.map(({ over }) => Math.abs(over)));
  assert.ok(off < 0.006, `a sole is ${off} m over or in the floor`);
  const climbed = Math.min(...walked.map(({ at }) => at));
  assert.ok(climbed < -0.008, `the world is at ${climbed} m: the step was not climbed`);

  const running = uneven.robot('--config', config);
  const { url: live } = await uneven.view('--instance', uneven.instance, '--config', config);
  const lively = await browser.page(live);
  await until(async () => (await floor(lively)).over.length > 0);
  assert.ok(Math.abs((await floor(lively)).over[0].over) < 0.006);
  await uneven.end(running);
});

test('no page has written an error to its console', () => {
  assert.deepEqual(browser.consoleErrors, []);
});
