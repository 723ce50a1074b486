// What the drawing found by trial, found again for another position.

/**
 * Finds where a miss vanishes, near where it is expected, and how the miss changes there. Gives how far that may be off.
 * @param {number} step @param {number[]} signs @param {Float64Array} row
 */
Program.prototype.find = function find(step, signs, row) {
  const { code, signCount, turnCount } = this;
  const [found, slope, miss, end, index, unit] = code.subarray(step + 1, step + 7);
  const steps = [];
  for (let k = step + WIDTH; k < end; k += WIDTH) steps.push(k);
  const region = Int32Array.from(steps);
  const at = (/** @type {number} */ x) => {
    row[found] = x;
    this.run(region, row[0], signs, row);
    return row[miss];
  };
  const [place, stood, rate, sense] = signs.slice(signCount + turnCount + 4 * index);
  const expected = stood + rate * (row[0] - place);
  const width = 1e-6 * unit, longest = 0.1 * unit, arrived = 1e-7 * unit;
  let x = expected, last = Infinity, gone = Infinity, below = NaN, above = NaN, before = NaN;
  for (let k = 0; k < 60; k++) {
    const here = at(x), change = at(x + width) - here;
    if (sense * change < 0 && !Number.isNaN(before)) {
      gone = 0.5 * Math.abs(before - x);
      x = (before + x) / 2;
      continue;
    }
    before = x;
    const by = here * width / change, size = Math.abs(by);
    if (size >= last && size <= arrived) break;
    last = size;
    if (size <= 4 * Number.EPSILON * Math.max(Math.abs(x), unit) || Number.isNaN(size)) break;
    if (here < 0) below = x; else above = x;
    let next = x - Math.max(-longest, Math.min(longest, by));
    const low = Math.min(below, above), high = Math.max(below, above);
    // With no sign of either kind both are no numbers.
    if (!Number.isNaN(low) && !(low < next && next < high && size <= 0.5 * gone)) next = (low + high) / 2;
    gone = Math.abs(next - x);
    x = next;
  }
  const grid = 2 ** 40, isFound = last <= arrived && Math.abs(x - expected) <= 0.5 * unit;
  x = isFound ? Math.floor(x * grid + 0.5) / grid : NaN;
  const difference = (/** @type {number} */ by) => (at(x + by) - at(x - by)) / (2 * by);
  const fine = difference(width), coarse = difference(2 * width);
  row[found] = x;
  row[slope] = fine;
  return Math.abs(fine - coarse);
};
