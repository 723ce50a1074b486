// A file that the reader keeps.

/** Throws where a page may not. */
function download(/** @type {string} */ text, /** @type {string} */ name, /** @type {string} */ kind) {
  if (window.origin === 'null' && (location.protocol !== 'file:' || window !== window.parent)) throw new Error('sandboxed');
  const link = document.createElement('a');
  link.download = name;
  link.href = URL.createObjectURL(new Blob([text], { type: kind }));
  link.click();
  URL.revokeObjectURL(link.href);
}
