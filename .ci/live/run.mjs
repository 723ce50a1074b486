// The live page in a real browser. node run.mjs BROWSER LINKGRAM [SCREENSHOTS]
// BROWSER is the path of Debian's chromium or firefox-esr; LINKGRAM the built program. ONLY=word runs the tests whose name has it.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import puppeteer from 'puppeteer-core';

const [, , browserPath, linkgram, pictures] = process.argv;
const root = path.resolve(import.meta.dirname, '../..');
const work = mkdtempSync(path.join(tmpdir(), 'linkgram-live-'));
const firefox = browserPath.includes('firefox');
const axe = readFileSync(path.join(import.meta.dirname, 'node_modules/axe-core/axe.min.js'), 'utf8');
const scripts = (...names) => names.map((name) => readFileSync(path.join(root, `src/live/page/${name}.js`), 'utf8')).join('\n');

const run = (...args) => execFileSync(linkgram, args, { encoding: 'utf8', maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'pipe'] });
const sceneOf = (name) => {
  const file = path.join(work, `${name}.json`);
  writeFileSync(file, run('new', name));
  return file;
};
// The input's place once what was done has been drawn.
const placeOf = (page) => page.evaluate(() => new Promise((done) => {
  requestAnimationFrame(() => requestAnimationFrame(() => done(Number(document.getElementById('exact').value))));
}));
const rest = (ms) => new Promise((done) => { setTimeout(done, ms); });

const browser = await puppeteer.launch({
  browser: firefox ? 'firefox' : 'chrome', executablePath: browserPath, headless: true,
  args: firefox ? [] : ['--no-sandbox', '--font-render-hinting=none'],
});

const trouble = [];
/** A page of its own. `atOnce`: a frame comes as soon as it is asked for, so that a thousand positions take seconds. `timed`: what
 * the script does for each frame is timed, in `frameTimes`. */
async function open(file, { width = 1300, height = 1000, hash = '', script = true, atOnce = false, timed = false } = {}) {
  const page = await browser.newPage();
  if (timed) {
    await page.evaluateOnNewDocument(() => {
      window.frameTimes = [];
      const own = window.requestAnimationFrame.bind(window);
      window.requestAnimationFrame = (does) => own((now) => {
        const begun = performance.now();
        does(now);
        window.frameTimes.push(performance.now() - begun);
      });
    });
  }
  if (atOnce) {
    await page.evaluateOnNewDocument(() => {
      window.requestAnimationFrame = (does) => {
        queueMicrotask(() => does(performance.now()));
        return 1;
      };
    });
  }
  page.on('console', (message) => trouble.push(`${file}: console: ${message.text()}`));
  page.on('pageerror', (error) => trouble.push(`${file}: ${error.message}`));
  page.on('request', (request) => {
    if (!/^(file|data|blob|about):/.test(request.url())) trouble.push(`${file}: request ${request.url()}`);
  });
  if (!script) await page.setJavaScriptEnabled(false);
  await page.setViewport({ width, height });
  await page.goto(`file://${file}${hash}`);
  await rest(150);
  return page;
}

const tests = [];
const test = (name, does) => tests.push([name, does]);
const pageOf = (scene, ...more) => {
  const out = path.join(work, `${path.basename(scene, '.json')}${more.join('').replace(/\W/g, '')}.html`);
  run('draw', scene, '-o', out, ...more);
  return out;
};
const four = sceneOf('four-bar'), rocker = sceneOf('rocker-crank'), slider = sceneOf('slider-crank');
const liveOf = (html) => JSON.parse(/id="linkgram-live">(.*?)<\/script>/s.exec(readFileSync(html, 'utf8'))[1]);
const fourPage = pageOf(four, '--lang', 'en,ar,fa');
/** As many positions as the contract wants, for minutes; else a part of them. */
const thorough = Boolean(process.env.LINKGRAM_LIVE_POSITIONS);
/** Ten scenes of different make. */
const moving = [four, rocker, slider, ...['whitworth', 'scotch-yoke', 'punch-press', 'crank-shaper'].map(sceneOf),
  ...['s000-ch3a-1', 's000-ch3b-1', 'eight-link'].map((name) => path.join(root, `examples/${name}.json`))];

test('every number of the browser is the sweep\'s', async () => {
  const page = await browser.newPage();
  let compared = 0;
  for (const scene of [four, rocker, slider, ...['rack-wheel', 'hypocycloid'].map(sceneOf), path.join(root, 'examples/s000-ch3a-1.json'), path.join(root, 'examples/eight-link.json')]) {
    const [tablePath, livePath] = ['t.json', 't.live.json'].map((name) => path.join(work, name));
    run('sweep', scene, '--steps', '1000', '-o', tablePath, '-o', livePath);
    const table = JSON.parse(readFileSync(tablePath, 'utf8')), live = JSON.parse(readFileSync(livePath, 'utf8'));
    const found = await page.evaluate((source, data) => {
      const course = new Function(`'use strict';${source}\nreturn Course;`)();
      const one = new course(data), out = [];
      const [from, to] = data.variable.range;
      for (let i = 0; i <= 1000; i++) {
        const at = i === 1000 ? to : from * ((1000 - i) / 1000) + to * (i / 1000);
        const values = one.look(at);
        if (values) out.push([at / data.variable.si, data.outputs.flatMap((o, k) => (o.asked ? [values[k] === null ? null : values[k] / o.si] : []))]);
      }
      return out;
    }, scripts('libm', 'program', 'course'), live);
    assert.equal(found.length, table.positions.length);
    table.positions.forEach((position, i) => {
      assert.equal(position.at, found[i][0]);
      position.values.forEach((value, k) => {
        compared += 1;
        assert.ok(value === found[i][1][k], `${scene} at ${position.at}: ${table.columns[k].name} ${value} ${found[i][1][k]}`);
      });
    });
  }
  await page.close();
  return `${compared} numbers`;
});

test('the cases of the suite: events, their neighbours, time', async () => {
  // What `cargo test` has left: places over the range and about every event, with the numbers of the sweep.
  const folder = path.join(process.env.CARGO_TARGET_DIR || path.join(root, 'target'), 'tmp/live-exact');
  if (!existsSync(folder)) return 'skipped: the suite has not run here';
  const page = await browser.newPage();
  let scenes = 0, compared = 0;
  for (const name of readdirSync(folder)) {
    const told = await page.evaluate((source, one) => {
      const course = new (new Function(`'use strict';${source}\nreturn Course;`)())(one.live);
      let numbers = 0;
      for (const [at, values] of one.positions) {
        const found = course.look(at);
        for (const [index, value] of values.entries()) {
          numbers += 1;
          if (!found || found[index] !== value) return `${one.live.outputs[index].name} at ${at} is ${found && found[index]}, not ${value}`;
        }
      }
      return numbers;
    }, scripts('libm', 'program', 'trial', 'course'), JSON.parse(readFileSync(path.join(folder, name), 'utf8')));
    assert.equal(typeof told, 'number', `${name}: ${told}`);
    scenes += 1;
    compared += told;
  }
  await page.close();
  return `${compared} numbers of ${scenes} scenes`;
});

