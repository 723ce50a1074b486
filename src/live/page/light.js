// Highlighting: a quantity is one thing as a vector, a term, a row and a link; what is lit in one place is lit in all.

/** @param {Page} page */
function highlights(page) {
  const { live, panels: [skeleton] } = page;
  const vectors = allOf('#stage .vector');
  const links = allOf('#stage [data-link]:not([data-quantity])');
  /** @type {string | null} */
  let pinned = null;
  /** @type {string | null} */
  let hovered = null;
  /** @type {string | null} */
  let hoveredLink = null;
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
    if (drawn) line.setAttribute('d', `M${pair(ends[0])} L${pair(ends[1])}`);
  }

  function light() {
    const lit = hovered || pinned, link = hoveredLink || linkOf(lit);
    const claims = vectors.filter((one) => lit && one.dataset.quantity === lit)
      .map((one) => one.dataset.parallel || one.dataset.perpendicular).filter(Boolean);
    const places = String(claims[0] || '').split(' ').map(placeNamed);
    beside = places.includes(-1) ? [] : places;
    show();
    for (const element of links) element.classList.toggle('lit', link !== null && element.dataset.link === link);
    for (const element of allOf('#live [data-quantity], #live [data-of]')) {
      const own = element.dataset.quantity, of = (element.dataset.of || '').split(' ');
      const byLink = hoveredLink !== null && linkOf(own) === hoveredLink;
      element.classList.toggle('lit', byLink || (lit !== null && (own === lit || of.includes(lit))));
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

  for (const element of allOf('#stage [data-quantity]')) {
    const { quantity } = element.dataset;
    listen(element, quantity);
    on(element, 'click', () => { if (!page.dragged) pin(quantity); });
  }
  // A link shows what it is that turns, and is shown by it.
  const hoverLink = (/** @type {string | null} */ link) => () => {
    hoveredLink = link;
    light();
  };
  for (const element of links) {
    on(element, 'pointerenter', hoverLink(element.dataset.link));
    on(element, 'pointerleave', hoverLink(null));
  }
  page.add({ show });
  return {
    light, listen, pin,
    pinned: () => pinned,
    /** @param {(pinned: string | null) => void} does */
    followed(does) { follow = does; },
    letGo() {
      pinned = null;
      hover(null)();
    },
  };
}
