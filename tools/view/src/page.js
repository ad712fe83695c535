// The page: one robot that walks, or recorded runs, whoever gives their frames.
import 'uplot/dist/uPlot.min.css';
import './style.css';
import { Charts } from './charts.js';
import { FloorMarks, GoalMark } from './floor_marks.js';
import { FloorShape } from './floor_shape.js';
import { Player } from './player.js';
import { PointerInput } from './pointer_input.js';
import { Robot } from './robot.js';
import { SolePlot } from './sole_plot.js';
import { Teleoperation } from './teleoperation.js';
import { Timeline } from './timeline.js';
import { Viewport } from './viewport.js';

const DEGREES = 180 / Math.PI;
/** Width of the panel for driving (px). */
const DRIVE_WIDTH = 424;
const ANSWERS = 4;
/** Time between two drawings of the charts (ms). */
const CHART_INTERVAL = 100;
const MODE_BADGES = {
  walking: 'good', 'in place': 'good', starting: 'warn', stopping: 'warn', fallen: 'bad', faulted: 'bad',
};

/** What is said beside the mode: nothing while the robot is balanced. */
const BALANCE_BADGES = { 'catching itself': 'warn', falling: 'bad' };

const $ = (id) => document.getElementById(id);
const viewport = new Viewport($('viewport'));
const player = new Player();
/** The runs that are shown: each with its timeline, robot and marks on the floor. */
const runs = [];
let charts = null;
let sole = null;
let goal = null;
let instance = '';
let liveRobot = '';

function hint(text) {
  $('hint').hidden = !text;
  $('hint').textContent = text;
}

function clear() {
  runs.splice(0).forEach(({ robot, marks, floor }) => {
    viewport.scene.remove(robot.group, marks.group, floor.group);
    robot.dispose();
    floor.dispose();
  });
}

function begin(index, drawing, name) {
  if (index === 0) clear();
  const ghost = index > 0;
  const [timeline, robot, marks] = [new Timeline(drawing), new Robot(drawing, ghost), new FloorMarks(drawing, ghost)];
  const run = { name, timeline, robot, marks, floor: new FloorShape() };
  runs[index] = run;
  if (index === 0) {
    viewport.fit(drawing.scale);
    sole = new SolePlot($('sole'), drawing);
    if (goal) viewport.scene.remove(goal.group);
    goal = new GoalMark(drawing.scale);
    viewport.scene.add(goal.group);
    pointer.goal = goal;
  }
  charts = new Charts($('plots'), ghost);
}

/** Where frames come from and commands go to. */
let connection = null;

/** What a connection calls with each kind of message. */
const handlers = {
  live({ instance: name, robot, rate_hz: rate }) {
    instance = `${robot.name} · instance ${name} · ${rate} Hz`;
    // After a silence it is mostly the same robot: what was seen of it stays.
    const text = JSON.stringify(robot);
    if (text !== liveRobot) {
      liveRobot = text;
      begin(0, robot, name);
      player.begin(true);
    }
    teleoperation.scale = robot.scale;
    $('drive').hidden = false;
    $('stop').hidden = false;
    hint('');
  },
  waiting({ why }) {
    hint(why);
  },
  frame(frame) {
    runs[0]?.timeline.add(frame);
  },
  floor({ index, pieces }) {
    runs[index]?.floor.set(pieces);
  },
  driver(driver) {
    teleoperation.setDriver(driver);
    viewport.resize(driver.you ? DRIVE_WIDTH : 0);
  },
  answer({ verdict, text }) {
    note(verdict, text, runs[0]?.timeline.end);
  },
  run({ index, name, robot }) {
    begin(index, robot, name);
    instance = runs.map((run) => run.name).join(' · compared with ');
    if (index === 0) player.begin(false);
    hint('');
  },
  frames({ index, frames }) {
    runs[index].timeline.extend(frames);
  },
  events({ index, events }) {
    runs[index].timeline.notes = events;
  },
  lost() {
    teleoperation.setDriver({ you: false, taken: false });
    hint('the connection to halfstep view is lost; is it running?');
  },
};

const teleoperation = new Teleoperation((message) => connection.send(message));
teleoperation.setDriver({ you: false, taken: false });
const pointer = new PointerInput(viewport, {
  robot: () => runs[0]?.robot,
  goal,
  drives: () => teleoperation.drives && player.isLive,
  walkTo: ([x, y, z], heading) => {
    goal.show([x, y, z], heading);
    const rounded = (value) => Math.round(value * 1e3) / 1e3;
    const place = { x_m: rounded(x), y_m: rounded(y) };
    if (heading !== null) place.heading_deg = rounded(heading * DEGREES);
    teleoperation.command({ goto: place });
  },
  push: ({ joint, impulse: [x, y, z], lasts_s: lasts }) => {
    // As the robot faces.
    const heading = runs[0].timeline.last.pose[2];
    const [c, s] = [Math.cos(heading), Math.sin(heading)];
    connection.send({ push: { joint, impulse: [c * x + s * y, c * y - s * x, z], lasts_s: lasts } });
  },
});

