// The table of stated verdicts: what the paper says, what comes out, and by how much.

/** The rows are in so many columns, beside each other where there is room. */
const COLUMNS = 2;
const HEAD = ['fig', 'gait, lean', 'paper', 'here', '', 'margin (mm)'];
/** Margin at which the bar of a row is full (mm). */
const FULL = 40;

function cell(row, className, text) {
  const element = row.insertCell();
  element.className = className;
  element.textContent = text;
  return element;
}

/** Millimetres with a typographic minus; a point that is nowhere has none. */
export function millimetres(value) {
  return value === null ? '−∞' : value.toFixed(1).replace(/^-(?=0\.0$)/, '').replace('-', '−');
}

/** An empty table with its head, and the part for its rows. */
function table() {
  const element = document.createElement('table');
  const head = element.createTHead().insertRow();
  HEAD.forEach((text) => {
    const heading = document.createElement('th');
    heading.textContent = text;
    head.append(heading);
  });
  head.lastChild.colSpan = 2;
  return [element, element.createTBody()];
}

export class VerdictTable {
  /** `choose` is called with the number of a figure. */
  constructor(parent, choose) {
    this.bodies = Array.from({ length: COLUMNS }, () => {
      const [element, body] = table();
      parent.append(element);
      return body;
    });
    parent.onclick = ({ target }) => {
      const row = target.closest('tbody tr');
      if (row) choose(Number(row.dataset.figure));
    };
  }

  get rows() {
    return this.bodies.flatMap((body) => [...body.rows]);
  }

  clear() {
    this.bodies.forEach((body) => body.replaceChildren());
  }

  /** Shows verdicts, and where they differ from those of our reading. */
  show(verdicts, ours, chosen) {
    const rows = verdicts.map((verdict, index) => {
      const row = document.createElement('tr');
      const { figure, title, lean, paper, here, agrees, margin_mm: margin } = verdict;
      const isNew = agrees !== ours[index].agrees;
      row.dataset.figure = figure;
      row.className = [agrees ? 'agrees' : 'misses', isNew ? 'new' : '', figure === chosen ? 'chosen' : ''].join(' ');
      cell(row, 'number', figure);
      const gait = lean ? `${title}, ${lean}` : title;
      cell(row, 'gait', gait).title = gait;
      cell(row, 'word', paper);
      cell(row, 'word', here);
      cell(row, 'mark', agrees ? '✓' : '✗').title = isNew ? `with our numbers: ${ours[index].here}` : '';
      cell(row, 'number', millimetres(margin));
      const bar = cell(row, 'bar', '').appendChild(document.createElement('i'));
      const length = Math.min(Math.abs(margin ?? FULL), FULL) / FULL;
      bar.style.width = `${(50 * length).toFixed(1)}%`;
      bar.className = margin > 0 ? 'inside' : 'outside';
      return row;
    });
    const each = Math.ceil(rows.length / COLUMNS);
    this.bodies.forEach((body, column) => body.replaceChildren(...rows.slice(column * each, (column + 1) * each)));
  }

  /** Marks the chosen figure. */
  mark(chosen) {
    this.rows.forEach((row) => row.classList.toggle('chosen', Number(row.dataset.figure) === chosen));
  }
}
