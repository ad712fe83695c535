// Values over time, the last seconds up to the time that is shown.
import uPlot from 'uplot';

const BEFORE = 10;
/** Height of a chart (px). */
const HEIGHT = 78;
const DEGREES = 180 / Math.PI;

/** A number on an axis, with k for thousands where it would not fit. */
const short = (value) => (Math.abs(value) < 1e4 ? `${value}` : `${value / 1e3}k`);
const milli = (value) => (value === null ? null : value * 1e3);
/** Title, unit, and the series of a chart: label, colour, value of a frame. */
const CHARTS = [
  {
    title: 'ZMP margin, mm', zero: true,
    series: [['measured', '#5ad1a0', ({ margin }) => milli(margin)]],
    compared: [['other run', '#d46ad0', ({ margin }) => milli(margin)]],
  },
  {
    title: 'Compensation, °', zero: true,
    series: [
      ['lean x', '#f2c14e', ({ lean }) => lean[0] * DEGREES],
      ['y', '#ff8a5c', ({ lean }) => lean[1] * DEGREES],
      ['plan x', '#6f8cff', ({ added }) => (added ? added[0] * DEGREES : null)],
      ['y', '#5cc8ff', ({ added }) => (added ? added[1] * DEGREES : null)],
    ],
  },
  {
    title: 'Velocity, m/s, rad/s', zero: true,
    series: [
      ['ahead', '#4aa3df', ({ velocity }) => velocity[0]],
      ['left', '#f0a060', ({ velocity }) => velocity[1]],
      ['turn', '#9aa7b5', ({ velocity }) => velocity[2]],
    ],
    compared: [['other run', '#d46ad0', ({ velocity }) => velocity[0]]],
  },
  {
    title: 'Force on the feet, N',
    series: [
      ['right', '#4aa3df', ({ loads }) => loads[0]],
      ['left', '#f0a060', ({ loads }) => loads[1]],
    ],
  },
  {
    title: 'Control period, µs',
    series: [
      ['computing', '#c99bff', ({ compute_us: compute }) => compute],
      ['jitter', '#ff5d5d', ({ jitter_us: jitter }) => jitter],
    ],
  },
];

export class Charts {
  constructor(parent, compares) {
    parent.replaceChildren();
    this.parent = parent;
    this.charts = CHARTS.map(({ title, zero, series, compared = [] }) => {
      const box = document.createElement('div');
      box.className = 'plot';
      const heading = document.createElement('h2');
      heading.textContent = title;
      const legend = document.createElement('div');
      legend.className = 'legend';
      const shown = compares ? [...series, ...compared] : series;
      shown.forEach(([label, colour]) => {
        const key = document.createElement('span');
        key.style.setProperty('--c', colour);
        key.textContent = label;
        legend.append(key);
      });
      heading.append(legend);
      box.append(heading);
      parent.append(box);
      const grid = { stroke: '#222b35', width: 1 };
      const axis = { stroke: '#8b98a8', grid, ticks: { show: false }, font: '10px system-ui' };
      const plot = new uPlot({
        width: 350, height: HEIGHT, cursor: { show: false }, legend: { show: false }, padding: [8, 6, 0, 0],
        scales: {
          x: { time: false },
          y: {
            range: (_, low, high) => {
              const zeros = zero ? [0] : [];
              const [least, most] = [Math.min(low ?? 0, ...zeros), Math.max(high ?? 1, ...zeros)];
              const room = Math.max(0.08 * (most - least), 1e-3);
              return [least - room, most + room];
            },
          },
        },
        axes: [
          { ...axis, size: 18, gap: 2 },
          { ...axis, size: 40, gap: 3, space: 16, values: (_, values) => values.map(short) },
        ],
        series: [{}, ...shown.map(([label, stroke]) => ({ label, stroke, width: 1.4, points: { show: false } }))],
      }, [[], ...shown.map(() => [])], box);
      return { plot, series, compared };
    });
    this.seen = '';
  }

  /** Shows the seconds up to a time; `other` is the run to compare with, if there is one. */
  show(timeline, time, other) {
    const seen = `${timeline.version} ${time.toFixed(3)} ${other?.version} ${this.parent.clientWidth}`;
    if (seen === this.seen) return;
    this.seen = seen;
    const frames = timeline.between(time - BEFORE, time);
    const times = frames.map(({ t }) => t);
    const others = other ? times.map((t) => other.frames[other.indexAt(t)]).map((frame, index) =>
      (frame && Math.abs(frame.t - times[index]) < 0.1 ? frame : null)) : null;
    const width = Math.max(200, this.parent.clientWidth - 2);
    this.charts.forEach(({ plot, series, compared }) => {
      const data = [times, ...series.map(([, , value]) => frames.map(value))];
      if (others) data.push(...compared.map(([, , value]) => others.map((frame) => (frame ? value(frame) : null))));
      if (plot.width !== width) plot.setSize({ width, height: HEIGHT });
      plot.setData(data, false);
      plot.setScale('x', { min: time - BEFORE, max: time });
    });
  }
}
