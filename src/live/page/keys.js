// The keys, and the help that lists them.

/** @param {Page} page */
function tellsKeys(page) {
  const box = make('input', { type: 'checkbox', checked: '' }), text = make('p');
  const dialog = make('dialog', { 'aria-labelledby': 'helptitle' },
    page.says(make('h2', { id: 'helptitle' }), 'help'), text, make('label', {}, box, page.says(make('span'), 'keys_off')),
    make('p'), page.button({}, 'close', () => dialog.close()));
  page.add({ speak: () => setText(text, `${page.words.moving_page} ${page.words.help_keys}`) });
  return { dialog, open: () => dialog.open || dialog.showModal(), areOn: () => box.checked && !dialog.open };
}

/** @param {Page} page @param {Record<string, (size: number) => void>} does what a key does; `size` is a degree, or what is as fine @param {() => boolean} areOn @param {() => void} letGo */
function keysWork(page, does, areOn, letGo) {
  const degree = page.variable.kind === 'angle' ? Math.PI / 180 : page.span / 360;
  on(document, 'keydown', (event) => {
    const { target, key } = event;
    const inField = target.matches('input:not([type=checkbox], #at), select, textarea');
    if (key === 'Escape') {
      letGo();
      if (inField) target.blur();
      return;
    }
    if (!areOn() || inField || event.ctrlKey || event.metaKey) return;
    if (key === ' ' && target.matches('button, summary, a')) return;
    const act = does[key] || does[key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act(degree * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1));
  });
}
