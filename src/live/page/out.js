// What the page gives away: drawings, the table of numbers, the address of the position.

/** The coordinate that a number is, of several. */
function axisOf(/** @type {number[]} */ outputs, /** @type {number} */ axis) {
  return outputs.length === 2 ? ['.x', '.y'][axis] : '';
}

/** One drawing, the panels below each other. @param {Page} page */
function drawings(page) {
  const { panels } = page;
  // Whoever reads it need not guess which name is whose.
  for (const panel of panels) panel.tells = true;
  page.draw(true);
  const all = makeInk('svg', { 'stroke-linejoin': 'round', 'font-family': panels[0].svg.getAttribute('font-family') || '' });
  let down = 0, across = 0;
  for (const panel of panels) {
    panel.tells = false;
    const copy = /** @type {Element} */ (panel.svg.cloneNode(true));
    copy.querySelectorAll('.grips, .reach, .cut, .beside, .way, .stop, [visibility=hidden]').forEach((own) => own.remove());
    copy.querySelectorAll('[class=""]').forEach((own) => own.removeAttribute('class'));
    const [x, y, width, height] = (copy.getAttribute('viewBox') || '').split(' ').map(Number);
    const group = makeInk('g', { transform: `translate(${mm(-x)} ${mm(down - y)})` });
    group.append(...copy.childNodes);
    const own = group.querySelector('g');
    if (own) having(own, { 'data-si-per-mm': String(panel.siPerMm), 'data-at': page.exact() });
    // What it is, at which scale and where, each in its own direction: polygons without a scale are none.
    const said = ['title', 'scale'].map((id) => byId(`${id}${panel.index}`).textContent);
    if (!panel.data.polygon) said.push(page.inUnit(page.at));
    const caption = makeInk('text', { x: '2', y: mm(down + height + 3), 'font-size': '3.5' });
    setText(caption, said.filter(Boolean).map((part) => `\u2068${part}\u2069`).join(' · '));
    all.append(group, caption);
    down += height + 6;
    across = Math.max(across, width);
  }
  page.draw(true);
  having(all, { width: `${mm(across)}mm`, height: `${mm(down)}mm`, viewBox: `0 0 ${mm(across)} ${mm(down)}` });
  return new XMLSerializer().serializeToString(all);
}

/** A unit as `sweep` writes it. @param {string} unit */
function plainUnit(unit) {
  return unit.replace('µ', 'u').replace('·', '*').replace('²', '^2').replace('³', '^3').replace('°', 'deg');
}

/** As `sweep` has it: a column for each number, its unit in the head, the position first; nothing where none is known. @param {Page} page */
function csv(page) {
  const { told: input, unit } = page.variable;
  const quoted = (/** @type {string} */ text) => (/[",\n\r]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
  const head = [`${input} [${unit}]`], line = [String(page.place())];
  for (const { name, outputs, unit: own, si, sized } of page.rows) {
    const put = (/** @type {string} */ part, /** @type {string} */ inUnit, /** @type {number | null} */ value) => {
      head.push(`${name}${part} [${plainUnit(inUnit)}]`);
      line.push(value === null ? '' : Object.is(value, -0) ? '-0' : String(value));
    };
    const [x, y] = outputs.map((/** @type {number} */ output) => page.outputs[output]);
    outputs.forEach((/** @type {number} */ _, /** @type {number} */ axis) => {
      const value = axis ? y : x;
      put(axisOf(outputs, axis), own, value === null ? null : value / si);
    });
    if (!sized) continue;
    const known = x !== null && y !== null;
    put('.size', own, known ? sizeOfBoth(x, y) / si : null);
    put('.direction', '°', known && (x !== 0 || y !== 0) ? angleOf(y, x) * (180 / Math.PI) : null);
  }
  return `${head.map(quoted).join(',')}\r\n${line.join(',')}\r\n`;
}

/** @param {Page} page */
function givesAway(page) {
  const field = page.says(make('textarea', { id: 'out', readonly: '', rows: '6' }), 'denied', 'aria-label');
  field.hidden = true;

  /** Where it is denied the text stands in a field. @param {string} text @param {() => void | Promise<void>} by */
  async function give(text, by) {
    field.hidden = true;
    try {
      await by();
    } catch {
      field.hidden = false;
      field.value = text;
      page.say(page.words.denied);
      field.select();
    }
  }
  const copy = (/** @type {string} */ text) => give(text, async () => {
    await navigator.clipboard.writeText(text);
    page.say(page.words.copied);
  });
  const save = (/** @type {string} */ text, /** @type {string} */ name, /** @type {string} */ kind) => give(text, () => download(text, name, kind));

  /** In a sandboxed frame nothing is printed, and nothing says so. */
  function prints() {
    let begun = false;
    window.addEventListener('beforeprint', () => { begun = true; }, { once: true });
    window.print();
    if (!begun) page.say(page.words.no_print);
  }

  return {
    field,
    buttons: [
      page.button({ id: 'copy' }, 'copy', () => copy(drawings(page))),
      page.button({ id: 'save' }, 'save', () => save(drawings(page), 'drawing.svg', 'image/svg+xml')),
      page.button({ id: 'table' }, 'save_table', () => save(csv(page), 'values.csv', 'text/csv')),
      page.button({ id: 'link' }, 'link_here', () => copy(`${location.href.split('#')[0]}#${page.address()}`)),
      page.button({ id: 'print' }, 'print', prints),
    ],
  };
}
