// The table of values.

/** @param {Page} page @param {any} light */
function showsValues(page, light) {
  const cells = ['quantity', 'value', 'sense', 'on_paper'].map((word) => page.says(make('th', { scope: 'col' }), word));
  const caption = make('caption', { class: 'unseen' }), body = make('tbody');
  const scroll = make('div', { class: 'scroll', tabindex: '0', role: 'region' },
    make('table', { id: 'values' }, caption, make('thead', {}, make('tr', {}, ...cells)), body));
  const rows = page.rows.map((/** @type {any} */ quantity) => {
    const name = make('button', { type: 'button', 'aria-pressed': 'false', dir: 'ltr' }), [value, sense, paper] = ['', '', ''].map(() => make('bdi'));
    const row = make('tr', { 'data-quantity': quantity.name }, ...[name, value, sense, paper].map((one) => make('td', {}, one)));
    body.append(row);
    light.listen(row, quantity.name);
    on(row, 'click', () => light.pin(quantity.name));
    const panel = page.panels.find((/** @type {Panel} */ one) => one.ink.some((ink) => ink.move === 'vector' && ink.quantity === quantity.name));
    return { quantity, name, value, sense, paper, panel };
  });

  const inWords = (/** @type {any} */ row) => `; ${[row.name, '=', row.value, row.sense].map((one) => one.textContent ?? one).join(' ')}`;

  page.add({
    box: scroll,
    show() {
      for (const row of rows) {
        const said = told(row.quantity, page);
        setRich(row.value, said.value);
        setRich(row.sense, said.sense);
        if (row.panel) setRich(row.paper, paperText(page, row.quantity, row.panel.siPerMm));
      }
    },
    speak() {
      setText(caption, page.valuesHere());
      for (const { name, quantity } of rows) setRich(name, page.symbolOf(quantity.name));
    },
  });
  return {
    box: make('section', {}, page.says(make('h2'), 'values'), page.says(scroll, 'values', 'aria-label')),
    /** Which names are pressed. @param {string | null} pinned */
    press(pinned) {
      for (const row of rows) row.name.setAttribute('aria-pressed', String(pinned === row.quantity.name));
    },
    /** The vectors of a panel in words. @param {Panel} panel */
    textOfPanel: (panel) => rows.filter((/** @type {any} */ row) => row.panel === panel).map(inWords).join(''),
    /** A row in words; nothing where there is none. @param {string | null} name */
    textOf(name) {
      const row = rows.find((/** @type {any} */ one) => one.quantity.name === name);
      return row ? inWords(row) : '';
    },
  };
}
