// What is drawn over a skeleton: lines through points, and circles.

/** A line through all of its points that are known, a little past the outermost of those on the panel; where it goes on to one that is not, to the border with an arrow. @param {any} ink @param {any[]} seen */
Panel.prototype.moveThrough = function moveThrough(ink, seen) {
  const points = ink.at.map((/** @type {any} */ p) => globalOf(p[0], p[1], seen)).filter(Boolean);
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
  const from = Math.max(low, Math.min(...ways) - PAST), to = Math.min(high, Math.max(...ways) + PAST);
  if (!(from < to)) return false;
  let path = `M${pair(along(from))} L${pair(along(to))}`;
  for (const [end, way] of [[from === low ? low : null, 1], [to === high ? high : null, -1]]) {
    if (end === null) continue;
    const back = along(end + way * 2.5), side = { x: -u.y * 0.5, y: u.x * 0.5 };
    path += ` M${pair(plus(back, side, 1))} L${pair(along(end))} L${pair(plus(back, side, -1))}`;
  }
  return stroked(ink, path);
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
