// The question: fields whose contents are saved as answers. Nothing here knows an answer.

const form = /** @type {HTMLFormElement} */ (document.getElementById('answers'));
const out = /** @type {HTMLTextAreaElement} */ (document.getElementById('out'));
const said = /** @type {HTMLElement} */ (document.getElementById('told'));

/** The answers as `linkgram grade` reads them; a field that cannot be read, or that says too little, is marked. */
function answers() {
  /** @type {Record<string, any>} */
  const values = {};
  /** @type {HTMLInputElement | null} */
  let wrong = null;
  const mark = (/** @type {HTMLInputElement} */ field, /** @type {boolean} */ bad) => {
    if (bad) field.setAttribute('aria-invalid', 'true');
    else field.removeAttribute('aria-invalid');
    field.style.outline = bad ? '2px solid #b00020' : '';
    if (bad) wrong = wrong || field;
  };
  for (const field of form.querySelectorAll('input')) {
    const empty = field.value.trim() === '';
    // A unit that stands beside the field may stand in it as well.
    const shown = field.dataset.part === 'direction' ? '°' : field.dataset.unit || '°', text = field.value.trim();
    const value = typed(text.endsWith(shown) ? text.slice(0, -shown.length) : text);
    // A magnitude carries no sign.
    mark(field, !empty && !(Number.isFinite(value) && (value >= 0 || field.dataset.part !== 'magnitude')));
    if (empty || !Number.isFinite(value)) continue;
    const { name = '', part = '', unit = '' } = field.dataset;
    const own = Object.prototype.hasOwnProperty.call(values, name) ? values[name] : (values[name] = {});
    own[part] = value;
    if (part !== 'direction' && unit) own.unit = unit;
  }
  // A direction alone is no vector, and half a place no place: the field that is empty is marked.
  for (const field of form.querySelectorAll('input')) {
    const { name = '', part = '' } = field.dataset;
    const own = Object.prototype.hasOwnProperty.call(values, name) ? values[name] : {};
    const lacks = (/** @type {string} */ one, /** @type {string} */ other) =>
      part === one && own[one] === undefined && own[other] !== undefined;
    if (lacks('magnitude', 'direction') || lacks('x', 'y') || lacks('y', 'x')) mark(field, true);
  }
  if (wrong) {
    /** @type {HTMLInputElement} */ (wrong).focus();
    return null;
  }
  // A place is two numbers.
  for (const [name, own] of Object.entries(values)) {
    const { x, y, ...rest } = own;
    if (x === undefined && y === undefined) continue;
    values[name] = { ...rest, components: [x, y] };
  }
  return `${JSON.stringify({ values }, null, 2)}\n`;
}

/** Says one of the sentences that stand ready. */
function tell(/** @type {string} */ what) {
  for (const one of said.children) /** @type {any} */ (one).hidden = !one.classList.contains(what);
}

form.addEventListener('submit', (event) => {
  event.preventDefault();
  tell('');
  out.hidden = true;
  const text = answers();
  if (text === null) {
    tell('bad');
    return;
  }
  try {
    download(text, 'answers.json', 'application/json');
  } catch {
    out.hidden = false;
    out.value = text;
    out.focus();
    out.select();
    tell('denied');
    return;
  }
  tell('good');
});
