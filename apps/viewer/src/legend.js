// What the colors mean: on the page, and drawn into screenshots.
import { element, formatted } from './dom.js';

const titleOf = (map) => (map.unit ? `${map.title} [${map.unit}]` : map.title);

const gradientOf = (colors) => `linear-gradient(to right, ${colors.join(', ')})`;

/** Fills a node; changed(low, high) is called when someone types another range. */
export function showLegend(node, map, scale, changed) {
  const name = element('p', { className: 'name' }, titleOf(map));
  if (map.categories) {
    node.replaceChildren(name, element('div', { className: 'swatches' }, ...map.categories
      .map(({ label, color }) => element('span', {},
        element('span', { className: 'swatch', style: `background:${color}` }), label))));
    return;
  }
  const input = (value, label) => element('input', {
    type: 'number', step: 'any', value: Number(value.toPrecision(6)), 'aria-label': label,
  });
  const low = input(scale.low, 'lower end of the color scale');
  const high = input(scale.high, 'upper end of the color scale');
  const apply = () => {
    if (Number(high.value) > Number(low.value)) changed(Number(low.value), Number(high.value));
  };
  low.addEventListener('change', apply);
  high.addEventListener('change', apply);
  node.replaceChildren(name,
    element('div', { className: 'bar', style: `background:${gradientOf(scale.colors)}` }),
    element('div', { className: 'ends' }, low,
      element('span', {}, formatted(0.5 * (scale.low + scale.high), (scale.high - scale.low) / 1000)), high));
}

/** Draws the legend into the lower left corner of a picture. */
export function drawLegend(pen, map, scale, { width, height, color, back }) {
  const size = Math.max(13, Math.min(width, height) / 45);
  const bar = 18 * size;
  const left = size;
  const top = height - 4.6 * size;
  pen.fillStyle = back;
  pen.globalAlpha = 0.82;
  pen.fillRect(left - 0.5 * size, top - 1.4 * size, bar + size, 5.4 * size);
  pen.globalAlpha = 1;
  pen.fillStyle = color;
  pen.font = `600 ${size}px system-ui, "DejaVu Sans", sans-serif`;
  pen.fillText(titleOf(map), left, top);
  pen.font = `${size}px system-ui, "DejaVu Sans", sans-serif`;
  if (map.categories) {
    let x = left;
    let y = top + 1.9 * size;
    for (const category of map.categories) {
      const needed = pen.measureText(category.label).width + 2.4 * size;
      if (x + needed > left + bar) { x = left; y += 1.5 * size; }
      pen.fillStyle = category.color;
      pen.fillRect(x, y - size, size, size);
      pen.fillStyle = color;
      pen.fillText(category.label, x + 1.3 * size, y);
      x += needed;
    }
    return;
  }
  const gradient = pen.createLinearGradient(left, 0, left + bar, 0);
  scale.colors.forEach((stop, i) => gradient.addColorStop(i / (scale.colors.length - 1), stop));
  pen.fillStyle = gradient;
  pen.fillRect(left, top + 0.5 * size, bar, 1.2 * size);
  pen.fillStyle = color;
  const step = (scale.high - scale.low) / 1000;
  [scale.low, 0.5 * (scale.low + scale.high), scale.high].forEach((value, i) => {
    pen.textAlign = ['left', 'center', 'right'][i];
    pen.fillText(formatted(value, step), left + (bar * i) / 2, top + 3 * size);
  });
  pen.textAlign = 'left';
}
