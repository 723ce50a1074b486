// Text of the drawing as nodes: italics, subscripts and superscripts, and nothing else. No markup is ever parsed as such.

const SVG = 'http://www.w3.org/2000/svg';

/** @param {string} text */
function unescaped(text) {
  return text.replace(/&lt;/g, '<').replace(/&gt;/g, '>').replace(/&amp;/g, '&');
}

/** Puts a run of text with <i>, <sub>, <sup> and three entities into an element, in the place of what was there. Where only
 * what stands between them is other than before, their elements stay. @param {any} into @param {string} text */
function setRich(into, text) {
  if (into.rich === text) return;
  const parts = text.includes('<') ? text.split(/(<\/?(?:i|b|sub|sup)>)/) : [text], tags = parts.filter((_, i) => i % 2).join('');
  const isSame = into.rich !== undefined && into.tags === tags;
  into.rich = text;
  into.tags = tags;
  if (isSame) {
    into.runs.forEach((/** @type {Text} */ run, /** @type {number} */ i) => { run.data = unescaped(parts[2 * i]); });
    return;
  }
  into.replaceChildren();
  into.runs = [];
  const open = [into];
  parts.forEach((part, i) => {
    if (i % 2 === 0) {
      const run = document.createTextNode(unescaped(part));
      open[open.length - 1].append(run);
      into.runs.push(run);
    } else if (part[1] === '/') {
      if (open.length > 1) open.pop();
    } else {
      const element = document.createElement(part.slice(1, -1));
      open[open.length - 1].append(element);
      open.push(element);
    }
  });
}

/** The same as plain characters. @param {string} text */
function plainText(text) {
  return unescaped(text.replace(/<\/?(?:i|b|sub|sup)>/g, ''));
}

/** The same in one line, digits set low as such. @param {string} text */
function lineText(text) {
  return plainText(text.replace(/<sub>([^<]*)<\/sub>/g, (_, low) => low.replace(/[0-9]/g, (/** @type {string} */ digit) => String.fromCharCode(0x2080 + Number(digit)))));
}

/** A sentence with its blanks filled. */
function filled(/** @type {string} */ template, /** @type {Record<string, string>} */ parts) {
  // Numbers and symbols read from the left among words that do not.
  const [open, close] = document.documentElement.dir === 'rtl' ? ['\u2066', '\u2069'] : ['', ''];
  return template.replace(/\{(\w+)\}/g, (whole, name) => (name in parts ? `${open}${parts[name]}${close}` : whole));
}

/** Writes text only where it changed. @param {any} element @param {string} text */
function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
  element.rich = undefined;
}

/** Whether a button is pressed. */
function pressed(/** @type {Element} */ button, /** @type {boolean} */ is) {
  if (button.ariaPressed !== String(is)) button.ariaPressed = String(is);
}

/** Attributes of an element. @template {Element} E @returns {E} */
function having(/** @type {E} */ element, /** @type {Record<string, string>} */ attributes) {
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

/** A new element with what is in it. @returns {any} */
function make(/** @type {string} */ name, /** @type {Record<string, string>} */ attributes = {}, /** @type {(Node | string)[]} */ ...inside) {
  const element = having(document.createElement(name), attributes);
  element.append(...inside);
  return element;
}

/** An element of a drawing. @returns {any} */
function makeInk(/** @type {string} */ name, /** @type {Record<string, string>} */ attributes = {}) {
  return having(document.createElementNS(SVG, name), attributes);
}

/** Does something whenever one of some events comes to an element. */
function on(/** @type {EventTarget} */ element, /** @type {string} */ events, /** @type {(event: any) => void} */ does) {
  for (const event of events.split(' ')) element.addEventListener(event, does);
}

/** @returns {any[]} */
function allOf(/** @type {string} */ selector) {
  return [...document.querySelectorAll(selector)];
}

/** @returns {any} */
function byId(/** @type {string} */ id) {
  return document.getElementById(id);
}

/** What the page holds. Of tags each is one character there. @returns {any} */
function dataOfPage() {
  const tags = ['<i>', '</i>', '<sub>', '</sub>', '<sup>', '</sup>'];
  return JSON.parse(byId('linkgram-live').textContent.replace(/[\ue000-\ue005]/g, (/** @type {string} */ own) => tags[own.charCodeAt(0) - 0xe000]));
}
