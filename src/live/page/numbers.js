// Numbers as the sheet writes them: three or four figures, a true minus, ties to the even digit.

/** `toExponential`, but a tie goes to the even digit. */
function scientific(/** @type {number} */ value, /** @type {number} */ digits) {
  const text = value.toExponential(digits);
  const more = Math.abs(value).toExponential(digits + 1);
  if (!/5e/.test(more)) return text;
  const [mantissa, exponent] = Math.abs(value).toExponential(Math.min(100, digits + 60)).split('e');
  if (!/^5?0*$/.test(mantissa.slice(digits + 2).replace('.', ''))) return text;
  // The exact tie: cut, and up where the last digit is odd.
  const cut = mantissa.slice(0, digits === 0 ? 1 : digits + 2);
  if (Number(cut[cut.length - 1]) % 2 !== 0) return text;
  return `${value < 0 ? '-' : ''}${cut}e${exponent}`;
}

/** `toFixed`, but a tie goes to the even digit; no sign before zero. */
function fixed(/** @type {number} */ value, /** @type {number} */ decimals) {
  const size = Math.abs(value);
  let text = size.toFixed(decimals);
  if (size < 1e15 && size.toFixed(decimals + 1).endsWith('5')) {
    const long = size.toFixed(Math.min(100, decimals + 60));
    const cut = long.slice(0, long.indexOf('.') + (decimals === 0 ? 0 : decimals + 1));
    const left = long.slice(long.indexOf('.') + 1 + decimals);
    if (/^50*$/.test(left) && Number(cut[cut.length - 1]) % 2 === 0) text = cut;
  }
  return value < 0 && /[1-9]/.test(text) ? `\u2212${text}` : text;
}

/** Whole digits in groups of three, from five on. @param {string} text */
function grouped(text) {
  const [whole, ...rest] = text.split('.');
  return [/\d{5}/.test(whole) ? whole.replace(/\d(?=(\d{3})+$)/g, '$&\u2009') : whole, ...rest].join('.');
}

/** @returns {[string, string]} the number, and the power of ten that is set high. */
function figures(/** @type {number} */ value, /** @type {number} */ digits, /** @type {boolean} */ trim) {
  if (value === 0 || !Number.isFinite(value)) return ['0', ''];
  const written = scientific(value, digits - 1);
  const [mantissa, power] = written.split('e');
  const exponent = Number(power);
  const tidy = (/** @type {string} */ text) => {
    const short = trim && text.includes('.') ? text.replace(/0+$/, '').replace(/\.$/, '') : text;
    return short.replace('-', '\u2212');
  };
  if (exponent >= -3 && exponent < 6) {
    const decimals = Math.max(0, digits - 1 - exponent);
    return [grouped(tidy(fixed(Number(written), decimals).replace('\u2212', '-'))), ''];
  }
  return [`${tidy(mantissa)}\u00a0×\u00a010`, String(exponent).replace('-', '\u2212')];
}

/** As the sheet writes a computed number, with so many figures more than usual: what three figures say whole has no more. @returns {[string, string]} */
function numberParts(/** @type {number} */ value, more = 0) {
  const size = Math.abs(value), short = Number(scientific(value, 2));
  if (Math.abs(short - value) <= 1e-9 * size) return figures(value, 3, true);
  return computed(value, (size >= 1000 ? 4 : 3) + more);
}

/** With so many figures: what lies half way between two of three has one more, what does between two of more goes up. @returns {[string, string]} */
function computed(/** @type {number} */ value, /** @type {number} */ digits) {
  const half = 0.5 * 10 ** (Math.floor(Math.log10(Math.abs(value))) - digits + 1);
  if (Math.abs(Math.abs(value - Number(scientific(value, digits - 1))) - half) > 1e-6 * half) return figures(value, digits, false);
  return digits < 4 ? figures(value, digits + 1, false) : figures(value + 0.2 * half * Math.sign(value), digits, false);
}

/** Whether so short a vector is a point on paper. @param {number} mm */
function isPoint(mm) {
  return Math.round(10 * mm) < 10;
}

/** A reading on paper, and what it is by the scale: to tenths of a millimetre, or to as many of its four figures as it takes for
 * the product to be the number that stands for the result, if need be a hundredth further off or with a fifth as a guard; where no ruler reads finer that
 * number is what was read.
 * @param {number} mm @param {number} factor @param {number} result @param {number} wished figures more than usual */
function readOff(mm, factor, result, wished) {
  const usual = result >= 1000 ? 4 : 3, more = Math.min(wished, 4 - usual), digits = usual + more;
  const written = Number(scientific(result, digits - 1)), half = 0.5 * 10 ** (Math.floor(Math.log10(written)) - digits + 1);
  const amount = (/** @type {string} */ text) => Number((Number(text) * factor).toPrecision(12));
  const finest = mm < 10 ? 3 : mm < 100 ? 2 : 1;
  for (let decimals = 1; decimals <= finest + 1; decimals++) {
    const near = fixed(mm, decimals), place = 10 ** -decimals, other = Number(near) + (Number(near) > mm ? -place : place);
    for (const text of decimals > 1 && decimals <= finest ? [near, fixed(other, decimals)] : [near]) {
      const off = (amount(text) - written) / half;
      if (off < 1 - 1e-6 && off >= (digits < 4 ? -1 + 1e-6 : -1 - 1e-6)) return [text, withPower(result, more)];
    }
  }
  const text = fixed(mm, finest);
  return [text, raised(computed(amount(text), digits))];
}

/** An angle in degrees, one decimal at most; one that is stated with up to five has these. @param {number} radians */
function degrees(radians) {
  const value = radians * (180 / Math.PI), is = (/** @type {number} */ places, /** @type {number} */ room) => Math.abs(Number(value.toFixed(places)) - value) <= room, decimals = is(3, 1e-9) ? 3 : is(5, 1e-11) ? 5 : 1;
  let text = fixed(value, decimals).replace(/\.?0+$/, '');
  if (text === '\u22120' || text === '\u2212180') text = text.slice(1);
  return `${text}°`;
}
