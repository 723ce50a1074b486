// The form of a question in a document of stubs: what is typed, what is saved, what is marked.
'use strict';
const fs = require('fs');
// The page has them one after the other.
const source = process.argv.slice(2, 5).map((file) => fs.readFileSync(file, 'utf8').replace(/^'use strict';/m, '')).join('\n');

function submitted(rows) {
  const inputs = rows.map(([name, part, unit, value]) => ({
    value,
    dataset: { name, part, unit },
    style: {},
    marks: {},
    setAttribute(key, text) { this.marks[key] = text; },
    removeAttribute(key) { delete this.marks[key]; },
    focus() {},
  }));
  let submit = null;
  const out = { hidden: true, value: '', focus() {}, select() {} };
  const said = { children: [] };
  const form = { querySelectorAll: () => inputs, addEventListener: (_, handler) => { submit = handler; } };
  const page = {
    getElementById: (id) => ({ answers: form, out, told: said })[id],
    createElement() { throw new Error('nothing is saved here'); },
  };
  new Function('document', 'window', 'location', source)(page, { origin: 'null' }, { protocol: 'http:' });
  submit({ preventDefault() {} });
  return { saved: out.value && JSON.parse(out.value).values, marked: inputs.map((one) => one.marks['aria-invalid'] === 'true') };
}

console.log(JSON.stringify(JSON.parse(process.argv[5]).map(submitted)));
