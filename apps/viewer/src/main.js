// The page: what is shown, in one place, and the panel that changes it.
import { colorFunction } from './colors.js';
import { readData } from './data.js';
import { byId, element, formatted, labelled, table } from './dom.js';
import { Histogram } from './histogram.js';
import { drawLegend, showLegend } from './legend.js';
import { selectByBondLength, selectByMap, selectByRingSize, worstAtoms } from './selection.js';
import { View } from './view.js';

const keys = [
  ['arrow keys', 'turn'], [', and .', 'roll'], ['+ and −', 'zoom'], ['0', 'first view'],
  ['c', 'next coloring'], ['a, b, r, s', 'atoms, bonds, rings, surface on or off'],
  ['[ and ]', 'move the divider between two states'], ['w', 'next one of the worst atoms'],
  ['p', 'save a picture'], ['t', 'light or dark'], ['Escape', 'clear the selection'], ['?', 'this list'],
];
const count = (number) => number.toLocaleString('en');

class Page {
  constructor(data) {
    this.data = data;
    this.layers = new Map();
    this.selected = null;
    this.hiddenWalls = new Set();
    this.scales = new Map(); // what the reader made of a map's scale
    this.atom = -1;
  }

  async start() {
    const last = this.data.states.length - 1;
    document.title = `${this.data.title} · Trivalent`;
    byId('title').textContent = this.data.title;
    this.view = new View(byId('canvas'));
    this.#applyTheme(matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');
    await this.showState('right', last);
    this.#buildPanel();
    this.#buildCompare();
    this.#listen();
    this.refresh();
    this.view.draw();
    document.documentElement.dataset.ready = 'true';
  }

  get state() { return this.view.right.state; }

  get map() { return this.state.maps.get(this.mapName) ?? this.state.maps.values().next().value; }

  get scale() { return this.map.categories ? null : this.scales.get(this.map.name) ?? this.map.scale; }

  async layer(index) {
    if (!this.layers.has(index)) this.layers.set(index, this.view.makeLayer(await this.data.state(index)));
    return this.layers.get(index);
  }

  async showState(side, index) {
    this.view[side] = await this.layer(index);
    if (side === 'right') {
      this.rightIndex = index;
      this.mapName ??= this.map.name;
    } else {
      this.leftIndex = index;
    }
  }

  /** Colors, legend, histograms and lists anew, after another state, map or scale was chosen. */
  refresh() {
    const { state } = this;
    byId('subtitle').textContent = [state.name, `${count(state.total)} atoms`,
      ...(state.total > state.count ? [`a sample of ${count(state.count)} is shown`] : [])].join(' · ');
    this.clearSelection();
    this.#showLegend();
    this.#fillMapHistogram();
    this.#fillNetHistograms();
    this.#fillWorst();
    this.showAtom(-1);
  }

