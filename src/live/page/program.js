// The evaluator: a list of operations on rows. It knows no more than this.

const UNIT = Number.EPSILON / 2;
/** A number is told from zero where it exceeds so many of its errors. */
const CLEAR = 8;
/** So many samples of the roundings are carried along. */
const SAMPLES = 8;
const SUM = 0, DIFFERENCE = 1, OPPOSITE = 2, PRODUCT = 3, QUOTIENT = 4, ROOT = 5, HALF_CHORD = 6, DOT = 7, CROSS = 8,
  COSINE = 9, SINE = 10, ANGLE = 11, TURNED = 12, WHOLE = 13, FIND = 14;
const OPERANDS = [2, 2, 1, 2, 2, 1, 1, 4, 4, 1, 1, 2, 2, 1, 0];
const WIDTH = 8;

/** @param {number} a */
function rootOf(a) {
  return a > 0 ? Math.sqrt(a) : 0;
}

/** The angle of (x, y) that is within half a turn of so many half turns. */
function angleNear(/** @type {number} */ halfTurns, /** @type {number} */ y, /** @type {number} */ x) {
  const odd = ((halfTurns % 2) + 2) % 2 === 1;
  return Math.PI * halfTurns + (odd ? angleOf(-y, -x) : angleOf(y, x));
}

/** @param {number} x */
function finiteOr0(x) {
  return Number.isFinite(x) ? x : 0;
}

class Program {
  /** @param {any} written */
  constructor(written) {
    this.rows = written.rows;
    this.code = Int32Array.from(written.code);
    this.constants = written.constants;
    /** Constants that are off by more than a few roundings. @type {Map<number, number>} */
    this.noise = new Map(written.noise);
    this.lots = written.lots;
    this.signCount = written.signs;
    this.turnCount = written.turned;
    this.divisors = written.divisors;
    this.value = new Float64Array(this.rows);
    this.slope = new Float64Array(this.rows);
    this.errors = new Float64Array(this.rows * SAMPLES);
    this.lost = new Uint8Array(this.rows);
    this.of = new Float64Array(4);
    this.partials = new Float64Array(4);
    /** Rows for `run` alone. */
    this.quick = new Float64Array(this.rows);
    for (const [row, value] of this.constants) this.quick[row] = value;
  }

  /** The error of a row. @param {number} row */
  error(row) {
    let squares = 0;
    for (let k = row * SAMPLES, end = k + SAMPLES; k < end; k++) squares += this.errors[k] * this.errors[k];
    return 3 * Math.sqrt(squares / SAMPLES);
  }

  /** Whether a row stands clear of its error. @param {number} row */
  isClear(row) {
    return Math.abs(this.value[row]) > CLEAR * this.error(row);
  }

  /** @param {number} row @param {number} by @param {number} lots */
  round(row, by, lots) {
    const at = row * SAMPLES;
    for (let k = 0; k < SAMPLES; k++) this.errors[at + k] += (lots >> k & 1) === 0 ? by : -by;
  }

  /** What the operands bring. @param {number} row @param {number} step @param {number} count @param {number} value */
  carry(row, step, count, value) {
    const { code, errors, partials } = this;
    const to = row * SAMPLES;
    let slope = 0, lost = 0;
    errors.fill(0, to, to + SAMPLES);
    for (let i = 0; i < count; i++) {
      const from = code[step + 3 + i], partial = partials[i];
      slope += partial * this.slope[from];
      for (let k = 0; k < SAMPLES; k++) errors[to + k] += partial * errors[from * SAMPLES + k];
      lost |= this.lost[from];
    }
    this.value[row] = value;
    this.slope[row] = slope;
    this.lost[row] = lost;
  }

  /** The result of a step; of cosine and sine both are in `circular`. */
  result(/** @type {number} */ step, /** @type {number[]} */ signs, /** @type {number} */ a, /** @type {number} */ b, /** @type {number} */ c, /** @type {number} */ d) {
    const { code } = this;
    switch (code[step]) {
      case SUM: return a + b;
      case DIFFERENCE: return a - b;
      case OPPOSITE: return -a;
      case PRODUCT: return a * b;
      case QUOTIENT: return a / b;
      case ROOT: return rootOf(a);
      case HALF_CHORD: return signs[code[step + 4]] * rootOf(a);
      case DOT: return a * b + c * d;
      case CROSS: return a * b - c * d;
      case WHOLE: return Math.floor(a);
      case ANGLE: return angleOf(a, b);
      case TURNED: return angleNear(signs[this.signCount + code[step + 5]], a, b);
      default:
        sinCos(a);
        return code[step] === COSINE ? circular.cosine : circular.sine;
    }
  }

