// Ink: where the places of a panel are in one position, and how groups of strokes go with them.

const PAST = 4;
const NEAR = 0.05;
/** Boxes of names reach into each other by no more than this, mm. */
const INTO = 0.3;

/** The place of a stroke that is nearest to a point, off its ends by some part of it. */
function nearestOn(/** @type {any} */ point, /** @type {any} */ from, /** @type {any} */ to, off = 0) {
  const d = minus(to, from), own = minus(point, from);
  return plus(from, d, Math.min(1 - off, Math.max(off, (own.x * d.x + own.y * d.y) / (d.x * d.x + d.y * d.y) || 0)));
}

/** Six decimals of a millimetre. @param {number} x */
function mm(x) {
  return String(Math.round(x * 1e6) / 1e6);
}

/** @param {{x: number, y: number}} p */
function pair(p) {
  return `${mm(p.x)} ${mm(p.y)}`;
}

/** @param {any} a @param {any} b */
function minus(a, b) {
  return { x: a.x - b.x, y: a.y - b.y };
}

/** From a point by a part of a way. @param {any} a @param {any} way @param {number} part */
function plus(a, way, part) {
  return { x: a.x + way.x * part, y: a.y + way.y * part };
}

/** @param {any} way */
function sizeOf(way) {
  return Math.hypot(way.x, way.y);
}

/** The two ends behind a tip, and the outline of a head: three times as long as wide. */
function headOf(/** @type {any} */ tip, /** @type {any} */ u, /** @type {number} */ size) {
  const back = plus(tip, u, -size), side = { x: -u.y * size / 6, y: u.x * size / 6 };
  return `M${pair(tip)} L${pair(plus(back, side, 1))} L${pair(plus(back, side, -1))} Z`;
}

/** Origin and x-axis of a frame; nothing where its places fall together. */
function axesOf(/** @type {number[]} */ frame, /** @type {any[]} */ seen) {
  const [kind, i, j] = frame;
  if (kind === 0) return { o: { x: 0, y: 0 }, x: { x: 1, y: 0 } };
  const a = seen[i];
  if (!a) return null;
  if (kind === 1) return { o: a, x: { x: 1, y: 0 } };
  if (kind >= 4) {
    // Where one vector carries a point, turned and stretched with another.
    if (kind === 6) {
      const o = globalOf([5, i, j], frame.slice(3, 5), seen), other = axesOf([5, i, frame[5]], seen);
      return o && other && { o, x: other.x };
    }
    // Turned to an angle, or turned and stretched with a vector: both are outputs.
    const p = seen.outputs[j], q = seen.outputs[j + 1];
    if (p === null || (kind === 5 && q === null)) return null;
    if (kind === 4) return { o: a, x: { x: Math.cos(p), y: -Math.sin(p) } };
    return Math.hypot(p, q) > 1e-9 ? { o: a, x: { x: p, y: -q } } : null;
  }
  const b = seen[j];
  if (!b) return null;
  const d = minus(b, a), length = sizeOf(d);
  if (!(length >= NEAR)) return null;
  return { o: a, x: kind === 2 ? { x: d.x / length, y: d.y / length } : d };
}

/** A point of a frame on the page. */
function globalOf(/** @type {number[]} */ frame, /** @type {number[]} */ own, /** @type {any[]} */ seen) {
  if (frame[0] === 1) {
    // Most names and strokes stand beside a place.
    const at = seen[frame[1]];
    return at ? { x: at.x + own[0], y: at.y + own[1] } : null;
  }
  const axes = axesOf(frame, seen);
  if (!axes) return null;
  const { o, x } = axes;
  return { x: o.x + x.x * own[0] - x.y * own[1], y: o.y + x.y * own[0] + x.x * own[1] };
}

/** A point of the page in a frame; nothing where that has none now. */
function localOf(/** @type {number[]} */ frame, /** @type {any} */ at, /** @type {any[]} */ seen) {
  const axes = axesOf(frame, seen);
  if (!axes) return null;
  const { o, x } = axes, d = minus(at, o), n = x.x * x.x + x.y * x.y;
  return [(d.x * x.x + d.y * x.y) / n, (d.y * x.x - d.x * x.y) / n];
}

