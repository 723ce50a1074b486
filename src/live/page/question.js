// The question: fields whose contents are saved as answers. Nothing here knows an answer.

const form = /** @type {HTMLFormElement} */ (document.getElementById('answers'));
const out = /** @type {HTMLTextAreaElement} */ (document.getElementById('out'));
const said = /** @type {HTMLElement} */ (document.getElementById('told'));

/** The answers as `linkgram grade` reads them. */
function answers() {
  /** @type {Record<string, any>} */
  const values = {};
  for (const field of form.querySelectorAll('input')) {
    const text = field.value.trim().replace(',', '.').replace('\u2212', '-');
    const value = Number(text);
    if (text === '' || !Number.isFinite(value)) continue;
    const { name = '', part = '', unit = '' } = field.dataset;
    const own = Object.prototype.hasOwnProperty.call(values, name) ? values[name] : (values[name] = {});
    own[part] = value;
    if (part !== 'direction' && unit) own.unit = unit;
  }
  // A place is two numbers or none.
  for (const [name, own] of Object.entries(values)) {
    const { x, y, ...rest } = own;
    if (x === undefined && y === undefined) continue;
    if (x === undefined || y === undefined) delete values[name];
    else values[name] = { ...rest, components: [x, y] };
  }
  return `${JSON.stringify({ values }, null, 2)}\n`;
}

form.addEventListener('submit', (event) => {
  event.preventDefault();
  const text = answers();
  try {
    if (window.origin === 'null' && location.protocol !== 'file:') throw new Error('sandboxed');
    const link = document.createElement('a');
    link.download = 'answers.json';
    link.href = URL.createObjectURL(new Blob([text], { type: 'application/json' }));
    link.click();
    URL.revokeObjectURL(link.href);
  } catch {
    out.hidden = false;
    out.value = text;
    out.focus();
    out.select();
  }
  said.textContent = '✓';
});
