// Where the input is sent: by a wish, a way, an event; and by taking the linkage apart where it must be.

/** @param {Page} page @param {() => void} halt stops the playing */
function travels(page, halt) {
  const { track, course, variable } = page;
  /** @type {number | null} */
  let wishedApart = null;
  const apart = page.button({ id: 'apart' }, '', () => {
    if (wishedApart === null) return;
    const at = wishedApart;
    arrive({ at, stopped: false });
    page.say(filled(page.words.taken_apart, { at: page.inUnit(at) }));
    page.draw();
  });
  apart.hidden = true;

  /** Goes somewhere, and forgets what was wished before. @param {{at: number, stopped: boolean}} found */
  function arrive(found, /** @type {number | null} */ wished = null) {
    wishedApart = wished;
    apart.hidden = wished === null;
    if (wished !== null) setText(apart, filled(page.words.take_apart, { at: page.inUnit(wished) }));
    page.goes(found);
  }

  /** To a place, or as near to it as the course allows. @param {number} at */
  function wish(at) {
    halt();
    const found = track.nearest(page.at, at);
    const beyond = found.stopped && track.regionAt(at);
    arrive(found, beyond ? at : null);
    if (beyond) page.say(page.words.apart);
  }

  /** By a way. @param {number} way */
  function by(way) {
    halt();
    arrive(track.go(page.at, way));
  }

  /** From wherever it is, if need be by taking it apart. */
  function goHome() {
    halt();
    const at = variable.start;
    const isApart = track.regionAt(page.at) !== track.regionAt(at) && track.nearest(page.at, at).stopped;
    arrive({ at, stopped: false });
    if (isApart) page.say(page.words.begin_over);
  }

  /** To the next event on one side. @param {number} way */
  function nextEvent(way) {
    const places = course.events.map((/** @type {any} */ event) => event.at);
    // Two that fall on one place are one stop.
    const beyond = places.filter((/** @type {number} */ at) => way * (at - page.at) > 1e-9 * page.span);
    const next = way > 0 ? Math.min(...beyond) : Math.max(...beyond);
    if (Number.isFinite(next)) wish(next);
  }

  return { apart, wish, by, goHome, nextEvent };
}

/** The events of the course, to be chosen. @param {Page} page @param {{wish: (at: number) => void}} travel */
function eventChoice(page, travel) {
  const { events } = page.course;
  const box = make('select', { id: 'events' });
  on(box, 'change', () => { if (box.value !== '') travel.wish(events[Number(box.value)].at); });

  function eventText(/** @type {any} */ event) {
    const { words } = page;
    const links = event.links?.length > 0 ? ` (${filled(words.in_line, { links: event.links.join(', ') })})` : '';
    if (event.name === undefined) return words[event.kind.replace(' ', '_')] + links;
    const [, bar, name, axis = ''] = /^(\|?)(.*?)(\.[xy])?\|?$/.exec(event.name) || [];
    return filled(words[event.kind], { name: bar + lineText(page.symbolOf(name)) + axis + bar });
  }

  page.add({
    speak() {
      box.replaceChildren(make('option', { value: '' }, '—'), ...events.map((/** @type {any} */ event, /** @type {number} */ i) =>
        make('option', { value: String(i) }, `${page.inUnit(event.at)}: ${eventText(event)}`)));
    },
  });
  return make('label', {}, page.says(make('span'), 'events'), box);
}