/** Where an event is on a drawing; nothing where that is not shown. @param {SVGSVGElement} svg @param {any} event */
function spotOf(svg, event) {
  const matrix = svg.getScreenCTM();
  return matrix && new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
}

/** Numbers that are letters where they are small. @param {string} text */
function uncoded(text) {
  const letters = '0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxy';
  return (text.replace(/~(\d+),/g, (_, run) => 'U'.repeat(Number(run))).match(/z-?\d+,|[0-9A-Za-y]/g) || [])
    .map((one) => (one[0] === 'z' ? Number(one.slice(1, -1)) : letters.indexOf(one) - 30));
}

/** Has a stroke go so. @param {Element} stroke @param {string} path */
function setPath(stroke, path) {
  stroke.setAttribute('d', path);
}

/** Ink of one stroke, drawn so. @param {any} ink @param {string} path */
function stroked(ink, path) {
  setPath(ink.paths[0], path);
  return true;
}

/** The part of a stroke within a box; nothing where it runs past. @param {any} from @param {any} to @param {number[]} box */
function partWithin(from, to, [x0, y0, x1, y1]) {
  const way = minus(to, from);
  let begin = 0, end = 1;
  for (const [length, low, high] of [[way.x, x0 - from.x, x1 - from.x], [way.y, y0 - from.y, y1 - from.y]]) {
    if (length === 0 && (low > 0 || high < 0)) return null;
    if (length !== 0) {
      begin = Math.max(begin, Math.min(low / length, high / length));
      end = Math.min(end, Math.max(low / length, high / length));
    }
  }
  return begin < end ? [plus(from, way, begin), plus(from, way, end)] : null;
}

/** The path that ties a name to what it names; nothing where it stands no farther from that than so, mm. */
function tieOf(/** @type {any} */ { spot: [from, to], half: [wide, high] }, /** @type {number} */ beside) {
  const way = minus(to, from), part = Math.min(wide / Math.abs(way.x), high / Math.abs(way.y));
  return (1 - part) * sizeOf(way) >= beside && `M${pair(plus(from, way, part))} L${pair(to)}`;
}

class Panel {
  /** @param {any} live @param {number} index @param {Course} course */
  constructor(live, index, course) {
    this.index = index;
    this.course = course;
    this.data = live.panels[index];
    this.quantities = live.quantities;
    this.events = live.course.events;
    this.siPerMm = this.data.si_per_mm;
    this.svg = /** @type {SVGSVGElement} */ (document.getElementById(`panel${index}`));
    /** @type {any[]} */
    this.ink = live.ink.filter((/** @type {any} */ ink) => ink.panel === index)
      .map((/** @type {any} */ ink) => ({ ...ink, element: document.getElementById(ink.id), last: '' }))
      .filter((/** @type {any} */ ink) => ink.element);
    /** @type {any[]} */
    this.labels = live.labels.filter((/** @type {any} */ label) => label.panel === index)
      .map((/** @type {any} */ label) => {
        // Each told by its difference from the one before.
        const by = uncoded(label.by);
        for (let i = 2; i < by.length; i++) by[i] += by[i - 2];
        const element = document.getElementById(label.id), tie = makeInk('path', { class: 'leader', stroke: '#000000', 'stroke-width': '0.13' });
        element?.before(tie);
        return { ...label, by, element, tie, last: '' };
      })
      .filter((/** @type {any} */ label) => label.element);
    // The places of the course at which names were placed: equal steps, as far as it goes.
    this.frames = equalSteps(live.variable.range, live.frames).filter((at) => live.course.stretches.some((/** @type {any} */ s) => at >= s.from && at <= s.to));
  }

  /** Where the places are, mm of the panel; null where one is not known. @param {(number | null)[]} outputs @param {number[] | null} only */
  seen(outputs, only = null) {
    const { origin, places } = this.data;
    const all = places.map((/** @type {number[][]} */ terms, /** @type {number} */ place) => {
      if (only && !only.includes(place)) return null;
      const at = [0, 0];
      for (const [sign, output] of terms) {
        for (let axis = 0; axis < 2; axis++) {
          const value = outputs[output + axis];
          if (value === null) return null;
          at[axis] += sign * value;
        }
      }
      const x = (at[0] - origin[0]) / this.siPerMm, y = -(at[1] - origin[1]) / this.siPerMm;
      return Number.isFinite(x) && Number.isFinite(y) ? { x, y } : null;
    });
    all.outputs = outputs;
    return all;
  }

