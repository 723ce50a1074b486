// The place of the input: a slider with its marks, a field for the exact number, and what a screen reader says of it.

/** The marks of the slider: events, the scene's own position, and hatched what cannot be assembled. @param {Page} page */
function sliderMarks(page) {
  const { course, variable, span } = page, [from, to] = variable.range;
  const marks = make('div', { class: 'marks', 'aria-hidden': 'true', dir: 'ltr' });
  const part = (/** @type {number} */ way) => `${(100 * way / span).toFixed(3)}%`;
  const mark = (/** @type {number} */ at, /** @type {string} */ kind, end = at) => {
    const one = make('i', { class: kind });
    if (end > at) one.style.width = part(end - at);
    one.style.left = part(at - from);
    marks.append(one);
  };
  for (const { at, kind } of course.events) mark(at, kind.split(' ')[0]);
  mark(variable.start, 'own');
  let reached = from;
  for (const stretch of [...course.stretches, { from: to, to }]) {
    if (stretch.from > reached) mark(reached, 'gap', stretch.from);
    reached = Math.max(reached, stretch.to);
  }
  return marks;
}

/** @param {Page} page @param {any} travel @param {() => string} pinnedText @param {(panel: Panel) => string} panelText what a panel shows, in words */
function showsPlace(page, travel, pinnedText, panelText) {
  const [from, to] = page.variable.range.map(String);
  const slider = page.says(make('input', { type: 'range', id: 'at', step: 'any', min: from, max: to, dir: 'ltr' }), 'of_input', 'aria-label');
  const field = make('input', { class: 'number', id: 'exact', inputmode: 'decimal', autocomplete: 'off', dir: 'ltr' });
  const state = make('p', { id: 'state', class: 'unseen', 'aria-live': 'polite' });
  // In print the position stands where on the screen the slider is.
  const here = make('p', { id: 'here' });
  byId('stage').before(here);
  /** @type {any} */
  let resting = 0;
  let last = '';

  on(slider, 'input', () => travel.wish(Number(slider.value)));
  on(slider, 'pointerdown', () => { page.isHeld = true; });
  on(slider, 'change pointerup pointercancel', () => page.rests());
  on(field, 'change', () => {
    const text = field.value.trim(), value = typedInput(text, page.variable);
    field.setAttribute('aria-invalid', String(!Number.isFinite(value)));
    if (Number.isFinite(value)) travel.wish(page.home(value));
    else if (text !== '') {
      page.say(filled(page.variable.kind === 'angle' ? page.words.not_a_number : page.words.not_a_length, { text, unit: page.unitSign() }));
      return;
    }
    page.draw();
    // Beyond a limit it goes no further, and the field says how far it went.
    field.value = page.exact();
  });

  page.add({
    show() {
      const exact = page.exact();
      slider.value = String(page.at);
      if (document.activeElement !== field) field.value = exact;
      // What is read aloud or printed is of a position at rest.
      if (!page.isWhole) return;
      const text = `${page.inUnit(page.at)}${pinnedText()}`;
      if (text !== last) slider.setAttribute('aria-valuetext', text);
      last = text;
      setRich(here, `${page.inputName()} = ${withUnit(exact, page.unitSign())}`);
      if (page.playing) return;
      // Half a second after rest, never while it plays.
      clearTimeout(resting);
      resting = setTimeout(() => {
        const said = `${page.words.position}: ${text}`;
        setText(state, said);
        for (const panel of page.panels) setText(byId(`state${panel.index}`), `${said}${panelText(panel)}`);
        remember(page.address());
      }, 500);
    },
  });
  return {
    slider: make('div', { id: 'slide' }, slider, sliderMarks(page)),
    field: make('label', {}, page.says(make('span'), 'of_input'), field, make('bdi', {}, page.unitSign())),
    state,
  };
}
