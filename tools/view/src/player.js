// The time that is shown: the newest of a live run, or any of a recorded or a paused one.

export class Player {
  constructor() {
    this.$ = (id) => document.getElementById(id);
    this.time = 0;
    this.follows = true;
    this.plays = false;
    this.isLive = true;
    const slider = this.$('time');
    slider.oninput = () => {
      this.follows = false;
      this.plays = false;
      this.time = Number(slider.value);
    };
    this.$('play').onclick = () => this.toggle();
    this.$('live').onclick = () => { this.follows = true; };
    addEventListener('keydown', (event) => {
      if (this.isLive || event.target.matches('select')) return;
      const step = { ArrowLeft: -0.02, ArrowRight: 0.02, PageUp: -1, PageDown: 1 }[event.code];
      if (event.code === 'Space') this.toggle();
      else if (step) this.seek(this.time + step);
      else return;
      event.preventDefault();
    });
  }

  /** A live run, or a recorded one. */
  begin(isLive) {
    this.isLive = isLive;
    this.follows = isLive;
    this.plays = !isLive;
    this.time = 0;
    this.$('live').hidden = !isLive;
    this.$('pace').hidden = isLive;
  }

  toggle() {
    if (this.isLive) {
      this.follows = !this.follows;
      return;
    }
    this.plays = !this.plays;
    if (this.plays && this.time >= this.end - 1e-3) this.time = this.first;
  }

  seek(time) {
    this.plays = false;
    this.follows = false;
    this.time = time;
  }

  /** Marks what happened on the track. */
  mark(notes, begin, end) {
    this.$('marks').replaceChildren(...notes.map(({ t, kind, text }) => {
      const mark = document.createElement('i');
      mark.className = kind;
      mark.title = text;
      mark.style.left = `${(100 * (t - begin)) / Math.max(end - begin, 1e-3)}%`;
      return mark;
    }));
  }

  /** Goes on by some seconds of the wall clock, and gives the time to show. */
  advance(seconds, begin, end) {
    [this.first, this.end] = [begin, end];
    if (this.isLive) {
      if (this.follows) this.time = end;
    } else if (this.plays) {
      this.time += seconds * Number(this.$('pace').value);
      if (this.time >= end) this.plays = false;
    }
    this.time = Math.min(end, Math.max(begin, this.time));
    const slider = this.$('time');
    if (!slider.matches(':active') || this.follows) {
      slider.min = begin;
      slider.max = end;
      slider.value = this.time;
    }
    this.$('clock').textContent = `${this.time.toFixed(2)} / ${end.toFixed(1)} s`;
    this.$('play').textContent = (this.isLive ? this.follows : this.plays) ? '❚❚' : '▶';
    this.$('live').classList.toggle('on', this.isLive && this.follows);
    return this.time;
  }
}
