// The steps: what is drawn in each, its sentences and equations with the numbers of the position.

// A number of a text is `[form, output, SI units of its unit, figures more than usual, panel]`; between two places the output of the
// other one stands last, and what a line calculates is `[form, its index, factors, divisors, figures more than usual, those at the start]`.
const SIZE = 0, SIGNED = 1, LENGTH = 2, ON_PAPER = 3, DIRECTION = 4, INPUT = 5, SENSE = 6, AMOUNT = 7, FACTOR = 8, READ = 9, BETWEEN = 10, CALCULATED = 11, ONE_NUMBER = 12;

/** Away from the scene's own position, where the sheet tells how many figures lines need, what is read has so many more than usual. */
const FINER = 1;

/** The sentences of the steps; of one whose words hang on a length all that it may say. @param {any[]} steps */
function sentencesOf(steps) {
  return steps.flatMap(({ sentences }) => sentences).flatMap((text) => (text.of ? [text.arrow, text.point, text.unmeasured].filter(Boolean) : [text.elsewhere || text]));
}

/** What lines calculate, by its index. @param {any[]} steps */
function calculationsOf(steps) {
  return new Map(sentencesOf(steps).flat().filter((piece) => piece[0] === CALCULATED && piece[2]).map((piece) => [piece[1], piece]));
}

/** The number that was printed so. @param {string | null} text */
function valueOf(text) {
  return text === null ? NaN : Number(plainText(text.replace('<sup>', 'e')).replace(/\s×\s10(?=e)|\s/g, '').replaceAll('\u2212', '-'));
}

/** The figures with which steps tell the numbers that begin with an output: of what is read those of its reading. */
function figuresOf(/** @type {any[]} */ steps) {
  const figures = new Map();
  for (const text of [...sentencesOf(steps), ...steps.flatMap((said) => said.equations.flat(2)).map((cell) => cell.elsewhere || cell)]) {
    const numbers = Array.isArray(text) ? text.filter((piece) => typeof piece !== 'string') : [];
    for (const [form, output, si, more, panel] of numbers) {
      const known = figures.get(output);
      if (form === READ) figures.set(output, { si, more, panel });
      // A line may need more of a number than the others tell.
      else if (form <= LENGTH && known?.panel === undefined && !(known?.more <= more)) figures.set(output, { si, more });
    }
  }
  return figures;
}

