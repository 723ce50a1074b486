// What the parts of the page share: the position, the step and the choices, and how a change of them is shown.

/** A part of the page makes its elements once; `show` follows the position, `speak` the language. What is in a `box` waits while that
 * is out of sight and something moves. @typedef {{show?: () => void, speak?: () => void, box?: Element}} Part */

class Page {
  /** @param {any} live */
  constructor(live) {
    const { variable } = live, [from, to] = variable.range;
    this.live = live;
    this.variable = variable;
    this.span = to - from;
    /** The rows of the table of values. @type {any[]} */
    this.rows = live.rows.map((/** @type {any} */ row) => (typeof row === 'string' ? { name: row, ...live.quantities[row] } : row));
    this.languages = Object.keys(live.texts);
    this.course = new Course(live);
    this.track = new Track(this.course);
    /** @type {Panel[]} */
    this.panels = live.panels.map((/** @type {any} */ _, /** @type {number} */ i) => new Panel(live, i, this.course));
    this.calm = window.matchMedia('(prefers-reduced-motion: reduce)');
    /** @type {Part[]} */
    this.parts = [];
    /** Elements that say a word, or have it as an attribute. @type {[Element, string, string][]} */
    this.spoken = [];
    this.use(this.languages[0]);
    this.last = Math.max(0, ...this.text.steps.map((/** @type {any} */ said) => said.step));

    // The state. A picture is a function of this alone.
    this.at = variable.start;
    this.step = this.last + 1;
    this.refit = live.opens.refit;

    // What goes on: none of it is in the picture.
    this.playing = false;
    /** A hand leads the input. */
    this.isHeld = false;
    /** Boxes out of sight. @type {Set<Element>} */
    this.unseen = new Set();
    this.watch = new IntersectionObserver((all) => {
      for (const { target, isIntersecting } of all) {
        if (isIntersecting) this.unseen.delete(target); else this.unseen.add(target);
      }
      // What comes into sight is as the position is, though the hand that moves it may stand still.
      if (this.isHeld) this.queue();
    });
    /** The input goes no further. */
    this.stopped = false;
    /** The hand has moved what it took: letting go is no click. */
    this.dragged = false;
    this.queued = 0;
    this.message = make('p', { id: 'message', role: 'status', 'aria-live': 'polite' });
    /** @type {any} Numbers of the position; nothing where it cannot be assembled. */
    this.outputs = this.course.look(this.at);
    this.isOwn = true;
  }

  // --- parts and words ---
  /** @template {Part} P @param {P} part */
  add(part) {
    this.parts.push(part);
    if (part.box) this.watch.observe(part.box);
    return part;
  }

  /** An element that says a word of the page in the language of choice, or has it as an attribute. */
  says(/** @type {any} */ element, /** @type {string} */ word, /** @type {string} */ attribute = '') {
    this.spoken.push([element, word, attribute]);
    return element;
  }

  /** A button that says a word. */
  button(/** @type {Record<string, string>} */ attributes, /** @type {string} */ word, /** @type {() => void} */ does) {
    const element = make('button', { type: 'button', ...attributes });
    on(element, 'click', does);
    return word ? this.says(element, word) : element;
  }

  /** @param {string} language */
  use(language) {
    this.language = language;
    this.text = this.live.texts[language];
    this.words = this.text.words;
    const { symbols, terms, steps } = this.text;
    this.figures = figuresOf(steps);
    this.calculations = calculationsOf(steps);
    /** Names of quantities by what they are called in equations. */
    this.named = new Map([...Object.entries(symbols).map(([name, symbol]) => [symbol, name]), ...Object.entries(terms)]);
  }

  /** @param {string} language */
  speak(language) {
    this.use(language);
    const { text, words } = this, root = document.documentElement;
    root.lang = language;
    root.dir = text.rtl ? 'rtl' : 'ltr';
    document.title = text.title;
    setText(byId('title'), text.title);
    for (const [element, word, attribute] of this.spoken) {
      if (attribute) element.setAttribute(attribute, words[word]); else setText(element, words[word]);
    }
    for (const part of this.parts) part.speak?.();
  }

  /** @param {string} text */
  say(text) {
    setText(this.message, text);
  }

  /** What a table of values is. */
  valuesHere() {
    return [this.words.values, this.words.here].join(this.text.rtl ? '، ' : ', ');
  }

  /** A quantity as the sheet calls it. @param {string} name */
  symbolOf(name) {
    return this.text.symbols[name] || name;
  }

  // --- the position ---
  /** Goes to where the track has led. @param {{at: number, stopped: boolean}} found */
  goes(found) {
    this.at = found.at;
    this.stopped = found.stopped;
    this.say(found.stopped ? this.words.reached_limit : '');
    this.queue();
  }

  /** Draws with the next frame. */
  queue() {
    if (this.queued || this.playing) return;
    this.queued = requestAnimationFrame(() => {
      this.queued = 0;
      this.draw();
    });
  }

  /** Whether something goes on, so that what nobody sees waits: at rest everything is of the position. */
  get isMoving() {
    return this.playing || this.isHeld;
  }

  /** The hand lets go. */
  rests() {
    if (!this.isHeld) return;
    this.isHeld = false;
    this.queue();
  }

  draw(whole = !this.isMoving) {
    const found = this.course.look(this.at), { range, start } = this.variable;
    if (!found) return;
    this.outputs = found;
    this.isOwn = Math.abs(this.at - start) <= 1e-12 * (Math.abs(range[0]) + Math.abs(range[1]));
    this.isWhole = whole;
    for (const part of this.parts) {
      if (part.show && this.isDue(part.box)) part.show();
    }
  }

  /** Whether what is in a box is shown anew. @param {Element | undefined} box */
  isDue(box) {
    return this.isWhole || !box || !this.unseen.has(box);
  }

  /** An angle beyond the range, where the range is a whole turn. @param {number} at */
  home(at) {
    const { range: [from, to], whole_turn: whole } = this.variable;
    return !whole || (at >= from && at <= to) ? at : at - this.span * Math.floor((at - from) / this.span);
  }

  /** The state as it stands in an address. */
  address() {
    return `at=${this.place()}&step=${this.step}&lang=${this.language}`;
  }

  /** The place of the input as a number of its unit. */
  place() {
    return this.at / this.variable.si;
  }

  unitSign() {
    const { unit } = this.variable;
    return unit === 'deg' ? '°' : unit;
  }

  inputName() {
    return this.text.input || this.words.of_input;
  }

  /** The place of the input, to ten figures. */
  exact() {
    return String(Number(this.place().toPrecision(10)));
  }

  /** A place of the input for people. @param {number} at */
  inUnit(at) {
    const value = at / this.variable.si;
    const text = this.variable.kind === 'angle' ? fixed(value, 1) : plainText(withPower(Number(value.toPrecision(7))));
    return withUnit(text, this.unitSign());
  }
}
