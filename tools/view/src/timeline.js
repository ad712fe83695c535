// The frames of a run in the order of their times: a recorded run whole, a live one as far as it is kept.

/** Longest time that is kept of a live run (s). */
const KEPT = 120;

export class Timeline {
  constructor(robot) {
    this.robot = robot;
    this.frames = [];
    this.notes = [];
    // Changes whenever frames come or go, so that others know when to look again.
    this.version = 0;
  }

  /** Adds a frame of a live run. One from before the last is of another controller: the run begins anew. */
  add(frame) {
    if (this.frames.length && frame.t < this.end) {
      this.frames = [];
      this.notes = [];
    }
    this.frames.push(frame);
    const old = this.frames.findIndex(({ t }) => t >= frame.t - KEPT);
    if (old > 200) this.frames.splice(0, old);
    this.version += 1;
  }

  /** Adds frames of a recorded run. */
  extend(frames) {
    this.frames.push(...frames);
    this.version += 1;
  }

  get begin() {
    return this.frames.length ? this.frames[0].t : 0;
  }

  get end() {
    return this.frames.length ? this.frames[this.frames.length - 1].t : 0;
  }

  get last() {
    return this.frames[this.frames.length - 1];
  }

  /** Index of the last frame that is not after a time; 0 if all are. */
  indexAt(time) {
    let [low, high] = [0, this.frames.length];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.frames[middle].t <= time) low = middle;
      else high = middle;
    }
    return low;
  }

  /** The two frames around a time and the share of the way between them. */
  around(time) {
    const index = this.indexAt(time);
    const before = this.frames[index];
    const after = this.frames[Math.min(index + 1, this.frames.length - 1)];
    const length = after.t - before.t;
    const share = length > 0 ? Math.min(1, Math.max(0, (time - before.t) / length)) : 0;
    return { before, after, share };
  }

  /** The frames between two times. */
  between(from, to) {
    const first = this.indexAt(from);
    return this.frames.slice(this.frames[first]?.t < from ? first + 1 : first, this.indexAt(to) + 1);
  }

  /** Where soles stood up to a time: x, y, heading and side of each support, the newest last. */
  footprints(time, count) {
    const prints = [];
    let last = null;
    for (let index = this.indexAt(time); index >= 0 && prints.length < count; index -= 1) {
      const frame = this.frames[index];
      if (!frame) break;
      if (last === null || frame.half_step !== last) prints.push([...frame.support_sole, frame.support]);
      last = frame.half_step;
    }
    return prints.reverse();
  }
}