/** Recovers every vector of a page from its ink alone. */
async function inkOf(html, parts) {
  const live = liveOf(html);
  const { Course } = { Course: new Function(`'use strict';${scripts('libm', 'program', 'course')}\nreturn Course;`)() };
  const course = new Course(live);
  const page = await open(html, { atOnce: true });
  let compared = 0;
  try {
    for (const part of parts) {
      const [from, to] = live.variable.range;
      const drawn = await page.evaluate((wish) => {
        const slide = document.getElementById('at');
        slide.value = String(wish);
        slide.dispatchEvent(new Event('input'));
        const read = (group) => {
          const of = (name) => group.querySelector(name)?.getAttribute('d')?.match(/-?[\d.]+(e-?\d+)?/g)?.slice(0, 4).map(Number);
          const hidden = group.getAttribute('visibility') === 'hidden' || group.querySelector('.shaft').getAttribute('visibility') === 'hidden';
          return [group.closest('svg').id, group.dataset.quantity, hidden ? null : [of('.shaft'), of('.head')]];
        };
        return new Promise((done) => {
          requestAnimationFrame(() => requestAnimationFrame(() => done([
            Number(slide.value), [...document.querySelectorAll('#stage .vector')].map(read),
            [...document.querySelectorAll('#stage figcaption bdi')].map((scale) => scale.textContent),
            [...document.querySelectorAll('#stage .bar')].map((bar) => {
              const matrix = bar.ownerSVGElement.getScreenCTM().inverse().multiply(bar.getScreenCTM());
              const ends = [0, bar.getTotalLength()].map((at) => bar.getPointAtLength(at).matrixTransform(matrix));
              return [bar.parentNode.dataset.link, ends.map((point) => [point.x, point.y])];
            })])));
        });
      }, from + part * (to - from));
      const outputs = course.look(drawn[0]);
      // The scale that a caption tells: 20 000 mm/s² ≡ 1 cm, 2.5 × 10⁶ mm/s² ≡ 1 cm.
      const scales = drawn[2].map((text, index) => {
        const plain = text.replace(/[\u2009\u202f]/g, '').replace(/\s?×\s?10/, 'e').replaceAll('\u2212', '-');
        return Number(/([\d.]+(e-?\d+)?)\s.*≡/.exec(plain)?.[1]) * live.panels[index].unit / 10;
      });
      for (const [panel, quantity, ends] of drawn[1]) {
        const own = live.quantities[quantity];
        if (!ends || !own || own.outputs.length !== 2) continue;
        const scale = scales[Number(panel.slice(5))];
        const [[x0, y0, xn, yn], [x1, y1]] = ends;
        const [vx, vy] = own.outputs.map((o) => outputs[o] / scale);
        // The shaft lies in the vector, and ends within the head.
        const length = Math.hypot(x1 - x0, y1 - y0), part = ((xn - x0) * (x1 - x0) + (yn - y0) * (y1 - y0)) / length ** 2;
        const off = Math.abs((xn - x0) * (y1 - y0) - (yn - y0) * (x1 - x0)) / length;
        assert.ok(off <= 3e-6 && part > 0 && part < 1, `${quantity} at ${drawn[0]}: its shaft strays by ${off} mm and ends at ${part} of it`);
        assert.ok(Math.hypot(x1 - x0 - vx, y0 - y1 - vy) <= 3e-6, `${html}: ${quantity} at ${drawn[0]}: ${[x1 - x0, y0 - y1]} is not ${[vx, vy]} (${drawn[2]})`);
        compared += 1;
      }
      // A bar begins and ends at a joint.
      const { origin, si_per_mm: scale, places } = live.panels[0];
      const joints = places.map(([[, o]]) => [(outputs[o] - origin[0]) / scale, -(outputs[o + 1] - origin[1]) / scale]);
      for (const [link, ends] of drawn[3]) {
        for (const [x, y] of ends) {
          const off = Math.min(...joints.map((joint) => Math.hypot(joint[0] - x, joint[1] - y)));
          assert.ok(off < 1e-3, `link ${link} at ${drawn[0]} is ${off} mm off its joints`);
        }
        compared += 1;
      }
    }
  } finally {
    await page.close();
  }
  return compared;
}

/** A page whose script was changed, and its policy with it. */
function changed(html, from, to) {
  const text = readFileSync(html, 'utf8'), script = /<script>(.*?)<\/script>/s.exec(text)[1];
  assert.ok(script.includes(from), from);
  const other = script.replace(from, () => to);
  const hash = (own) => `'sha256-${createHash('sha256').update(own).digest('base64')}'`;
  const out = path.join(work, 'changed.html');
  writeFileSync(out, text.replace(script, () => other).replace(hash(script), hash(other)));
  return out;
}

test('the ink is where the numbers say', async () => {
  let compared = 0;
  const count = thorough ? 100 : 12, parts = Array.from({ length: count }, (_, i) => (i + 0.37) / count);
  for (const scene of moving) compared += await inkOf(pageOf(scene), parts);
  assert.ok(compared > 1500, String(compared));
  return `${compared} vectors and bars of ${moving.length} scenes`;
});

test('a wrong move is noticed', async () => {
  const html = pageOf(slider);
  for (const [from, to] of [
    [',y=-(at[1]-origin', ',y=(at[1]-origin'],
    ['at[axis]+=sign*value}', 'at[axis]-=sign*value}'],
    ['const d=minus(b,a),length=sizeOf(d);const short', 'const d=minus(a,b),length=sizeOf(d);const short'],
    ['s=(to.x.y*from.x.x-to.x.x*from.x.y)/ n', 's=-(to.x.y*from.x.x-to.x.x*from.x.y)/ n'],
  ]) {
    await assert.rejects(inkOf(changed(html, from, to), [0.21, 0.55]), `nobody noticed ${to}`);
    trouble.length = 0;
  }
});

test('mouse, keys, field and play', async () => {
  const page = await open(fourPage);
  const at = () => placeOf(page);
  const start = await at();
  await page.keyboard.press('ArrowRight');
  await rest(60);
  assert.ok(Math.abs(await at() - start - 1) < 1e-6);
  await page.keyboard.down('Shift');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.up('Shift');
  await rest(60);
  assert.ok(Math.abs(await at() - start + 9) < 1e-6);
  await page.keyboard.press('Home');
  await rest(60);
  assert.equal(await at(), start);
  await page.focus('#exact');
  await page.evaluate(() => /** @type {any} */ (document.getElementById('exact')).select());
  await page.keyboard.type('123.4');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  await rest(60);
  assert.equal(await at(), 123.4);
  await page.evaluate(() => document.activeElement.blur());
  // A full turn by the crank pin, round its pivot.
  const places = await page.evaluate(() => {
    const at = (circle) => { const box = circle.getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; };
    return { grip: at(document.querySelector('.grip')), pivot: at(document.querySelector('.support[data-point=O2] path') ? document.querySelector('.joint[data-point=O2] circle') : document.querySelector('.joint circle')) };
  });
  const [gx, gy] = places.grip, [px, py] = places.pivot;
  const radius = Math.hypot(gx - px, gy - py), begin = Math.atan2(gy - py, gx - px);
  await page.mouse.move(gx, gy);
  await page.mouse.down();
  const seen = [];
  for (let i = 1; i <= 36; i++) {
    const angle = begin - i * Math.PI / 18;
    await page.mouse.move(px + radius * Math.cos(angle), py + radius * Math.sin(angle));
    await rest(25);
    seen.push(await at());
  }
  await page.mouse.up();
  assert.ok(Math.abs(await at() - 123.4) < 2, `after a turn: ${await at()}`);
  assert.ok(Math.max(...seen) > 340 && Math.min(...seen) < 20, 'the crank went all the way round');
  // Playing goes by time.
  await page.keyboard.press('Home');
  const before = await at(), begun = Date.now();
  await page.keyboard.press(' ');
  await rest(700);
  await page.keyboard.press(' ');
  const way = ((await at() - before) % 360 + 360) % 360, fair = 60 * (Date.now() - begun) / 1000;
  assert.ok(way > 0.4 * fair && way < 1.2 * fair, `${way} in ${fair}`);
  await page.close();
});

test('what is out of sight follows at rest, and as soon as it is seen', async () => {
  const page = await open(fourPage, { width: 390, height: 844 });
  /** All that is told and drawn. */
  const shown = () => page.evaluate(() => new Promise((done) => {
    requestAnimationFrame(() => requestAnimationFrame(() => done([...document.querySelectorAll('#stage svg *')].map((ink) =>
      ['d', 'transform', 'cx', 'cy', 'visibility', 'data-value'].map((key) => ink.getAttribute(key)).join()).join('\n') + document.getElementById('live').textContent)));
  }));
  /** The same drawn anew in this position: to the other scale and back. */
  const again = async () => {
    await page.keyboard.press('s');
    await page.keyboard.press('s');
    return shown();
  };
  const table = () => page.evaluate(() => document.getElementById('values').textContent);
  const still = await table();
  await page.keyboard.press(' ');
  await rest(500);
  assert.equal(await table(), still, 'nobody sees the table');
  await page.evaluate(() => document.getElementById('values').scrollIntoView());
  await rest(200);
  assert.notEqual(await table(), still);
  await page.evaluate(() => scrollTo(0, 0));
  await rest(200);
  await page.keyboard.press(' ');
  assert.equal(await shown(), await again());
  const before = await table();
  const [x, y] = await page.evaluate(() => { const box = document.querySelector('.grip').getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; });
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 9, y + 7, { steps: 5 });
  await rest(60);
  assert.equal(await table(), before);
  await page.mouse.up();
  const after = await shown();
  assert.notEqual(await table(), before);
  assert.equal(after, await again());
  // What is given away while it plays is of the position, seen or not.
  await page.keyboard.press(' ');
  await rest(300);
  const old = await table();
  assert.ok((await given(page, 'save')).includes('data-at="'));
  assert.notEqual(await table(), old);
  await page.close();
});

test('a limit stops the hand', async () => {
  const html = pageOf(rocker);
  const live = liveOf(html);
  const limits = live.course.events.filter((event) => event.kind === 'limit').map((event) => event.at / live.variable.si);
  assert.ok(limits.length > 0);
  const page = await open(html);
  const at = () => placeOf(page);
  await page.keyboard.down('Shift');
  for (let i = 0; i < 40; i++) await page.keyboard.press('ArrowRight');
  await page.keyboard.up('Shift');
  await rest(80);
  const end = await at();
  assert.ok(limits.some((limit) => Math.abs(limit - end) < 1e-6), `${end} is none of ${limits}`);
  assert.ok(await page.evaluate(() => document.getElementById('message').textContent.length > 0));
  // There the speeds are not determined: no number, no vector, and the links that are in line.
  const told = await page.evaluate(() => [...document.querySelectorAll('#values tbody tr')].map((row) => row.textContent));
  assert.ok(told.some((row) => /—.*links \d/.test(row)), told.join('; '));
  assert.ok(await page.evaluate(() => [...document.querySelectorAll('#stage .velocity .vector')].some((v) => v.getAttribute('visibility') === 'hidden')));
  await page.keyboard.press('Home');
  await rest(80);
  assert.ok(await page.evaluate(() => [...document.querySelectorAll('#stage .velocity .vector')].every((v) => v.getAttribute('visibility') !== 'hidden')));
  await page.close();
});

