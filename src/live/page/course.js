// The course: where the input may go, and the numbers at one position.

/** The number of an output as it counts. */
function counted(/** @type {any} */ output, /** @type {number} */ value) {
  return output.unsigned && value < 0 ? -value : value;
}

/** Places at equal steps over a range, the same doubles as a sweep has. */
function equalSteps(/** @type {number[]} */ [from, to], /** @type {number} */ count) {
  return Array.from({ length: count + 1 }, (_, i) => (i === count ? to : from * ((count - i) / count) + to * (i / count)));
}

class Course {
  /** @param {any} live */
  constructor(live) {
    this.live = live;
    this.program = new Program(live.program);
    this.stretches = live.course.stretches;
    this.events = live.course.events;
  }

  /** The stretch in which a place lies. @param {number} at */
  stretchAt(at) {
    return this.stretches.find((/** @type {any} */ s) => at >= s.from && at <= s.to);
  }

  /** The outputs at a place, `null` where one is not known; nothing where it cannot be assembled. @param {number} at */
  look(at) {
    const stretch = this.stretchAt(at);
    if (!stretch) return null;
    const { program } = this;
    program.look(at, stretch.signs);
    return this.live.outputs.map((/** @type {any} */ output) => {
      const value = program.value[output.row];
      const known = Number.isFinite(value) && (output.of_position || program.lost[output.row] === 0);
      return known ? counted(output, value) : null;
    });
  }
}