/** @param {Page} page */
function readings(page) {
  /** What is read by the scale. */
  let amount = '';
  /** The words are those of a vector of this length. */
  let isWorded = false;

  /** What a line calculates is calculated from what is printed in it. @param {any} piece @returns {string | null} */
  function calculated([, index]) {
    const [, , factors, divisors, more, own] = page.calculations.get(index);
    const [over, under] = [factors, divisors].map((all) => all.reduce((/** @type {number} */ product, /** @type {any} */ part) =>
      product * (Array.isArray(part) ? valueOf(numberHere(part)) : part), 1));
    const value = Number((over / under).toPrecision(12)), digits = (value >= 1000 ? 4 : 3) + (page.isOwn ? own : more);
    return Number.isFinite(value) ? raised(computed(value, digits)) : null;
  }

  /** @param {any} piece @returns {string | null} */
  function numberHere(piece) {
    const [form, output, si, more, panel] = piece;
    if (form === CALCULATED) return calculated(piece);
    if (form === ONE_NUMBER) return page.isOwn ? output : si;
    const { course, outputs, panels } = page, one = outputs[output];
    if (form === INPUT) return stated(page.at / si);
    if (form === AMOUNT) return amount;
    if (form === FACTOR) return stated(panels[output].siPerMm / si);
    if (form === BETWEEN) {
      const [x, y] = [0, 1].map((axis) => (outputs[panel + axis] ?? NaN) - (outputs[output + axis] ?? NaN));
      const size = Math.hypot(x, y) / si;
      return Number.isFinite(size) ? fixed(size, more) : null;
    }
    const isVector = [LENGTH, ON_PAPER, DIRECTION, READ].includes(form);
    if (one === null || (isVector && outputs[output + 1] === null)) return null;
    if (!isVector) {
      const value = clearNumber(course, outputs, output);
      // What is not told from zero has no sense.
      if (form === SENSE) return value === 0 ? '' : page.text.senses[value > 0 ? 0 : 1];
      return form === SIGNED ? withPower(value / si, more) : amountText(page, output, Math.abs(value), si, more);
    }
    const [size, angle] = clearVector(course, outputs, output);
    if (form === DIRECTION) return degrees(angle);
    if (form === LENGTH) return amountText(page, output, size, si, more);
    // The paper is that of the scale in force.
    const { siPerMm } = panels[panel];
    // What is a point on paper is not read off it, nor laid off.
    if (!isWorded && isPoint(size / siPerMm)) return null;
    if (form === ON_PAPER) return fixed(size / siPerMm, more);
    const [read, by] = readOff(size / siPerMm, siPerMm / si, size / si, page.isOwn ? more : FINER);
    amount = by;
    return read;
  }

  /** What is said of a vector that is so long on paper: as an arrow, a point, less than a ruler shows, or zero. @param {any} text */
  function wordsOf({ of: [output, panel], arrow, point, unmeasured = point, zero = unmeasured, own }) {
    const { course, outputs, panels } = page;
    if (page.isOwn && own !== undefined) return own;
    if (outputs[output] === null || outputs[output + 1] === null) return null;
    const mm = clearVector(course, outputs, output)[0] / panels[panel].siPerMm;
    return isPoint(mm) ? (mm >= 0.05 ? point : mm > 0 ? unmeasured : zero) : arrow;
  }

  /** A text with the numbers of this position; nothing where it is said of the scene's own only. */
  return (/** @type {any} */ any) => {
    isWorded = Boolean(any.of);
    const text = isWorded ? wordsOf(any) ?? null : (!page.isOwn && any.elsewhere) || any;
    if (typeof text === 'string' || text === null) return text;
    if (!Array.isArray(text)) return page.isOwn ? text.own : null;
    const pieces = text.map((piece) => (typeof piece === 'string' ? piece : numberHere(piece)));
    return pieces.includes(null) ? null : pieces.join('');
  };
}

