// The choices that are no position: language, scale, light or dark.

function turnTheme() {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === 'dark' : window.matchMedia('(prefers-color-scheme: dark)').matches;
  root.dataset.theme = dark ? 'light' : 'dark';
}

/** @param {Page} page */
function choosesLanguage(page) {
  const { languages } = page;
  if (languages.length < 2) return [];
  const box = page.says(make('select', { id: 'language' }, ...languages.map((tag) => make('option', { value: tag, lang: tag }, page.live.texts[tag].words.own_name))), 'language', 'aria-label');
  on(box, 'change', () => {
    page.speak(box.value);
    page.draw();
  });
  page.add({ speak: () => { box.value = page.language; } });
  return [box];
}

/** @param {Page} page */
function choosesScale(page) {
  const turn = () => {
    page.refit = !page.refit;
    page.draw();
  };
  const button = page.button({ id: 'scale' }, '', turn);
  page.add({
    show() {
      const { scale, refit, fixed: still } = page.words;
      setText(button, `${scale}: ${page.refit ? refit : still}`);
      pressed(button, page.refit);
    },
  });
  return { button, turn };
}
