// Elements are made here and nowhere else: texts enter as text, so a name is never read as HTML.

export const byId = (id) => document.getElementById(id);

/** An element with properties, and children that are elements or texts. */
export function element(tag, properties = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in node) node[name] = value;
    else node.setAttribute(name, value);
  }
  node.append(...children);
  return node;
}

export function labelled(text, input) {
  return element('label', {}, input, ` ${text}`);
}

/** A table of [name, value] rows; a row without a value is a heading. */
export function table(rows) {
  return element('table', {}, ...rows.map(([name, value]) => (value === ''
    ? element('tr', {}, element('th', { colSpan: 2 }, name))
    : element('tr', {}, element('th', {}, name), element('td', {}, value)))));
}

/** A number with as many decimals as steps of this size can tell apart. */
export function formatted(value, step) {
  if (Number.isNaN(value)) return 'none';
  const decimals = Math.max(0, Math.min(6, Math.round(-Math.log10(step))));
  return value.toFixed(decimals).replace('-', '−');
}
