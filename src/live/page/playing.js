// Playing: the input at constant speed by the time that has gone, to and fro where the course has ends.

/** @param {Page} page */
function plays(page) {
  const { track, span, variable, live, calm } = page;
  const button = page.button({ id: 'play' }, '', play), pace = make('span', { dir: 'auto' });
  const field = make('input', { inputmode: 'decimal', value: String(live.seconds), class: 'number', dir: 'ltr' });
  // As the mechanism turns in truth.
  let way = variable.rate < 0 ? -1 : 1, before = 0, sum = 0, told = 0;

  const seconds = () => Math.min(120, Math.max(1, typed(field.value) || live.seconds));

  function halt() {
    if (!page.playing) return;
    page.playing = false;
    speak();
    page.queue();
  }

  function play() {
    if (page.playing) {
      halt();
      return;
    }
    page.playing = true;
    before = 0;
    sum = 0;
    page.say('');
    speak();
    requestAnimationFrame(tick);
  }

  /** @param {number} now */
  function tick(now) {
    if (!page.playing) return;
    if (before > 0) {
      sum += Math.min(0.25, (now - before) / 1000);
      // With reduced motion it goes by a step in a second.
      if (!calm.matches || sum >= 1) {
        const step = calm.matches ? (variable.kind === 'angle' ? Math.PI / 12 : span / 24) : sum * span / seconds();
        const found = track.go(page.at, way * step);
        sum = 0;
        page.at = found.at;
        if (found.stopped) {
          way = -way;
          told = now;
          page.say(page.words.turns_back);
        } else if (told > 0 && now - told > 2000) {
          told = 0;
          page.say('');
        }
        page.draw();
      }
    }
    before = now;
    requestAnimationFrame(tick);
  }

  function speak() {
    const { words, playing } = page, ratio = Math.abs(variable.rate) * seconds() / span;
    setText(button, playing ? words.stop : words.play);
    pressed(button, playing);
    const times = plainText(withPower(Number((ratio >= 1 ? ratio : 1 / ratio).toPrecision(3))));
    setText(pace, ratio === 0 ? '' : filled(ratio >= 1 ? words.slower : words.faster, { times }));
  }

  on(field, 'change', speak);
  page.add({ speak });
  return { play, halt, button, pace: [make('label', {}, page.says(make('span'), 'seconds_a_turn'), field), pace] };
}