  /** What the markup shows: the ink at the scene's own position. @param {(number | null)[]} outputs */
  begin(outputs) {
    this.home = this.seen(outputs);
    for (const ink of this.ink) {
      ink.paths = [...ink.element.querySelectorAll('path')];
      ink.tells = Boolean(ink.element.dataset.value);
      if (ink.move === 'whole') ink.home = axesOf(ink.at, this.home);
      if (ink.move === 'mark') ink.home = globalOf(ink.at[0], ink.at[1], this.home);
      if (ink.move === 'vector' || ink.move === 'arrow') {
        const part = (/** @type {string} */ selector, /** @type {any} */ ...made) => ink.element.querySelector(selector) || ink.element.appendChild(makeInk(...made));
        ink.shaft = part('.shaft', 'path', { class: 'shaft', fill: 'none', stroke: '#000000', 'stroke-width': '0.25' });
        ink.head = part('.head', 'path', { class: 'head', fill: '#000000' });
        ink.dot = part('circle', 'circle', { r: '0.55', fill: '#000000' });
        ink.width = ink.wide = Number(ink.shaft.getAttribute('stroke-width'));
      }
    }
    // Lines of one step that lead to one place: where they cross too flat it is badly found.
    const rays = this.ink.filter((ink) => ink.move === 'ray');
    /** @type {any[][]} */
    this.crossings = rays.flatMap((one, i) => rays.slice(i + 1)
      .filter((other) => one.at[1] === other.at[1] && one.step === other.step).map((other) => [one, other]));
  }

  /** Moves everything. What the ink tells besides is told where it comes to rest. */
  show(/** @type {(number | null)[]} */ outputs, /** @type {number} */ at, /** @type {number} */ step, /** @type {boolean} */ own, /** @type {boolean} */ rests) {
    const seen = this.seen(outputs);
    this.now = seen;
    this.at = at;
    this.rests = rests;
    for (const ink of this.ink) {
      const wanted = this.senseHolds(ink, outputs) && (ink.step === undefined || ink.step <= step) && (ink.move !== 'still' || own);
      const drawn = wanted && this.move(ink, seen);
      visible(ink.element, drawn);
      const isFresh = drawn && ink.step === step;
      if (isFresh !== ink.isFresh) ink.element.classList.toggle('fresh', isFresh);
      ink.isFresh = isFresh;
      // What is read off the ink is that of this position.
      if (drawn && ink.tells && rests) {
        const own = this.quantities[ink.quantity];
        if (ink.move === 'vector') {
          const [a, b] = ink.at.map((/** @type {number} */ i) => seen[i]);
          ink.element.dataset.value = String(sizeOf(minus(b, a)) * this.siPerMm / this.data.unit);
        } else if (own?.outputs.length === 1) ink.element.dataset.value = String(Number(outputs[own.outputs[0]]) / own.si);
      }
    }
    this.place(seen, at, step, outputs);
  }

  /** @param {any} ink @param {(number | null)[]} outputs */
  senseHolds(ink, outputs) {
    if (!ink.sense) return true;
    const value = this.clear(outputs, ink.sense[0]);
    return value !== 0 && (value > 0) === ink.sense[1];
  }

  /** A number of the position, zero where it is not known or not told from that. @param {(number | null)[]} outputs @param {number} index */
  clear(outputs, index) {
    return outputs[index] ? clearNumber(this.course, outputs, index) : 0;
  }

