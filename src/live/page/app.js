// The page: its state is a position, a step and some choices; everything that is shown follows from these alone.

/** @type {any} */
const live = JSON.parse(/** @type {HTMLElement} */ (document.getElementById('linkgram-live')).textContent || '{}');
const languages = Object.keys(live.texts);
const byId = (/** @type {string} */ id) => /** @type {any} */ (document.getElementById(id));

/** Flatter crossings than this are badly readable by hand. */
const FLAT = 3 * Math.PI / 180;

/** What a store keeps is a favour: in a sandboxed frame asking for it throws. */
const store = {
  get(/** @type {string} */ key) {
    try { return sessionStorage.getItem(key); } catch { return null; }
  },
  set(/** @type {string} */ key, /** @type {string} */ value) {
    try { sessionStorage.setItem(key, value); } catch { /* nothing is kept, then */ }
  },
};

function refuseVersion() {
  const told = make('p', { class: 'still' }, live.texts[languages[0]].words.page_version);
  byId('title').after(told);
}

function begin() {
  const course = new Course(live);
  const track = new Track(course);
  const panels = live.panels.map((/** @type {any} */ _, /** @type {number} */ i) => new Panel(live, i));
  const { variable } = live;
  const calm = window.matchMedia('(prefers-reduced-motion: reduce)');
  const last = Math.max(0, ...live.texts[languages[0]].steps.map((/** @type {any} */ s) => s.step));
  const own = course.look(variable.start);
  if (!own) return;
  for (const panel of panels) panel.begin(own);

  const state = { at: variable.start, step: last + 1, refit: false, lang: languages[0], keys: true, playing: false, way: 1 };
  let words = live.texts[state.lang].words;
  let outputs = own;
  let isOwn = true;
  let queued = 0;
  let message = '';
  /** @type {string | null} */
  let pinned = null;
  let lastPanel = byId('figure0');
  /** @type {string | null} */
  let hovered = null;

  // --- the controls ---
  const controls = byId('controls');
  // Not named as any ink is: print hides it.
  const bar = make('div', { class: 'hand' });
  const line = make('div', { class: 'row' });
  const slideBox = make('div', { id: 'slide' });
  const slider = /** @type {HTMLInputElement} */ (make('input', { type: 'range', id: 'at', step: 'any', min: String(variable.range[0]), max: String(variable.range[1]), dir: 'ltr' }));
  const marks = make('div', { class: 'marks', 'aria-hidden': 'true', dir: 'ltr' });
  slideBox.append(slider, marks);
  const field = /** @type {HTMLInputElement} */ (make('input', { class: 'number', id: 'exact', inputmode: 'decimal', autocomplete: 'off', dir: 'ltr' }));
  const unit = make('bdi');
  const fieldLabel = make('label', { for: 'exact' });
  const fieldName = make('span');
  fieldLabel.append(fieldName, field, unit);
  const playButton = make('button', { type: 'button', id: 'play' });
  line.append(playButton, slideBox, fieldLabel);
  const messageLine = make('p', { id: 'message', role: 'status', 'aria-live': 'polite' });
  const stateLine = make('p', { id: 'state', class: 'unseen' });
  bar.append(line, messageLine, stateLine);

  const tools = make('div', { class: 'row tools' });
  const button = (/** @type {string} */ id, /** @type {() => void} */ does) => {
    const element = make('button', { type: 'button', id });
    element.addEventListener('click', does);
    tools.append(element);
    return element;
  };
  const languageBox = /** @type {HTMLSelectElement} */ (make('select', { id: 'language' }));
  for (const tag of languages) languageBox.append(make('option', { value: tag, lang: tag }, NAMES[tag] || tag));
  languageBox.addEventListener('change', () => speak(languageBox.value));
  if (languages.length > 1) tools.append(languageBox);
  const ownButton = button('own', goHome);
  const scaleButton = button('scale', () => { state.refit = !state.refit; draw(); });
  const themeButton = button('theme', turnTheme);
  const fullButton = button('full', fill);
  const copyButton = button('copy', () => give(drawings(), 'text'));
  const saveButton = button('save', () => give(drawings(), 'drawing.svg', 'image/svg+xml'));
  const tableButton = button('table', () => give(csv(), 'values.csv', 'text/csv'));
  const linkButton = button('link', () => give(hereAddress(), 'text'));
  const printButton = button('print', () => window.print());
  const helpButton = button('help', () => { if (!help.open) help.showModal(); });
  const secondsLabel = make('label');
  const secondsName = make('span');
  const seconds = /** @type {HTMLInputElement} */ (make('input', { type: 'number', min: '1', max: '120', value: String(live.seconds), class: 'number', dir: 'ltr' }));
  secondsLabel.append(secondsName, seconds);
  const pace = make('span', { dir: 'auto' });
  const eventBox = /** @type {HTMLSelectElement} */ (make('select', { id: 'events' }));
  const eventLabel = make('label', { for: 'events' });
  const eventName = make('span');
  eventLabel.append(eventName, eventBox);
  const second = make('div', { class: 'row' });
  second.append(secondsLabel, pace, eventLabel);
  const takeApart = make('button', { type: 'button', id: 'apart' });
  takeApart.hidden = true;
  takeApart.addEventListener('click', () => {
    if (wishedApart !== null) {
      state.at = wishedApart;
      wishedApart = null;
      takeApart.hidden = true;
      stopped(false);
      say(filled(words.taken_apart, { at: inUnit(state.at) }));
      draw();
    }
  });
  second.append(takeApart);
  const outField = /** @type {HTMLTextAreaElement} */ (make('textarea', { id: 'out', readonly: '', rows: '6' }));
  outField.hidden = true;
  const wide = make('div', { class: 'wide' });
  const valueBox = make('section');
  const stepBox = make('section');
  wide.append(valueBox, stepBox);
  const more = make('section');
  controls.append(bar, second, tools, outField, wide, more);
  const help = /** @type {HTMLDialogElement} */ (make('dialog', { 'aria-labelledby': 'helptitle' }));
  const helpTitle = make('h2', { id: 'helptitle' }), helpText = make('p'), keyLabel = make('label'), keyName = make('span');
  const keyBox = /** @type {HTMLInputElement} */ (make('input', { type: 'checkbox', checked: '' }));
  keyBox.addEventListener('change', () => { state.keys = keyBox.checked; });
  keyLabel.append(keyBox, keyName);
  const closeHelp = make('button', { type: 'button' });
  closeHelp.addEventListener('click', () => help.close());
  help.append(helpTitle, helpText, keyLabel, make('p'), closeHelp);
  controls.append(help);
  // In print the position stands where on the screen the slider is.
  const hereLine = make('p', { id: 'here' });
  byId('stage').before(hereLine);
  const outButtons = panels.map((/** @type {Panel} */ panel) => {
    const figure = byId(`figure${panel.index}`), out = make('button', { type: 'button', class: 'out' });
    out.addEventListener('click', () => figure.classList.remove('whole'));
    figure.addEventListener('pointerdown', () => { lastPanel = figure; });
    figure.append(out);
    return out;
  });

  for (const event of course.events) {
    const kind = event.kind === 'limit' ? 'limit' : event.kind === 'dead position' ? 'dead' : '';
    mark(event.at, kind);
  }
  mark(variable.start, 'own');
  // Where nothing can be assembled the slider is hatched.
  let reached = variable.range[0];
  for (const { from, to } of [...course.stretches, { from: variable.range[1], to: variable.range[1] }]) {
    if (from > reached) mark(reached, 'gap', from);
    reached = Math.max(reached, to);
  }

  /** A mark of the slider, by an attribute that is no style. */
  function mark(/** @type {number} */ at, /** @type {string} */ kind, to = at) {
    const span = variable.range[1] - variable.range[0], part = (at - variable.range[0]) / span;
    const one = make('i', { class: kind });
    if (to > at) one.style.width = `${(100 * (to - at) / span).toFixed(3)}%`;
    one.style.left = `${(100 * part).toFixed(3)}%`;
    marks.append(one);
  }

  // --- values ---
  const table = make('table', { id: 'values' });
  const caption = make('caption', { class: 'unseen' });
  const head = make('tr'), body = make('tbody');
  const heads = [0, 1, 2].map(() => head.appendChild(make('th', { scope: 'col' })));
  const thead = make('thead');
  thead.append(head);
  table.append(caption, thead, body);
  const valueHead = make('h2');
  const scroll = make('div', { class: 'scroll', tabindex: '0', role: 'region' });
  scroll.append(table);
  valueBox.append(valueHead, scroll);
  const rows = live.rows.map((/** @type {any} */ quantity) => {
    const row = make('tr', { 'data-quantity': quantity.name });
    const name = make('button', { type: 'button', 'aria-pressed': 'false' });
    const cell = make('td'), value = make('bdi'), sense = make('bdi');
    cell.append(name);
    row.append(cell);
    for (const one of [value, sense]) row.appendChild(make('td')).append(one);
    body.append(row);
    listen(row, quantity.name);
    name.addEventListener('click', () => pin(quantity.name));
    return { quantity, row, name, value, sense, last: '' };
  });

  // --- steps ---
  const stepHead = make('h2');
  const stepRow = make('div', { class: 'row' });
  const backButton = make('button', { type: 'button', id: 'back' }), onButton = make('button', { type: 'button', id: 'on' });
  const stepSlider = /** @type {HTMLInputElement} */ (make('input', { type: 'range', id: 'step', min: '0', max: String(last + 1), step: '1', dir: 'ltr' }));
  const stepSlide = make('div', { id: 'slide2' });
  stepSlide.append(stepSlider);
  stepRow.append(backButton, stepSlide, onButton);
  const stepTitle = make('h3'), stepBody = make('div', { class: 'scroll', tabindex: '0', role: 'region' });
  const stepNote = make('p');
  stepBox.append(stepHead, stepRow, stepTitle, stepBody, stepNote);
  backButton.addEventListener('click', () => toStep(state.step - 1));
  onButton.addEventListener('click', () => toStep(state.step + 1));
  stepSlider.addEventListener('input', () => toStep(Number(stepSlider.value)));

  /** @type {{quantity: any, value: Element, sense: Element}[]} */
  let stepCells = [];
  /** Texts with numbers of the position. @type {{element: Element, text: any, last: string}[]} */
  let stepTexts = [];

  // --- traces and diagram ---
  const traceHead = make('h2', { class: 'traces' }), traceRow = make('div', { class: 'row traces' });
  more.append(traceHead, traceRow);
  for (const panel of panels) {
    panel.labels.forEach((/** @type {any} */ label) => {
      const frame = label.anchors[0][0];
      // What stands under a layer has its path in the panel of its own.
      const isPoint = label.anchors.length === 1 && frame[0] === 1 && label.of !== undefined
        && (panel.data.layer ? frame[1] >= panel.data.own : label.point);
      if (!isPoint || !moves(panel, frame[1])) return;
      const box = make('input', { type: 'checkbox' });
      const choice = make('label');
      choice.append(box, make('bdi', {}, label.of.join(', ')));
      traceRow.append(choice);
      /** @type {any} */
      let path = null;
      box.addEventListener('change', () => {
        if (!path) {
          path = makeInk('path', { class: 'trace', d: tracePath(course, panel, frame[1]) });
          panel.svg.prepend(path);
        }
        visible(path, /** @type {any} */ (box).checked);
      });
    });
  }
  const diagramHead = make('h2', { class: 'idle' }), diagramRow = make('div', { class: 'row diagrams' });
  const diagramBox = /** @type {HTMLSelectElement} */ (make('select', { id: 'diagram', 'aria-labelledby': 'diagramhead' }));
  diagramHead.id = 'diagramhead';
  diagramBox.append(make('option', { value: '' }, '—'));
  live.rows.forEach((/** @type {any} */ quantity, /** @type {number} */ i) => {
    const name = lineText(live.texts[state.lang].symbols[i]);
    if (quantity.kind === 'vector') diagramBox.append(make('option', { value: `${i} -1` }, `|${name}|`));
    quantity.outputs.forEach((/** @type {number} */ _, /** @type {number} */ axis) => {
      const suffix = quantity.outputs.length === 2 ? ['.x', '.y'][axis] : '';
      diagramBox.append(make('option', { value: `${i} ${axis}` }, name + suffix));
    });
  });
  diagramRow.append(diagramBox);
  const diagramSpan = make('p', { dir: 'ltr' });
  const diagramPlace = make('div', { class: 'plot', dir: 'ltr' });
  more.append(diagramHead, diagramRow, diagramSpan, diagramPlace);
  /** @type {CurveDiagram | null} */
  let diagram = null;
  diagramBox.addEventListener('change', showDiagram);

  function showDiagram() {
    const chosen = diagramBox.value;
    diagramPlace.hidden = chosen === '';
    diagramSpan.hidden = chosen === '';
    diagramHead.classList.toggle('idle', chosen === '');
    if (chosen === '') return;
    if (!diagram) {
      diagram = new CurveDiagram(course, (at) => wish(at));
      diagramPlace.append(diagram.svg, diagram.numbers);
    }
    const [index, axis] = chosen.split(' ').map(Number);
    const quantity = live.rows[index];
    const { low, high } = diagram.draw(quantity, axis, variable);
    const said = [low, high].map((value) => plainText(withPower(value)));
    diagram.svg.setAttribute('aria-label', `${plainText(live.texts[state.lang].symbols[index])}: ${said[0]} … ${said[1]} ${quantity.unit}`);
    setRich(diagramSpan, `${live.texts[state.lang].symbols[index]}, ${quantity.unit || '1'} · ${inputName()}, ${unitSign()}`);
    diagram.show(state.at);
  }

  // --- grips: every joint that moves ---
  const skeleton = panels[0];
  /** What the hand holds: a point of a frame. @type {{pointer: number, moved: boolean, spot: any, beyond: any[]}} */
  let held = { pointer: -1, moved: false, spot: null, beyond: [] };
  const handWay = makeInk('path', { class: 'way' });
  const grips = makeInk('g', { class: 'grips' });
  skeleton.svg.append(grips);
  const stop = makeInk('circle', { class: 'stop', r: '3.2' });
  skeleton.svg.append(stop, handWay);
  skeleton.data.places.forEach((/** @type {any} */ _, /** @type {number} */ place) => {
    if (!moves(skeleton, place)) return;
    const grip = makeInk('circle', { class: 'grip', r: '6' });
    grips.append(grip);
    skeleton.grips = [...(skeleton.grips || []), { place, grip }];
    hold(grip, () => [[1, place], [0, 0]]);
  });
  // A stroke between two places is thin: beside it is as good, and any other ink by itself.
  for (const ink of skeleton.ink) {
    if (ink.move !== 'whole') continue;
    const frame = ink.at, local = (/** @type {any} */ at) => [frame, localOf(frame, at, skeleton.now)];
    hold(ink.element, local);
    if (frame[0] !== 2 || !ink.element.querySelector('.bar')) continue;
    const reach = makeInk('path', { class: 'reach', 'data-link': ink.element.getAttribute('data-link') || '' });
    skeleton.reaches = [...(skeleton.reaches || []), { frame, reach }];
    hold(reach, local);
    grips.before(reach);
  }

  /** Ink that is held leads the input to where the point that was taken comes nearest to the pointer. */
  function hold(/** @type {Element} */ element, /** @type {(at: any) => any} */ spotAt) {
    const here = (/** @type {any} */ event) => {
      const matrix = skeleton.svg.getScreenCTM();
      return matrix && new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    };
    element.addEventListener('pointerdown', (/** @type {any} */ event) => {
      // A second finger zooms.
      if (event.button !== 0 || !event.isPrimary || held.pointer !== -1) return;
      const at = here(event);
      const spot = at && spotAt(at);
      if (!spot || !spot[1]) return;
      held = { pointer: event.pointerId, moved: false, spot, beyond: [] };
      element.setPointerCapture(event.pointerId);
      halt();
      event.preventDefault();
    });
    element.addEventListener('pointermove', (/** @type {any} */ event) => {
      const at = event.pointerId === held.pointer && here(event);
      if (!at) return;
      held.moved = true;
      const most = variable.kind === 'angle' ? Math.PI / 6 : (variable.range[1] - variable.range[0]) / 12;
      const found = seekSpot(course, track, skeleton, held.spot, at, state.at, most);
      state.at = found.at;
      stopped(found.stopped);
      // The hand's way beyond a limit, until it comes back.
      if (found.stopped) held.beyond.push(at);
      else held.beyond = [];
      queue();
    });
    const release = (/** @type {any} */ event) => {
      if (event.pointerId === held.pointer) letGo();
    };
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) element.addEventListener(end, release);
  }

  function letGo() {
    if (held.pointer === -1) return;
    held = { ...held, pointer: -1, beyond: [] };
    skeleton.stopped = false;
    queue();
  }
  document.addEventListener('pointerdown', (event) => { if (!event.isPrimary) letGo(); }, true);

  /** Whether a place goes anywhere over the course. */
  function moves(/** @type {Panel} */ panel, /** @type {number} */ place) {
    const terms = panel.data.places[place];
    if (!terms || terms.length === 0) return false;
    const at = [0.2, 0.45, 0.7].map((part) => course.stretches.length && course.stretches[0].from + part * (course.stretches[0].to - course.stretches[0].from));
    const seen = at.map((x) => {
      const numbers = course.look(x);
      return numbers ? panel.seen(numbers)[place] : null;
    }).filter(Boolean);
    return seen.length > 1 && seen.some((p) => Math.hypot(p.x - seen[0].x, p.y - seen[0].y) > 1e-6);
  }

  // --- highlighting ---
  function listen(/** @type {Element} */ element, /** @type {string} */ quantity) {
    element.addEventListener('pointerenter', () => { hovered = quantity; light(); });
    element.addEventListener('pointerleave', () => { hovered = null; light(); });
    // Ink that listened for the focus would be a stop of the Tab key.
    if (element instanceof SVGElement) return;
    element.addEventListener('focusin', () => { hovered = quantity; light(); });
    element.addEventListener('focusout', () => { hovered = null; light(); });
  }

  for (const element of document.querySelectorAll('#stage [data-quantity]')) {
    const quantity = element.getAttribute('data-quantity') || '';
    listen(element, quantity);
    element.addEventListener('click', () => { if (!held.moved) pin(quantity); held.moved = false; });
  }

  function pin(/** @type {string} */ quantity) {
    pinned = pinned === quantity ? null : quantity;
    light();
  }

  // A link shows what it is that turns, and is shown by it.
  for (const element of document.querySelectorAll('#stage [data-link]')) {
    if (element.hasAttribute('data-quantity')) continue;
    const link = element.getAttribute('data-link');
    element.addEventListener('pointerenter', () => { hoveredLink = link; light(); });
    element.addEventListener('pointerleave', () => { hoveredLink = null; light(); });
  }
  /** @type {string | null} */
  let hoveredLink = null;
  const beside = makeInk('path', { class: 'beside' });
  skeleton.svg.append(beside);
  /** Of what is lit the points to whose line it is parallel or square, by their places. @type {number[] | null} */
  let besidePlaces = null;

  const linkOf = (/** @type {string | null} */ name) => (name && live.quantities[name] && live.quantities[name].link !== undefined ? String(live.quantities[name].link) : null);

  function placeNamed(/** @type {string} */ name) {
    const label = skeleton.labels.find((/** @type {any} */ one) => one.point && one.of?.includes(name));
    return label && label.anchors[0][0][0] === 1 ? label.anchors[0][0][1] : -1;
  }

  function showBeside() {
    const ends = besidePlaces ? besidePlaces.map((place) => skeleton.now && skeleton.now[place]) : [];
    const drawn = ends.length === 2 && ends.every(Boolean);
    visible(beside, drawn);
    if (drawn) beside.setAttribute('d', `M${pair(ends[0])} L${pair(ends[1])}`);
  }

  function light() {
    const lit = hovered || pinned;
    const link = hoveredLink || linkOf(lit);
    besidePlaces = null;
    if (lit) {
      const claims = [...document.querySelectorAll('#stage .vector')].filter((one) => one.getAttribute('data-quantity') === lit)
        .map((one) => one.getAttribute('data-parallel') || one.getAttribute('data-perpendicular')).filter(Boolean);
      const places = String(claims[0] || '').split(' ').map(placeNamed);
      if (places.length === 2 && !places.includes(-1)) besidePlaces = places;
    }
    showBeside();
    for (const element of document.querySelectorAll('#stage [data-link]')) {
      if (!element.hasAttribute('data-quantity')) element.classList.toggle('lit', link !== null && element.getAttribute('data-link') === link);
    }
    for (const element of document.querySelectorAll('#live [data-quantity], #live [data-of]')) {
      const own = element.getAttribute('data-quantity');
      const of = (element.getAttribute('data-of') || '').split(' ');
      const byLink = hoveredLink !== null && linkOf(own) === hoveredLink;
      element.classList.toggle('lit', byLink || (lit !== null && (own === lit || of.includes(lit))));
    }
    for (const row of rows) row.name.setAttribute('aria-pressed', String(pinned === row.quantity.name));
  }

  // --- where the input goes ---
  /** @type {number | null} */
  let wishedApart = null;

  function say(/** @type {string} */ text) {
    message = text;
    setText(messageLine, text);
  }

  function stopped(/** @type {boolean} */ isStopped) {
    skeleton.stopped = isStopped;
    if (isStopped && message !== words.reached_limit) say(words.reached_limit);
    if (!isStopped && message !== '') say('');
  }

  function wish(/** @type {number} */ at) {
    const found = track.nearest(state.at, at);
    const there = track.regionAt(at);
    wishedApart = found.stopped && there ? at : null;
    takeApart.hidden = wishedApart === null;
    if (wishedApart !== null) setText(takeApart, filled(words.take_apart, { at: inUnit(wishedApart) }));
    state.at = found.at;
    stopped(found.stopped);
    if (wishedApart !== null) say(words.apart);
    queue();
  }

  function goTo(/** @type {number} */ at) {
    halt();
    wish(at);
  }

  /** From wherever it is, if need be by taking it apart. */
  function goHome() {
    halt();
    const apart = track.regionAt(state.at) !== track.regionAt(variable.start) && track.nearest(state.at, variable.start).stopped;
    state.at = variable.start;
    wishedApart = null;
    takeApart.hidden = true;
    stopped(false);
    if (apart) say(words.begin_over);
    queue();
  }

  function by(/** @type {number} */ way) {
    halt();
    const found = track.go(state.at, way);
    state.at = found.at;
    stopped(found.stopped);
    queue();
  }

  slider.addEventListener('input', () => { halt(); wish(Number(slider.value)); });
  field.addEventListener('change', () => {
    const value = typedInput(field.value, variable);
    field.setAttribute('aria-invalid', String(!Number.isFinite(value)));
    if (Number.isFinite(value)) {
      goTo(home(value));
      draw();
    } else if (field.value.trim() === '') draw();
    else say(filled(words.not_a_number, { text: field.value.trim(), unit: unitSign() }));
  });

  /** An angle beyond the range, where the range is a whole turn. */
  function home(/** @type {number} */ at) {
    const [from, to] = variable.range;
    if (!variable.whole_turn || (at >= from && at <= to)) return at;
    const turn = to - from;
    return at - turn * Math.floor((at - from) / turn);
  }

  function inUnit(/** @type {number} */ at) {
    const value = at / variable.si;
    const text = plainText(withPower(Number(value.toPrecision(7))));
    return withUnit(variable.kind === 'angle' ? fixed(value, 1) : text, variable.unit === 'deg' ? '°' : variable.unit);
  }

  // --- play ---
  let before = 0, sum = 0;

  function play() {
    if (state.playing) {
      halt();
      return;
    }
    state.playing = true;
    before = 0;
    sum = 0;
    say('');
    speakPlay();
    requestAnimationFrame(tick);
  }

  function halt() {
    if (!state.playing) return;
    state.playing = false;
    speakPlay();
  }

  function tick(/** @type {number} */ now) {
    if (!state.playing) return;
    if (before > 0) {
      const span = variable.range[1] - variable.range[0];
      const time = Math.min(0.25, (now - before) / 1000);
      sum += state.way * time * span / Math.max(1, Number(seconds.value) || live.seconds);
      // With reduced motion it goes in steps.
      const least = calm.matches ? (variable.kind === 'angle' ? Math.PI / 12 : span / 24) : 0;
      if (Math.abs(sum) > least) {
        const found = track.go(state.at, sum);
        sum = 0;
        state.at = found.at;
        if (found.stopped) {
          state.way = -state.way;
          say(words.reached_limit);
        }
        draw();
      }
    }
    before = now;
    requestAnimationFrame(tick);
  }
  playButton.addEventListener('click', play);
  seconds.addEventListener('change', speakPlay);

  function speakPlay() {
    setText(playButton, state.playing ? words.stop : words.play);
    playButton.setAttribute('aria-pressed', String(state.playing));
    const shown = (variable.range[1] - variable.range[0]) / Math.max(1, Number(seconds.value) || live.seconds);
    const ratio = variable.rate === 0 ? 0 : Math.abs(variable.rate) / shown;
    const times = plainText(withPower(Number((ratio >= 1 ? ratio : 1 / ratio).toPrecision(3))));
    setText(pace, ratio === 0 ? '' : filled(ratio >= 1 ? words.slower : words.faster, { times }));
  }

  // --- keys ---
  document.addEventListener('keydown', (event) => {
    const target = /** @type {HTMLElement} */ (event.target);
    const inField = target.matches('input:not([type=checkbox], #at), select, textarea');
    if (event.key === 'Escape') {
      pinned = null;
      hovered = null;
      light();
      letGo();
      if (inField) target.blur();
      document.querySelectorAll('.panel.whole').forEach((panel) => panel.classList.remove('whole'));
      return;
    }
    if (!state.keys || inField || help.open || event.ctrlKey || event.metaKey) return;
    if (event.key === ' ' && target.matches('button, summary, a')) return;
    const degree = variable.kind === 'angle' ? Math.PI / 180 : (variable.range[1] - variable.range[0]) / 360;
    const size = degree * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
    /** @type {Record<string, () => void>} */
    const does = {
      ArrowLeft: () => by(-size),
      ArrowRight: () => by(size),
      Home: goHome,
      PageDown: () => nextEvent(1),
      PageUp: () => nextEvent(-1),
      ' ': play,
      '[': () => toStep(state.step - 1),
      ']': () => toStep(state.step + 1),
      s: () => { state.refit = !state.refit; draw(); },
      d: () => {
        if (diagramBox.value === '' && diagramBox.options.length > 1) diagramBox.selectedIndex = 1;
        showDiagram();
        diagramPlace.scrollIntoView({ block: 'nearest' });
      },
      f: fill,
      '?': () => help.showModal(),
    };
    const act = does[event.key] || does[event.key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act();
  });

  function nextEvent(/** @type {number} */ way) {
    const places = course.events.map((/** @type {any} */ e) => e.at);
    const beyond = places.filter((/** @type {number} */ at) => (way > 0 ? at > state.at : at < state.at));
    const next = way > 0 ? Math.min(...beyond) : Math.max(...beyond);
    if (Number.isFinite(next)) goTo(next);
  }

  function toStep(/** @type {number} */ step) {
    state.step = Math.max(0, Math.min(last + 1, step));
    sayStep();
    draw();
  }

  function fill() {
    const panel = document.querySelector('.panel.whole') || lastPanel;
    panel.classList.toggle('whole');
  }

  function turnTheme() {
    const root = document.documentElement;
    const dark = root.dataset.theme ? root.dataset.theme === 'dark' : window.matchMedia('(prefers-color-scheme: dark)').matches;
    root.dataset.theme = dark ? 'light' : 'dark';
  }

  // --- out ---
  function drawings() {
    // One drawing, the panels below each other.
    const all = makeInk('svg', { 'stroke-linejoin': 'round', 'font-family': panels[0].svg.getAttribute('font-family') || '' });
    let down = 0, across = 0;
    for (const panel of panels) {
      const copy = /** @type {Element} */ (panel.svg.cloneNode(true));
      copy.querySelectorAll('.grips, .reach, .beside, .way, .stop, [visibility=hidden]').forEach((own) => own.remove());
      copy.querySelectorAll('[class=""]').forEach((own) => own.removeAttribute('class'));
      const [x, y, width, height] = (copy.getAttribute('viewBox') || '').split(' ').map(Number);
      const group = makeInk('g', { transform: `translate(${mm(-x)} ${mm(down - y)})` });
      group.append(...copy.childNodes);
      const own = group.querySelector('g');
      if (own) {
        own.setAttribute('data-si-per-mm', String(panel.siPerMm));
        own.setAttribute('data-at', String(state.at / variable.si));
      }
      all.append(group);
      down += height;
      across = Math.max(across, width);
    }
    for (const [name, value] of [['width', `${mm(across)}mm`], ['height', `${mm(down)}mm`], ['viewBox', `0 0 ${mm(across)} ${mm(down)}`]]) all.setAttribute(name, value);
    return new XMLSerializer().serializeToString(all);
  }

  function csv() {
    const quoted = (/** @type {string} */ text) => `"${text.replace(/"/g, '""')}"`;
    // As `sweep` has it: a column for each number, its unit in the head, the position first; nothing where none is known.
    const head = [`${variable.kind}${variable.of ? ` ${variable.of}` : ''} [${variable.unit}]`], line = [String(state.at / variable.si)];
    for (const { quantity } of rows) {
      quantity.outputs.forEach((/** @type {number} */ output, /** @type {number} */ axis) => {
        head.push(`${quantity.name}${quantity.outputs.length === 2 ? ['.x', '.y'][axis] : ''}${quantity.unit ? ` [${quantity.unit}]` : ''}`);
        const value = outputs[output];
        line.push(value === null ? '' : String(value / quantity.si));
      });
    }
    return `${head.map(quoted).join(',')}\r\n${line.join(',')}\r\n`;
  }

  function hereAddress() {
    return `${location.href.split('#')[0]}#at=${state.at / variable.si}&step=${state.step}&lang=${state.lang}`;
  }

  /** Gives text away: by the clipboard or as a file; where both are denied, in a field. */
  async function give(/** @type {string} */ text, /** @type {string} */ name, /** @type {string} */ kind = '') {
    outField.hidden = true;
    try {
      if (name === 'text') {
        await navigator.clipboard.writeText(text);
        say(words.copied);
        return;
      }
      if (window.origin === 'null' && (location.protocol !== 'file:' || window !== window.parent)) throw new Error('sandboxed');
      const link = /** @type {HTMLAnchorElement} */ (make('a', { download: name }));
      link.href = URL.createObjectURL(new Blob([text], { type: kind }));
      link.click();
      URL.revokeObjectURL(link.href);
    } catch {
      outField.hidden = false;
      outField.value = text;
      outField.setAttribute('aria-label', words.denied);
      say(words.denied);
      outField.focus();
      outField.select();
    }
  }

  // --- words ---
  function speak(/** @type {string} */ tag) {
    if (!live.texts[tag]) return;
    state.lang = tag;
    store.set('linkgram-lang', tag);
    const text = live.texts[tag];
    words = text.words;
    document.documentElement.lang = tag;
    document.documentElement.dir = text.rtl ? 'rtl' : 'ltr';
    document.title = text.title;
    setText(byId('title'), text.title);
    languageBox.value = tag;
    languageBox.setAttribute('aria-label', words.language);
    slider.setAttribute('aria-label', words.of_input);
    setText(fieldName, words.of_input);
    setText(unit, unitSign());
    for (const out of outButtons) setText(out, words.close);
    setText(ownButton, words.own_position);
    setText(themeButton, words.theme);
    setText(fullButton, words.full);
    setText(copyButton, words.copy);
    setText(saveButton, words.save);
    setText(tableButton, words.save_table);
    setText(linkButton, words.link_here);
    setText(printButton, words.print);
    setText(helpButton, words.help);
    setText(helpTitle, words.help);
    setText(helpText, `${words.moving_page} ${words.help_keys}`);
    setText(keyName, words.keys_off);
    setText(closeHelp, words.close);
    setText(secondsName, words.seconds_a_turn);
    setText(eventName, words.events);
    setText(valueHead, words.values);
    setText(caption, `${words.values}, ${words.here}`);
    scroll.setAttribute('aria-label', words.values);
    stepBody.setAttribute('aria-label', words.steps);
    setText(stepHead, words.steps);
    setText(backButton, words.back);
    setText(onButton, words.on);
    stepSlider.setAttribute('aria-label', words.step);
    setText(traceHead, words.traces);
    setText(diagramHead, words.diagram);
    setText(document.querySelector('#sheet > summary') || make('p'), words.sheet);
    [words.quantity, words.value, words.sense].forEach((word, i) => setText(heads[i], word));
    text.panels.forEach((/** @type {string} */ title, /** @type {number} */ i) => {
      setRich(byId(`title${i}`), title);
      setRich(byId(`scale${i}`), text.scales[i]);
    });
    rows.forEach((/** @type {any} */ row, /** @type {number} */ i) => {
      setRich(row.name, text.symbols[i]);
      row.last = '';
    });
    // The finished sheet is there in the first language, or in all.
    const sheets = [...document.querySelectorAll('#sheet .sheet')];
    if (sheets.length > 1) for (const sheet of sheets) /** @type {any} */ (sheet).hidden = sheet.getAttribute('lang') !== tag;
    eventBox.replaceChildren(make('option', { value: '' }, '—'));
    course.events.forEach((/** @type {any} */ event, /** @type {number} */ i) => {
      eventBox.append(make('option', { value: String(i) }, `${inUnit(event.at)}: ${eventText(event)}`));
    });
    speakPlay();
    sayStep();
    light();
  }

  function eventText(/** @type {any} */ event) {
    const links = event.links && event.links.length > 0 ? ` (${filled(words.in_line, { links: event.links.join(', ') })})` : '';
    switch (event.kind) {
      case 'limit': return words.limit + links;
      case 'change point': return words.change_point + links;
      case 'dead position': return words.dead_position + links;
      case 'at infinity': return words.at_infinity;
      default: {
        const [, bar, name, axis] = /^(\|?)(.*?)(\.[xy])?\|?$/.exec(event.name) || [];
        return filled(event.kind === 'least' ? words.least : words.greatest, { name: `${bar}${lineText(symbolOf(name))}${axis || ''}${bar}` });
      }
    }
  }
  eventBox.addEventListener('change', () => {
    if (eventBox.value !== '') goTo(course.events[Number(eventBox.value)].at);
  });

  /** What is said of the present step, with the quantities that it draws. */
  function sayStep() {
    const all = live.texts[state.lang].steps;
    const said = all.find((/** @type {any} */ one) => one.step >= state.step) || null;
    stepBody.replaceChildren();
    stepCells = [];
    stepTexts = [];
    setText(stepNote, '');
    stepSlider.value = String(state.step);
    stepBox.classList.toggle('idle', state.step > last);
    if (!said || state.step > last) {
      setText(stepTitle, words.all_steps);
      stepSlider.setAttribute('aria-valuetext', words.all_steps);
      return;
    }
    setRich(stepTitle, said.head);
    stepSlider.setAttribute('aria-valuetext', plainText(said.head));
    for (const equation of said.equations) {
      const own = make('table');
      const names = equation[0].map((/** @type {any} */ cell) => live.texts[state.lang].terms[cell]);
      for (const cells of equation) {
        const row = make('tr');
        cells.forEach((/** @type {any} */ text, /** @type {number} */ i) => {
          const cell = row.appendChild(make('td'));
          stepTexts.push({ element: cell, text, last: '' });
          if (!names[i]) return;
          cell.setAttribute('data-quantity', names[i]);
          listen(cell, names[i]);
          cell.addEventListener('click', () => pin(names[i]));
        });
        own.append(row);
      }
      stepBody.append(own);
    }
    const quantities = [];
    for (const panel of panels) {
      for (const ink of panel.ink) {
        if (ink.step === state.step && ink.quantity && live.quantities[ink.quantity] && !quantities.includes(ink.quantity)) quantities.push(ink.quantity);
      }
    }
    if (quantities.length > 0) {
      stepBody.append(make('p', {}, `${words.values}, ${words.here}`));
      const own = make('table');
      for (const name of quantities) {
        const row = make('tr', { 'data-quantity': name });
        const value = make('td'), sense = make('td');
        value.append(make('bdi'));
        sense.append(make('bdi'));
        const named = make('th', { scope: 'row' });
        setRich(named, symbolOf(name));
        row.append(named, value, sense);
        own.append(row);
        listen(row, name);
        stepCells.push({ quantity: live.quantities[name], value, sense });
      }
      stepBody.append(own);
    }
    const list = make('ol', { class: 'said' });
    for (const text of said.sentences) {
      const item = list.appendChild(make('li'));
      stepTexts.push({ element: item, text, last: '' });
    }
    stepBody.append(list);
    sayNumbers();
    light();
  }

  /** A quantity as the sheet calls it. */
  function symbolOf(/** @type {string} */ name) {
    const { symbols, terms } = live.texts[state.lang];
    const asked = live.rows.findIndex((/** @type {any} */ quantity) => quantity.name === name);
    return asked >= 0 ? symbols[asked] : Object.keys(terms).find((symbol) => terms[symbol] === name) || name;
  }

  /** What was last read off the paper of a line, mm, and the scale by which it is multiplied. */
  let read = NaN, factor = 1;

  /** A text with the numbers of this position; nothing where it is said of the scene's own only. */
  function textHere(/** @type {any} */ text) {
    if (typeof text === 'string') return text;
    if (!Array.isArray(text)) return isOwn ? text.own : null;
    read = NaN;
    const pieces = text.map((piece) => (typeof piece === 'string' ? piece : numberHere(piece)));
    return pieces.includes(null) ? null : pieces.join('');
  }

  function numberHere(/** @type {any} */ [form, output, si, more, panel]) {
    if (form === 5) return stated(state.at / si);
    if (form === 8) {
      factor = panels[output].siPerMm / si;
      return stated(factor);
    }
    if (form === 7) return withGuard(read * factor, output);
    const { program } = course, row = (/** @type {number} */ i) => live.outputs[i].row;
    const one = outputs[output];
    if (one === null) return null;
    if (form === 6) return one === 0 ? '' : one > 0 ? live.texts[state.lang].senses[0] : live.texts[state.lang].senses[1];
    if (form < 2) {
      const value = program.isClear(row(output)) ? one : 0;
      return withGuard((form === 0 ? Math.abs(value) : value) / si, more);
    }
    const other = outputs[output + 1];
    if (other === null) return null;
    const bound = Math.hypot(program.error(row(output)), program.error(row(output + 1))) * CLEAR;
    const size = Math.hypot(one, other) <= bound ? 0 : Math.hypot(one, other);
    if (form === 4) return degrees(size === 0 ? 0 : angleOf(other, one));
    // The paper is that of the scale in force.
    if (form === 3) {
      const text = fixed(size / panels[panel].siPerMm, more);
      read = Number(text);
      return text;
    }
    return withGuard(size / si, more);
  }

  function sayNumbers() {
    let left = 0;
    for (const one of stepTexts) {
      const said = textHere(one.text);
      if (said === null) left += 1;
      const now = said === null ? '…' : said;
      if (now !== one.last || one.last === '') setRich(one.element, now);
      one.last = now;
    }
    setText(stepNote, left > 0 ? filled(left === 1 ? words.said_at_start_one : words.said_at_start, { count: String(left) }) : '');
  }

  // --- drawing ---
  function queue() {
    if (queued || state.playing) return;
    queued = requestAnimationFrame(() => { queued = 0; draw(); });
  }

  /** The scale of a panel in this position, by the rule for one position. */
  function refitted(/** @type {Panel} */ panel) {
    const data = panel.data;
    if (!state.refit || !data.polygon) return data.si_per_mm;
    panel.siPerMm = 1;
    const seen = panel.seen(outputs).filter(Boolean);
    const side = (/** @type {'x' | 'y'} */ axis) => Math.max(0, ...seen.map((/** @type {any} */ p) => p[axis])) - Math.min(0, ...seen.map((/** @type {any} */ p) => p[axis]));
    const [x0, y0, x1, y1] = data.box;
    const reach = Math.max(...seen.map((/** @type {any} */ p) => Math.max(p.x / (x1 - 13), p.x / (x0 + 13), p.y / (y1 - 13), p.y / (y0 + 13))), 0);
    const needed = (reach || Math.max(side('x'), side('y')) / 100) / data.unit * 10;
    if (!(needed > 0) || !Number.isFinite(needed)) return data.si_per_mm;
    const power = 10 ** Math.floor(Math.log10(needed));
    const step = [1, 2, 2.5, 5, 10].find((s) => s * power >= needed * (1 - 1e-12)) || 10;
    return step * power * data.unit / 10;
  }

  /** The least angle at which two lines of a panel meet that lead to one place. @param {Panel} panel */
  function flattest(panel) {
    const rays = panel.ink.filter((ink) => ink.move === 'ray' && ink.element.getAttribute('visibility') !== 'hidden');
    let least = Math.PI / 2;
    rays.forEach((one, i) => {
      for (const other of rays.slice(i + 1)) {
        if (one.at[1] !== other.at[1] || one.step !== other.step) continue;
        const [a, b] = [one, other].map((ink) => ({ x: panel.now[ink.at[1]].x - panel.now[ink.at[0]].x, y: panel.now[ink.at[1]].y - panel.now[ink.at[0]].y }));
        const size = Math.hypot(a.x, a.y) * Math.hypot(b.x, b.y);
        if (size > 0) least = Math.min(least, Math.asin(Math.min(1, Math.abs(a.x * b.y - a.y * b.x) / size)));
      }
    });
    return least;
  }

  /** In words what leaves the panel: the longest vector that does. @param {Panel} panel */
  function beyond(panel) {
    const [x0, y0, x1, y1] = panel.data.box;
    let longest = 0, name = '';
    for (const ink of panel.ink) {
      if (ink.move !== 'vector' || !live.quantities[ink.quantity]) continue;
      const [a, b] = ink.at.map((/** @type {number} */ i) => panel.now[i]);
      if (!a || !b || (b.x > x0 && b.x < x1 && b.y > y0 && b.y < y1)) continue;
      const length = Math.hypot(b.x - a.x, b.y - a.y);
      if (length > longest) [longest, name] = [length, ink.quantity];
    }
    const angle = flattest(panel);
    const flat = angle < FLAT ? ` ${filled(live.texts[state.lang].flat, { angle: degrees(angle) })}` : '';
    if (name === '') return flat;
    const said = filled(words.beyond, { name: name.replace(/[<&]/g, ''), length: `${plainText(withPower(longest))}\u00a0mm` });
    return ` · ${said}${flat}`;
  }

  function draw() {
    const found = course.look(state.at);
    if (!found) return;
    outputs = found;
    isOwn = Math.abs(state.at - variable.start) <= 1e-12 * (Math.abs(variable.range[0]) + Math.abs(variable.range[1]));
    const lost = [];
    for (const panel of panels) {
      const { data } = panel;
      panel.siPerMm = refitted(panel);
      panel.calm = calm.matches;
      panel.angle = variable.kind === 'angle' ? state.at : undefined;
      panel.show(outputs, state.at, state.step > last ? Infinity : state.step, isOwn);
      const scale = byId(`scale${panel.index}`);
      if (data.polygon) {
        const value = withUnit(plainText(figures(panel.siPerMm * 10 / panel.data.unit, 6, true).join('')), panel.data.unit_symbol);
        setText(scale, filled(live.texts[state.lang].scale, { scale: `${value}\u00a0≡\u00a01\u00a0cm` }));
        setRich(byId(`beyond${panel.index}`), beyond(panel));
      } else if (data.still > 0) {
        setText(byId(`beyond${panel.index}`), isOwn ? '' : ` · ${filled(data.still === 1 ? words.not_moving_one : words.not_moving, { count: String(data.still) })}`);
      }
    }
    showBeside();
    for (const { place, grip } of skeleton.grips || []) {
      const at = skeleton.now[place];
      if (!at) continue;
      grip.setAttribute('cx', at.x.toFixed(3));
      grip.setAttribute('cy', at.y.toFixed(3));
    }
    for (const { frame, reach } of skeleton.reaches || []) {
      const ends = [skeleton.now[frame[1]], skeleton.now[frame[2]]];
      if (ends.every(Boolean)) reach.setAttribute('d', `M${pair(ends[0])} L${pair(ends[1])}`);
    }
    // A limit is marked where the hand holds the mechanism, or at a joint.
    const first = (skeleton.grips || [])[0];
    const spot = held.pointer !== -1 ? globalOf(held.spot[0], held.spot[1], skeleton.now) : first && skeleton.now[first.place];
    visible(stop, Boolean(skeleton.stopped && spot));
    if (spot) {
      stop.setAttribute('cx', spot.x.toFixed(3));
      stop.setAttribute('cy', spot.y.toFixed(3));
    }
    visible(handWay, Boolean(spot) && held.beyond.length > 0);
    if (spot && held.beyond.length > 0) handWay.setAttribute('d', `M${[spot, ...held.beyond].map(pair).join(' L')}`);
    const hereText = `${inputName()} = ${withUnit(fieldText(), unitSign())}`;
    if (hereText !== hereShown) setRich(hereLine, hereText);
    hereShown = hereText;
    for (const row of rows) {
      const said = told(row.quantity, course, outputs, words);
      const key = `${said.value}|${said.sense}`;
      if (key === row.last) continue;
      row.last = key;
      setRich(row.value, said.value);
      setRich(row.sense, said.sense);
      if (said.value === '—') lost.push(said.sense);
    }
    sayNumbers();
    for (const { quantity, value, sense } of stepCells) {
      const said = told(quantity, course, outputs, words);
      setRich(value.firstElementChild || value, said.value);
      setRich(sense.firstElementChild || sense, said.sense);
    }
    slider.value = String(state.at);
    if (document.activeElement !== field) field.value = fieldText();
    slider.setAttribute('aria-valuetext', `${inUnit(state.at)}${pinnedText()}`);
    setText(scaleButton, `${words.scale}: ${state.refit ? words.refit : words.fixed}`);
    scaleButton.setAttribute('aria-pressed', String(state.refit));
    if (diagram) diagram.show(state.at);
    if (!state.playing) {
      clearTimeout(resting);
      resting = setTimeout(() => {
        setText(stateLine, `${words.position}: ${inUnit(state.at)}${pinnedText()}`);
        store.set('linkgram-at', String(state.at));
      }, 500);
    }
  }
  /** @type {any} */
  let resting = 0;
  let hereShown = '';

  function unitSign() {
    return variable.unit === 'deg' ? '°' : variable.unit;
  }

  function inputName() {
    return live.texts[state.lang].input || words.of_input;
  }

  function fieldText() {
    const value = state.at / variable.si;
    return String(Number(value.toPrecision(10)));
  }

  function pinnedText() {
    const row = rows.find((/** @type {any} */ one) => one.quantity.name === pinned);
    return row ? `; ${row.name.textContent} = ${row.value.textContent} ${row.sense.textContent}` : '';
  }

  // --- beginning ---
  const asked = new URLSearchParams(location.hash.slice(1));
  speak(languages.includes(asked.get('lang') || '') ? /** @type {string} */ (asked.get('lang')) : languages[0]);
  const wished = Number(asked.get('at') || 'x');
  if (Number.isFinite(wished)) {
    const at = home(wished * variable.si);
    if (track.regionAt(at) && course.stretchAt(at)) state.at = at;
  }
  const wishedStep = Number(asked.get('step') || 'x');
  if (Number.isInteger(wishedStep) && wishedStep >= 0 && wishedStep <= last + 1) state.step = wishedStep;
  sayStep();
  diagramPlace.hidden = true;
  byId('live').hidden = false;
  byId('sheet').open = false;
  draw();
}

/** @type {Record<string, string>} */
const NAMES = { en: 'English', ar: 'العربية', 'ar-x-ajala': 'العربية (عجلة)', fa: 'فارسی' };

if (live.format !== 'linkgram-live' || live.version !== 1) refuseVersion();
else if (live.program && live.panels) begin();
