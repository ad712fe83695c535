// The thread that walks: controller and plant as a WebAssembly module, beside the page that shows them.
//
// In: `{ module }`, then `{ begin }`, `{ hear }` with a message as `halfstep view` takes it, `{ pace }` in simulated
// seconds per second (0 stops), `{ walk }` with the number of periods to walk as fast as it can. Out: texts of
// messages as `halfstep view` sends them, and how fast it walks.

import { ModuleTexts } from './module_texts.js';

/** Time between two looks at the clock (ms), which is that between two frames. */
const INTERVAL = 25;
/** Most wall-clock time that is made up for (s). */
const CATCH_UP = 0.1;
/** Periods per second of the robot. */
const RATE = 1000;
/** Periods from frame to frame: at least and, at a high pace, at most. */
const SLICE = 25;
const SLICE_MAX = 250;

let walker = null;
let texts = null;
let pace = 1;
let last = 0;
/** Periods that are due, with their fraction. */
let owed = 0;

/** Gives the module a text for one of its functions, and the page what the module says. */
function call(name, text) {
  texts.give(text);
  walker[name]();
  say();
}

function say(more = {}) {
  postMessage({ texts: texts.said(), ...more });
}

/** Walks on by some periods; tells how many times as fast as in reality that was possible. */
function walk(ticks) {
  const began = performance.now();
  walker.halfstep_walk(ticks);
  say({ factor: ticks / RATE / Math.max((performance.now() - began) / 1e3, 1e-6) });
}

function walkAtPace() {
  const now = performance.now();
  owed += Math.min((now - last) / 1e3, CATCH_UP) * pace * RATE;
  last = now;
  const slice = Math.min(SLICE_MAX, Math.max(SLICE, Math.round((pace * RATE * INTERVAL) / 1e3)));
  while (owed >= SLICE) {
    const ticks = Math.min(Math.floor(owed), slice);
    walk(ticks);
    owed -= ticks;
    // Too slow for this pace: what is missing stays missing.
    if (performance.now() - now > INTERVAL) owed = 0;
  }
}

onmessage = async ({ data }) => {
  if (data.module) {
    walker = (await WebAssembly.instantiate(data.module, {})).exports;
    texts = new ModuleTexts(walker);
    last = performance.now();
    setInterval(walkAtPace, INTERVAL);
    postMessage({ texts: [], ready: true });
  } else if (data.begin) {
    call('halfstep_begin', JSON.stringify(data.begin));
    [last, owed] = [performance.now(), 0];
  } else if (data.hear) call('halfstep_hear', JSON.stringify(data.hear));
  else if (data.pace !== undefined) [pace, owed, last] = [data.pace, 0, performance.now()];
  else if (data.walk !== undefined) {
    const began = performance.now();
    for (let left = data.walk; left > 0; left -= SLICE_MAX) walk(Math.min(left, SLICE_MAX));
    postMessage({ texts: [], walked: { ticks: data.walk, seconds: (performance.now() - began) / 1e3 } });
  }
};
