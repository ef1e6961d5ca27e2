/* Long names break behind a dot, an underscore or a bracket, and are copied as they are. */
document.addEventListener("DOMContentLoaded", () => {
  for (const name of document.querySelectorAll(".bd-article :is(p, li, dd, td, dt, h1) :is(code, .sig-name, .sig-prename) .pre, .bd-article h1")) {
    for (const text of [...name.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE)) {
      const parts = text.data.split(/(?<=[._(\/,=])(?=\w)/);
      if (parts.length > 1) text.replaceWith(...parts.flatMap((part, i) => (i ? [document.createElement("wbr"), part] : [part])));
    }
  }
});
