// Sine, cosine, atan2 and hypot by the routines of FreeBSD's msun, as the crate `libm` 0.2 has them, operation by
// operation: the browsers' own differ in the last place. Arguments up to 2^20 quarter turns.
//
// Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved.
// Developed at SunPro, a Sun Microsystems, Inc. business.
// Permission to use, copy, modify, and distribute this software is freely granted, provided that this notice
// is preserved.

const word = new DataView(new ArrayBuffer(8));

/** The upper half of a double's bits. @param {number} x */
function highWord(x) {
  word.setFloat64(0, x);
  return word.getInt32(0);
}

/** Sine of x + y for |x + y| < pi/4. @param {number} x @param {number} y @param {boolean} hasTail */
function kernelSine(x, y, hasTail) {
  const z = x * x;
  const w = z * z;
  const r = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06)
    + z * w * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10);
  const v = z * x;
  const S1 = -1.66666666666666324348e-01;
  return hasTail ? x - ((z * (0.5 * y - v * r) - y) - v * S1) : x + v * (S1 + z * r);
}

/** Cosine of x + y for |x + y| < pi/4. @param {number} x @param {number} y */
function kernelCosine(x, y) {
  const z = x * x;
  const w = z * z;
  const r = z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05))
    + w * w * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
  const hz = 0.5 * z;
  const one = 1.0 - hz;
  return one + (((1.0 - one) - hz) + (z * r - x * y));
}

const PIO2_1 = 1.57079632673412561417e+00;
const PIO2_1T = 6.07710050650619224932e-11;
/** What is left of an angle after quarter turns: their number and two parts. */
const rest = { quarters: 0, y0: 0, y1: 0 };

/** @param {number} x @param {number} ix */
function reduceMedium(x, ix) {
  const TO_INT = 1.5 / 2.2204460492503131e-16;
  const n = x * 6.36619772367581382433e-01 + TO_INT - TO_INT;
  let r = x - n * PIO2_1;
  let w = n * PIO2_1T;
  let y0 = r - w;
  const ex = ix >> 20;
  if (ex - ((highWord(y0) >> 20) & 0x7ff) > 16) {
    let t = r;
    w = n * 6.07710050630396597660e-11;
    r = t - w;
    w = n * 2.02226624879595063154e-21 - ((t - r) - w);
    y0 = r - w;
    if (ex - ((highWord(y0) >> 20) & 0x7ff) > 49) {
      t = r;
      w = n * 2.02226624871116645580e-21;
      r = t - w;
      w = n * 8.47842766036889956997e-32 - ((t - r) - w);
      y0 = r - w;
    }
  }
  rest.quarters = n | 0;
  rest.y0 = y0;
  rest.y1 = (r - y0) - w;
}

/** @param {number} x @param {number} n */
function reduceBy(x, n) {
  const z = x - n * PIO2_1;
  const tail = n * PIO2_1T;
  rest.quarters = n;
  rest.y0 = z - tail;
  rest.y1 = (z - rest.y0) - tail;
}

/** @param {number} x @param {number} ix */
function reduce(x, ix) {
  const side = x < 0 ? -1 : 1;
  if (ix <= 0x400f6a7a) {
    if ((ix & 0xfffff) === 0x921fb) reduceMedium(x, ix);
    else reduceBy(x, side * (ix <= 0x4002d97c ? 1 : 2));
  } else if (ix <= 0x401c463b) {
    const three = ix <= 0x4015fdbc;
    if (ix === (three ? 0x4012d97c : 0x401921fb)) reduceMedium(x, ix);
    else reduceBy(x, side * (three ? 3 : 4));
  } else if (ix < 0x413921fb) {
    reduceMedium(x, ix);
  } else {
    rest.quarters = 0;
    rest.y0 = NaN;
    rest.y1 = NaN;
  }
}

/** Of the last angle. */
const circular = { sine: 0, cosine: 1 };

/** Sine and cosine of an angle, into `circular`. @param {number} x */
function sinCos(x) {
  const ix = highWord(x) & 0x7fffffff;
  if (ix <= 0x3fe921fb) {
    const small = ix < 0x3e46a09e;
    circular.sine = small ? x : kernelSine(x, 0, false);
    circular.cosine = small ? 1 : kernelCosine(x, 0);
    return;
  }
  if (ix >= 0x7ff00000) {
    circular.sine = NaN;
    circular.cosine = NaN;
    return;
  }
  reduce(x, ix);
  const s = kernelSine(rest.y0, rest.y1, true);
  const c = kernelCosine(rest.y0, rest.y1);
  switch (rest.quarters & 3) {
    case 0: circular.sine = s; circular.cosine = c; break;
    case 1: circular.sine = c; circular.cosine = -s; break;
    case 2: circular.sine = -s; circular.cosine = -c; break;
    default: circular.sine = -c; circular.cosine = s;
  }
}

