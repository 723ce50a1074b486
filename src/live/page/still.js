// The steps of a page that does not move: ink of later steps is not there, and that of the step is emphasised.

const { texts } = dataOfPage();
const [shownFirst] = Object.keys(texts);
const lastStep = Math.max(-1, ...texts[shownFirst].steps.map((/** @type {any} */ said) => said.step));
const stepSlider = make('input', { type: 'range', id: 'step', min: '0', max: String(lastStep + 1), step: '1', value: String(lastStep + 1), dir: 'ltr' });
const stepHead = make('h2'), stepTitle = make('h3'), stepBody = make('div', { class: 'scroll', tabindex: '0', role: 'region' });
const turnBy = (/** @type {number} */ by) => {
  stepSlider.value = String(Number(stepSlider.value) + by);
  showStep();
};
const [backButton, onButton] = [['back', -1], ['on', 1]].map(([id, by]) => {
  const button = make('button', { type: 'button', id });
  on(button, 'click', () => turnBy(by));
  return button;
});

/** A line or cell of a step. */
function written(/** @type {string} */ name, /** @type {string} */ text) {
  const element = make(name);
  setRich(element, text);
  return element;
}

function showStep() {
  const { words, steps } = texts[byId('language')?.value || shownFirst], step = Number(stepSlider.value);
  const said = step > lastStep ? null : steps.find((/** @type {any} */ one) => one.step >= step);
  for (const ink of allOf('#sheet [data-step]')) {
    ink.toggleAttribute('hidden', Boolean(said) && Number(ink.dataset.step) > step);
    ink.classList.toggle('fresh', Boolean(said) && Number(ink.dataset.step) === step);
  }
  setText(stepHead, words.steps);
  setText(backButton, words.back);
  setText(onButton, words.on);
  having(stepSlider, { 'aria-label': words.step, 'aria-valuetext': plainText(said ? said.head : words.all_steps) });
  stepBody.setAttribute('aria-label', words.steps);
  setRich(stepTitle, said ? said.head : words.all_steps);
  stepBody.replaceChildren();
  if (!said) return;
  const table = (/** @type {string[][]} */ rows) => make('table', {}, ...rows.map((cells) => make('tr', {}, ...cells.map((cell) => written('td', cell)))));
  stepBody.append(...said.equations.map(table),
    make('ol', { class: 'said' }, ...said.sentences.map((/** @type {string} */ text) => written('li', text))));
}

if (lastStep >= 0) {
  byId('controls').append(stepHead, make('div', { class: 'row' }, backButton, make('div', { id: 'slide2' }, stepSlider), onButton), stepTitle, stepBody);
  byId('live').hidden = false;
  on(stepSlider, 'input', showStep);
  on(document, 'keydown', ({ key, target }) => {
    if (!target.matches('input, select') && (key === '[' || key === ']')) turnBy(key === ']' ? 1 : -1);
  });
  if (byId('language')) on(byId('language'), 'change', showStep);
  showStep();
}
