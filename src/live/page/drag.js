// Where the input goes: along the course, never across a limit, and after a joint that is dragged.

class Track {
  /** @param {any} course */
  constructor(course) {
    this.course = course;
    const { range, whole_turn: whole } = course.live.variable;
    [this.from, this.to] = range;
    this.whole = whole;
    /** Ranges that can be gone through without taking anything apart. @type {{from: number, to: number, apart: boolean}[]} */
    this.regions = [];
    for (const stretch of course.stretches) {
      const last = this.regions.at(-1);
      if (last && last.to === stretch.from && last.apart === stretch.apart) last.to = stretch.to;
      else this.regions.push({ from: stretch.from, to: stretch.to, apart: stretch.apart });
    }
    const first = this.regions[0], last = this.regions.at(-1);
    this.round = whole && first && first.from === this.from && last.to === this.to && first.apart === last.apart;
  }

  /** @param {number} at */
  regionAt(at) {
    return this.regions.find((r) => at >= r.from && at <= r.to);
  }

  /** From a place by a way, as far as it goes. */
  go(/** @type {number} */ at, /** @type {number} */ by) {
    const turn = this.to - this.from;
    let region = this.regionAt(at), to = at + by;
    while (region) {
      const end = to > region.to ? 'to' : to < region.from ? 'from' : null;
      if (!end) return { at: to, stopped: false };
      if (!this.round || region[end] !== this[end]) return { at: region[end], stopped: true };
      to += end === 'to' ? -turn : turn;
      region = this.regions.at(end === 'to' ? 0 : -1);
    }
    return { at, stopped: true };
  }

  /** The nearest place to a wish that lies on the same region; and whether it was the wish. */
  nearest(/** @type {number} */ at, /** @type {number} */ wish) {
    const region = this.regionAt(at);
    if (!region) return { at, stopped: true };
    if (wish >= region.from && wish <= region.to) return { at: wish, stopped: false };
    const other = this.regionAt(wish);
    const joined = this.round && other && !other.apart && !region.apart
      && [region, other].every((r) => r.from === this.from || r.to === this.to);
    if (joined) return { at: wish, stopped: false };
    // Round a whole turn either end may be the nearer one.
    const off = (/** @type {number} */ end) => {
      const way = Math.abs(end - wish), turn = this.to - this.from;
      return this.whole ? Math.min(way, turn - way) : way;
    };
    // Where the course goes on round the turn, its seam is no end.
    const next = !this.round || region.apart ? region : region.from === this.from ? this.regions.at(-1) || region : region.to === this.to ? this.regions[0] : region;
    const ends = [region, next].flatMap(({ from, to }) => [from, to]).filter((end) => next === region || (end !== this.from && end !== this.to));
    return { at: ends.reduce((best, end) => (off(end) < off(best) ? end : best)), stopped: true };
  }
}

/** A point that is led is where it is wanted, mm. */
const HELD = 0.05;

/** Leads a point of a frame as near to a point as the course allows, by at most so much of the input. */
function seekSpot(/** @type {any} */ course, /** @type {Track} */ track, /** @type {Panel} */ panel, /** @type {any} */ spot,
  /** @type {{x: number, y: number}} */ wish, /** @type {number} */ at, /** @type {number} */ most) {
  const { program, live } = course;
  const [frame, own] = spot, [kind, one, other] = frame;
  const places = kind === 2 || kind === 3 ? [one, other] : [one];
  // A frame is told by places, or by one and outputs.
  const more = kind === 4 ? [other] : kind === 5 ? [other, other + 1] : [];
  const outputs = [...places.flatMap((place) => panel.data.places[place].flatMap((/** @type {number[]} */ term) => [term[1], term[1] + 1])), ...more];
  const rows = outputs.map((output) => live.outputs[output].row);
  const steps = program.behind(rows);
  const cost = (/** @type {number} */ by) => {
    const to = track.go(at, by).at;
    const stretch = course.stretchAt(to);
    if (!stretch) return Infinity;
    program.run(steps, to, stretch.signs);
    /** @type {any[]} */
    const numbers = [];
    outputs.forEach((output, i) => { numbers[output] = program.quick[rows[i]]; });
    const held = globalOf(frame, own, panel.seen(numbers, places));
    return held ? sizeOf(minus(held, wish)) : Infinity;
  };
  // Local descent: from here down, to the first place from which it would go up again.
  let by = 0, best = cost(0), step = most / 8;
  for (let i = 0; i < 40 && step > most * 1e-5; i++) {
    const [down, up] = [by - step, by + step].map((next) => (Math.abs(next) <= most ? cost(next) : Infinity));
    if (up < best && up <= down) {
      by += step;
      best = up;
    } else if (down < best) {
      by -= step;
      best = down;
    } else {
      step /= 2.5;
    }
  }
  // At a limit whoever wants further is stopped there, as he was when he came.
  const found = track.go(at, by);
  return best > HELD && [-1, 1].some((way) => track.go(found.at, way * most * 1e-5).stopped) ? { ...found, stopped: true } : found;
}