test('a finger leads a joint, and a phone is wide enough', async () => {
  if (firefox) return 'touch in Chromium only';
  const page = await open(fourPage, { width: 390, height: 800 });
  const at = () => placeOf(page);
  const before = await at();
  const [x, y] = await page.evaluate(() => { const box = document.querySelector('.grip').getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; });
  await page.touchscreen.touchStart(x, y);
  const places = [];
  for (let i = 1; i < 30; i++) {
    await page.touchscreen.touchMove(x - 2 * i, y + i);
    await rest(20);
    places.push(await at());
  }
  await page.touchscreen.touchEnd();
  await rest(60);
  assert.ok(Math.abs(await at() - before) > 3, `${before} ${await at()}`);
  assert.ok(new Set(places.slice(-8)).size > 4, `the finger is followed to the end: ${places.slice(-8)}`);
  assert.equal(await page.evaluate(() => scrollY), 0);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth + 1), 'nothing is wider than the phone');
  await page.close();
});

test('names are calm', async () => {
  const all = [];
  for (const scene of thorough ? moving : [moving[7], moving[5]]) {
    const html = pageOf(scene), found = await crowds(html, thorough ? 720 : 180);
    for (const [id, { labels, touching, left, astray }] of Object.entries(found)) {
      // A panel may have no names: what is drawn in it has none, or none is asked for.
      const part = labels > 0 ? 100 * touching / labels : 0;
      // No more than this, and the cure is not that names are left out. The places are the same in Firefox, which tells larger
      // boxes of the same letters: there the parts are told only.
      assert.ok(firefox || part <= (id === 'panel0' ? 0.5 : 4), `${scene} ${id}: ${part} of 100 touch another`);
      assert.ok(left <= (labels + left) * (id === 'panel0' ? 0.02 : 0.35), `${scene} ${id}: ${left} of ${labels + left} have no room`);
      assert.ok(astray <= 0.01 * labels, `${scene} ${id}: ${astray} of ${labels} stand by another point`);
      if (labels + left > 0) all.push(`${part.toFixed(1)} (${(100 * left / (labels + left)).toFixed(1)})`);
    }
    const fastest = glide(html);
    assert.ok(fastest <= 1.02, `${scene}: a name goes ${fastest} mm in a degree`);
  }
  return `of 100 touch another (have no room): ${all.join(', ')}`;
});

test('names of arrows are there, and stay', async () => {
  const all = [];
  for (const scene of [four, moving[5]]) {
    const page = await open(pageOf(scene), { atOnce: true });
    const found = await page.evaluate(async (positions) => {
      const slide = document.getElementById('at'), span = Number(slide.max) - Number(slide.min), sums = {};
      const isHidden = (element) => element.getAttribute('visibility') === 'hidden';
      // An arrow too short to be one is a dot.
      const isArrow = (one) => !isHidden(one) && !isHidden(one.querySelector('.shaft'));
      const before = new Map();
      for (let i = 0; i < positions; i++) {
        slide.value = String(Number(slide.min) + span * (i + 0.5) / positions);
        slide.dispatchEvent(new Event('input'));
        await new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
        for (const svg of document.querySelectorAll('#stage svg')) {
          const arrows = [...svg.querySelectorAll('.vector')].filter(isArrow).map((one) => one.dataset.quantity);
          const sum = sums[svg.id] = sums[svg.id] || { arrows: 0, unnamed: 0, switched: 0, counted: 0 };
          for (const label of svg.querySelectorAll('.labels > g')) {
            if (!(label.dataset.of || '').split(' ').some((of) => arrows.includes(of))) {
              before.delete(label.id);
              continue;
            }
            sum.arrows += 1;
            sum.unnamed += isHidden(label);
            sum.switched += before.has(label.id) && before.get(label.id) !== isHidden(label);
            before.set(label.id, isHidden(label));
          }
          const caption = document.getElementById(svg.id.replace('panel', 'beyond')).textContent;
          sum.counted += Number(/(\d+) names? ha(s|ve) no room/.exec(caption)?.[1] || 0);
        }
      }
      return sums;
    }, 360);
    await page.close();
    for (const [id, { arrows, unnamed, switched, counted }] of Object.entries(found)) {
      if (arrows === 0) continue;
      // Four links name all but what is seen in passing; of a press, which crowds at its dead centres, a few more are left out.
      assert.ok(unnamed <= (scene === four ? 0.01 : 0.1) * arrows, `${scene} ${id}: ${unnamed} of ${arrows} arrows have no name`);
      assert.ok(switched <= 0.03 * arrows, `${scene} ${id}: names come and go ${switched} times at ${arrows} arrows`);
      // A name that is left out is told of.
      assert.ok(counted >= 0.9 * unnamed, `${scene} ${id}: ${unnamed} arrows have no name, the captions tell of ${counted}`);
      all.push(`${(100 * unnamed / arrows).toFixed(1)} (${(100 * switched / arrows).toFixed(1)})`);
    }
  }
  return `of 100 arrows have no name (come and go): ${all.join(', ')}`;
});

/** How far a name goes of itself at most in a degree of the input, or in as small a part of its range. */
function glide(html) {
  const live = liveOf(html);
  const uncoded = new Function(`'use strict';${scripts('text', 'place', 'ink')}\nreturn uncoded;`)();
  const { variable: { kind, range } } = live, frames = 180;
  const degrees = (kind === 'angle' ? (range[1] - range[0]) * 180 / Math.PI : 360) / frames;
  return Math.max(...live.labels.map((label) => {
    const by = uncoded(label.by);
    // After the first place the ways from each to the next, in tenths of a millimetre.
    return Math.max(0, ...by.slice(2).map((_, i) => (i % 2 ? 0 : Math.hypot(by[i + 2], by[i + 3]) - 1.42) / 10 / degrees));
  }));
}

/** Of each panel over the course: names, those that touch another, those that the caption says have no room, and those of
 * joints that stand nearer to another joint than to their own. */
async function crowds(html, count) {
  const page = await open(html, { atOnce: true });
  const found = await page.evaluate(async (positions) => {
    const slide = document.getElementById('at'), span = Number(slide.max) - Number(slide.min);
    const sums = {};
    const off = (box, [x, y]) => Math.hypot(Math.max(box.left - x, 0, x - box.right), Math.max(box.top - y, 0, y - box.bottom));
    for (let i = 0; i < positions; i++) {
      slide.value = String(Number(slide.min) + span * (i + 0.37) / positions);
      slide.dispatchEvent(new Event('input'));
      await new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
      for (const svg of document.querySelectorAll('#stage svg')) {
        const scale = svg.getScreenCTM().a;
        const labels = [...svg.querySelectorAll('.labels > g')].filter((g) => g.getAttribute('visibility') !== 'hidden');
        const boxes = labels.map((g) => g.getBoundingClientRect());
        const joints = [...svg.querySelectorAll('.joint[data-point]')].map((joint) => {
          const box = joint.getBoundingClientRect();
          return [joint.dataset.point, [box.x + box.width / 2, box.y + box.height / 2]];
        });
        const sum = sums[svg.id] = sums[svg.id] || { labels: 0, touching: 0, left: 0, astray: 0 };
        sum.left += Number(/(\d+) names? ha(s|ve) no room/.exec(document.getElementById(svg.id.replace('panel', 'beyond')).textContent)?.[1] || 0);
        boxes.forEach((a, k) => {
          sum.labels += 1;
          const room = 0.35 * scale;
          if (boxes.some((b, m) => m !== k && a.left + room < b.right - room && b.left + room < a.right - room && a.top + 2 * room < b.bottom - 2 * room && b.top + 2 * room < a.bottom - 2 * room)) sum.touching += 1;
          const own = joints.find(([name]) => name === labels[k].dataset.of);
          if (own && joints.some(([, at]) => off(a, at) < off(a, own[1]) - 0.5 * scale)) sum.astray += 1;
        });
      }
    }
    return sums;
  }, count);
  await page.close();
  return found;
}

test('steps, highlighting, diagram, traces, languages', async () => {
  const page = await open(fourPage);
  const shown = () => page.evaluate(() => [...document.querySelectorAll('#stage .vector')].filter((v) => v.getAttribute('visibility') !== 'hidden').length);
  const all = await shown();
  for (let i = 0; i < 40; i++) await page.keyboard.press('[');
  await rest(60);
  assert.equal(await shown(), 0);
  for (let i = 0; i < 40; i++) await page.keyboard.press(']');
  await rest(60);
  assert.equal(await shown(), all);
  await page.click('#values tbody tr:first-child button');
  assert.ok(await page.evaluate(() => document.querySelectorAll('#stage .lit').length) > 0);
  await page.evaluate(() => { for (const box of document.querySelectorAll('.traces input')) box.click(); });
  assert.ok(await page.evaluate(() => [...document.querySelectorAll('.trace')].every((path) => path.getAttribute('d').length > 100)));
  await page.select('#diagram', '0 0');
  assert.ok(await page.evaluate(() => document.querySelector('.diagram .curve').getAttribute('d').length > 1000));
  for (const [language, direction] of [['ar', 'rtl'], ['fa', 'rtl'], ['en', 'ltr']]) {
    await page.select('#language', language);
    assert.deepEqual(await page.evaluate(() => [document.documentElement.lang, document.documentElement.dir]), [language, direction]);
  }
  await page.close();
});

