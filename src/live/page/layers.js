// What is drawn over a skeleton, lines through points and circles; and what is said of it that few skeletons need.

/** Whether the place of a frame is at infinity in this position. */
Panel.prototype.isFar = function isFar(/** @type {number[]} */ [kind, place]) {
  return kind === 1 && this.events.some((/** @type {any} */ event) => event.kind === 'at infinity' && event.at === this.at && event.column === this.data.places[place][0]?.[1]);
};

/** A line through all of its points that are known, a little past the outermost of those on the panel; where it goes on to one that is not, to the border with an arrow. @param {any} ink @param {any[]} seen */
Panel.prototype.moveThrough = function moveThrough(ink, seen) {
  const points = ink.at.map((/** @type {any} */ p) => globalOf(p[0], p[1], seen)).filter(Boolean);
  /** Where it leaves the panel, and which way. @type {any[]} */
  ink.leaves = [];
  if (points.length < 2) return false;
  // The two that are farthest apart tell the direction, told from the one nearest to the middle.
  const [x0, y0, x1, y1] = this.data.box, middle = { x: (x0 + x1) / 2, y: (y0 + y1) / 2 };
  const off = (/** @type {any} */ p, /** @type {any} */ q) => sizeOf(minus(p, q));
  const near = points.reduce((/** @type {any} */ a, /** @type {any} */ b) => (off(b, middle) < off(a, middle) ? b : a));
  const far = points.reduce((/** @type {any} */ a, /** @type {any} */ b) => (off(b, near) > off(a, near) ? b : a));
  const length = off(near, far);
  if (length < NEAR) return false;
  const u = { x: (far.x - near.x) / length, y: (far.y - near.y) / length };
  const ways = points.map((/** @type {any} */ p) => (p.x - near.x) * u.x + (p.y - near.y) * u.y);
  const along = (/** @type {number} */ way) => plus(near, u, way);
  const reach = 2 * (x1 - x0 + y1 - y0) + off(near, middle);
  const cut = partWithin(along(-reach), along(reach), this.data.box);
  if (!cut) return false;
  const [low, high] = cut.map((at) => (at.x - near.x) * u.x + (at.y - near.y) * u.y);
  // What is at infinity is so either way.
  if (ink.at.some((/** @type {any} */ p) => this.isFar(p[0]))) ways.push(high + PAST);
  const past = ink.past ?? PAST, from = Math.max(low, Math.min(...ways) - past), to = Math.min(high, Math.max(...ways) + past);
  if (!(from < to)) return false;
  let path = `M${pair(along(from))} L${pair(along(to))}`;
  for (const [end, way] of [[from === low ? low : null, 1], [to === high ? high : null, -1]]) {
    if (end === null) continue;
    ink.leaves.push([along(end), plus({ x: 0, y: 0 }, u, -way)]);
    const back = along(end + way * 2.5), side = { x: -u.y * 0.5, y: u.x * 0.5 };
    path += ` M${pair(plus(back, side, 1))} L${pair(along(end))} L${pair(plus(back, side, -1))}`;
  }
  return stroked(ink, path);
};

/** The name of what lies beyond the panel stands where a line leaves it that leads there, with how far it is from there. */
Panel.prototype.placeFar = function placeFar(/** @type {any} */ label, /** @type {any} */ at, /** @type {number[][]} */ stand) {
  const { anchors: [[frame]], element, half: [wide, high] } = label, { box: [x0, y0, x1, y1], unit, unit_symbol: symbol } = this.data;
  const leads = (/** @type {any[]} */ [end, u]) => !at || (at.x - end.x) * u.x + (at.y - end.y) * u.y > 0;
  const lines = this.ink.filter((/** @type {any} */ ink) => ink.leaves && ink.element.isShown && ink.at.some((/** @type {any} */ p) => String(p[0]) === String(frame)));
  const way = (at || this.isFar(frame)) && lines.flatMap((/** @type {any} */ ink) => ink.leaves).find(leads);
  let found = false;
  if (way) {
    const [end, u] = way, text = at ? withUnit(plainText(withPower(sizeOf(minus(at, end)) * this.siPerMm / unit)), symbol) : '∞';
    label.far ||= element.appendChild(makeInk('text', { 'font-size': '3.3', dy: '.33em' }));
    setText(label.far, text);
    having(label.far, { x: mm(wide + 0.8) });
    // About as wide as it is set.
    const half = wide + 0.4 + 0.85 * text.length, side = { x: -u.y, y: u.x }, reach = (/** @type {any} */ n) => Math.abs(n.x) * half + Math.abs(n.y) * high;
    const places = [3, 7, 12, 18].flatMap((back) => [1, -1].map((sign) => plus(plus(end, u, -back - reach(u)), side, sign * (1 + reach(side)))));
    const free = places.find(({ x, y }) => x - half > x0 && x + half < x1 && y - high > y0 && y + high < y1
      && !stand.some(([v, w, a, b]) => half + a - Math.abs(x - v) > 0 && high + b - Math.abs(y - w) > 0));
    if (free) {
      stand.push([free.x, free.y, half, high]);
      label.last = `translate(${mm(free.x + wide - half)} ${mm(free.y)})`;
      element.setAttribute('transform', label.last);
      found = true;
    } else this.crowded += 1;
  }
  if (label.far) visible(label.far, found);
  visible(element, found);
};

/** A circle about a point. @param {any} ink @param {any[]} seen */
Panel.prototype.moveRound = function moveRound(ink, seen) {
  const [[frame, own], unit, part] = ink.at;
  const centre = globalOf(frame, own, seen), axes = axesOf(unit, seen);
  if (!centre || !axes) return false;
  const radius = part * sizeOf(axes.x);
  if (!(radius < 1e4)) return false;
  having(ink.element.querySelector('circle'), { cx: mm(centre.x), cy: mm(centre.y), r: mm(radius) });
  return true;
};

/** Pins that have left their slots, in words. @param {Record<string, string>} words */
Panel.prototype.outOfSlots = function outOfSlots(words) {
  const { now, data: { openings = [] } } = this;
  return openings.filter((/** @type {any[]} */ [a, b, reach]) => now[a] && now[b] && sizeOf(minus(now[a], now[b])) > reach)
    .map((/** @type {any[]} */ [, , , point, link]) => filled(words.out_of_slot, { point, link })).join(' · ');
};