  /** Whether the ink could be moved. @param {any} ink @param {any[]} seen */
  move(ink, seen) {
    switch (ink.move) {
      case 'whole': return this.moveWhole(ink, seen);
      case 'strokes': return ink.at.every((/** @type {any} */ stroke, /** @type {number} */ i) => {
        const points = stroke[1].map((/** @type {any} */ p) => globalOf(p[0], p[1], seen));
        if (points.includes(null) || !ink.paths[i]) return false;
        setPath(ink.paths[i], `M${points.map(pair).join(' L')}${stroke[0] ? ' Z' : ''}`);
        return true;
      });
      case 'vector': return this.moveVector(ink, seen[ink.at[0]], seen[ink.at[1]]);
      case 'ray': {
        const a = seen[ink.at[0]], b = seen[ink.at[1]];
        if (!a || !b) return false;
        const d = minus(b, a), length = sizeOf(d);
        if (length < NEAR) return false;
        return stroked(ink, `M${pair(a)} L${pair(plus(b, d, PAST / length))}`);
      }
      case 'outline': {
        const points = ink.at.map((/** @type {number} */ i) => seen[i]);
        return !points.includes(null) && stroked(ink, `M${points.map(pair).join(' L')} Z`);
      }
      case 'arrow': {
        const [a, b] = ink.at.map((/** @type {any} */ p) => globalOf(p[0], p[1], seen));
        return this.moveVector(ink, a, b);
      }
      case 'through': return this.moveThrough(ink, seen);
      case 'round': return this.moveRound(ink, seen);
      case 'mark': {
        const at = globalOf(ink.at[0], ink.at[1], seen);
        if (!at || !ink.home) return false;
        ink.element.setAttribute('transform', `translate(${pair(minus(at, ink.home))})`);
        return true;
      }
      case 'turn': return this.moveTurn(ink, seen[ink.at[0]], seen.outputs[ink.at[2]] ?? this.angle);
      default: return true;
    }
  }

  /** One transform for a group. @param {any} ink @param {any[]} seen */
  moveWhole(ink, seen) {
    const from = ink.home, to = axesOf(ink.at, seen);
    if (!from || !to) return false;
    const n = from.x.x * from.x.x + from.x.y * from.x.y;
    const c = (to.x.x * from.x.x + to.x.y * from.x.y) / n, s = (to.x.y * from.x.x - to.x.x * from.x.y) / n;
    const e = to.o.x - (c * from.o.x - s * from.o.y), f = to.o.y - (s * from.o.x + c * from.o.y);
    const cosine = Math.round(c * 1e9) / 1e9, sine = Math.round(s * 1e9) / 1e9;
    const text = ink.at[0] === 1 ? `translate(${mm(e)} ${mm(f)})` : `matrix(${cosine} ${sine} ${-sine} ${cosine} ${mm(e)} ${mm(f)})`;
    if (text !== ink.last) ink.element.setAttribute('transform', text);
    ink.last = text;
    return true;
  }

  /** @param {any} ink @param {any} a @param {any} b */
  moveVector(ink, a, b) {
    if (!a || !b) return false;
    ink.ends = [a, b];
    const d = minus(b, a), length = sizeOf(d);
    const short = length < 1;
    visible(ink.dot, short);
    visible(ink.shaft, !short);
    visible(ink.head, !short);
    if (short) having(ink.dot, { cx: mm(b.x), cy: mm(b.y) });
    // At rest it is drawn all the same: what is copied is measured by its shaft.
    if (short && !this.rests) return true;
    const u = { x: d.x / (length || 1), y: d.y / (length || 1) };
    const head = Math.min(ink.width < 0.5 ? 2.5 : 3, length / 3), wide = Math.min(ink.width, head / 4);
    setPath(ink.shaft, `M${pair(a)} L${pair(plus(b, u, -0.9 * head))}`);
    if (wide !== ink.wide) ink.shaft.setAttribute('stroke-width', mm(wide));
    ink.wide = wide;
    setPath(ink.head, headOf(b, u, head));
    return true;
  }

