// What people type.

/** A number as people write it, with Persian and Arabic digits and signs as well; NaN where it is none. */
function typed(/** @type {string} */ text) {
  const plain = text
    .replace(/[\u200e\u200f\u061c\s\u066c]/g, '')
    .replace(/[\u0660-\u0669\u06f0-\u06f9]/g, (digit) => String(digit.charCodeAt(0) & 15))
    .replace(/^\u2212/, '-')
    .replace(/([eE])\u2212/, '$1-')
    .replace(/[,\u066b\u060c]/, '.');
  return /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/.test(plain) ? Number(plain) : NaN;
}

/** A place of the input in SI units: a number or a fraction, with its unit or in that of the scene. */
function typedInput(/** @type {string} */ text, /** @type {any} */ variable) {
  /** @type {Record<string, number>} */
  const units = variable.kind === 'angle' ? { '°': Math.PI / 180, deg: Math.PI / 180, rad: 1 } : {};
  units[variable.unit] = variable.si;
  let [rest, si] = [text.trim(), variable.si];
  for (const [unit, own] of Object.entries(units)) {
    if (rest.endsWith(unit)) {
      [rest, si] = [rest.slice(0, -unit.length), own];
      break;
    }
  }
  const parts = rest.split(/[/\u2044]/).map(typed);
  if (parts.length > 2 || parts[1] === 0) return NaN;
  return parts.length === 2 ? parts[0] / parts[1] * si : parts[0] * si;
}
