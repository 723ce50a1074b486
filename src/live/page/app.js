// The page is put together: each part is given the page, and those of the others that it calls.

/** @param {Page} page */
function assemble(page) {
  showDiagrams(page);
  const playing = plays(page), travel = travels(page, playing.halt), hand = handLeads(page, playing.halt), light = highlights(page);
  const values = showsValues(page, light), steps = showsSteps(page, light), diagram = choosesDiagram(page, travel);
  light.followed(values.press);
  const place = showsPlace(page, travel, () => values.textOf(light.pinned()), values.textOfPanel);
  const scale = choosesScale(page), panel = fillWindow(page), help = tellsKeys(page), out = givesAway(page);

  // Below the drawings, and in sight while these are. Not named as any ink is: print hides it.
  byId('controls').before(make('div', { class: 'hand' }, make('div', { class: 'row' }, playing.button, place.slider, place.field), page.message, place.state));
  byId('controls').append(
    make('div', { class: 'row' }, ...playing.pace, eventChoice(page, travel), travel.apart),
    make('div', { class: 'row tools' }, ...choosesLanguage(page), page.button({ id: 'own' }, 'own_position', travel.goHome), scale.button,
      page.button({ id: 'theme' }, 'theme', turnTheme), page.button({ id: 'full' }, 'full', panel.fill), ...out.buttons,
      page.button({ id: 'help' }, 'help', help.open)),
    out.field,
    make('div', { class: 'wide' }, values.box, steps.box), steps.printed,
    make('section', {}, ...choosesPanels(page), ...choosesTraces(page), ...diagram.elements),
    help.dialog);
  page.says(document.querySelector('#sheet > summary'), 'sheet');

  keysWork(page, {
    ArrowLeft: (size) => travel.by(-size),
    ArrowRight: travel.by,
    Home: travel.goHome,
    PageDown: () => travel.nextEvent(1),
    PageUp: () => travel.nextEvent(-1),
    ' ': playing.play,
    '[': () => steps.to(page.step - 1),
    ']': () => steps.to(page.step + 1),
    s: scale.turn,
    d: diagram.open,
    f: panel.fill,
    '?': help.open,
  }, help.areOn, () => {
    light.letGo();
    hand.letGo();
    panel.leave();
  });
}

/** What a store keeps is a favour: in a sandboxed frame asking for it throws. */
const KEPT = `linkgram ${location.pathname}`;

/** @param {string} address */
function remember(address) {
  try { sessionStorage.setItem(KEPT, address); } catch { /* nothing is kept, then */ }
}

function remembered() {
  try { return sessionStorage.getItem(KEPT) || ''; } catch { return ''; }
}

/** What the address asks for is data; what it cannot be is ignored. Loaded again the page is where it was. @param {Page} page */
function followAddress(page, address = location.hash.slice(1)) {
  const asked = new URLSearchParams(address), language = asked.get('lang') || '';
  if (page.languages.includes(language)) page.use(language);
  const at = page.home(Number(asked.get('at') || 'x') * page.variable.si);
  if (page.track.regionAt(at)) page.at = at;
  const step = Number(asked.get('step') || 'x');
  if (Number.isInteger(step) && step >= 0 && step <= page.last + 1) page.step = step;
}

function begin() {
  const live = dataOfPage();
  if (live.format !== 'linkgram-live' || live.version !== 1) {
    byId('title').after(make('p', { class: 'still' }, Object.values(live.texts)[0].words.page_version));
    return;
  }
  const page = new Page(live);
  if (!page.outputs) return;
  for (const panel of page.panels) panel.begin(page.outputs);
  assemble(page);
  followAddress(page, location.hash.slice(1) || remembered());
  page.speak(page.language);
  byId('live').hidden = false;
  byId('sheet').open = false;
  page.draw();
  on(window, 'beforeprint', () => page.draw(true));
  on(window, 'hashchange', () => {
    followAddress(page);
    page.speak(page.language);
    page.draw();
  });
}

begin();
