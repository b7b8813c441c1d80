// A histogram on which a range can be selected with the mouse.
import { element, formatted } from './dom.js';

export class Histogram extends EventTarget {
  constructor(caption) {
    super();
    this.canvas = element('canvas', { role: 'img' });
    this.name = element('span', {}, caption);
    this.info = element('span');
    this.node = element('div', { className: 'histogram' },
      element('div', { className: 'caption' }, this.name, this.info), this.canvas);
    this.#listen();
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  /** Shows values between low and high, step apart where they are counts; range is what is selected. */
  set({ caption, values, low, high, step, bins, colorOf, labels }) {
    this.name.textContent = caption;
    Object.assign(this, { low, high, step, colorOf, labels, range: null });
    this.counts = new Array(bins).fill(0);
    let total = 0;
    for (const value of values) {
      if (Number.isNaN(value)) continue;
      ++total;
      ++this.counts[this.#binOf(value)];
    }
    this.total = total;
    this.canvas.setAttribute('aria-label', `Histogram: ${caption}`);
    this.#inform(-1);
    this.draw();
  }

  #binOf(value) {
    const bins = this.counts.length;
    return Math.min(bins - 1, Math.max(0, Math.floor(((value - this.low) / (this.high - this.low)) * bins)));
  }

  #edge(bin) { return this.low + ((this.high - this.low) * bin) / this.counts.length; }

  #text(bin) {
    return this.labels ? this.labels[bin]
      : `${formatted(this.#edge(bin), this.step)} to ${formatted(this.#edge(bin + 1), this.step)}`;
  }

  #inform(bin) {
    this.info.textContent = bin >= 0 ? `${this.#text(bin)}: ${this.counts[bin].toLocaleString('en')}` : '';
  }

  draw() {
    if (!this.counts) return;
    const { canvas } = this;
    const ratio = window.devicePixelRatio;
    const width = Math.max(1, canvas.clientWidth);
    const height = Math.max(1, canvas.clientHeight);
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const pen = canvas.getContext('2d');
    pen.scale(ratio, ratio);
    const style = getComputedStyle(canvas);
    const text = style.getPropertyValue('--quiet');
    const most = Math.max(1, ...this.counts);
    const bins = this.counts.length;
    const floor = height - 16;
    pen.font = '11.5px system-ui, "DejaVu Sans", sans-serif';
    this.counts.forEach((count, bin) => {
      const isKept = !this.range || (bin >= this.range[0] && bin <= this.range[1]);
      // The square root keeps the rare ones in sight, which are the ones that matter.
      const tall = count > 0 ? Math.max(2, Math.sqrt(count / most) * (floor - 4)) : 0;
      const left = (bin * width) / bins;
      const gap = this.labels ? 4 : 0.5;
      pen.globalAlpha = isKept ? 1 : 0.25;
      pen.fillStyle = this.colorOf ? `rgb(${this.colorOf(0.5 * (this.#edge(bin) + this.#edge(bin + 1))).map(Math.round)})` : text;
      pen.fillRect(left + gap / 2, floor - tall, width / bins - gap, tall);
      if (tall > 0) {
        pen.strokeStyle = style.getPropertyValue('--quiet');
        pen.lineWidth = 0.5;
        pen.strokeRect(left + gap / 2, floor - tall, width / bins - gap, tall);
      }
    });
    pen.globalAlpha = 1;
    pen.fillStyle = style.getPropertyValue('--line');
    pen.fillRect(0, floor, width, 1);
    pen.fillStyle = text;
    this.#drawLabels(pen, width, height);
  }

  #drawLabels(pen, width, height) {
    if (this.labels) {
      pen.textAlign = 'center';
      this.labels.forEach((label, bin) => pen.fillText(label, ((bin + 0.5) * width) / this.labels.length, height - 3));
      return;
    }
    pen.textAlign = 'left';
    pen.fillText(formatted(this.low, this.step), 0, height - 3);
    pen.textAlign = 'right';
    pen.fillText(formatted(this.high, this.step), width, height - 3);
  }

  #listen() {
    let start = -1;
    const binAt = (event) => {
      const box = this.canvas.getBoundingClientRect();
      const bins = this.counts.length;
      return Math.min(bins - 1, Math.max(0, Math.floor(((event.clientX - box.left) / box.width) * bins)));
    };
    this.canvas.addEventListener('pointerdown', (event) => {
      if (!this.counts) return;
      start = binAt(event);
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (!this.counts) return;
      const bin = binAt(event);
      this.#inform(bin);
      if (start < 0) return;
      this.range = [Math.min(start, bin), Math.max(start, bin)];
      this.draw();
    });
    this.canvas.addEventListener('pointerup', (event) => {
      if (start < 0) return;
      const bin = binAt(event);
      this.range = [Math.min(start, bin), Math.max(start, bin)];
      start = -1;
      this.draw();
      const [first, last] = this.range;
      // The outer bins also hold what lies beyond them.
      this.dispatchEvent(new CustomEvent('select', { detail: {
        low: first === 0 ? -Infinity : this.#edge(first),
        high: last === this.counts.length - 1 ? Infinity : this.#edge(last + 1),
      } }));
    });
    this.canvas.addEventListener('pointerleave', () => this.#inform(-1));
  }

  clear() {
    this.range = null;
    this.draw();
  }
}
