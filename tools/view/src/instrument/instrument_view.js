// The second view of the page: the paper as an instrument. Numbers are turned, and verdicts and a figure follow.
import program from 'instrument_thread';
import './instrument.css';
import { DialPanel } from './dial_panel.js';
import { InstrumentConnection } from './instrument_connection.js';
import { VerdictTable, millimetres } from './verdict_table.js';

/** The figure that is drawn first: its verdict does not come out with our numbers, and does with others. */
const FIRST_FIGURE = 32;
const $ = (id) => document.getElementById(id);

/** The picture of a figure, of the size of its place. */
function pictureOf({ svg, summary }) {
  const picture = document.adoptNode(new DOMParser().parseFromString(svg, 'image/svg+xml').documentElement);
  const [width, height] = ['width', 'height'].map((side) => picture.getAttribute(side));
  picture.setAttribute('viewBox', `0 0 ${width} ${height}`);
  ['width', 'height'].forEach((side) => picture.removeAttribute(side));
  picture.setAttribute('role', 'img');
  picture.setAttribute('aria-label', summary);
  return picture;
}

class InstrumentView {
  constructor(module) {
    this.module = module;
    this.connection = null;
    this.panel = null;
    /** The verdicts of our reading. */
    this.ours = null;
    /** The last answer, and in how many seconds it was computed; null if there is none to the last question. */
    this.answer = null;
    this.seconds = 0;
    this.figure = FIRST_FIGURE;
    this.table = new VerdictTable($('verdicts'), (figure) => this.choose(figure));
    $('figure').onchange = () => this.choose(Number($('figure').value));
    $('reset-dials').onclick = () => {
      this.panel.reset();
      this.ask();
    };
  }

  /** Begins to compute when it is seen for the first time. */
  show() {
    this.connection ??= new InstrumentConnection({
      dials: (dials) => this.#begin(dials),
      answer: (answer, seconds) => this.#tell(answer, seconds),
      problem: (text) => this.#refuse(text),
    }, program, this.module);
  }

  get isSettled() {
    return Boolean(this.connection?.isSettled && this.panel);
  }

  choose(figure) {
    this.figure = figure;
    $('figure').value = figure;
    this.table.mark(figure);
    this.ask();
  }

  ask() {
    $('reset-dials').disabled = !this.panel.isTurned;
    this.connection.ask({ ...this.panel.question, figure: this.figure });
  }

  #begin(dials) {
    this.panel = new DialPanel($('dials'), dials, () => this.ask());
    dials.figures.forEach(({ figure, title }) => $('figure').append(new Option(`${figure}: ${title}`, figure)));
    this.choose(this.figure);
  }

  #tell(answer, seconds) {
    [this.answer, this.seconds] = [answer, seconds];
    const { agree, verdicts, drawn } = answer;
    this.ours ??= answer;
    document.body.classList.remove('no-answer');
    $('refusal').hidden = true;
    $('agree').textContent = `${agree} of ${verdicts.length}`;
    $('compared').textContent = `stated verdicts come out, ${this.#compared(agree)}`;
    this.table.show(verdicts, this.ours.verdicts, this.figure);
    $('drawn').replaceChildren(pictureOf(drawn));
    $('note').textContent = drawn.note ?? '';
    const took = `computed in ${(seconds * 1e3).toFixed(0)} ms`;
    $('facts-of-figure').textContent = `least margin ${millimetres(drawn.margin_mm)} mm · ${took}`;
  }

  #compared(agree) {
    const away = agree - this.ours.agree;
    if (away) return `${Math.abs(away)} ${away > 0 ? 'more' : 'fewer'} than with our numbers`;
    return this.panel.isTurned ? 'as many as with our numbers' : 'with our numbers';
  }

  /** Says why there is no answer: what was shown before is not that of these numbers, and goes. */
  #refuse(text) {
    this.answer = null;
    document.body.classList.add('no-answer');
    $('refusal').hidden = false;
    $('refusal-text').textContent = text;
    $('agree').textContent = 'no verdicts';
    $('compared').textContent = '';
    this.table.clear();
    $('drawn').replaceChildren();
    $('note').textContent = '';
    $('facts-of-figure').textContent = '';
  }
}

/** The instrument, which begins when it is shown; `module` is the promise of the compiled module. */
export const openInstrument = (module) => new InstrumentView(module);
