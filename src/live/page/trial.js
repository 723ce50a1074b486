// What the drawing found by trial, found again for another position.

/** A slope may be off by this part of it. */
const CARRIED = 1e-9;

/**
 * Computes the steps from one place of the code to another with how they change with what is tried. Gives the least square
 * of a half chord that cannot be drawn and changes, with its slope.
 * @param {number} from @param {number} to @param {number[]} signs @param {Float64Array} row @param {Float64Array} slope
 */
Program.prototype.runWithSlopes = function runWithSlopes(from, to, signs, row, slope) {
  const { code, partials } = this;
  let apart = 0, parting = 0;
  const values = [0, 0, 0, 0], moves = [0, 0, 0, 0];
  for (let step = from; step < to; step += WIDTH) {
    const kind = code[step], count = OPERANDS[kind], second = code[step + 2];
    for (let i = 0; i < 4; i++) {
      values[i] = i < count ? row[code[step + 3 + i]] : 0;
      moves[i] = i < count ? slope[code[step + 3 + i]] : 0;
    }
    const [a, b, c, d] = values;
    if (kind === HALF_CHORD && a < apart && moves[0] !== 0) {
      apart = a;
      parting = moves[0];
    }
    const note = (/** @type {number} */ to, /** @type {number} */ value) => {
      let sum = 0;
      for (let i = 0; i < 4; i++) sum += partials[i] * moves[i];
      row[to] = value;
      slope[to] = sum;
    };
    const out = this.result(step, signs, a, b, c, d);
    this.differentiate(kind, a, b, c, d, out);
    note(code[step + 1], out);
    if (second !== 0) {
      partials[0] = kind === COSINE ? circular.cosine : -circular.sine;
      note(second, kind === COSINE ? circular.sine : circular.cosine);
    }
  }
  return [apart, parting];
};

/**
 * Finds where a miss vanishes, near where it is expected, and how the miss changes there. Gives how far that may be off.
 * @param {number} step @param {number[]} signs @param {Float64Array} row
 */
Program.prototype.find = function find(step, signs, row) {
  const { code, signCount, turnCount } = this;
  const [found, change, miss, end, index, unit] = code.subarray(step + 1, step + 7);
  const slope = new Float64Array(this.rows);
  slope[found] = 1;
  const at = (/** @type {number} */ x) => {
    row[found] = x;
    const apart = this.runWithSlopes(step + WIDTH, end, signs, row, slope);
    return [row[miss], slope[miss], ...apart];
  };
  const [place, stood, rate, sense] = signs.slice(signCount + turnCount + 4 * index);
  const expected = stood + rate * (row[0] - place);
  const longest = 0.1 * unit, arrived = 1e-7 * unit;
  let x = expected, last = Infinity, gone = Infinity, below = NaN, above = NaN, before = NaN;
  for (let k = 0; k < 60; k++) {
    const [here, by, apart, parting] = at(x);
    if (apart < 0 && Number.isNaN(before)) {
      x -= Math.max(-longest, Math.min(longest, 1.5 * apart / parting));
      continue;
    }
    if ((apart < 0 || sense * by < 0) && !Number.isNaN(before)) {
      gone = 0.5 * Math.abs(before - x);
      x = (before + x) / 2;
      continue;
    }
    before = x;
    const newton = here / by, size = Math.abs(newton);
    if (size >= last && size <= arrived) break;
    last = size;
    if (size <= 4 * Number.EPSILON * Math.max(Math.abs(x), unit) || Number.isNaN(size)) break;
    if (here < 0) below = x; else above = x;
    let next = x - Math.max(-longest, Math.min(longest, newton));
    const low = Math.min(below, above), high = Math.max(below, above);
    // With no sign of either kind both are no numbers.
    if (!Number.isNaN(low) && !(low < next && next < high && size <= 0.5 * gone)) next = (low + high) / 2;
    gone = Math.abs(next - x);
    x = next;
  }
  const grid = 2 ** 40, isFound = last <= arrived && Math.abs(x - expected) <= 0.5 * unit;
  row[change] = at(isFound ? Math.floor(x * grid + 0.5) / grid : NaN)[1];
  return CARRIED * Math.abs(row[change]);
};
