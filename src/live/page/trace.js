// Curves over the course: the paths of places in a panel, and diagrams over the input.

/** So many equal steps over the range. */
const PLACES = 720;

/** The places of the course at which curves are reckoned: equal steps and every event, each with its stretch. */
function courseNodes(/** @type {any} */ course) {
  const events = course.events.map((/** @type {any} */ event) => event.at);
  return [...equalSteps(course.live.variable.range, PLACES), ...events].sort((a, b) => a - b);
}

/** Numbers over the course, one list for each part that hangs together: [[at, values], ...]. Where one is not known it
 * hangs together no more. @param {(found: any) => (number | null)[]} values */
function curves(/** @type {any} */ course, values) {
  const runs = [];
  let run = [], last = null;
  for (const at of courseNodes(course)) {
    const stretch = course.stretchAt(at);
    if (stretch !== last && (!stretch || !last || stretch.from !== last.to || stretch.apart)) {
      if (run.length > 1) runs.push(run);
      run = [];
    }
    last = stretch;
    if (!stretch) continue;
    const here = values(course.look(at)), known = !here.includes(null);
    const ends = course.events.some((/** @type {any} */ event) => event.kind === 'limit' && event.at === at);
    if (known && !(ends && run.length === 0)) run.push([at, here]);
    if (ends || !known) {
      if (run.length > 1) runs.push(run);
      run = [];
    }
  }
  if (run.length > 1) runs.push(run);
  return runs;
}

/** The path over the course of what stands beside a place of a panel. */
function tracePath(/** @type {any} */ course, /** @type {Panel} */ panel, /** @type {number} */ place, /** @type {number[]} */ [dx, dy]) {
  const terms = panel.data.places[place];
  const outputs = terms.flatMap((/** @type {number[]} */ term) => [term[1], term[1] + 1]);
  const [x0, y0, x1, y1] = panel.data.box;
  let path = '';
  for (const run of curves(course, (found) => outputs.map((output) => found[output]))) {
    let pen = false;
    for (const [, values] of run) {
      let x = 0, y = 0;
      terms.forEach((/** @type {number[]} */ term, /** @type {number} */ i) => {
        x += term[0] * values[2 * i];
        y += term[0] * values[2 * i + 1];
      });
      const px = (x - panel.data.origin[0]) / panel.siPerMm + dx, py = -(y - panel.data.origin[1]) / panel.siPerMm + dy;
      const inside = px > x0 && px < x1 && py > y0 && py < y1;
      if (inside) path += `${pen ? 'L' : 'M'}${px.toFixed(3)} ${py.toFixed(3)}`;
      pen = inside;
    }
  }
  return path;
}

/** The next of some numbers and their tenfolds. */
function roundUp(/** @type {number} */ least, steps = [1, 2, 5]) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * (steps.find((step) => step * power >= least * (1 - 1e-12)) || 10);
}

