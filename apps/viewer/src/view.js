// The canvas: camera, drawing on demand, and what the mouse, fingers and keys do to it.
import * as three from 'three';
import { Layer, makeGhost, makeMarker } from './layer.js';

const shownRadius = 100; // of every state, in view units
const firstTurn = new three.Quaternion().setFromEuler(new three.Euler(0.3, -0.5, 0));

export class View extends EventTarget {
  show = { atoms: true, bonds: true, rings: false, surface: false };
  right = null; // the layer that fills the view
  left = null; // and another one left of the divider
  divider = 0; // as a fraction of the width
  marked = -1;
  turn = firstTurn.clone();
  zoom = 1;
  pan = new three.Vector2();
  fraction = 1;
  inset = 0; // pixels at the lower edge that are covered by something else

  constructor(canvas) {
    super();
    this.canvas = canvas;
    this.renderer = new three.WebGLRenderer({ canvas, antialias: false, powerPreference: 'high-performance' });
    this.renderer.autoClear = false;
    this.camera = new three.OrthographicCamera(-1, 1, 1, -1, -1.2 * shownRadius, 1.2 * shownRadius);
    this.background = new three.Color();
    this.ghostUniforms = { ghostColor: { value: new three.Color() } };
    this.markerUniforms = {
      markerColor: { value: new three.Color() }, background: { value: this.background }, markerSize: { value: 20 },
    };
    this.marker = makeMarker(this.markerUniforms);
    this.over = new three.Scene();
    this.over.add(this.marker);
    this.under = new three.Scene();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.#listen();
    this.resize();
  }

  makeLayer(state) { return new Layer(state, shownRadius); }

  setGhost(surface, state) {
    this.ghost = makeGhost(surface, state, shownRadius, this.ghostUniforms);
    this.under.add(this.ghost);
  }

  setTheme({ background, marker, ghost }) {
    this.background.set(background);
    // Shaders write what the screen gets: no conversion to and from linear light.
    this.background.convertLinearToSRGB();
    this.markerUniforms.markerColor.value.set(marker).convertLinearToSRGB();
    this.ghostUniforms.ghostColor.value.set(ghost).convertLinearToSRGB();
    this.redraw();
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.width = Math.max(1, clientWidth);
    this.height = Math.max(1, clientHeight);
    this.sharpness = 0;
    this.#setSharpness(1);
    this.move(); // sharp as soon as it rests
  }