test('steps say what the sheet says there', async () => {
  let compared = 0, same = 0, left = 0;
  const told = async (html, at) => {
    const page = await open(html, { hash: at === null ? '' : `#at=${at}` });
    const lines = await page.evaluate(() => {
      const all = [], slide = document.getElementById('step');
      for (let i = 0; i < Number(slide.max); i++) {
        slide.value = String(i);
        slide.dispatchEvent(new Event('input'));
        const title = slide.getAttribute('aria-valuetext');
        for (const one of document.querySelectorAll('.said li, .said')) if (one.matches('li')) all.push(`${title}: ${one.textContent}`);
        const box = document.querySelector('.said');
        for (const cell of box ? box.parentElement.querySelectorAll('td') : []) all.push(`${title}: ${cell.textContent}`);
      }
      return all;
    });
    await page.close();
    return lines;
  };
  for (const [scene, other] of [[four, 100], [slider, 200], [moving[3], 75], [moving[6], 60]]) {
    const text = readFileSync(scene, 'utf8');
    const moved = path.join(work, `moved-${path.basename(scene)}`);
    const stated = JSON.parse(text);
    assert.notEqual(stated.input.angle, other);
    stated.input.angle = other;
    writeFileSync(moved, JSON.stringify(stated));
    const [there, own] = [await told(pageOf(scene), other), await told(pageOf(moved), null)];
    assert.equal(there.length, own.length);
    const numbers = (line) => line.match(/\u2212?\d[\d\u2009]*(\.\d+)?°?/g) || [];
    there.forEach((line, i) => {
      if (line.endsWith('…')) { left += 1; return; }
      compared += 1;
      if (line === own[i]) { same += 1; return; }
      // As many guard figures as another line needs: the words are the same, and the numbers to the places that both print.
      const bare = (text) => text.replace(/\u2212?\d[\d\u2009]*(\.\d+)?°?/g, '#');
      assert.equal(bare(line), bare(own[i]));
      numbers(line).forEach((text, k) => {
        const both = [text, numbers(own[i])[k]].map((one) => one.replace(/[\u2009°]/g, '').replace('\u2212', '-'));
        const [a, b] = both.map(Number);
        const [u, v] = both.map((one) => (one.includes('.') ? 10 ** -one.split('.')[1].length : 10 ** /0*$/.exec(one)[0].length));
        // A direction is the same after a turn.
        const turned = text.endsWith('°') && Math.abs(((a - b) % 360 + 540) % 360 - 180) < 0.15;
        // Sheet and page read with guard figures of their own, a place apart at most: what follows from a reading differs by no
        // more than half a per cent.
        assert.ok(turned || Math.abs(a - b) <= 0.5001 * (u + v) + 0.005 * Math.abs(b), `${line} is not ${own[i]}`);
      });
    });
  }
  assert.ok(compared > 250 && same > 0.8 * compared && left < 0.05 * compared, `${compared} compared, ${same} the same, ${left} left`);
  return `${compared} texts, ${same} to the letter, ${left} at the scene's own position only`;
});

test('what only a line calculates comes out of the numbers that stand in it', async () => {
  let compared = 0;
  for (const scene of [slider, moving[3], moving[6], path.join(root, 'examples/s000-ch3a-1.json')]) {
    const page = await open(pageOf(scene), { atOnce: true });
    const lines = await page.evaluate(async () => {
      const all = [], slide = document.getElementById('at'), step = document.getElementById('step');
      const { steps } = JSON.parse(document.getElementById('linkgram-live').textContent).texts.en;
      for (let i = 0; i < 16; i++) {
        slide.value = String(Number(slide.min) + (Number(slide.max) - Number(slide.min)) * (i + 0.37) / 16);
        slide.dispatchEvent(new Event('input'));
        await new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
        for (let k = 0; k < Number(step.max); k++) {
          step.value = String(k);
          step.dispatchEvent(new Event('input'));
          const { sentences } = steps.find((said) => said.step >= k);
          for (const [index, line] of document.querySelectorAll('.said li').entries()) {
            // Other numbers are those of the sweep. A power of ten stands high in its element.
            if (Array.isArray(sentences[index]) && sentences[index].some((piece) => piece[0] === 11 && piece[2])) all.push([...line.childNodes].map((one) => (one.nodeName === 'SUP' ? `^${one.textContent}` : one.textContent)).join(''));
          }
        }
      }
      return all;
    });
    await page.close();
    for (const line of lines) {
      const number = '(\\d[\\d.\\u2009]*(?:\u00a0×\u00a010\\^\u2212?\\d+)?)';
      const found = new RegExp(`=\\s${number}(²?)\\s([×/])\\s${number}\\s=\\s${number}(?![\\d.])`).exec(line);
      if (!found) continue;
      const [a, b, c] = [1, 4, 5].map((k) => Number(found[k].replace(/\u2009/g, '').replace('\u00a0×\u00a010^', 'e').replace('\u2212', '-')));
      const left = found[2] ? a * a : a, wanted = found[3] === '×' ? left * b : left / b;
      // The last place of what is printed, with its power of ten.
      const [digits, power] = found[5].replace(/\u2009/g, '').split('\u00a0×\u00a010^');
      const place = 10 ** (-(digits.split('.')[1] || '').length) * (power ? 10 ** Number(power.replace('\u2212', '-')) : 1);
      // From a thousand on there are four figures.
      const half = 0.5001 * (c >= 1000 ? Math.max(place, 10 ** (Math.floor(Math.log10(c)) - 3)) : place);
      assert.ok(Math.abs(wanted - c) <= half, `${scene}: ${line}: ${wanted}`);
      compared += 1;
    }
  }
  assert.ok(compared > 150, String(compared));
  return `${compared} lines`;
});

test('centres and constructions move', async () => {
  for (const [name, moves] of [['centres/four-bar', ['through', 'arrow']], ['constructions/klein', ['through', 'round']]]) {
    const html = pageOf(path.join(root, 'examples', `${name}.json`));
    const live = liveOf(html);
    for (const move of moves) assert.ok(live.ink.some((ink) => ink.move === move), `${name}: nothing moves as ${move}`);
    const page = await open(html);
    const drawn = () => page.evaluate((ids) => ids.map((id) => [...document.getElementById(id).querySelectorAll('path, circle')]
      .map((one) => ['d', 'cx', 'cy', 'r'].map((key) => one.getAttribute(key)).join(' ')).join()), live.ink.filter((ink) => moves.includes(ink.move)).map((ink) => ink.id));
    const before = await drawn();
    await page.keyboard.down('Shift');
    await page.keyboard.press('ArrowRight');
    await page.keyboard.up('Shift');
    await rest(80);
    const after = await drawn();
    assert.ok(before.filter((one, i) => one !== after[i]).length > before.length / 2);
    // On a phone the captions with their scales stay within their panels.
    await page.setViewport({ width: 360, height: 740 });
    const wide = await page.evaluate(() => [...document.querySelectorAll('#stage .panel:not([hidden])')].map((panel) => {
      const own = panel.getBoundingClientRect(), scale = panel.querySelector('figcaption bdi').getBoundingClientRect();
      return scale.right <= own.right && scale.left >= own.left;
    }));
    assert.ok(wide.every(Boolean), `${name}: ${wide}`);
    await page.close();
  }
});

