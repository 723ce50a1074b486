// A page that does not move: which of its languages is shown.

const choice = /** @type {HTMLSelectElement | null} */ (document.getElementById('language'));
if (choice) {
  choice.hidden = false;
  choice.addEventListener('change', () => {
    const { value: tag, dir } = /** @type {HTMLOptionElement} */ (choice.selectedOptions[0]);
    document.documentElement.lang = tag;
    document.documentElement.dir = dir;
    for (const said of document.querySelectorAll('main [lang]:not(option)')) {
      /** @type {any} */ (said).hidden = said.getAttribute('lang') !== tag;
    }
  });
}
