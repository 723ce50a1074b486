// Numbers as the sheet writes them: three or four figures, a true minus, ties to the even digit.

/** `toExponential`, but a tie goes to the even digit. */
function scientific(/** @type {number} */ value, /** @type {number} */ digits) {
  const text = value.toExponential(digits);
  const more = Math.abs(value).toExponential(digits + 1);
  if (!/5e/.test(more)) return text;
  const [mantissa, exponent] = Math.abs(value).toExponential(Math.min(100, digits + 60)).split('e');
  if (!/^5?0*$/.test(mantissa.slice(digits + 2 + (digits === 0 ? 0 : 0)).replace('.', ''))) return text;
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
  const point = text.indexOf('.') < 0 ? text.length : text.indexOf('.');
  const digits = text.slice(0, point).replace(/[^0-9]/g, '').length;
  if (digits < 5) return text;
  let left = digits, out = '';
  for (const c of text.slice(0, point)) {
    if (c >= '0' && c <= '9') {
      if (left < digits && left % 3 === 0) out += '\u2009';
      left -= 1;
    }
    out += c;
  }
  return out + text.slice(point);
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

/** As the sheet writes a computed number. @param {number} value */
function numberParts(value) {
  const size = Math.abs(value);
  const short = Number(scientific(value, 2));
  if (Math.abs(short - value) <= 1e-9 * size) return figures(value, 3, true);
  return figures(value, size >= 1000 ? 4 : 3, false);
}

/** An angle in degrees, one decimal at most. @param {number} radians */
function degrees(radians) {
  let text = fixed(radians * (180 / Math.PI), 1).replace(/\.0$/, '');
  if (text === '\u22120' || text === '\u2212180') text = text.slice(1);
  return `${text}°`;
}
