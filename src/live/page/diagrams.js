// The diagrams with their captions: scales, and in words what cannot be seen.

/** Flatter crossings than this are badly readable by hand. */
const FLAT = 3 * Math.PI / 180;

/** @param {Page} page */
function showDiagrams(page) {
  const { panels, live, calm, variable } = page;

  /** The scale of a panel in this position, by the rule for one position. @param {Panel} panel */
  function refitted(panel) {
    const { data } = panel;
    if (!page.refit || !data.polygon) return data.si_per_mm;
    panel.siPerMm = 1;
    const seen = panel.seen(page.outputs).filter(Boolean);
    const [x0, y0, x1, y1] = data.box;
    const part = (/** @type {number} */ way, /** @type {number} */ low, /** @type {number} */ high) => (way === 0 ? 0 : way / (way > 0 ? high - 13 : low + 13));
    const needed = Math.max(0, ...seen.map((/** @type {any} */ p) => Math.max(part(p.x, x0, x1), part(p.y, y0, y1)))) / data.unit * 10;
    if (!(needed > 0) || !Number.isFinite(needed)) return data.si_per_mm;
    return roundUp(needed, [1, 2, 2.5, 5]) * data.unit / 10;
  }

  /** The least angle at which two lines of a panel meet that lead to one place. @param {Panel} panel */
  function flattest(panel) {
    let least = 1;
    for (const [one, other] of panel.crossings) {
      if (!one.element.isShown || !other.element.isShown) continue;
      const [a, b] = [one, other].map((ink) => minus(panel.now[ink.at[1]], panel.now[ink.at[0]]));
      const size = sizeOf(a) * sizeOf(b);
      if (size > 0) least = Math.min(least, Math.abs(a.x * b.y - a.y * b.x) / size);
    }
    return Math.asin(least);
  }

  /** Where vectors leave a panel, by its index: arrows at its border. */
  const cuts = panels.map(({ svg }) => ({ path: svg.appendChild(makeInk('path', { class: 'cut' })), told: '' }));

  /** In words what leaves the panel, with its length, and what crosses too flat. @param {Panel} panel */
  function beyond(panel) {
    const [x0, y0, x1, y1] = panel.data.box, said = [];
    let arrows = '';
    for (const ink of panel.ink) {
      if (!ink.ends || !ink.element.isShown) continue;
      const [a, b] = ink.ends;
      if (b.x > x0 && b.x < x1 && b.y > y0 && b.y < y1) continue;
      const d = minus(b, a), length = sizeOf(d), name = ink.quantity || ink.element.dataset.of;
      if (live.quantities[name]) said.push(filled(page.words.beyond, { name: lineText(page.symbolOf(name)), length: `${plainText(withPower(length))}\u00a0mm` }));
      const ends = [d.x > 0 ? (x1 - a.x) / d.x : (x0 - a.x) / d.x, d.y > 0 ? (y1 - a.y) / d.y : (y0 - a.y) / d.y];
      const part = Math.min(...ends.filter((end) => end > 0)), u = { x: d.x / length, y: d.y / length };
      if (part < 1) arrows += [0, -2.5].map((by) => headOf(plus(plus(a, d, part), u, by), u, 2.5)).join(' ');
    }
    const cut = cuts[panel.index];
    if (cut.told !== arrows) setPath(cut.path, arrows);
    cut.told = arrows;
    const angle = flattest(panel);
    if (angle < FLAT) said.push(filled(page.text.flat, { angle: degrees(angle) }));
    return said.join(' · ');
  }

  /** A sentence of so many; nothing of none. */
  function said(/** @type {number} */ count, /** @type {string} */ several, /** @type {string} */ one) {
    return count === 0 ? '' : filled(count === 1 ? one : several, { count: String(count) });
  }

  const boxes = panels.map(({ index }) => byId(`figure${index}`));
  for (const [index, box] of boxes.entries()) {
    page.watch.observe(box);
    // Side by side a millimetre is as long in one as in the other.
    const [left, top, right, bottom] = panels[index].data.box;
    box.style.setProperty('--wide', String(Math.round(right - left)));
    // As wide as its height allows: beside what is shown of its plane nothing is seen.
    box.style.setProperty('--broad', String((right - left) / (bottom - top)));
  }

  /** What stands below each panel, and the scale that it was last told with. */
  const below = panels.map(({ index }) => ({ scale: byId(`scale${index}`), beyond: byId(`beyond${index}`), told: 0 }));

  page.add({
    show() {
      for (const panel of panels) {
        const { data, index } = panel, own = below[index];
        if (!page.isDue(boxes[index])) continue;
        panel.siPerMm = refitted(panel);
        panel.calm = calm.matches;
        panel.angle = variable.kind === 'angle' ? page.at : undefined;
        panel.show(page.outputs, page.at, page.step > page.last ? Infinity : page.step, page.isOwn, page.isWhole);
        if (data.polygon && own.told !== panel.siPerMm) {
          own.told = panel.siPerMm;
          const value = withUnit(plainText(stated(panel.siPerMm * 10 / data.unit)), data.unit_symbol);
          setText(own.scale, filled(page.text.scale, { scale: `${value}\u00a0≡\u00a01\u00a0cm` }));
        }
        const { no_room: names, no_room_one: name, not_moving: strokes, not_moving_one: stroke } = page.words;
        const still = page.isOwn ? 0 : data.still;
        setText(own.beyond, [panel.outOfSlots?.(page.words), beyond(panel), said(still, strokes, stroke), said(panel.crowded, names, name)].filter(Boolean).join(' · '));
      }
    },
    speak() {
      const { panels: titles, scales } = page.text;
      titles.forEach((/** @type {string} */ title, /** @type {number} */ i) => {
        setRich(byId(`title${i}`), title);
        setRich(below[i].scale, scales[i]);
        below[i].told = 0;
      });
    },
  });
}

/** Which panels are open. @param {Page} page */
function choosesPanels(page) {
  const { panels, live: { opens } } = page, row = make('div', { class: 'row traces' });
  if (panels.length < 2) return [];
  const choices = panels.map(({ index }) => {
    const box = make('input', { type: 'checkbox' }), name = make('span'), figure = byId(`figure${index}`);
    const turn = () => { figure.hidden = !box.checked; };
    box.checked = !opens.closed.includes(index);
    on(box, 'change', turn);
    turn();
    row.append(make('label', {}, box, name));
    return name;
  });
  page.add({ speak: () => { choices.forEach((name, i) => setRich(name, page.text.panels[i])); } });
  return [page.says(make('h2', { class: 'traces' }), 'panels'), row];
}

/** Panels that fill the window. @param {Page} page */
function fillWindow(page) {
  let latest = byId('figure0');
  for (const { index } of page.panels) {
    const figure = byId(`figure${index}`);
    figure.append(page.button({ class: 'out' }, 'close', () => figure.classList.remove('whole')));
    on(figure, 'pointerdown', () => { latest = figure; });
  }
  const whole = () => document.querySelector('.panel.whole');
  return {
    fill: () => { (whole() || latest).classList.toggle('whole'); },
    leave: () => { whole()?.classList.remove('whole'); },
  };
}
