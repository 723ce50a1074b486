// Runs a written drawing as a page does and holds every number against those of a sweep.
// node exact.js PAGE-FOLDER CASES-FOLDER, where each file is { name, live, positions: [[at, [value or null, ...]], ...] }.
'use strict';
const fs = require('node:fs');
const path = require('node:path');

const [, , pages, folder] = process.argv;
const source = ['libm', 'program', 'trial', 'course'].map((name) => fs.readFileSync(path.join(pages, `${name}.js`), 'utf8'));
// One thing turned round, to see that it is noticed: node exact.js PAGE-FOLDER CASES-FOLDER FROM TO.
if (process.argv.length > 5) {
  const [from, to] = process.argv.slice(4);
  const at = source.findIndex((text) => text.includes(from));
  if (at < 0) throw new Error(`${from} is in no script`);
  source[at] = source[at].replace(from, () => to);
}
const Course = new Function(`'use strict';${source.join('\n')}\nreturn Course;`)();
// A thing turned round is noticed at its first difference.
const enough = process.argv.length > 5 ? 1 : Infinity;
const files = fs.readdirSync(folder);
let numbers = 0, refusals = 0, runs = 0;
const wrong = [];
for (const file of files) {
  if (wrong.length >= enough) break;
  const { name, live, positions } = JSON.parse(fs.readFileSync(path.join(folder, file), 'utf8'));
  const course = new Course(live);
  const { program } = course;
  const steps = program.behind(live.outputs.map((output) => output.row));
  for (const [at, values] of positions) {
    const found = course.look(at);
    if (found === null) {
      wrong.push(`${name} at ${at}: not assembled`);
      continue;
    }
    program.run(steps, at, course.stretchAt(at).signs);
    values.forEach((value, index) => {
      numbers += 1;
      if (value === null) refusals += 1;
      const same = value === found[index] || (value !== null && found[index] !== null && value === found[index]);
      const output = live.outputs[index];
      if (!same) wrong.push(`${name} at ${at}: ${output.name} is ${found[index]}, not ${value}`);
      // Without errors the same double, but where a half chord that only just touches was taken for zero.
      const quick = program.quick[output.row];
      if (value !== null && quick === program.value[output.row]) runs += 1;
    });
  }
}
for (const line of wrong.slice(0, 40)) console.error(line);
console.log(JSON.stringify({ scenes: files.length, numbers, refusals, runs, wrong: wrong.length }));
process.exit(wrong.length === 0 && numbers > 0 ? 0 : 1);
