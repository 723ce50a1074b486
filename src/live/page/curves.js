// Paths of points, to be chosen, and the diagram of a quantity over the input.

/** The name of a point as it stands beside it: its letters, its primes, and what is set low. @param {string} name */
function nameInk(name) {
  const [, letters, primes, low] = /^([^\d']*)('*)(.*)$/.exec(name) || [];
  return [['i', letters], ['', primes?.replace(/'/g, '\u2032')], ['sub', low]].filter(([, text]) => text)
    .map(([tag, text]) => (tag ? make(String(tag), {}, String(text)) : String(text)));
}

/** @param {Page} page */
function choosesTraces(page) {
  const row = make('div', { class: 'row traces' });
  for (const panel of page.panels) {
    for (const { anchors, of, point } of panel.labels) {
      const [[kind, place], beside] = anchors[0];
      // What stands under a layer has its path in the panel of its own.
      const isPoint = anchors.length === 1 && kind === 1 && of !== undefined && (panel.data.layer ? place >= panel.data.own : point);
      if (!isPoint || !moves(page, panel, place)) continue;
      const box = make('input', { type: 'checkbox' });
      box.checked = panel.index === 0 && of.some((/** @type {string} */ name) => page.live.opens.traces.includes(name));
      row.append(make('label', {}, box, make('bdi', {}, ...of.flatMap((/** @type {string} */ name, /** @type {number} */ i) => [...(i ? [', '] : []), ...nameInk(name)]))));
      /** @type {any} */
      let path = null;
      const draw = () => {
        if (!path) {
          path = makeInk('path', { class: 'trace', d: tracePath(page.course, panel, place, beside) });
          panel.svg.prepend(path);
        }
        visible(path, box.checked);
      };
      on(box, 'change', draw);
      if (box.checked) draw();
    }
  }
  return [page.says(make('h2', { class: 'traces' }), 'traces'), row];
}

/** A place for the diagram of a number, a coordinate of a row or, with -1, its size. @param {Page} page @param {{wish: (at: number) => void}} travel */
function diagramPlace(page, travel) {
  const { rows, course, variable } = page;
  const span = make('p', { dir: 'ltr' }), place = make('div', { class: 'plot', dir: 'ltr' });
  const diagram = new CurveDiagram(course, travel.wish);
  place.append(diagram.svg, diagram.numbers);
  page.add({ box: place, show: () => diagram.show(page.at) });

  function show(/** @type {number} */ index, /** @type {number} */ axis) {
    const quantity = rows[index], symbol = page.symbolOf(quantity.name);
    const { low, high } = diagram.draw(quantity, axis, variable);
    const [least, most] = [low, high].map((value) => plainText(withPower(value)));
    diagram.svg.setAttribute('aria-label', `${plainText(symbol)}: ${least} … ${most} ${quantity.unit}`);
    setRich(span, `${symbol}, ${quantity.unit || '1'} · ${page.inputName()}, ${page.unitSign()}`);
    diagram.show(page.at);
  }
  return { elements: [span, place], show };
}

/** @param {Page} page @param {{wish: (at: number) => void}} travel */
function choosesDiagram(page, travel) {
  const head = page.says(make('h2', { class: 'idle', id: 'diagramhead' }), 'diagram');
  const box = make('select', { id: 'diagram', 'aria-labelledby': 'diagramhead' }, make('option', { value: '' }, '—'));
  page.rows.forEach(({ name: own, kind, outputs }, i) => {
    const name = lineText(page.symbolOf(own));
    if (kind === 'vector') box.append(make('option', { value: `${i} -1` }, `|${name}|`));
    outputs.forEach((/** @type {number} */ _, /** @type {number} */ axis) => {
      box.append(make('option', { value: `${i} ${axis}` }, name + axisOf(outputs, axis)));
    });
  });
  const chosen = diagramPlace(page, travel), all = make('div');
  const more = page.live.opens.diagrams.map((/** @type {number} */ index) => {
    const one = diagramPlace(page, travel);
    all.append(...one.elements);
    return () => one.show(index, page.rows[index].kind === 'vector' ? -1 : 0);
  });

  function choose() {
    const isIdle = box.value === '', [index, axis] = box.value.split(' ').map(Number);
    for (const element of chosen.elements) element.hidden = isIdle;
    head.classList.toggle('idle', isIdle && more.length === 0);
    if (!isIdle) chosen.show(index, axis);
  }

  on(box, 'change', choose);
  page.add({
    speak() {
      for (const show of more) show();
      choose();
    },
  });
  return {
    elements: [head, all, make('div', { class: 'row diagrams' }, box), ...chosen.elements],
    /** The diagram that is chosen, or the first. */
    open() {
      if (box.value === '' && box.options.length > 1) box.selectedIndex = 1;
      choose();
      chosen.elements[1].scrollIntoView({ block: 'nearest' });
    },
  };
}