test('what lies beyond its panel is named where it leaves it', async () => {
  // The four-bar of the example at 140°, by circles and straight lines: (13) is where O2A and O4B meet.
  const angle = 140 * Math.PI / 180, [ax, ay] = [40 * Math.cos(angle), 40 * Math.sin(angle)], d = Math.hypot(110 - ax, ay);
  const base = Math.atan2(-ay, 110 - ax), off = Math.acos((120 ** 2 + d ** 2 - 80 ** 2) / (2 * 120 * d));
  const [bx, by] = [ax + 120 * Math.cos(base + off), ay + 120 * Math.sin(base + off)];
  const part = (110 * by) / (by * ax - ay * (bx - 110)), centre = [part * ax, part * ay];
  const page = await open(pageOf(path.join(root, 'examples/centres/four-bar.json')), { hash: '#at=140' });
  const seen = await page.evaluate(() => {
    const live = JSON.parse(document.getElementById('linkgram-live').textContent), [, panel] = live.panels;
    const label = live.labels.find((own) => own.panel === 1 && own.of?.includes('(13)')), element = document.getElementById(label.id);
    const lines = live.ink.filter((own) => own.panel === 1 && own.move === 'through').map((own) => document.getElementById(own.id).querySelector('path').getAttribute('d'));
    return { box: panel.box, scale: panel.si_per_mm, lines, text: element.textContent, hidden: element.getAttribute('visibility'), at: element.getAttribute('transform') };
  });
  assert.notEqual(seen.hidden, 'hidden');
  const far = Number(/\(13\)\s*([\d.]+)/.exec(seen.text)?.[1]), [x, y] = /translate\(([-\d.]+) ([-\d.]+)\)/.exec(seen.at).slice(1).map(Number);
  assert.ok(x > seen.box[0] && x < seen.box[2] && y > seen.box[1] && y < seen.box[3], 'its name stands on the panel');
  // It is told from one of the places where a line leaves the panel.
  const borders = seen.lines.flatMap((line) => [...line.matchAll(/([-\d.]+) ([-\d.]+)/g)].map(([, u, v]) => [Number(u), Number(v)]))
    .filter(([u, v]) => Math.min(Math.abs(u - seen.box[0]), Math.abs(u - seen.box[2]), Math.abs(v - seen.box[1]), Math.abs(v - seen.box[3])) < 1e-5);
  const ways = borders.map(([u, v]) => Math.hypot(u * seen.scale * 1000 - centre[0], -v * seen.scale * 1000 - centre[1]));
  assert.ok(ways.some((way) => Math.abs(way - far) <= 0.006 * way), `${far} mm is none of ${ways}`);
  // Within its panel it is only named.
  await page.evaluate(() => { location.hash = '#at=60'; });
  await rest(200);
  const within = await page.evaluate(() => {
    const live = JSON.parse(document.getElementById('linkgram-live').textContent);
    const element = document.getElementById(live.labels.find((own) => own.panel === 1 && own.of?.includes('(13)')).id);
    return [element.getAttribute('visibility'), [...element.children].map((one) => one.getAttribute('visibility'))];
  });
  assert.deepEqual(within, [null, [null, 'hidden']]);
  await page.close();
  // An arrow that leaves its panel is cut there, and the caption says so.
  const other = await open(pageOf(path.join(root, 'examples/centres/four-bar.json')), { hash: '#at=200' });
  const said = await other.evaluate(() => document.getElementById('beyond4').textContent);
  assert.match(said, /VA is 40\smm long/);
  await other.close();
  return `${far} mm`;
});

test('a pin that leaves its slot is said to', async () => {
  // With four slots the pin of a Geneva drive is in one from 315° to 45°.
  const page = await open(pageOf(sceneOf('geneva'), '--lang', 'en,fa'));
  for (const [at, isOut] of [[0, false], [44, false], [46, true], [180, true], [314, true], [316, false]]) {
    await page.evaluate((place) => { location.hash = `#at=${place}`; }, at);
    await rest(120);
    const said = await page.evaluate(() => document.getElementById('beyond0').textContent);
    assert.equal(/A is out of the slot of link 3/.test(said), isOut, `at ${at}: ${said}`);
  }
  // The wheel's number stays on the wheel, whose pivot is 100 mm from the crank's.
  await page.evaluate(() => { location.hash = '#at=180'; });
  await rest(120);
  const off = await page.evaluate(() => {
    const live = JSON.parse(document.getElementById('linkgram-live').textContent), [panel] = live.panels;
    const label = live.labels.find((own) => own.panel === 0 && own.of?.includes('3'));
    const [x, y] = /\(([-\d.]+) ([-\d.]+)\)/.exec(document.getElementById(label.id).getAttribute('transform')).slice(1).map(Number);
    return Math.hypot(x * panel.si_per_mm * 1000 - 100, y * panel.si_per_mm * 1000);
  });
  assert.ok(off < 100 / Math.SQRT2 + 15, `${off} mm from the middle of the wheel`);
  await page.close();
  return `${off.toFixed(0)} mm`;
});

test('a phone shows a question in letters that can be read, in the typefaces of its languages', async () => {
  for (const scene of [path.join(root, 'examples/s000-ch3a-1.json'), sceneOf('geneva')]) {
    const file = pageOf(scene, '--as', 'question', '--lang', 'en,ar');
    const page = await open(file, { width: 360, height: 740 });
    const seen = () => page.evaluate(() => [...document.querySelectorAll('#sheet .sheet')].filter((one) => one.offsetParent !== null).map((one) => {
      const svg = one.querySelector('svg'), scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
      const sizes = [...svg.querySelectorAll('text')].map((text) => parseFloat(getComputedStyle(text).fontSize) * scale);
      const arabic = [...svg.querySelectorAll('text')].filter((text) => /[\u0621-\u064a]/.test(text.textContent));
      return [Math.min(...sizes), arabic.length, arabic.every((text) => /^.?Amiri/.test(getComputedStyle(text).fontFamily)), document.documentElement.scrollWidth];
    }));
    const [[least], ...others] = await seen();
    assert.equal(others.length, 0, 'one sheet is shown');
    assert.ok(least >= 7.5, `letters of ${least} px`);
    await page.select('#language', 'ar');
    const [[, count, isSet, wide]] = await seen();
    assert.ok(count > 5 && isSet, `${count} texts in Arabic, set in Amiri: ${isSet}`);
    assert.ok(wide <= 360, String(wide));
    // `FontFace`s load when they are used.
    assert.ok(await page.evaluate(async () => (await document.fonts.ready, [...document.fonts].some((face) => /Amiri/.test(face.family) && face.status === 'loaded'))));
    await page.close();
    const desktop = await open(file, { width: 1000 });
    assert.equal(await desktop.evaluate(() => [...document.querySelectorAll('#sheet .sheet')].filter((one) => one.offsetParent !== null).length), 1);
    await desktop.close();
  }
});

test('over time an angle opens with its link', async () => {
  const page = await open(pageOf(slider, '--against', 'time', '--from', '0', '--to', '0.1'));
  for (const part of [0.2, 0.5, 0.8]) {
    const [hidden, told, seen] = await page.evaluate((wish) => {
      const slide = document.getElementById('at');
      slide.value = String(Number(slide.min) + wish * (Number(slide.max) - Number(slide.min)));
      slide.dispatchEvent(new Event('input'));
      return new Promise((done) => {
        requestAnimationFrame(() => requestAnimationFrame(() => {
          const live = JSON.parse(document.getElementById('linkgram-live').textContent);
          const ink = document.getElementById(live.ink.find((own) => own.move === 'turn').id);
          const [, sx, sy, radius, , , , , ex, ey] = /M([-\d.]+) ([-\d.]+) A([\d.]+) ([\d.]+) (0) ([01]) ([01]) ([-\d.]+) ([-\d.]+)/.exec(ink.querySelector('path').getAttribute('d')).map(Number);
          // The bar of the link stands where its arc ends, but for the arrow's head.
          const bar = document.querySelector('#panel0 [data-link="2"] .bar'), matrix = bar.ownerSVGElement.getScreenCTM().inverse().multiply(bar.getScreenCTM());
          const [a, b] = [0, bar.getTotalLength()].map((at) => bar.getPointAtLength(at).matrixTransform(matrix));
          const centre = { x: sx - radius, y: sy };
          const far = Math.hypot(a.x - centre.x, a.y - centre.y) > Math.hypot(b.x - centre.x, b.y - centre.y) ? a : b;
          const angle = (p) => Math.atan2(centre.y - p.y, p.x - centre.x);
          done([ink.getAttribute('visibility'), angle({ x: ex, y: ey }), angle(far)]);
        }));
      });
    }, part);
    assert.equal(hidden, null);
    const off = Math.abs(Math.atan2(Math.sin(told - seen), Math.cos(told - seen)));
    assert.ok(off < 0.45, `the arc ends at ${told}, the link stands at ${seen}`);
  }
  await page.close();
});

