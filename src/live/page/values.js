// The values of one position as the sheet tells them.

/** A number with its power of ten set high. @param {[string, string]} parts */
function raised([digits, power]) {
  return power ? `${digits}<sup>${power}</sup>` : digits;
}

/** As the sheet writes a computed number, with so many figures more than usual, as a line of a step may have it. */
function withPower(/** @type {number} */ value, more = 0) {
  return raised(numberParts(value, more));
}

/** A stated number: as many of its figures as it needs, at most six. @param {number} value */
function stated(value) {
  return raised(figures(value, 6, true));
}

/** @param {string} text @param {string} unit */
function withUnit(text, unit) {
  if (!unit) return text;
  return unit === '°' ? `${text}°` : `${text}\u00a0${unit}`;
}

/** A number of the position: what its running error does not tell from zero is zero. */
function clearNumber(/** @type {any} */ { program, live }, /** @type {any} */ outputs, /** @type {number} */ index) {
  return program.isClear(live.outputs[index].row) ? outputs[index] : 0;
}

/** The size of the vector whose first coordinate is an output, and its direction; zero where neither coordinate is told
 * from zero. */
function clearVector(/** @type {any} */ course, /** @type {any} */ outputs, /** @type {number} */ index) {
  const clear = [0, 1].some((axis) => clearNumber(course, outputs, index + axis) !== 0);
  const [x, y] = [outputs[index], outputs[index + 1]];
  return clear ? [Math.hypot(x, y), angleOf(y, x)] : [0, 0];
}

/** A vector on the paper of its panel: its length and the scale, whose product it is; nothing of what is a point there. */
function paperText(/** @type {Page} */ { course, outputs }, /** @type {any} */ { outputs: [x, y], si }, /** @type {number} */ siPerMm) {
  if (outputs[x] === null || outputs[y] === null) return '';
  const [size] = clearVector(course, outputs, x);
  return isPoint(size / siPerMm) ? '' : `${readOff(size / siPerMm, siPerMm / si, size / si, 0)[0]}\u00a0mm\u00a0×\u00a0${stated(siPerMm / si)}`;
}

/** A number that begins with an output, in a unit: with the figures with which the steps tell it, or so many more than usual. */
function amountText(/** @type {Page} */ page, /** @type {number} */ output, /** @type {number} */ value, /** @type {number} */ si, more = 0) {
  const own = page.figures.get(output);
  if (own?.si !== si) return withPower(value / si, more);
  const { siPerMm } = page.panels[own.panel] || {};
  if (!siPerMm || isPoint(value / siPerMm)) return withPower(value / si, own.more);
  return readOff(value / siPerMm, siPerMm / si, value / si, page.isOwn ? own.more : FINER)[1];
}

/** Value and sense of a quantity. @returns {{value: string, sense: string}} */
function told(/** @type {any} */ { kind, outputs: own, si, unit, value: constant }, /** @type {Page} */ page) {
  const { course, outputs, words } = page;
  if (constant !== undefined) return { value: withUnit(withPower(constant / si), unit), sense: '' };
  if (own.length === 0 || own.some((/** @type {number} */ i) => outputs[i] === null)) return { value: '—', sense: reasonOf(own, course, words) };
  const clear = (/** @type {number} */ i) => clearNumber(course, outputs, own[i]);
  // Rounded once: the sheet's table tells what was read on its own paper.
  const amount = (/** @type {number} */ value) => withPower(value / si);
  const said = (/** @type {string} */ text, sense = '') => ({ value: withUnit(text, unit), sense });
  switch (kind) {
    case 'rotation': {
      const value = clear(0);
      return said(amount(Math.abs(value)), value === 0 ? '' : value > 0 ? words.ccw : words.cw);
    }
    case 'place': return said(`(${withPower(clear(0) / si)};\u00a0${withPower(clear(1) / si)})`);
    case 'vector': {
      const [size, angle] = clearVector(course, outputs, own[0]);
      return size === 0 ? said('0') : said(amount(size), `∠\u00a0${degrees(angle)}`);
    }
    default: return said(amount(clear(0)));
  }
}

/** Why a quantity is not known here: the first divisor behind it that does not stand clear, by its links, or by how friction is
 * stuck there. What was computed from it is no number, and no reason. */
function reasonOf(/** @type {number[]} */ outputs, /** @type {any} */ course, /** @type {any} */ words) {
  const { live, program } = course;
  for (const output of outputs) {
    for (const index of live.behind[output]) {
      const [row, reason] = program.divisors[index];
      if (program.isClear(row) || Number.isNaN(program.value[row])) continue;
      const own = [...new Set(live.reasons[reason])], stuck = live.stuck?.[reason];
      if (stuck) return `${words.not_here}: ${words[stuck]}`;
      if (own.length > 1) {
        return `${words.not_here}: ${filled(words.in_line, { links: own.join(', ') })}`;
      }
    }
  }
  return words.not_here;
}
