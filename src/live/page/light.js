// Highlighting: a quantity is one thing as a vector, a term, a row and a link; what is lit in one place is lit in all.

/** @param {Page} page */
function highlights(page) {
  const { live, panels } = page, [skeleton] = panels;
  const vectors = allOf('#stage .vector');
  const links = allOf('#stage [data-link]:not([data-quantity])');
  /** @type {string | null} */
  let pinned = null;
  /** @type {string | null} */
  let hovered = null;
  /** @type {string | null} */
  let hoveredLink = null;
  /** @type {string | null} */
  let pinnedLink = null;
  const line = makeInk('path', { class: 'beside' });
  skeleton.svg.append(line);
  /** Of what is lit the points to whose line it is parallel or square, by their places. @type {number[]} */
  let beside = [];
  /** What else follows a pin. @type {(pinned: string | null) => void} */
  let follow = () => {};

  const linkOf = (/** @type {string | null | undefined} */ name) => {
    const link = name && live.quantities[name]?.link;
    return link === null || link === undefined ? null : String(link);
  };

  function placeNamed(/** @type {string} */ name) {
    const label = skeleton.labels.find((/** @type {any} */ one) => one.point && one.of?.includes(name));
    return label && label.anchors[0][0][0] === 1 ? label.anchors[0][0][1] : -1;
  }

  function show() {
    const ends = beside.map((place) => skeleton.now?.[place]);
    const drawn = ends.length === 2 && ends.every(Boolean);
    visible(line, drawn);
    if (drawn) setPath(line, `M${pair(ends[0])} L${pair(ends[1])}`);
  }

  function light() {
    const lit = hovered || pinned, own = hoveredLink || pinnedLink, link = own || linkOf(lit);
    const claims = vectors.filter((one) => lit && one.dataset.quantity === lit)
      .map((one) => one.dataset.parallel || one.dataset.perpendicular).filter(Boolean);
    const places = String(claims[0] || '').split(' ').map(placeNamed);
    beside = places.includes(-1) ? [] : places;
    show();
    for (const element of links) element.classList.toggle('lit', link !== null && element.dataset.link === link);
    for (const element of allOf('#live [data-quantity], #live [data-of]')) {
      const { quantity, of = '' } = element.dataset;
      const byLink = own !== null && linkOf(quantity) === own;
      element.classList.toggle('lit', byLink || (lit !== null && (quantity === lit || of.split(' ').includes(lit))));
    }
    follow(pinned);
  }

  const hover = (/** @type {string | null} */ quantity) => () => {
    hovered = quantity;
    light();
  };
  function listen(/** @type {Element} */ element, /** @type {string} */ quantity) {
    // Ink that listened for the focus would be a stop of the Tab key.
    const isInk = element instanceof SVGElement;
    on(element, isInk ? 'pointerenter' : 'pointerenter focusin', hover(quantity));
    on(element, isInk ? 'pointerleave' : 'pointerleave focusout', hover(null));
  }

  function pin(/** @type {string | null} */ quantity) {
    pinned = pinned === quantity ? null : quantity;
    light();
  }

  for (const element of allOf('#stage [data-quantity]:not(.vector)')) {
    const { quantity } = element.dataset;
    listen(element, quantity);
    on(element, 'click', () => { if (!page.dragged) pin(quantity); });
  }
  // A vector is thin: the nearest one is meant, of those that are near enough for a mouse or a finger.
  for (const panel of panels) {
    const near = (/** @type {any} */ event) => {
      const at = spotOf(panel.svg, event);
      if (!at) return null;
      let least = (event.pointerType === 'touch' ? 18 : 6) / (panel.svg.getScreenCTM()?.a || 1), nearest = null;
      for (const ink of panel.ink) {
        const [a, b] = ink.move === 'vector' ? ink.at.map((/** @type {number} */ i) => panel.now[i]) : [];
        if (!a || !b || !live.quantities[ink.quantity] || !ink.element.isShown) continue;
        const off = offStroke(at, a, b);
        if (off < least) [least, nearest] = [off, ink.quantity];
      }
      return nearest;
    };
    on(panel.svg, 'pointermove', (event) => {
      if (page.playing || event.buttons) return;
      const quantity = near(event);
      if (quantity !== hovered && (quantity || !event.target.closest('[data-quantity]'))) hover(quantity)();
    });
    on(panel.svg, 'pointerleave', hover(null));
    on(panel.svg, 'click', (event) => {
      const quantity = !page.dragged && !event.target.closest('[data-quantity]:not(.vector)') && near(event);
      if (quantity) pin(quantity);
    });
  }
  // A link shows what it is that turns, and is shown by it.
  const hoverLink = (/** @type {string | null} */ link) => () => {
    hoveredLink = link;
    light();
  };
  for (const element of links) {
    on(element, 'pointerenter', hoverLink(element.dataset.link));
    on(element, 'pointerleave', hoverLink(null));
    on(element, 'click', () => {
      if (page.dragged) return;
      pinnedLink = pinnedLink === element.dataset.link ? null : element.dataset.link;
      light();
    });
  }
  page.add({ show });
  return {
    light, listen, pin,
    pinned: () => pinned,
    /** @param {(pinned: string | null) => void} does */
    followed(does) { follow = does; },
    letGo() {
      pinned = null;
      pinnedLink = null;
      hover(null)();
    },
  };
}
