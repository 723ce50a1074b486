// A page that does not move: which of its languages is shown.

const choice = /** @type {HTMLSelectElement | null} */ (document.getElementById('language'));
if (choice) {
  choice.hidden = false;
  const show = () => {
    const { value: tag, dir } = /** @type {HTMLOptionElement} */ (choice.selectedOptions[0]);
    document.documentElement.lang = tag;
    document.documentElement.dir = dir;
    for (const said of document.querySelectorAll('main [lang]:not(option)')) {
      /** @type {any} */ (said).hidden = said.getAttribute('lang') !== tag;
    }
  };
  choice.addEventListener('change', show);
  // The address may say in which language the page opens.
  const follow = () => {
    const tag = new URLSearchParams(location.hash.slice(1)).get('lang');
    if ([...choice.options].some(({ value }) => value === tag)) {
      choice.value = String(tag);
      show();
    }
  };
  addEventListener('hashchange', follow);
  follow();
}
