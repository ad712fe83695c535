// The page that walks by itself: one file, opened from a disk, without a server.
import program from 'walk_thread';
import './walk_here.css';
import { openInstrument } from '../instrument/instrument_view.js';
import { openPage } from '../page.js';
import { readDropped } from './dropped_files.js';
import { compiled } from './packed_module.js';
import { onView } from './views.js';
import { WalkConnection } from './walk_connection.js';

/** How much a new measurement of the speed counts. */
const SMOOTHING = 0.05;
const $ = (id) => document.getElementById(id);

let connection = null;
/** Who walks, or is about to. */
let robot = null;
let factor = 0;
/** How far the walk is, and what was done in it. */
let news = null;

/** Adds what is only here to the page's handlers. */
function withWalk(handlers) {
  return {
    ...handlers,
    problem(text) {
      handlers.hint('');
      $('problem').hidden = false;
      $('problem-text').textContent = text;
    },
    imported(lines) {
      $('robot').append(new Option(robot.urdf.urdf.name, 'dropped', true, true));
      $('found').hidden = false;
      $('found-lines').textContent = lines.join('\n');
    },
    walked(walked) {
      news = walked;
      $('hash').textContent = walked.hash;
      $('hash-time').textContent = `after ${(walked.ticks / 1e3).toFixed(3)} s`;
    },
    factor(measured) {
      factor += (measured - factor) * (factor ? SMOOTHING : 1);
      $('factor').textContent = `${factor.toFixed(0)} × real time possible`;
    },
  };
}

function begin(next) {
  robot = next;
  factor = 0;
  $('problem').hidden = true;
  $('found').hidden = true;
  if ($('robot').value !== 'dropped' || next.in_the_box) {
    [...$('robot').options].filter(({ value }) => value === 'dropped').forEach((option) => option.remove());
  }
  connection.begin(robot, Number($('seed').value));
}

$('robot').onchange = () => {
  begin({ in_the_box: $('robot').value });
  $('robot').blur();
};
$('again').onclick = () => begin(robot);
$('walk-pace').onchange = () => connection.setPace(Number($('walk-pace').value));
$('problem-close').onclick = () => { $('problem').hidden = true; };

/** Offers a text as a file. */
function save(name, text) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type: 'text/plain' }));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}
$('save').onclick = () => {
  save('commands.jsonl', news.commands);
  if (news.disturbances) save('disturbances.toml', news.disturbances);
};

addEventListener('dragover', (event) => {
  event.preventDefault();
  document.body.classList.add('dropping');
});
addEventListener('dragleave', (event) => {
  if (!event.relatedTarget) document.body.classList.remove('dropping');
});
addEventListener('drop', async (event) => {
  event.preventDefault();
  document.body.classList.remove('dropping');
  location.hash = 'walk';
  try {
    begin({ urdf: await readDropped(event.dataTransfer.files) });
  } catch (error) {
    $('problem').hidden = false;
    $('problem-text').textContent = error.message;
  }
});

const module = compiled($('walker').textContent);
openPage((handlers) => {
  connection = new WalkConnection(withWalk(handlers), program, module);
  return connection;
});
const instrument = openInstrument(module);
onView((view) => {
  // What nobody sees neither walks nor is drawn.
  const isWalk = view === 'walk';
  connection.setPace(isWalk ? Number($('walk-pace').value) : 0);
  window.halfstep.viewport.scene.visible = isWalk;
  if (!isWalk) instrument.show();
});
connection.ready.then(() => begin({ in_the_box: $('robot').value }));

// For tests and for the console.
window.halfstep.here = {
  instrument,
  get connection() {
    return connection;
  },
  get robot() {
    return robot;
  },
  get news() {
    return news;
  },
};