/** A diagram of one output over the input, in a box of 1000 by 320. */
class CurveDiagram {
  constructor(/** @type {any} */ course, /** @type {(at: number) => void} */ seek) {
    this.course = course;
    this.svg = makeInk('svg', { class: 'diagram', viewBox: '0 0 1000 320', preserveAspectRatio: 'none', role: 'img' });
    this.curve = makeInk('path', { class: 'curve' });
    this.zero = makeInk('path', { class: 'zero' });
    this.marks = makeInk('g');
    this.cursor = makeInk('path', { class: 'cursor' });
    this.svg.append(this.marks, this.zero, this.curve, this.cursor);
    const [from, to] = course.live.variable.range;
    this.xOf = (/** @type {number} */ at) => (at - from) / (to - from) * 1000;
    const go = (/** @type {PointerEvent} */ event) => {
      const box = this.svg.getBoundingClientRect();
      seek(from + (to - from) * Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)));
    };
    this.svg.addEventListener('pointerdown', (event) => {
      this.svg.setPointerCapture(event.pointerId);
      go(event);
    });
    this.svg.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) go(event);
    });
    this.numbers = make('div', { class: 'numbers', 'aria-hidden': 'true' });
    this.grid = makeInk('path', { class: 'grid' });
    this.svg.prepend(this.grid);
    for (const event of course.events) {
      const x = this.xOf(event.at).toFixed(1);
      if (event.kind !== 'least' && event.kind !== 'greatest') this.marks.append(makeInk('path', { class: 'event', d: `M${x} 0 V320` }));
    }
  }

  /** @param {any} quantity @param {number} axis @param {any} variable */
  draw(quantity, axis, variable) {
    const { course } = this, own = quantity.outputs, isSize = axis < 0 && own.length === 2;
    const number = (/** @type {any} */ found) => {
      const index = own[Math.max(0, axis)];
      if (found[index] === null || (isSize && found[index + 1] === null)) return null;
      return isSize ? clearVector(course, found, index)[0] : clearNumber(course, found, index);
    };
    const runs = curves(course, (found) => [number(found)]).map((run) => run.map(([at, [value]]) => [at, value / quantity.si]));
    const sizes = runs.flat().map((node) => node[1]).sort((a, b) => a - b);
    if (sizes.length === 0) return { low: 0, high: 0 };
    // Where it grows without end the curve leaves the box.
    const cut = Math.floor(sizes.length / 50);
    let low = Math.min(0, sizes[cut]), high = Math.max(0, sizes[sizes.length - 1 - cut]);
    const room = (high - low || 1) * 0.06;
    low -= room;
    high += room;
    const y = (/** @type {number} */ value) => Math.min(1000, Math.max(-680, 320 - (value - low) / (high - low) * 320)).toFixed(1);
    // From beyond one border to beyond the other it goes through infinity, not through the box.
    const side = (/** @type {number} */ value) => (value > high ? 1 : value < low ? -1 : 0);
    setPath(this.curve, runs.map((run) => run.map((node, i) => {
      const through = i > 0 && side(node[1]) * side(run[i - 1][1]) < 0;
      return `${i && !through ? 'L' : 'M'}${this.xOf(node[0]).toFixed(1)} ${y(node[1])}`;
    }).join('')).join(''));
    setPath(this.zero, `M0 ${y(0)} H1000`);
    this.tick(low, high, variable);
    return { low: low + room, high: high - room };
  }

  /** Lines at round numbers, and the numbers beside the box, in the unit of each. */
  tick(/** @type {number} */ low, /** @type {number} */ high, /** @type {any} */ variable) {
    const [from, to] = variable.range.map((/** @type {number} */ end) => end / variable.si);
    this.numbers.replaceChildren();
    let grid = '';
    const put = (/** @type {number} */ value, /** @type {number} */ part, /** @type {string} */ axis) => {
      grid += axis === 'x' ? `M${(1000 * part).toFixed(1)} 0V320` : `M0 ${(320 - 320 * part).toFixed(1)}H1000`;
      const tick = make('bdi', { class: axis });
      setRich(tick, stated(value));
      if (axis === 'x') tick.style.left = `${(100 * part).toFixed(2)}%`;
      else tick.style.bottom = `${(100 * part).toFixed(2)}%`;
      this.numbers.append(tick);
    };
    const degrees = variable.unit === 'deg' && to - from >= 90 ? (to - from > 400 ? 180 : 45) : 0;
    for (const [least, most, axis, step] of [[from, to, 'x', degrees || roundUp((to - from) / 6)], [low, high, 'y', roundUp((high - low) / 5)]]) {
      for (let i = Math.ceil(least / step); i * step <= most; i++) put(Number((i * step).toPrecision(12)), (i * step - least) / (most - least), axis);
    }
    setPath(this.grid, grid);
  }

  /** @param {number} at */
  show(at) {
    setPath(this.cursor, `M${this.xOf(at).toFixed(1)} 0 V320`);
  }
}