/** @param {Page} page @param {any} light */
function showsSteps(page, light) {
  const { live, panels, last } = page, textHere = readings(page);
  const slider = page.says(make('input', { type: 'range', id: 'step', min: '0', max: String(last + 1), step: '1', dir: 'ltr' }), 'step', 'aria-label');
  const title = make('h3'), note = make('p');
  const body = page.says(make('div', { class: 'scroll', tabindex: '0', role: 'region' }), 'steps', 'aria-label');
  const box = make('section', {}, page.says(make('h2'), 'steps'), make('div', { class: 'row' },
    page.button({ id: 'back' }, 'back', () => to(page.step - 1)), make('div', { id: 'slide2' }, slider),
    page.button({ id: 'on' }, 'on', () => to(page.step + 1)), page.button({ id: 'draw' }, 'draw', grow)), title, body, note);
  // On paper all steps stand together, where no one is chosen.
  const printed = make('section', { class: 'printed' });
  on(window, 'beforeprint', () => printed.replaceChildren(...(page.step > last ? page.text.steps.map(wholeStep) : [])));
  on(slider, 'input', () => to(Number(slider.value)));
  /** Quantities of the step. @type {{quantity: any, value: Element, sense: Element}[]} */
  let values = [];
  /** Texts with numbers of the position. @type {{element: Element, text: any}[]} */
  let texts = [];

  /** @param {number} step */
  function to(step) {
    page.step = Math.max(0, Math.min(last + 1, step));
    speak();
    page.draw();
  }

  const linked = (/** @type {any} */ element, /** @type {string} */ name) => {
    element.dataset.quantity = name;
    light.listen(element, name);
    return element;
  };
  const living = (/** @type {any} */ element, /** @type {any} */ text) => {
    texts.push({ element, text });
    return element;
  };

  /** A vector equation with what is known of its terms. @param {any[][]} equation */
  function equationTable(equation) {
    const names = equation[0].map((cell) => page.named.get(cell));
    const cellOf = (/** @type {any} */ text, /** @type {number} */ i) => {
      const cell = living(make('td'), text);
      if (!names[i]) return cell;
      on(cell, 'click', () => light.pin(names[i]));
      return linked(cell, names[i]);
    };
    return make('table', { dir: 'ltr' }, ...equation.map((cells) => make('tr', {}, ...cells.map(cellOf))));
  }

  /** A step with all that can be said of it here. @param {any} said */
  function wholeStep(said) {
    const own = [...texts], head = make('h3'), tables = said.equations.map(equationTable);
    const lines = said.sentences.map((/** @type {any} */ text) => living(make('li'), text));
    for (const { element, text } of texts.slice(own.length)) {
      const here = textHere(text);
      // A line that is empty here is left out below; an empty cell of a table keeps its column.
      if (here) setRich(element, here);
    }
    texts = own;
    setRich(head, said.head);
    return make('div', {}, head, ...tables, make('ol', { class: 'said' }, ...lines.filter((/** @type {Element} */ line) => line.hasChildNodes())));
  }

  /** Lets the strokes of the step grow. */
  function grow() {
    if (page.calm.matches) return;
    for (const ink of allOf('#stage .fresh path, #stage .fresh circle')) {
      const length = ink.getTotalLength(), isStroke = (ink.getAttribute('fill') || 'none') === 'none';
      ink.animate(isStroke ? [{ strokeDasharray: `0 ${length}` }, { strokeDasharray: `${length} 0` }] : [{ opacity: 0 }, { opacity: 0, offset: 0.9 }, { opacity: 1 }], 900);
    }
  }

  /** The quantities that the step draws, with their values here. @param {string[]} names */
  function valueTable(names) {
    return make('table', {}, ...names.map((name) => {
      const named = make('th', { scope: 'row', dir: 'ltr' }), value = make('bdi'), sense = make('bdi');
      setRich(named, page.symbolOf(name));
      values.push({ quantity: live.quantities[name], value, sense });
      return linked(make('tr', {}, named, make('td', {}, value), make('td', {}, sense)), name);
    }));
  }

  /** What is said of the present step, with the quantities that it draws. */
  function speak() {
    const { words, step } = page;
    const said = step > last ? null : page.text.steps.find((/** @type {any} */ one) => one.step >= step);
    const head = said ? said.head : words.all_steps;
    values = [];
    texts = [];
    slider.value = String(step);
    slider.setAttribute('aria-valuetext', plainText(head));
    setRich(title, head);
    box.classList.toggle('idle', !said);
    body.replaceChildren();
    if (said) {
      const drawn = panels.flatMap((panel) => panel.ink.filter((ink) => ink.step === step && live.quantities[ink.quantity]).map((ink) => ink.quantity));
      body.append(...said.equations.map(equationTable));
      if (drawn.length > 0) body.append(make('p', {}, page.valuesHere()), valueTable([...new Set(drawn)]));
      body.append(make('ol', { class: 'said' }, ...said.sentences.map((/** @type {any} */ text) => living(make('li'), text))));
    }
    show();
    light.light();
  }

  function show() {
    const { words } = page;
    let left = 0;
    for (const one of texts) {
      const said = textHere(one.text);
      if (said === null) left += 1;
      setRich(one.element, said === null ? '…' : said);
    }
    setText(note, left > 0 ? filled(left === 1 ? words.said_at_start_one : words.said_at_start, { count: String(left) }) : '');
    for (const { quantity, value, sense } of values) {
      const said = told(quantity, page);
      setRich(value, said.value);
      setRich(sense, said.sense);
    }
  }

  page.add({ box, show, speak });
  return { box, printed, to };
}
