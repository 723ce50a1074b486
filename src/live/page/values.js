// The values of one position as the sheet tells them.

/** A number with its power of ten set high. */
function withPower(/** @type {number} */ value) {
  const [digits, power] = numberParts(value);
  return power ? `${digits}<sup>${power}</sup>` : digits;
}

/** A number as a line of a step has it, with so many figures more than usual. */
function withGuard(/** @type {number} */ value, /** @type {number} */ more) {
  const short = Number(scientific(value, 2));
  if (more === 0 || Math.abs(short - value) <= 1e-9 * Math.abs(value)) return withPower(value);
  const [digits, power] = figures(value, (Math.abs(value) >= 1000 ? 4 : 3) + more, false);
  return power ? `${digits}<sup>${power}</sup>` : digits;
}

/** A stated number: as many of its figures as it needs, at most six. @param {number} value */
function stated(value) {
  const [digits, power] = figures(value, 6, true);
  return power ? `${digits}<sup>${power}</sup>` : digits;
}

/** @param {string} text @param {string} unit */
function withUnit(text, unit) {
  if (!unit) return text;
  return unit === '°' ? `${text}°` : `${text}\u00a0${unit}`;
}

/** Value and sense of a quantity: what its running error does not tell from zero reads zero. */
function told(/** @type {any} */ quantity, /** @type {any} */ course, /** @type {(number | null)[]} */ outputs, /** @type {any} */ words) {
  const { program, live } = course;
  const own = quantity.outputs.map((/** @type {number} */ i) => outputs[i]);
  if (own.length === 0 || own.includes(null)) return { value: '—', sense: reasonOf(quantity, course, words), size: null };
  const rows = quantity.outputs.map((/** @type {number} */ i) => live.outputs[i].row);
  const clear = (/** @type {number} */ i) => (program.isClear(rows[i]) ? own[i] : 0);
  switch (quantity.kind) {
    case 'rotation': {
      const value = clear(0);
      const sense = value === 0 ? '' : value > 0 ? words.ccw : words.cw;
      return { value: withUnit(withPower(Math.abs(value) / quantity.si), quantity.unit), sense, size: value };
    }
    case 'place': {
      const pair = [clear(0), clear(1)].map((x) => withPower(x / quantity.si));
      return { value: withUnit(`(${pair[0]};\u00a0${pair[1]})`, quantity.unit), sense: '', size: null };
    }
    case 'vector': {
      const bound = Math.hypot(program.error(rows[0]), program.error(rows[1])) * CLEAR;
      const size = Math.hypot(own[0], own[1]);
      if (size <= bound) return { value: withUnit('0', quantity.unit), sense: '', size: 0 };
      const sense = `∠\u00a0${degrees(angleOf(own[1], own[0]))}`;
      return { value: withUnit(withPower(size / quantity.si), quantity.unit), sense, size };
    }
    default: {
      const value = clear(0);
      return { value: withUnit(withPower(value / quantity.si), quantity.unit), sense: '', size: value };
    }
  }
}

/** Why a quantity is not known here: the links of the divisors behind it that do not stand clear. */
function reasonOf(/** @type {any} */ quantity, /** @type {any} */ course, /** @type {any} */ words) {
  const { live, program } = course;
  for (const output of quantity.outputs) {
    for (const index of live.behind[output]) {
      const [row, reason] = program.divisors[index];
      const links = live.reasons[reason] || [];
      if (!program.isClear(row) && links.length > 0) {
        return `${words.not_here}: ${filled(words.in_line, { links: links.join(', ') })}`;
      }
    }
  }
  return words.not_here;
}