  /** An arc from the right to the angle that is varied, or of a link that goes with the time: once round at most. */
  moveTurn(/** @type {any} */ ink, /** @type {any} */ centre, /** @type {number | undefined} */ angle) {
    if (!centre || angle === undefined) return false;
    const [, radius, of] = ink.at, whole = 2 * Math.PI;
    const turn = angle - whole * (of ? Math.floor(angle / whole) : Math.trunc(angle / whole));
    if (Math.abs(turn) * radius < 1.5) return false;
    const { paths } = ink;
    const size = Math.min(2.25, radius * Math.abs(turn) / 2), span = size / radius, sign = Math.sign(turn);
    const at = (/** @type {number} */ angle) => ({ x: centre.x + radius * Math.cos(angle), y: centre.y - radius * Math.sin(angle) });
    const end = turn - sign * span * 0.8;
    setPath(paths[0], `M${pair(at(0))} A${mm(radius)} ${mm(radius)} 0 ${Math.abs(end) > Math.PI ? 1 : 0} ${end < 0 ? 1 : 0} ${pair(at(end))}`);
    if (paths[1]) {
      const way = turn - sign * span / 2;
      setPath(paths[1], headOf(at(turn), { x: -Math.sin(way) * sign, y: -Math.cos(way) * sign }, size));
    }
    return true;
  }

  /** Puts the names where they were placed in advance. Where a diagram is so small that one would stand in another, the
   * later one is left out, and counted. */
  place(/** @type {any[]} */ seen, /** @type {number} */ at, /** @type {number} */ step, /** @type {(number | null)[]} */ outputs) {
    const { frames, data: { box: [x0, y0, x1, y1], polygon, ties } } = this;
    // The frames about the place, and how far it is between them.
    const low = Math.max(0, frames.findLastIndex((frame) => frame <= at)), next = Math.min(low + 1, frames.length - 1);
    let part = Math.min(1, Math.max(0, (at - frames[low]) / (frames[next] - frames[low]))) || 0;
    if (this.calm) part = Math.round(part);
    /** Names that stand: middle and half sizes. @type {number[][]} */
    const stand = [];
    this.crowded = 0;
    /** Names of what lies beyond the panel. @type {any[]} */
    const far = [];
    for (const label of this.labels) {
      const { anchors: [one, two], by, element, tie, half: [wide, high] } = label, isArrow = two && (polygon || label.arrow);
      let a = globalOf(one[0], one[1], seen), b = two ? globalOf(two[0], two[1], seen) : a;
      // Next to a limit a vector is metres long: its name stands by what is seen of it.
      if (isArrow && a && b) [a, b] = partWithin(a, b, this.data.box) || [a, a];
      let shown = a && b && (label.step === null || label.step <= step) && (label.output === undefined || this.clear(outputs, label.output))
        && (two ? !isArrow || sizeOf(minus(b, a)) >= 1 : a.x > x0 && a.x < x1 && a.y > y0 && a.y < y1);
      label.spot = null;
      if (!shown && !two && this.placeFar) {
        visible(tie, false);
        far.push([label, a]);
        continue;
      }
      if (shown) {
        const middle = two ? plus(a, minus(b, a), 0.5) : a;
        const off = (/** @type {number} */ axis) => (by[2 * low + axis] * (1 - part) + by[2 * next + axis] * part) / 10;
        const x = middle.x + off(0), y = middle.y + off(1);
        shown = !stand.some(([u, v, w, h]) => wide + w - Math.abs(x - u) > INTO && high + h - Math.abs(y - v) > INTO);
        if (shown) {
          stand.push([x, y, wide, high]);
          // At the ends of a stroke others begin.
          label.spot = [{ x, y }, nearestOn({ x, y }, a, b, 0.1)];
          const text = `translate(${x.toFixed(3)} ${y.toFixed(3)})`;
          if (text !== label.last) element.setAttribute('transform', text);
          label.last = text;
        } else this.crowded += 1;
      }
      visible(element, Boolean(shown));
      if (label.far) visible(label.far, false);
      // In what is given away, names of points are tied wherever they do not stand beside them.
      const path = label.spot && tieOf(label, this.tells && label.point ? 1 : ties ? 2.6 : Infinity);
      visible(tie, Boolean(path));
      if (path && path !== label.path) setPath(tie, path);
      label.path = path;
    }
    for (const [label, point] of far) this.placeFar(label, point, stand);
  }
}

/** Shows or hides, where that changes anything: an element remembers, since to read it off costs more. @param {any} element @param {boolean} shown */
function visible(element, shown) {
  if (element.isShown === shown) return;
  element.isShown = shown;
  if (shown) element.removeAttribute('visibility');
  else element.setAttribute('visibility', 'hidden');
}