const ATAN_HI = [4.63647609000806093515e-01, 7.85398163397448278999e-01, 9.82793723247329054082e-01, 1.57079632679489655800e+00];
const ATAN_LO = [2.26987774529616870924e-17, 3.06161699786838301793e-17, 1.39033110312309984516e-17, 6.12323399573676603587e-17];
const AT = [
  3.33333333333329318027e-01, -1.99999999998764832476e-01, 1.42857142725034663711e-01, -1.11111104054623557880e-01,
  9.09088713343650656196e-02, -7.69187620504482999495e-02, 6.66107313738753120669e-02, -5.83357013379057348645e-02,
  4.97687799461593236017e-02, -3.65315727442169155270e-02, 1.62858201153657823623e-02,
];

/** Of a number that is not negative. @param {number} x */
function arcTangent(x) {
  const ix = highWord(x);
  if (ix >= 0x44100000) return x !== x ? x : ATAN_HI[3];
  let id = -1;
  if (ix < 0x3fdc0000) {
    if (ix < 0x3e400000) return x;
  } else if (ix < 0x3ff30000) {
    if (ix < 0x3fe60000) {
      x = (2.0 * x - 1.0) / (2.0 + x);
      id = 0;
    } else {
      x = (x - 1.0) / (x + 1.0);
      id = 1;
    }
  } else if (ix < 0x40038000) {
    x = (x - 1.5) / (1.0 + 1.5 * x);
    id = 2;
  } else {
    x = -1.0 / x;
    id = 3;
  }
  const z = x * x;
  const w = z * z;
  const s1 = z * (AT[0] + w * (AT[2] + w * (AT[4] + w * (AT[6] + w * (AT[8] + w * AT[10])))));
  const s2 = w * (AT[1] + w * (AT[3] + w * (AT[5] + w * (AT[7] + w * AT[9]))));
  if (id < 0) return x - x * (s1 + s2);
  return ATAN_HI[id] - (x * (s1 + s2) - ATAN_LO[id] - x);
}

/** The angle of the vector (x, y). @param {number} y @param {number} x */
function angleOf(y, x) {
  if (x !== x || y !== y) return NaN;
  const PI = 3.1415926535897931160E+00;
  const PI_LO = 1.2246467991473531772E-16;
  const right = highWord(x) >= 0;
  const up = highWord(y) >= 0;
  if (x === 1.0) return up ? arcTangent(y) : -arcTangent(-y);
  if (y === 0) return right ? y : up ? PI : -PI;
  if (x === 0) return up ? PI / 2.0 : -PI / 2.0;
  if (Math.abs(x) === Infinity) {
    const size = Math.abs(y) === Infinity ? (right ? PI / 4.0 : 3.0 * PI / 4.0) : (right ? 0 : PI);
    return up ? size : -size;
  }
  const ix = highWord(x) & 0x7fffffff;
  const iy = highWord(y) & 0x7fffffff;
  if (ix + 0x4000000 < iy) return up ? PI / 2.0 : -PI / 2.0;
  const z = !right && iy + 0x4000000 < ix ? 0 : arcTangent(Math.abs(y / x));
  if (right) return up ? z : -z;
  return up ? PI - (z - PI_LO) : (z - PI_LO) - PI;
}

/** A square, and what its rounding left. @param {number} x */
function squared(x) {
  const c = x * 134217729, high = x - c + c, low = x - high, square = x * x;
  return [square, high * high - square + 2 * high * low + low * low];
}

/** The size of what has two parts. */
function sizeOfBoth(/** @type {number} */ one, /** @type {number} */ other) {
  let [y, x] = [Math.abs(one), Math.abs(other)].sort((a, b) => a - b);
  const [long, short] = [x, y].map((part) => highWord(part) >> 20);
  if (y === 0) return x;
  if (long - short > 64) return x + y;
  const scale = long > 1533 ? 2 ** 700 : short < 573 ? 2 ** -700 : 1;
  x /= scale;
  y /= scale;
  const [hx, lx] = squared(x), [hy, ly] = squared(y);
  return scale * Math.sqrt(ly + lx + hy + hx);
}