test('axe finds nothing', async () => {
  const question = path.join(work, 'question.html');
  run('draw', four, '--as', 'question', '-o', question);
  let rules = 0;
  const centres = pageOf(path.join(root, 'examples/s000-ch3b-1.json'), '--lang', 'en,ar'), still = pageOf(sceneOf('gear-pair'));
  for (const [file, hash] of [[fourPage, ''], [fourPage, '#lang=ar'], [fourPage, '#lang=fa'], [centres, '#step=4'], [centres, '#lang=ar&step=4'], [still, ''], [question, '']]) {
    for (const scheme of ['light', 'dark']) {
      const page = await open(file, { hash });
      if (!firefox) await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
      await page.evaluate((source) => { (0, eval)(source); }, axe).catch(() => page.evaluate(axe));
      // At rest; with every panel, path and a diagram open; with the help.
      for (const open of [() => {}, () => {
        for (const box of document.querySelectorAll('.traces input:not(:checked)')) box.click();
        const diagram = document.getElementById('diagram');
        if (diagram) diagram.value = '0 0';
        diagram?.dispatchEvent(new Event('change'));
        document.querySelector('#values button')?.click();
        document.getElementById('sheet').open = true;
      }, () => { document.getElementById('help')?.click(); }]) {
        await page.evaluate(open);
        const found = await page.evaluate(() => window.axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa'] }));
        rules += found.passes.length;
        assert.deepEqual(found.violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html.slice(0, 120)).join(' | ')}`), [], `${file}${hash} ${scheme}`);
      }
      await page.close();
    }
  }
  trouble.splice(0, trouble.length, ...trouble.filter((line) => !/unsafe-eval|Content.Security.Policy|Content-Security-Policy/i.test(line)));
  return `${rules} rules passed`;
});

test('hostile names and addresses do nothing', async () => {
  const scene = JSON.parse(readFileSync(four, 'utf8'));
  scene.title = '</script><script>window.hit=1</script><!-- "\'\u2028\u202e<img src=x onerror=window.hit=1> ' + 'x'.repeat(3000);
  const file = path.join(work, 'hostile.json');
  writeFileSync(file, JSON.stringify(scene));
  const html = pageOf(file);
  assert.ok(!readFileSync(html, 'utf8').includes('<script>window.hit'));
  const page = await open(html, { hash: '#at=1e999&step=-7&lang=<b>&x=%00' });
  assert.equal(await page.evaluate(() => window.hit), undefined);
  assert.equal(await page.evaluate(() => document.getElementById('live').hidden), false);
  await page.close();
});

test('without a script the sheet stands; in a sandboxed frame the page works', async () => {
  // Only Chromium can be told to run no scripts.
  if (!firefox) {
    const page = await open(fourPage, { script: false });
    const [stands, paths] = await page.$eval('#sheet', (sheet) => [sheet.hasAttribute('open'), sheet.querySelectorAll('svg path').length]);
    assert.ok(stands && paths > 50);
    await page.close();
  }
  const frame = path.join(work, 'frame.html');
  const own = readFileSync(fourPage, 'utf8').replaceAll('&', '&amp;').replaceAll('"', '&quot;');
  writeFileSync(frame, `<!doctype html><meta charset="utf-8"><title>t</title><iframe sandbox="allow-scripts" width="900" height="700" srcdoc="${own}"></iframe>`);
  const outer = await open(frame);
  await rest(400);
  const inner = outer.frames().find((one) => one !== outer.mainFrame());
  assert.equal(await inner.evaluate(() => document.getElementById('live').hidden), false);
  await outer.close();
  return firefox ? 'the frame only in Firefox' : '';
});

test('the print is true to scale', async () => {
  if (firefox) return 'only Chromium prints here';
  const page = await open(fourPage);
  await page.emulateMediaType('print');
  const found = await page.evaluate(() => [...document.querySelectorAll('.panel svg')].map((svg) => {
    const box = svg.getBoundingClientRect();
    return [box.width / 96 * 25.4, svg.viewBox.baseVal.width];
  }));
  for (const [drawn, wanted] of found) assert.ok(Math.abs(drawn / wanted - 1) < 1e-3, `${drawn} mm for ${wanted} mm`);
  await page.close();
  return `${found.length} panels`;
});

/** What a button gives away, instead of a download. */
const given = (page, id) => page.evaluate(async (button) => {
  const own = URL.createObjectURL;
  let blob;
  URL.createObjectURL = (one) => { blob = one; return own(one); };
  document.getElementById(button).click();
  URL.createObjectURL = own;
  return blob.text();
}, id);

test('a drawing saved from a page is graded, names and all', async () => {
  const scene = path.join(root, 'examples/s000-ch3a-1.json'), drawing = path.join(work, 'saved.svg');
  const page = await open(pageOf(scene));
  writeFileSync(drawing, await given(page, 'save'));
  await page.close();
  // Not everything that is asked is drawn: that is no fault, and the status says that marks are missing.
  let told = '';
  try { told = run('grade', scene, drawing); } catch (error) { told = error.stdout + error.stderr; }
  assert.match(told, /^D \(skeleton\) .* right/m, told);
  assert.ok((told.match(/ right /g) || []).length >= 14 && !/wrong|error/.test(told), told);
});

test('at its own position the page says what the sheet says', async () => {
  let compared = 0;
  for (const name of ['s000-ch3a-1', 's000-ch3b-1', 'eight-link']) {
    const scene = path.join(root, `examples/${name}.json`);
    const page = await open(pageOf(scene));
    const [rows, sheet] = await page.evaluate(() => {
      const bare = (element) => element.textContent.replace(/\s+/g, '');
      return [[...document.querySelectorAll('#values tbody tr td:nth-child(2)')].map(bare), new Set([...document.querySelectorAll('#sheet text')].map(bare))].map((all) => [...all]);
    });
    // What the scene states is in no table of the sheet: a line tells it, perhaps with more figures.
    const rounded = (value) => {
      const [, number, unit] = /^\(?([\d.]+)(.*)$/.exec(value) || [];
      if (Number(number) === 0) return sheet.some((text) => /=0\.?$/.test(text));
      // With a figure more it may lie half way between two of so many.
      const half = 0.5 * (1 + 1e-9) * 10 ** -((number || '').split('.')[1] || '').length;
      return Number(number) !== 0 && sheet.some((text) => text.includes(unit) && [...text.matchAll(/\d+(?:\.\d+)?/g)].some(([own]) => Math.abs(Number(own) - Number(number)) <= half));
    };
    for (const value of rows) assert.ok(sheet.includes(value) || sheet.includes(`+${value}`) || rounded(value), `${name}: ${value} stands nowhere on the sheet`);
    compared += rows.length;
    await page.close();
  }
  return `${compared} values`;
});

test('the address moves the page, a field says how far it went, and a page loaded again is where it was', async () => {
  const page = await open(fourPage, { hash: '#at=100' });
  await page.evaluate(() => { location.hash = '#at=140&step=2'; });
  await rest(120);
  assert.equal(await placeOf(page), 140);
  assert.equal(await page.evaluate(() => document.getElementById('step').value), '2');
  await page.close();
  const limited = await open(pageOf(rocker));
  const [typed, stands] = await limited.evaluate(async () => {
    const field = document.getElementById('exact'), slide = document.getElementById('at');
    field.focus();
    field.value = slide.max * 180 / Math.PI - 1;
    field.dispatchEvent(new Event('change'));
    await new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
    return [Number(field.value), Number(slide.value) * 180 / Math.PI];
  });
  assert.ok(Math.abs(typed - stands) < 1e-6, `the field says ${typed} where the input is ${stands}`);
  await rest(700);
  await limited.evaluate(() => location.reload()).catch(() => {});
  await rest(500);
  assert.ok(Math.abs(await placeOf(limited) - stands) < 1e-6);
  await limited.close();
});

test('a scene states how its page opens', async () => {
  const scene = JSON.parse(readFileSync(four, 'utf8'));
  scene.sheet = { ...scene.sheet, live: { play_seconds: 20, traces: ['B'], diagrams: ['omega(4)'], scale: 'refit', panels: ['skeleton', 'acceleration'] } };
  const file = path.join(work, 'opens.json');
  writeFileSync(file, JSON.stringify(scene));
  const page = await open(pageOf(file));
  assert.deepEqual(await page.evaluate(() => [
    document.querySelector('input.number:not(#exact)').value, document.querySelectorAll('.trace').length,
    document.querySelectorAll('.diagram .curve[d]').length, document.getElementById('scale').getAttribute('aria-pressed'),
  ]), ['20', 1, 1, 'true']);
  const shown = () => page.evaluate(() => [...document.querySelectorAll('#stage .panel')].map((panel) => panel.offsetWidth > 0));
  assert.deepEqual(await shown(), [true, false, true]);
  // Whoever reads it may change that.
  await page.evaluate(() => { document.querySelectorAll('.traces input')[1].click(); });
  assert.deepEqual(await shown(), [true, true, true]);
  await page.close();
});

test('a page that does not move has its steps', async () => {
  const page = await open(pageOf(sceneOf('rolling-wheel')));
  const seen = () => page.evaluate(() => [...document.querySelectorAll('#sheet [data-step]')].filter((ink) => !ink.hasAttribute('hidden')).length);
  const all = await seen();
  assert.ok(all > 5, String(all));
  for (let i = 0; i < 40; i++) await page.keyboard.press('[');
  assert.ok(await seen() < all / 2);
  assert.ok(await page.evaluate(() => document.querySelectorAll('.said li').length) > 0);
  for (let i = 0; i < 40; i++) await page.keyboard.press(']');
  assert.equal(await seen(), all);
  await page.close();
});

test('print keeps the bars and tells the position', async () => {
  const page = await open(fourPage, { hash: '#at=100' });
  if (!firefox) await page.emulateMediaType('print');
  const found = await page.evaluate(() => [[...document.querySelectorAll('#stage .bar')].map((bar) => getComputedStyle(bar).display), document.getElementById('here').textContent]);
  assert.ok(found[0].length > 2 && found[0].every((display) => display !== 'none'), found[0].join());
  assert.match(found[1], /100°/);
  await page.close();
});

test('what is saved is one drawing and a table of numbers', async () => {
  const page = await open(fourPage, { hash: '#at=100' });
  const svg = await given(page, 'save');
  const roots = await page.evaluate((text) => {
    const read = new DOMParser().parseFromString(text, 'image/svg+xml');
    return [read.querySelectorAll('parsererror').length, read.querySelectorAll('svg').length];
  }, svg);
  assert.deepEqual(roots, [0, 1]);
  const [head, line] = (await given(page, 'table')).trim().split('\r\n');
  const numbers = line.split(',').map(Number);
  // A comma within quotes parts nothing.
  assert.equal(numbers.length, head.split(/,(?=(?:[^"]*"[^"]*")*[^"]*$)/).length);
  assert.ok(numbers[0] === 100 && numbers.every(Number.isFinite), line);
  await page.close();
});

test('the table that is saved is the sweep\'s, heads and all', async () => {
  let compared = 0;
  for (const scene of [slider, path.join(root, 'examples/s000-ch3a-1.json'), path.join(root, 'examples/forces/friction-slider-crank.json')]) {
    const table = path.join(work, 'own.csv'), html = pageOf(scene);
    run('sweep', scene, '--steps', '7', '-o', table);
    const [head, ...lines] = readFileSync(table, 'utf8').trim().split(/\r?\n/);
    for (const line of [lines[2], lines[5]]) {
      const page = await open(html, { hash: `#at=${line.split(',')[0]}` });
      const [own, numbers] = (await given(page, 'table')).trim().split('\r\n');
      await page.close();
      assert.equal(own, head, scene);
      // The place is told in the scene's unit, and comes back from it: it may be another double.
      const [mine, wanted] = [numbers, line].map((text) => text.split(','));
      assert.equal(mine.length, wanted.length);
      wanted.forEach((text, i) => {
        assert.equal(mine[i] === '', text === '', `${scene}: ${head.split(',')[i]}`);
        assert.ok(Math.abs(Number(mine[i]) - Number(text)) <= 1e-9 * Math.abs(Number(text)) + 1e-9, `${scene}: ${mine[i]} is not ${text}`);
      });
      compared += wanted.length;
    }
  }
  return `${compared} numbers`;
});

/** The rows of the table of values, by quantity. */
const rowsOf = (page) => page.evaluate(() => Object.fromEntries([...document.querySelectorAll('#values tbody tr')].map((row) => [row.dataset.quantity, [...row.cells].map((cell) => cell.textContent)])));

test('rounding has no sense, a pair that rubs comes to rest, and what is of the cycle stands at every position', async () => {
  // The connecting rod of two parallel cranks does not turn: what is computed is zero or the rounding of it.
  const html = pageOf(sceneOf('parallel-crank'));
  const live = liveOf(html);
  const course = new (new Function(`'use strict';${scripts('libm', 'program', 'course')}\nreturn Course;`)())(live);
  const rate = live.outputs.findIndex((output) => output.name === 'omega(3)'), { range: [from, to], si } = live.variable;
  const dust = Array.from({ length: 2000 }, (_, i) => from + (i + 0.37) / 2000 * (to - from)).find((at) => course.look(at)?.[rate] !== 0);
  assert.ok(dust !== undefined && Math.abs(course.look(dust)[rate]) < 1e-9, 'somewhere rounding is left');
  const turning = await open(html);
  await goTo(turning, dust);
  assert.deepEqual((await rowsOf(turning))['omega(3)'].slice(1, 3), ['0\u00a0rad/s', ''], `at ${dust / si}`);
  await turning.close();
  const rubbing = await open(pageOf(path.join(root, 'examples/forces/friction-slider-crank.json')));
  await goTo(rubbing, Math.PI);
  const atRest = await rowsOf(rubbing);
  assert.ok(Object.values(atRest).every((row) => row[1] === '—' && /comes to rest/.test(row[2])), JSON.stringify(atRest));
  await goTo(rubbing, 1);
  assert.ok(Object.values(await rowsOf(rubbing)).every((row) => /\d/.test(row[1])));
  await rubbing.close();
  // The mean torque is that of the sheet wherever the crank stands.
  const scene = path.join(root, 'examples/forces/gas-engine.json'), engine = await open(pageOf(scene), { hash: '#at=50' });
  const rows = await rowsOf(engine);
  await engine.close();
  for (const { name, value, unit } of JSON.parse(run('solve', scene, '--json')).quantities.filter((own) => own.unit && !/[(]/.test(own.name))) {
    const told = Number.parseFloat(rows[name][1].replace(/[\u2009]/g, ''));
    assert.ok(Math.abs(told - value) <= 0.005 * Math.abs(value), `${name} = ${rows[name][1]} for ${value} ${unit}`);
  }
});

test('no name comes before its ink', async () => {
  const page = await open(fourPage, { hash: '#step=1' });
  const early = await page.evaluate(() => [...document.querySelectorAll('#panel1 .labels > g, #panel2 .labels > g')].filter((name) => {
    const of = (name.getAttribute('data-of') || '').split(' ');
    const ink = [...document.querySelectorAll('#stage .vector')].filter((vector) => of.includes(vector.getAttribute('data-quantity')));
    const hidden = (one) => one.getAttribute('visibility') === 'hidden';
    return !hidden(name) && ink.length > 0 && ink.every(hidden);
  }).length);
  assert.equal(early, 0);
  await page.close();
});

test('a guide is as long as its rider goes', async () => {
  const page = await open(pageOf(slider));
  const [low, high, from, to] = await page.evaluate(async () => {
    const slide = document.getElementById('at'), all = [];
    const block = document.querySelector('#panel0 .slider');
    for (let i = 0; i <= 24; i++) {
      slide.value = String(Number(slide.min) + (Number(slide.max) - Number(slide.min)) * i / 24);
      slide.dispatchEvent(new Event('input'));
      await new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
      all.push(block.getBoundingClientRect());
    }
    const guides = [...document.querySelectorAll('#panel0 .guide')].map((guide) => guide.getBoundingClientRect());
    return [Math.min(...all.map((b) => b.left)), Math.max(...all.map((b) => b.right)), Math.min(...guides.map((g) => g.left)), Math.max(...guides.map((g) => g.right))];
  });
  assert.ok(from <= low && to >= high, `${from} … ${to} for ${low} … ${high}`);
  await page.close();
});

test('a bar leads the input, and the field says what it does not understand', async () => {
  const page = await open(fourPage);
  const before = await placeOf(page);
  const [x, y] = await page.evaluate(() => {
    const bar = document.querySelector('.reach'), at = bar.getPointAtLength(0.4 * bar.getTotalLength()).matrixTransform(bar.getScreenCTM());
    return [at.x, at.y];
  });
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 8, y - 3, { steps: 4 });
  await page.mouse.up();
  assert.ok(Math.abs(await placeOf(page) - before) > 2);
  for (const [text, wanted] of [['30°', 30], ['0.5 rad', 90 / Math.PI], ['1/2', 0.5], ['\u06f4\u06f5', 45]]) {
    await page.evaluate((typed) => { const field = document.getElementById('exact'); field.value = typed; field.dispatchEvent(new Event('change')); }, text);
    assert.ok(Math.abs(await placeOf(page) - wanted) < 1e-6, text);
  }
  await page.evaluate(() => { const field = document.getElementById('exact'); field.value = 'abc'; field.dispatchEvent(new Event('change')); });
  assert.match(await page.evaluate(() => document.getElementById('message').textContent), /abc/);
  await page.close();
});

/** Sends the page to a place of the slider. */
const goTo = (page, at) => page.evaluate((wish) => {
  const slide = document.getElementById('at');
  slide.value = String(wish);
  slide.dispatchEvent(new Event('input'));
  return new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
}, at);

test('it plays as the mechanism turns in truth', async () => {
  for (const [scene, sign] of [[path.join(root, 'examples/s000-ch3a-1.json'), -1], [four, 1]]) {
    const html = pageOf(scene), page = await open(html);
    const { rate } = liveOf(html).variable;
    assert.equal(Math.sign(rate), sign);
    const before = await placeOf(page);
    await page.keyboard.press(' ');
    await rest(600);
    await page.keyboard.press(' ');
    const way = ((await placeOf(page) - before + 540) % 360 + 360) % 360 - 180;
    assert.equal(Math.sign(way), sign, `${scene}: ${way}`);
    await page.close();
  }
});

test('paths and diagrams are those of what they name, and zero is straight', async () => {
  const page = await open(pageOf(sceneOf('parallel-crank')));
  await page.evaluate(() => { for (const box of document.querySelectorAll('.row.traces input')) if (!box.checked) box.click(); });
  const traces = await page.evaluate(() => [...document.querySelectorAll('#panel0 .trace')].map((trace) => trace.getBBox().x));
  assert.ok(traces.length === 2 && Math.abs(traces[0] - traces[1]) > 10, traces.join());
  // The coupler translates: its rate is zero in every position, not the rounding of zero.
  const [curve, label] = await page.evaluate(() => {
    const box = document.getElementById('diagram'), own = [...box.options].find((option) => option.textContent.includes('\u2083'));
    box.value = own.value;
    box.dispatchEvent(new Event('change'));
    return [document.querySelector('.diagram .curve').getAttribute('d'), own.textContent];
  });
  const heights = new Set(curve.match(/ -?[\d.]+/g));
  assert.equal(heights.size, 1, `${label}: ${[...heights].slice(0, 5)}`);
  await page.close();
});

test('what is laid off has the length that the scale in force gives it', async () => {
  // The crank's own vectors stay the same over the course, and the scale does not.
  const html = pageOf(slider), page = await open(html);
  const { variable: { range: [from, to] } } = liveOf(html);
  await page.keyboard.press('s');
  let compared = 0;
  for (const part of [0.02, 0.1, 0.26, 0.4, 0.6]) {
    await goTo(page, from + part * (to - from));
    const found = await page.evaluate(() => {
      const all = [], slide = document.getElementById('step');
      for (let i = 0; i < Number(slide.max); i++) {
        slide.value = String(i);
        slide.dispatchEvent(new Event('input'));
        for (const line of document.querySelectorAll('.said li')) all.push(line.textContent);
      }
      const lengths = [...document.querySelectorAll('#stage .vector .shaft')].map((shaft) => {
        const [x0, y0, x1, y1] = `${shaft.getAttribute('d')} ${shaft.parentNode.querySelector('.head').getAttribute('d')}`.match(/-?[\d.]+/g).map(Number).flatMap((n, i) => (i < 2 || i === 4 || i === 5 ? [n] : []));
        return Math.hypot(x1 - x0, y1 - y0);
      });
      return [all, lengths];
    });
    for (const line of found[0]) {
      const [, mm] = /Lay off .*= ([\d.]+)\u00a0mm/.exec(line) || [];
      if (!mm) continue;
      compared += 1;
      assert.ok(found[1].some((length) => Math.abs(length - Number(mm)) <= 0.06), `${line}: no vector is so long`);
    }
  }
  assert.ok(compared >= 5, String(compared));
  await page.close();
  return `${compared} lengths`;
});

test('names and numbers of the ink follow, and controls stay where they are', async () => {
  const page = await open(pageOf(path.join(root, 'examples/s000-ch3a-1.json')), { height: 1400 });
  const { text, told, tops } = await page.evaluate(async () => {
    const slide = document.getElementById('at'), tops = new Set();
    const frame = () => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
    for (let i = 0; i <= 40; i++) {
      slide.value = String(Number(slide.min) + (Number(slide.max) - Number(slide.min)) * i / 40);
      slide.dispatchEvent(new Event('input'));
      await frame();
      tops.add(Math.round(document.getElementById('values').getBoundingClientRect().top + scrollY));
    }
    slide.value = String(75 * Math.PI / 180);
    slide.dispatchEvent(new Event('input'));
    await frame();
    const row = document.querySelector('#values tr[data-quantity="omega(4)"] td:nth-child(2)');
    return { text: row.textContent, told: Number(document.querySelector('#stage [data-quantity="omega(4)"][data-value]').dataset.value), tops: [...tops] };
  });
  assert.ok(Math.abs(Math.abs(told) - Number.parseFloat(text)) < 0.006, `${told} and ${text}`);
  assert.equal(tops.length, 1, `the table stands at ${tops}`);
  await page.close();
});

/** What a page does with the document in the frames of three seconds of playing: how often each thing a frame, and what it wrote
 * though it stood there already. */
async function written(html) {
  const page = await browser.newPage();
  await page.evaluateOnNewDocument(() => {
    const told = window.told = { on: false, frames: 0, writes: 0, idle: [], reads: [], made: 0 };
    const wrap = (of, name, does) => {
      const own = of[name];
      of[name] = function (...all) {
        if (told.on) does(this, ...all);
        return own.apply(this, all);
      };
    };
    wrap(Element.prototype, 'setAttribute', (element, name, value) => {
      told.writes += 1;
      if (element.getAttribute(name) === String(value)) told.idle.push(`${element.tagName}.${element.getAttribute('class')} ${name}`);
    });
    for (const [of, name] of [[Element.prototype, 'getBoundingClientRect'], [SVGGraphicsElement.prototype, 'getScreenCTM'], [SVGGraphicsElement.prototype, 'getBBox'], [window, 'getComputedStyle']]) wrap(of, name, () => told.reads.push(name));
    for (const name of ['offsetWidth', 'offsetHeight', 'clientWidth', 'clientHeight', 'scrollTop']) {
      const [of, own] = [HTMLElement.prototype, Element.prototype].map((one) => [one, Object.getOwnPropertyDescriptor(one, name)]).find(([, found]) => found);
      Object.defineProperty(of, name, { ...own, get() { if (told.on) told.reads.push(name); return own.get.call(this); } });
    }
    for (const name of ['createElement', 'createElementNS', 'createTextNode']) wrap(Document.prototype, name, () => { told.made += 1; });
    const frame = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (does) => frame((now) => {
      if (told.on) told.frames += 1;
      does(now);
    });
  });
  await page.setViewport({ width: 390, height: 844 });
  await page.goto(`file://${html}`);
  await page.evaluate(() => { for (const box of [...document.querySelectorAll('.traces label input:not(:checked)')].slice(-2)) box.click(); });
  await rest(600);
  await page.keyboard.press(' ');
  await rest(300);
  await page.evaluate(() => { window.told.on = true; });
  await rest(3000);
  const told = await page.evaluate(() => { window.told.on = false; return window.told; });
  await page.keyboard.press(' ');
  await page.close();
  return told;
}

test('a frame writes what has changed, reads no layout and makes nothing', async () => {
  const all = [];
  for (const scene of [four, moving[6], path.join(root, 'examples/s000-ch3a-1.json')]) {
    const told = await written(pageOf(scene));
    assert.ok(told.frames > 5, `${told.frames} frames`);
    assert.deepEqual([...new Set(told.reads)], [], scene);
    // One coordinate of a dot may stay where it is.
    assert.ok(told.idle.length <= told.writes / 50, `${scene}: ${told.idle.length} of ${told.writes} stood there already: ${[...new Set(told.idle)]}`);
    // What leaves a panel is said in words now and then.
    assert.ok(told.made <= told.frames / 2, `${scene}: ${told.made} nodes made in ${told.frames} frames`);
    all.push((told.writes / told.frames).toFixed(0));
    assert.ok(told.writes / told.frames < 160, `${scene}: ${told.writes} writes in ${told.frames} frames`);
  }
  return `${all.join(', ')} attributes a frame`;
});

test('size and speed', async () => {
  const six = pageOf(path.join(root, 'examples/s000-ch3a-1.json')), eight = pageOf(path.join(root, 'examples/eight-link.json'));
  const sizes = [six, eight].map((file) => readFileSync(file).length);
  const script = /<script>(.*?)<\/script>/s.exec(readFileSync(six, 'utf8'))[1].length;
  assert.ok(script <= 80_000, `script ${script}`);
  assert.ok(sizes[0] <= 290_000, `six-link ${sizes[0]}`);
  assert.ok(sizes[1] <= 450_000, `eight-link ${sizes[1]}`);
  // While it plays in the window of a phone, with two paths.
  const page = await open(six, { width: 390, height: 844, timed: true });
  await page.evaluate(() => { for (const box of [...document.querySelectorAll('.traces label input:not(:checked)')].slice(-2)) box.click(); });
  await rest(600);
  await page.keyboard.press(' ');
  await page.evaluate(() => { window.frameTimes.length = 0; });
  await rest(3000);
  await page.keyboard.press(' ');
  const times = (await page.evaluate(() => window.frameTimes)).sort((a, b) => a - b);
  await page.close();
  const [middle, most] = [0.5, 0.95].map((part) => times[Math.floor(part * times.length)]);
  // Told and not asserted: the ceiling, 2 ms at 95 of 100, is of a machine at rest (benches/README.md).
  return `six-link ${sizes[0]} bytes, eight-link ${sizes[1]} bytes, script ${script} bytes; of ${times.length} frames the script takes ${middle.toFixed(1)} ms, ${most.toFixed(1)} at 95 of 100`;
});

let failed = 0;
for (const [name, does] of tests) {
  if (!name.includes(process.env.ONLY || '')) continue;
  const begun = Date.now();
  try {
    const told = await does();
    assert.deepEqual(trouble, []);
    console.log(`ok   ${name}${told ? `: ${told}` : ''} (${Date.now() - begun} ms)`);
  } catch (error) {
    failed += 1;
    console.log(`FAIL ${name}: ${error.message}`);
    trouble.length = 0;
  }
}
if (pictures) {
  for (const [width, height, device] of [[390, 844, 'phone'], [1400, 1000, 'desktop']]) {
    for (const scheme of ['light', 'dark']) {
      for (const language of ['en', 'ar']) {
        for (const at of [20, 140, 260]) {
          const page = await open(fourPage, { width, height, hash: `#at=${at}&lang=${language}` });
          if (!firefox) await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
          await page.screenshot({ path: path.join(pictures, `${device}-${scheme}-${language}-${at}.png`) });
          await page.close();
        }
      }
    }
  }
}
await browser.close();
rmSync(work, { recursive: true });
process.exit(failed === 0 ? 0 : 1);
