// The hand: joints and bars that lead the input, and the mark of a limit.

/** Whether a place goes anywhere over the course. */
function moves(/** @type {Page} */ page, /** @type {Panel} */ panel, /** @type {number} */ place) {
  const [stretch] = page.course.stretches;
  if (!stretch || !panel.data.places[place]?.length) return false;
  const seen = [0.2, 0.45, 0.7].map((part) => {
    const numbers = page.course.look(stretch.from + part * (stretch.to - stretch.from));
    return numbers && panel.seen(numbers)[place];
  }).filter(Boolean);
  return seen.some((p) => sizeOf(minus(p, seen[0])) > 1e-6);
}

/** So near to where it left a limit the hand has come back to it, mm. */
const BACK = 12;
/** A hand may go far between two of its places: so many parts of its way are looked at. */
const PARTS = 8;

/** How far a point is from a stroke. */
function offStroke(/** @type {any} */ point, /** @type {any} */ from, /** @type {any} */ to) {
  return sizeOf(minus(point, nearestOn(point, from, to)));
}

/** @param {Page} page @param {() => void} halt stops the playing */
function handLeads(page, halt) {
  const { panels: [skeleton], track, course, variable } = page, { svg } = skeleton;
  /** What the hand holds: a point of a frame, and its way beyond a limit. @type {{pointer: number, spot: any, beyond: any[]}} */
  const free = { pointer: -1, spot: null, beyond: [] };
  let held = free;
  const way = makeInk('path', { class: 'way' }), stop = makeInk('circle', { class: 'stop', r: '3.2' });
  const layer = makeInk('g', { class: 'grips' });
  /** @type {{place: number, grip: any}[]} */
  const grips = [];
  const most = variable.kind === 'angle' ? Math.PI / 6 : page.span / 12;

  /** Ink that is held leads the input to where the point that was taken comes nearest to the pointer. */
  function hold(/** @type {Element} */ element, /** @type {(at: any) => any} */ spotAt) {
    on(element, 'pointerdown', (event) => {
      // A second finger zooms.
      if (event.button !== 0 || !event.isPrimary || held.pointer !== -1) return;
      const at = spotOf(svg, event);
      const spot = at && spotAt(at);
      if (!spot || !spot[1]) return;
      held = { pointer: event.pointerId, spot, beyond: [] };
      page.isHeld = true;
      element.setPointerCapture(event.pointerId);
      halt();
      event.preventDefault();
    });
    // A finger that leads does not scroll the page: not every browser heeds the style of ink for that.
    element.addEventListener('touchstart', (event) => {
      if (/** @type {TouchEvent} */ (event).touches.length === 1) event.preventDefault();
    }, { passive: false });
    on(element, 'pointermove', (event) => {
      const at = event.pointerId === held.pointer && spotOf(svg, event);
      if (!at) return;
      page.dragged = true;
      // Beyond a limit nothing moves until the hand has come back to where it left it.
      const limit = globalOf(held.spot[0], held.spot[1], skeleton.now), [first] = held.beyond, last = held.beyond.at(-1);
      if (first && limit) {
        const parts = Array.from({ length: PARTS }, (_, part) => plus(last, minus(at, last), (part + 1) / PARTS));
        if (parts.every((part) => offStroke(part, limit, first) > BACK)) {
          held.beyond.push(at);
          page.queue();
          return;
        }
      }
      const found = seekSpot(course, track, skeleton, held.spot, at, page.at, most);
      held.beyond = found.stopped ? [...held.beyond, at] : [];
      page.goes(found);
    });
    on(element, 'pointerup pointercancel lostpointercapture', (event) => {
      if (event.pointerId === held.pointer) letGo();
    });
  }

  function letGo() {
    if (held === free) return;
    held = free;
    page.stopped = false;
    page.rests();
  }

  svg.append(layer, stop, way);
  skeleton.data.places.forEach((/** @type {any} */ _, /** @type {number} */ place) => {
    if (!moves(page, skeleton, place)) return;
    const grip = makeInk('circle', { class: 'grip', r: '6' });
    layer.append(grip);
    grips.push({ place, grip });
    hold(grip, (at) => [[1, place], localOf([1, place], at, skeleton.now)]);
  });
  // Ink leads by itself. A stroke between two places is thin: beside it is as good, and what makes it wide goes with it.
  for (const { move, at: frame, element } of skeleton.ink) {
    if (move !== 'whole') continue;
    hold(element, (at) => [frame, localOf(frame, at, skeleton.now)]);
    const [a, b] = frame.slice(1).map((/** @type {number} */ place) => skeleton.home[place]);
    if (frame[0] === 2 && a && b && element.querySelector('.bar')) element.append(makeInk('path', { class: 'reach', d: `M${pair(a)} L${pair(b)}` }));
  }
  document.addEventListener('pointerdown', (event) => {
    page.dragged = false;
    if (!event.isPrimary) letGo();
  }, true);

  const put = (/** @type {Element} */ circle, /** @type {any} */ at) => {
    if (at) circle.setAttribute('transform', `translate(${pair(at)})`);
  };
  page.add({
    show() {
      const { now } = skeleton;
      for (const { place, grip } of grips) put(grip, now[place]);
      // A limit is marked where the hand holds the mechanism, or at a joint.
      const spot = held.spot ? globalOf(held.spot[0], held.spot[1], now) : grips[0] && now[grips[0].place];
      const beyond = spot ? held.beyond : [];
      visible(stop, Boolean(page.stopped && spot));
      put(stop, spot);
      visible(way, beyond.length > 0);
      if (beyond.length > 0) setPath(way, `M${[spot, ...beyond].map(pair).join(' L')}`);
    },
  });
  return { letGo };
}
