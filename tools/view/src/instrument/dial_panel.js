// The dials: a slider for each number, a list for each choice. Each says whether the paper states it or leaves it open.
import { CHOICES, GROUPS, reader } from './dial_names.js';

function made(tag, className, text = '') {
  const element = document.createElement(tag);
  element.className = className;
  element.textContent = text;
  return element;
}

/** A slider; the track shows the plausible range and the value of our reading. */
function slider(dial, label, turned) {
  const row = made('label', 'dial');
  const input = made('input', '');
  const [output, tag] = [made('output', ''), made('span', 'tag', 'open')];
  const [least, greatest] = dial.reach;
  const share = (value) => ((value - least) / (greatest - least)).toFixed(4);
  const read = reader(dial.name, dial.grain);
  Object.assign(input, { type: 'range', id: `dial-${dial.name}`, min: least, max: greatest, step: dial.grain });
  const track = made('span', 'track');
  const ends = dial.plausible.map(read).join(' to ');
  row.title = `${ends}: ${dial.basis}. Ours: ${read(dial.value)}`;
  Object.entries({ '--from': dial.plausible[0], '--to': dial.plausible[1], '--ours': dial.value })
    .forEach(([name, value]) => track.style.setProperty(name, share(value)));
  track.append(input);
  const show = () => {
    const value = Number(input.value);
    output.textContent = read(value);
    row.classList.toggle('turned', Math.abs(value - dial.value) > dial.grain / 2);
    row.classList.toggle('implausible', value < dial.plausible[0] || value > dial.plausible[1]);
  };
  input.oninput = () => {
    show();
    turned();
  };
  row.append(made('span', 'name', label), track, output, tag);
  return {
    row,
    name: dial.name,
    value: () => Number(input.value),
    isTurned: () => row.classList.contains('turned'),
    reset() {
      input.value = dial.value;
      show();
    },
  };
}

/** A list of choices. */
function list(dial, label, turned) {
  const row = made('label', 'dial');
  const select = made('select', '');
  const named = (choice) => CHOICES[choice] ?? choice;
  select.id = `dial-${dial.name}`;
  dial.choices.forEach((choice) => select.append(new Option(named(choice), choice)));
  const tag = made('span', dial.stated ? 'tag stated' : 'tag', 'open');
  row.title = dial.stated ? `The paper: ${named(dial.stated)}. Ours: ${named(dial.value)}`
    : `The paper states both. Ours: ${named(dial.value)}`;
  const show = () => {
    row.classList.toggle('turned', select.value !== dial.value);
    if (!dial.stated) return;
    const differs = select.value !== dial.stated;
    tag.classList.toggle('differs', differs);
    tag.textContent = differs ? 'differs' : 'stated';
  };
  select.onchange = () => {
    show();
    turned();
  };
  row.append(made('span', 'name', label), select, tag);
  return {
    row,
    name: dial.name,
    value: () => select.value,
    isTurned: () => row.classList.contains('turned'),
    reset() {
      select.value = dial.value;
      show();
    },
  };
}

export class DialPanel {
  /** `turned` is called when something was turned. */
  constructor(parent, { numbers, choices }, turned) {
    const numberNames = new Set(numbers.map(({ name }) => name));
    const all = new Map([...numbers, ...choices].map((dial) => [dial.name, dial]));
    this.numbers = [];
    this.choices = [];
    GROUPS.forEach(([title, members]) => {
      const group = made('section', 'dials');
      group.append(made('h2', '', title));
      members.forEach(([name, label]) => {
        const isNumber = numberNames.has(name);
        const control = (isNumber ? slider : list)(all.get(name), label, turned);
        (isNumber ? this.numbers : this.choices).push(control);
        group.append(control.row);
      });
      parent.append(group);
    });
    this.reset();
  }

  /** Back to our reading. */
  reset() {
    [...this.numbers, ...this.choices].forEach((control) => control.reset());
  }

  get isTurned() {
    return [...this.numbers, ...this.choices].some((control) => control.isTurned());
  }

  /** What differs from our reading, as a question. */
  get question() {
    const differing = (controls) => controls.filter((control) => control.isTurned());
    const values = (controls) => Object.fromEntries(differing(controls).map(({ name, value }) => [name, value()]));
    return { numbers: values(this.numbers), ...values(this.choices) };
  }
}