  /** The slopes of a result by its operands, into `partials`. Gives the size of the products that it is a sum of. */
  differentiate(/** @type {number} */ kind, /** @type {number} */ a, /** @type {number} */ b, /** @type {number} */ c, /** @type {number} */ d, /** @type {number} */ out) {
    const { partials } = this;
    partials.fill(0);
    switch (kind) {
      case SUM: partials[0] = 1; partials[1] = 1; break;
      case DIFFERENCE: partials[0] = 1; partials[1] = -1; break;
      case OPPOSITE: partials[0] = -1; break;
      case PRODUCT: partials[0] = b; partials[1] = a; break;
      case QUOTIENT:
        if (Number.isFinite(out) && Number.isFinite(1 / b) && Number.isFinite(out / b)) {
          partials[0] = 1 / b;
          partials[1] = -out / b;
        }
        break;
      case ROOT: case HALF_CHORD: partials[0] = finiteOr0(0.5 / out); break;
      case DOT: case CROSS: {
        const sign = kind === DOT ? 1 : -1;
        partials[0] = b; partials[1] = a; partials[2] = sign * d; partials[3] = sign * c;
        return Math.abs(a * b) + Math.abs(c * d);
      }
      case COSINE: partials[0] = -circular.sine; break;
      case SINE: partials[0] = circular.cosine; break;
      case WHOLE: break;
      default: {
        const square = a * a + b * b;
        partials[0] = finiteOr0(b / square);
        partials[1] = finiteOr0(-a / square);
      }
    }
    return 0;
  }

  /** Computes one position with errors. @param {number} input @param {number[]} signs */
  look(input, signs) {
    const { code, value, of, partials } = this;
    this.errors.fill(0);
    this.lost.fill(0);
    value[0] = input;
    this.slope[0] = 1;
    this.round(0, 2 * UNIT * Math.abs(input), this.lots);
    for (const [row, constant, lots] of this.constants) {
      value[row] = constant;
      this.slope[row] = 0;
      this.round(row, this.noise.get(row) ?? 4 * UNIT * Math.abs(constant), lots);
    }
    for (let step = 0; step < code.length; step += WIDTH) {
      const kind = code[step], to = code[step + 1], second = code[step + 2], last = code[step + 7];
      if (kind === FIND) {
        this.round(second, this.find(step, signs, value), last);
        if (!this.isClear(second)) this.lost[second] = 1;
        continue;
      }
      const count = OPERANDS[kind];
      for (let i = 0; i < 4; i++) of[i] = i < count ? value[code[step + 3 + i]] : 0;
      if (kind === HALF_CHORD && !this.isClear(code[step + 3])) of[0] = 0;
      const out = this.result(step, signs, of[0], of[1], of[2], of[3]);
      const products = this.differentiate(kind, of[0], of[1], of[2], of[3], out);
      this.carry(to, step, count, out);
      if (kind !== WHOLE) this.round(to, 2 * UNIT * Math.abs(out) + UNIT * products, last & 255);
      if (last & 256 && !this.isClear(to)) this.lost[to] = 1;
      if (second !== 0) {
        const other = kind === COSINE ? circular.sine : circular.cosine;
        partials[0] = kind === COSINE ? circular.cosine : -circular.sine;
        this.carry(second, step, 1, other);
        const lots = last & 255;
        this.round(second, 2 * UNIT * Math.abs(other), (lots << 3 | lots >> 5) & 255);
      }
    }
  }

  /** The steps on which some rows hang, for `run`. @param {number[]} rows */
  behind(rows) {
    const { code } = this;
    const wanted = new Uint8Array(this.rows);
    for (const row of rows) wanted[row] = 1;
    const steps = [];
    for (let step = code.length - WIDTH; step >= 0; step -= WIDTH) {
      if (!wanted[code[step + 1]] && !(code[step + 2] !== 0 && wanted[code[step + 2]])) continue;
      for (let i = 0; i < OPERANDS[code[step]]; i++) wanted[code[step + 3 + i]] = 1;
      steps.push(step);
    }
    return Int32Array.from(steps.reverse());
  }

  /** Computes these steps alone, without errors, into `quick`. */
  run(/** @type {Int32Array} */ steps, /** @type {number} */ input, /** @type {number[]} */ signs, row = this.quick) {
    const { code } = this;
    row[0] = input;
    for (const step of steps) {
      const kind = code[step], second = code[step + 2];
      if (kind === FIND) {
        this.find(step, signs, row);
        continue;
      }
      row[code[step + 1]] = this.result(step, signs, row[code[step + 3]], row[code[step + 4]], row[code[step + 5]], row[code[step + 6]]);
      if (second !== 0) row[second] = kind === COSINE ? circular.sine : circular.cosine;
    }
  }
}