  /** Samples along a pixel's side, which is what smooths the edges of round things. */
  #setSharpness(samples) {
    const sharpness = Math.max(samples, Math.min(2, window.devicePixelRatio));
    if (sharpness === this.sharpness) return;
    this.sharpness = sharpness;
    this.renderer.setPixelRatio(sharpness);
    this.renderer.setSize(this.width, this.height, false);
  }

  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  /** Something moves: if frames take long, fewer atoms are drawn until it rests. */
  move() {
    const now = performance.now();
    // As much as there was time for the last time; at first, what any computer can draw.
    if (!this.lastMove) this.fraction = this.lastFraction ?? Math.min(1, 2 * this.least);
    if (this.fraction < 1) this.#setSharpness(1);
    if (this.lastMove && now - this.lastMove < 1000) {
      const frame = now - this.lastMove;
      if (frame > 90) this.fraction = Math.max(this.least, this.fraction * 0.6);
      else if (frame < 30) this.fraction = Math.min(1, this.fraction * 1.15);
    }
    this.lastMove = now;
    this.redraw();
    clearTimeout(this.resting);
    this.resting = setTimeout(() => {
      this.lastMove = 0;
      this.lastFraction = this.fraction;
      this.fraction = 1;
      this.#setSharpness(2);
      this.redraw();
    }, 250);
  }

  /** Small shells are always drawn whole, and of no shell less than can be recognized. */
  get least() { return Math.min(1, 20000 / Math.max(1, this.right?.state.count ?? 1)); }

  /** The middle of what nothing covers. */
  get middle() { return 0.5 * (this.height - this.inset); }

  get pixelsPerUnit() { return (Math.min(this.width, this.height - this.inset) / (2.08 * shownRadius)) * this.zoom; }

  draw() {
    const { renderer, camera } = this;
    const halfWidth = this.width / (2 * this.pixelsPerUnit);
    camera.left = this.pan.x - halfWidth;
    camera.right = this.pan.x + halfWidth;
    camera.top = this.pan.y + this.middle / this.pixelsPerUnit;
    camera.bottom = camera.top - this.height / this.pixelsPerUnit;
    camera.updateProjectionMatrix();
    renderer.setClearColor(new three.Color().copy(this.background).convertSRGBToLinear());
    renderer.setScissorTest(false);
    renderer.clear();
    if (!this.right) return;
    const look = {
      show: this.show, fraction: this.fraction, pixelsPerUnit: this.pixelsPerUnit, turn: this.turn,
      background: this.background, pixelRatio: renderer.getPixelRatio(),
    };
    const at = this.left ? Math.round(this.divider * this.width) : 0;
    renderer.setScissorTest(true);
    if (at > 0) {
      renderer.setScissor(0, 0, at, this.height);
      this.left.draw(renderer, camera, look);
    }
    renderer.setScissor(at, 0, this.width - at, this.height);
    this.right.draw(renderer, camera, look);
    renderer.setScissorTest(false);
    if (this.ghost && this.show.surface) {
      this.under.quaternion.copy(this.turn);
      renderer.render(this.under, camera);
    }
    if (this.marked >= 0) this.#drawMarker();
    this.dispatchEvent(new Event('drawn'));
  }

  #drawMarker() {
    this.marker.geometry.attributes.position.array.set(this.right.place(this.marked).toArray());
    this.marker.geometry.attributes.position.needsUpdate = true;
    const ratio = this.renderer.getPixelRatio();
    const radius = this.right.radii[this.marked] * this.pixelsPerUnit;
    this.markerUniforms.markerSize.value = ratio * Math.max(26, Math.min(240, 2.2 * radius + 12));
    this.over.quaternion.copy(this.turn);
    this.renderer.render(this.over, this.camera);
  }

  rotate(dx, dy, dz = 0) {
    const step = new three.Quaternion().setFromEuler(new three.Euler(dy, dx, dz));
    this.turn.premultiply(step).normalize();
    this.move();
  }

  /** Zooms by a factor around a place of the canvas in pixels (its middle without one). */
  zoomBy(factor, x = this.width / 2, y = this.middle) {
    const before = this.toView(x, y);
    const nearest = 0.25 * (this.right ? this.height / (this.right.bondLength * 2) : 100);
    this.zoom = Math.min(Math.max(nearest, 4), Math.max(0.2, this.zoom * factor));
    this.pan.add(before.sub(this.toView(x, y)));
    this.move();
  }

  reset() {
    this.turn.copy(firstTurn);
    this.zoom = 1;
    this.pan.set(0, 0);
    this.redraw();
  }

  toView(x, y) {
    return new three.Vector2(this.pan.x + (x - this.width / 2) / this.pixelsPerUnit,
      this.pan.y - (y - this.middle) / this.pixelsPerUnit);
  }

  atomAt(x, y) {
    if (!this.right) return -1;
    const isLeft = this.left && x < this.divider * this.width;
    if (isLeft) return -1;
    const place = this.toView(x, y);
    return this.right.pick(place.x, place.y, this.turn, 3 / this.pixelsPerUnit);
  }

  /** Turns an atom of the right layer to the front and goes near it. */
  flyTo(atom) {
    const place = this.right.place(atom);
    const outward = place.lengthSq() > 1 ? place.clone().normalize() : new three.Vector3(0, 0, 1);
    const upright = new three.Quaternion().setFromUnitVectors(
      outward.clone().applyQuaternion(this.turn), new three.Vector3(0, 0, 1)).multiply(this.turn);
    const zoom = Math.max(this.zoom, Math.min(this.height, this.width) / (24 * this.right.bondLength)
      / (this.pixelsPerUnit / this.zoom));
    const from = { turn: this.turn.clone(), zoom: this.zoom, pan: this.pan.clone() };
    const goal = place.clone().applyQuaternion(upright);
    const begin = performance.now();
    const time = matchMedia('(prefers-reduced-motion: reduce)').matches ? 0 : 450;
    const step = () => {
      const t = time > 0 ? Math.min(1, (performance.now() - begin) / time) : 1;
      const eased = t * t * (3 - 2 * t);
      this.turn.slerpQuaternions(from.turn, upright, eased);
      this.zoom = from.zoom * (zoom / from.zoom) ** eased;
      this.pan.set(from.pan.x + (goal.x - from.pan.x) * eased, from.pan.y + (goal.y - from.pan.y) * eased);
      this.move();
      if (t < 1) requestAnimationFrame(step);
    };
    step();
  }

  #listen() {
    const { canvas } = this;
    const pointers = new Map();
    let travelled = 0;
    canvas.addEventListener('pointerdown', (event) => {
      pointers.set(event.pointerId, event);
      canvas.setPointerCapture(event.pointerId);
      travelled = 0;
    });
    canvas.addEventListener('pointermove', (event) => {
      const before = pointers.get(event.pointerId);
      if (!before) {
        this.dispatchEvent(new CustomEvent('hover', { detail: event }));
        return;
      }
      pointers.set(event.pointerId, event);
      const dx = event.clientX - before.clientX;
      const dy = event.clientY - before.clientY;
      travelled += Math.abs(dx) + Math.abs(dy);
      if (pointers.size === 2) this.#pinch([...pointers.values()], event, before);
      else if (before.shiftKey || before.buttons > 1) this.#panBy(dx, dy);
      else this.rotate(dx * 0.007, dy * 0.007);
    });
    const release = (event) => {
      const wasClick = pointers.delete(event.pointerId) && travelled < 4 && event.type === 'pointerup';
      if (wasClick) this.dispatchEvent(new CustomEvent('pick', { detail: event }));
    };
    canvas.addEventListener('pointerup', release);
    canvas.addEventListener('pointercancel', release);
    canvas.addEventListener('pointerleave', () => this.dispatchEvent(new CustomEvent('hover', { detail: null })));
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoomBy(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.04 : 0.0014)), event.offsetX, event.offsetY);
    }, { passive: false });
  }

  #panBy(dx, dy) {
    this.pan.x -= dx / this.pixelsPerUnit;
    this.pan.y += dy / this.pixelsPerUnit;
    this.move();
  }

  #pinch([a, b], event, before) {
    const other = a.pointerId === event.pointerId ? b : a;
    const size = (one) => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
    this.#panBy((event.clientX - before.clientX) / 2, (event.clientY - before.clientY) / 2);
    if (size(before) > 0) {
      const box = this.canvas.getBoundingClientRect();
      this.zoomBy(size(event) / size(before), (event.clientX + other.clientX) / 2 - box.left,
        (event.clientY + other.clientY) / 2 - box.top);
    }
  }
}