  #showLegend() {
    showLegend(byId('legend'), this.map, this.scale, (low, high) => {
      this.scales.set(this.map.name, { ...this.scale, low, high });
      this.paint();
      this.#fillMapHistogram();
      this.#showLegend();
    });
  }

  paint() {
    this.view.right.paint(this.map, this.scale, this.selected, this.hiddenWalls);
    if (this.view.left && this.view.left !== this.view.right) {
      this.view.left.paint(this.map, this.scale, null, this.hiddenWalls);
    }
    this.view.redraw();
  }

  select(selected, what) {
    this.selected = selected;
    const number = selected.reduce((sum, one) => sum + one, 0);
    this.selectionText.textContent = number > 0
      ? `${count(number)} atoms selected: ${what}` : `No atoms selected: ${what} holds none.`;
    this.paint();
  }

  clearSelection() {
    this.selected = null;
    this.selectionText.textContent = 'All atoms. Drag over a histogram to select.';
    for (const histogram of this.histograms) histogram.clear();
    this.paint();
  }

  #buildPanel() {
    this.colorSelect = element('select', { id: 'coloring' });
    for (const map of this.state.maps.values()) {
      this.colorSelect.append(element('option', { value: map.name }, map.title));
    }
    this.colorSelect.addEventListener('change', () => this.chooseMap(this.colorSelect.value));
    this.toggles = new Map(['atoms', 'bonds', 'rings', 'surface'].map((what) => {
      const box = element('input', { type: 'checkbox', id: `show-${what}`, checked: this.view.show[what] });
      box.addEventListener('change', () => this.setShown(what, box.checked));
      return [what, box];
    }));
    const hidden = this.data.hasSurface ? [] : ['surface'];
    const walls = (this.state.maps.get('wall')?.categories ?? []).map(({ value, label }) => {
      const box = element('input', { type: 'checkbox', id: `show-wall-${value}`, checked: true });
      box.addEventListener('change', () => this.setWallShown(value, box.checked));
      return labelled(label, box);
    });
    const button = (text, id, action) => {
      const node = element('button', { type: 'button', id }, text);
      node.addEventListener('click', action);
      return node;
    };
    this.selectionText = element('p', { id: 'selection', role: 'status', className: 'quiet' });
    this.histograms = ['', 'bond lengths [Å]', 'rings by size'].map((caption) => new Histogram(caption));
    this.details = element('section', { id: 'atom' });
    this.worst = element('section', { id: 'worst' });
    const { notes, parameters, results, program } = this.data;
    byId('panel').replaceChildren(
      element('section', {},
        element('div', { className: 'row' }, element('label', { htmlFor: 'coloring' }, 'Color by'), this.colorSelect),
        element('div', { className: 'row' }, ...[...this.toggles].filter(([what]) => !hidden.includes(what))
          .map(([what, box]) => labelled(what, box))),
        ...(walls.length > 0 ? [element('div', { className: 'row', id: 'walls' }, 'walls', ...walls)] : []),
        element('div', { className: 'row' }, button('First view', 'reset', () => this.view.reset()),
          button('Save picture', 'screenshot', () => this.savePicture()),
          button('Light / dark', 'theme', () => this.toggleTheme()),
          button('Keys', 'keys', () => byId('help').showModal()))),
      ...(notes.length > 0 ? [element('section', { id: 'notes' }, element('h2', {}, 'Notes'),
        ...notes.map((note) => element('p', { className: 'note' }, note)))] : []),
      element('section', {}, element('h2', {}, 'Distributions'), this.selectionText,
        button('Clear selection', 'clear', () => this.clearSelection()),
        ...this.histograms.map(({ node }) => node)),
      this.details, this.worst,
      ...(results.length > 0 ? [this.#facts('Results', results, true)] : []),
      ...(parameters.length > 0 ? [this.#facts('Parameters', parameters, false)] : []),
      element('p', { className: 'quiet' }, program, ' · ', button('Software in this page', 'licenses', () => byId('about').showModal())));
    byId('help').replaceChildren(element('h2', {}, 'Keys'), element('table', {}, ...keys.map(([key, meaning]) => element('tr', {},
      element('td', {}, element('kbd', {}, key)), element('td', {}, meaning)))),
    element('p', {}, 'Drag turns, shift-drag or right-drag moves, the wheel zooms, a click picks an atom.'),
    element('form', { method: 'dialog' }, element('button', {}, 'Close')));
    this.histograms[0].addEventListener('select', ({ detail }) => this.#selectRange(0, detail,
      selectByMap(this.state, this.map.name, detail.low, detail.high), this.map.title));
    this.histograms[1].addEventListener('select', ({ detail }) => this.#selectRange(1, detail,
      selectByBondLength(this.state, detail.low, detail.high), 'bond length'));
    this.histograms[2].addEventListener('select', ({ detail }) => this.#selectRange(2, detail,
      selectByRingSize(this.state, detail.low, detail.high), 'ring size'));
  }

  #facts(title, rows, isOpen) {
    return element('details', { open: isOpen }, element('summary', {}, title), table(rows));
  }

  #selectRange(which, { low, high }, selected, what) {
    this.histograms.forEach((histogram, i) => { if (i !== which) histogram.clear(); });
    const { step } = this.histograms[which];
    const from = low === -Infinity ? '' : ` from ${formatted(low, step)}`;
    const to = high === Infinity ? '' : ` to ${formatted(high, step)}`;
    this.select(selected, `${what}${from}${to}`);
  }

  #fillMapHistogram() {
    const { map, scale } = this;
    const caption = map.unit ? `${map.title} [${map.unit}]` : map.title;
    if (map.categories) {
      const values = map.categories.map(({ value }) => value);
      const low = Math.min(...values) - 0.5;
      const high = Math.max(...values) + 0.5;
      const bins = Math.round(high - low);
      this.histograms[0].set({
        caption, values: map.values, low, high, bins, step: 1, colorOf: (value) => colorFunction(map)(Math.round(value)),
        labels: Array.from({ length: bins }, (_, i) => String(Math.round(low + 0.5 + i))),
      });
      return;
    }
    let least = scale.high;
    for (const value of map.values) if (value < least) least = value;
    this.histograms[0].set({
      caption, values: map.values, low: Math.max(scale.low, least), high: scale.high, bins: 60,
      step: (scale.high - scale.low) / 1000, colorOf: colorFunction({ ...map, scale }),
    });
  }

  #fillNetHistograms() {
    const lengths = this.state.bondLengths;
    const sorted = lengths.slice().sort();
    const at = (fraction) => sorted[Math.floor(fraction * (sorted.length - 1))] ?? 1.42;
    const [low, high] = [at(0.002) - 0.005, at(0.998) + 0.005];
    this.histograms[1].set({ caption: 'bond lengths [Å]', values: lengths, low, high, bins: 60, step: 0.001 });
    const sizes = this.state.ringSizes;
    let [least, most] = [5, 7];
    for (const size of sizes) { least = Math.min(least, size); most = Math.max(most, size); }
    most = Math.min(most, 12);
    const bins = most - least + 1;
    const ringMap = this.state.maps.get('ring_size');
    this.histograms[2].set({
      caption: 'rings by size', values: sizes, low: least - 0.5, high: most + 0.5, bins, step: 1,
      colorOf: ringMap ? (value) => colorFunction(ringMap)(Math.round(value)) : null,
      labels: Array.from({ length: bins }, (_, i) => String(least + i)),
    });
  }

  #fillWorst() {
    const worst = worstAtoms(this.state, 10);
    this.worst.hidden = worst.length === 0;
    if (worst.length === 0) return;
    const energy = this.state.maps.get('energy');
    const ring = this.state.maps.get('ring_size');
    this.worst.replaceChildren(element('h2', {}, 'Carbon atoms of highest energy'), element('table', { className: 'atoms' },
      element('tr', {}, ...['atom', `energy [${energy.unit}]`, 'ring'].map((text) => element('th', {}, text))),
      ...worst.map((atom) => {
        const node = element('button', { type: 'button', title: 'go there' }, String(this.state.id(atom)));
        node.addEventListener('click', () => this.goTo(atom));
        const row = element('tr', {}, element('td', {}, node), element('td', {}, formatted(energy.values[atom], energy.step)),
          element('td', {}, ring ? String(ring.values[atom]) : ''));
        row.dataset.atom = atom;
        return row;
      })));
    this.worstList = worst;
  }

  goTo(atom) {
    this.showAtom(atom);
    this.view.flyTo(atom);
  }

  showAtom(atom) {
    this.atom = atom;
    this.view.marked = atom;
    this.view.redraw();
    for (const row of this.worst.querySelectorAll('tr[data-atom]')) {
      row.setAttribute('aria-current', String(Number(row.dataset.atom) === atom));
    }
    if (atom < 0) {
      this.details.replaceChildren(element('h2', {}, 'Atom'),
        element('p', { className: 'quiet' }, 'Click an atom to see its values.'));
      return;
    }
    const { state } = this;
    const [first, end] = [state.starts[atom], state.starts[atom + 1]];
    const neighbors = [...state.neighbors.subarray(first, end)];
    this.details.replaceChildren(element('h2', {}, `Atom ${state.id(atom)}`), table([
      ['element', state.species[atom] === 1 ? 'H' : 'C'],
      ...[...state.maps.values()].map((map) => [map.title, this.#valueText(map, atom)]),
      ['position [Å]', [0, 1, 2].map((axis) => formatted(state.positions[3 * atom + axis], 0.001)).join(', ')]]),
    element('div', { className: 'row' }, 'neighbors ', ...neighbors.map((other, i) => {
      const length = state.bondLengths[state.neighborBonds[first + i]];
      const node = element('button', { type: 'button' }, `${state.id(other)} (${length.toFixed(3)} Å)`);
      node.addEventListener('click', () => this.goTo(other));
      return node;
    })));
  }

  #valueText(map, atom) {
    const value = map.values[atom];
    if (map.categories) return Number.isNaN(value) || value === 0 ? 'none' : String(value);
    return map.unit ? `${formatted(value, map.step)} ${map.unit}` : formatted(value, map.step);
  }

  #buildCompare() {
    const { states } = this.data;
    if (states.length < 2) return;
    const chooser = (side, chosen) => {
      const node = element('select', { id: `${side}-state`, 'aria-label': `state on the ${side}` });
      states.forEach(({ name }, i) => node.append(element('option', { value: i, selected: i === chosen }, name)));
      node.addEventListener('change', async () => {
        await this.showState(side, Number(node.value));
        this.refresh();
      });
      return node;
    };
    this.slider = element('input', { type: 'range', id: 'divider-place', min: 0, max: 1000, value: 0,
      'aria-label': 'divider between the two states' });
    this.slider.addEventListener('input', () => this.setDivider(this.slider.value / 1000));
    byId('compare').replaceChildren(
      element('div', { className: 'states' }, chooser('left', 0), chooser('right', states.length - 1)), this.slider);
  }

  async setDivider(fraction) {
    if (this.data.states.length < 2) return;
    this.view.divider = Math.min(1, Math.max(0, fraction));
    this.slider.value = 1000 * this.view.divider;
    if (this.view.divider > 0 && !this.view.left) {
      await this.showState('left', Number(byId('left-state').value));
      this.paint();
    }
    const line = byId('divider');
    line.style.display = this.view.divider > 0 && this.view.divider < 1 ? 'block' : 'none';
    line.style.left = `${100 * this.view.divider}%`;
    this.view.move();
  }

  chooseMap(name) {
    this.mapName = name;
    this.colorSelect.value = name;
    this.refresh();
  }

  async setShown(what, isShown) {
    if (what === 'surface' && !this.data.hasSurface) return;
    this.view.show[what] = isShown;
    this.toggles.get(what).checked = isShown;
    if (what === 'surface' && isShown && !this.view.ghost) {
      this.view.setGhost(await this.data.surface(), this.state);
    }
    this.view.redraw();
  }

  setWallShown(wall, isShown) {
    if (isShown) this.hiddenWalls.delete(wall);
    else this.hiddenWalls.add(wall);
    this.paint();
  }

  toggleTheme() {
    this.#applyTheme(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark');
    for (const histogram of this.histograms) histogram.draw();
  }

  #applyTheme(theme) {
    document.documentElement.dataset.theme = theme;
    const dark = theme === 'dark';
    this.view.setTheme({ background: dark ? '#14171c' : '#ffffff', marker: dark ? '#ffffff' : '#000000', ghost: dark ? '#9fb4d0' : '#3b5675' });
  }

  savePicture() {
    this.view.draw(); // the canvas can be read only until the next frame
    const source = byId('canvas');
    const picture = element('canvas', { width: source.width, height: source.height });
    const pen = picture.getContext('2d');
    pen.drawImage(source, 0, 0);
    const style = getComputedStyle(document.documentElement);
    drawLegend(pen, this.map, this.scale, { width: picture.width, height: picture.height,
      color: style.getPropertyValue('--text'), back: style.getPropertyValue('--back') });
    picture.toBlob((blob) => {
      const link = element('a', { href: URL.createObjectURL(blob), download: 'shell.png' });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    });
  }

  #listen() {
    this.view.addEventListener('pick', ({ detail }) => this.showAtom(this.view.atomAt(detail.offsetX, detail.offsetY)));
    this.view.addEventListener('hover', ({ detail }) => this.#hover(detail));
    addEventListener('keydown', (event) => this.#key(event));
    const covers = new ResizeObserver(() => this.#makeRoom());
    for (const id of ['stage', 'legend', 'compare']) covers.observe(byId(id));
  }

  /** On a narrow screen legend and slider lie below the shell, one above the other. */
  #makeRoom() {
    const isNarrow = matchMedia('(max-width: 860px)').matches;
    const [legend, compare] = [byId('legend'), byId('compare')];
    compare.style.bottom = isNarrow ? `${legend.offsetHeight + 20}px` : '';
    this.view.inset = isNarrow ? legend.offsetHeight + compare.offsetHeight + 24 : 0;
    this.view.redraw();
  }

  #hover(event) {
    const box = byId('hover');
    clearTimeout(this.hovering);
    box.style.display = 'none';
    if (!event) return;
    const { offsetX, offsetY } = event;
    this.hovering = setTimeout(() => {
      const atom = this.view.atomAt(offsetX, offsetY);
      if (atom < 0) return;
      box.textContent = `atom ${this.state.id(atom)}\n${this.map.title}: ${this.#valueText(this.map, atom)}`;
      box.style.display = 'block';
      box.style.left = `${Math.min(offsetX + 14, this.view.width - box.offsetWidth - 4)}px`;
      box.style.top = `${Math.min(offsetY + 14, this.view.height - box.offsetHeight - 4)}px`;
    }, 40);
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector('dialog[open]')) return;
    if (/^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName) && event.key !== 'Escape') return;
    const turn = 0.12;
    const flip = (what) => this.setShown(what, !this.view.show[what]);
    const actions = {
      ArrowLeft: () => this.view.rotate(-turn, 0), ArrowRight: () => this.view.rotate(turn, 0),
      ArrowUp: () => this.view.rotate(0, -turn), ArrowDown: () => this.view.rotate(0, turn),
      ',': () => this.view.rotate(0, 0, turn), '.': () => this.view.rotate(0, 0, -turn),
      '+': () => this.view.zoomBy(1.25), '=': () => this.view.zoomBy(1.25), '-': () => this.view.zoomBy(0.8),
      0: () => this.view.reset(), a: () => flip('atoms'), b: () => flip('bonds'), r: () => flip('rings'),
      s: () => flip('surface'), p: () => this.savePicture(), t: () => this.toggleTheme(),
      '[': () => this.setDivider(this.view.divider - 0.05), ']': () => this.setDivider(this.view.divider + 0.05),
      c: () => this.#nextMap(), w: () => this.#nextWorst(), Escape: () => { this.clearSelection(); this.showAtom(-1); },
      '?': () => byId('help').showModal(),
    };
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  #nextMap() {
    const names = [...this.state.maps.keys()];
    this.chooseMap(names[(names.indexOf(this.map.name) + 1) % names.length]);
  }

  #nextWorst() {
    if (!this.worstList?.length) return;
    this.goTo(this.worstList[(this.worstList.indexOf(this.atom) + 1) % this.worstList.length]);
  }
}

async function open() {
  try {
    const page = new Page(readData());
    window.trivalent = page; // for the curious, and for tests
    await page.start();
  } catch (error) {
    byId('message').textContent = `The shell cannot be shown: ${error.message}. The page needs a browser with `
      + 'WebGL 2 (Chrome 90, Firefox 113, Safari 16.4 or later).';
    throw error;
  }
}
open();