function note(kind, text, time) {
  const item = document.createElement('li');
  item.className = kind;
  const clock = document.createElement('time');
  clock.textContent = time === undefined ? '' : `${time.toFixed(2)} s`;
  item.append(clock, text);
  $('answers').append(item);
  while ($('answers').children.length > ANSWERS) $('answers').firstChild.remove();
}

/** Shows what happened in a recorded run just before a time. */
let shownNotes = '';
function showNotes(timeline, time) {
  const before = timeline.notes.filter(({ t }) => t <= time).slice(-ANSWERS);
  const key = before.map(({ t, text }) => `${t} ${text}`).join();
  if (key === shownNotes) return;
  shownNotes = key;
  $('answers').replaceChildren();
  before.forEach(({ kind, text, t }) => note(kind, text, t));
}

/** A number with some decimals, without the sign of a zero. */
const fixed = (value, digits) => (Number(value.toFixed(digits)) + 0).toFixed(digits);

let shownFacts = '';
function showFacts(frame) {
  const [x, y, heading] = frame.pose;
  const [ahead, left, turn] = frame.velocity;
  const facts = [
    ['half-step', `${frame.half_step} ${frame.support ? 'left' : 'right'}`],
    ['v', `${fixed(ahead, 2)}, ${fixed(left, 2)} m/s, ${fixed(turn * DEGREES, 0)}°/s`],
    ['at', `${fixed(x, 2)}, ${fixed(y, 2)} m, ${fixed(heading * DEGREES, 0)}°`],
  ];
  if (frame.destination) {
    const [places, distance] = frame.destination;
    facts.push(['goal', places ? `${distance.toFixed(2)} m away` : 'reached']);
  }
  if (frame.missed) facts.push(['missed', `${frame.missed} deadlines`]);
  const balance = BALANCE_BADGES[frame.capturability];
  const key = JSON.stringify([facts, frame.mode, frame.capturability, frame.faults, instance]);
  if (key === shownFacts) return;
  shownFacts = key;
  $('instance').textContent = instance;
  $('mode').textContent = frame.mode;
  $('mode').className = `badge ${MODE_BADGES[frame.mode] ?? ''}`;
  $('balance').textContent = balance ? frame.capturability : '';
  $('balance').className = `badge ${balance ?? ''}`;
  $('balance').hidden = !balance;
  $('facts').replaceChildren(...facts.map(([name, value]) => {
    const row = document.createElement('div');
    const [term, text] = [document.createElement('dt'), document.createElement('dd')];
    [term.textContent, text.textContent] = [name, value];
    row.append(term, text);
    return row;
  }));
  $('faults').replaceChildren(...frame.faults.map((fault) => {
    const chip = document.createElement('span');
    chip.textContent = fault;
    return chip;
  }));
  $('sole-side').textContent = `${frame.support ? 'left' : 'right'} foot, from above`;
  if (frame.destination && frame.destination[0] === 0) goal.hide();
}

let last = performance.now();
let charted = 0;
let marked = '';
function draw(now) {
  requestAnimationFrame(draw);
  const seconds = Math.min((now - last) / 1e3, 0.2);
  last = now;
  const shown = runs.filter(({ timeline }) => timeline.frames.length);
  if (shown.length && shown[0] === runs[0]) {
    const begin = Math.min(...shown.map(({ timeline }) => timeline.begin));
    const end = Math.max(...shown.map(({ timeline }) => timeline.end));
    const time = player.advance(seconds, begin, end);
    const key = `${begin} ${end} ${shown.map(({ timeline }) => timeline.notes.length)}`;
    if (!player.isLive && key !== marked) {
      marked = key;
      player.mark(runs[0].timeline.notes, begin, end);
    }
    shown.forEach(({ timeline, robot, marks, floor }) => {
      if (!robot.group.parent) viewport.scene.add(robot.group, marks.group, floor.group);
      floor.place(timeline.frames[timeline.indexAt(time)]);
      robot.pose(timeline.around(time));
      marks.show(timeline, time, floor);
    });
    const { timeline, robot, floor } = runs[0];
    viewport.showFloor(floor.origin ? floor : null);
    const frame = timeline.frames[timeline.indexAt(time)];
    viewport.track(robot.middle(), seconds);
    showFacts(frame);
    if (player.isLive) teleoperation.showGait(frame.gait);
    else showNotes(timeline, time);
    if (now - charted > CHART_INTERVAL) {
      charted = now;
      sole.draw(timeline, time);
      charts.show(timeline, time, runs[1]?.timeline);
    }
  }
  viewport.draw();
}
requestAnimationFrame(draw);

// What is drawn, for tests and for the console.
window.halfstep = {
  runs,
  player,
  viewport,
  teleoperation,
  /** The frame that is shown. */
  get frame() {
    const timeline = runs[0]?.timeline;
    return timeline?.frames[timeline.indexAt(player.time)];
  },
  /** The last goal that was asked for. */
  get goal() {
    return goal.group.position.toArray();
  },
};

/** Opens the page on a connection, which `connect` makes for these handlers. */
export function openPage(connect) {
  connection = connect({ ...handlers, hint });
}
