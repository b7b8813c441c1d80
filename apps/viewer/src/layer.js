// One state of the shell as things to draw. All states are drawn equally large around the origin.
import * as three from 'three';
import { colorFunction } from './colors.js';
import * as shaders from './shaders.js';

function material(shader, uniforms, options = {}) {
  return new three.RawShaderMaterial({
    glslVersion: three.GLSL3, uniforms, ...shader, side: three.DoubleSide, ...options,
  });
}

function drawable(Kind, attributes, shaderMaterial) {
  const geometry = new three.BufferGeometry();
  for (const [name, [array, size, normalized]] of Object.entries(attributes)) {
    geometry.setAttribute(name, new three.BufferAttribute(array, size, normalized));
  }
  const object = new Kind(geometry, shaderMaterial);
  object.frustumCulled = false;
  return object;
}

/** A fixed shuffle: the first atoms of it are a fair sample, to be drawn while there is no time. */
function shuffled(count) {
  const order = Uint32Array.from({ length: count }, (_, i) => i);
  let random = 1;
  for (let i = count - 1; i > 0; --i) {
    random = (Math.imul(random, 1664525) + 1013904223) >>> 0; // Numerical Recipes' generator
    const j = random % (i + 1);
    [order[i], order[j]] = [order[j], order[i]];
  }
  return order;
}

/** Radii that fill the net whatever the lengths of its bonds: half an atom's mean bond, nearly. */
function radiiOf(state) {
  const sorted = state.bondLengths.slice().sort();
  const typical = sorted.length > 0 ? sorted[sorted.length >> 1] : 1.42;
  const sums = new Float32Array(state.count);
  const { bonds, bondLengths } = state;
  for (let i = 0; i < bondLengths.length; ++i) {
    sums[bonds[2 * i]] += bondLengths[i];
    sums[bonds[2 * i + 1]] += bondLengths[i];
  }
  return sums.map((sum, atom) => {
    const n = state.starts[atom + 1] - state.starts[atom];
    const mean = n > 0 ? sum / n : typical;
    const size = state.species[atom] === 1 ? 0.3 : 0.46;
    return size * Math.min(2.5 * typical, Math.max(0.4 * typical, mean));
  });
}

const hiddenAlpha = 128; // as the shaders know it

export class Layer {
  constructor(state, shownRadius) {
    this.state = state;
    this.scale = shownRadius / state.radius;
    this.scene = new three.Scene();
    this.uniforms = {
      background: { value: new three.Color() }, depthCue: { value: 0.4 },
      pixelsPerUnit: { value: 1 }, radiusFactor: { value: 1 }, depthPerUnit: { value: 1 },
      bondRadius: { value: 1 },
    };
    this.positions = new Float32Array(state.positions.length);
    for (let i = 0; i < this.positions.length; ++i) {
      this.positions[i] = (state.positions[i] - state.center[i % 3]) * this.scale;
    }
    this.radii = radiiOf(state).map((radius) => radius * this.scale);
    const sorted = state.bondLengths.slice().sort();
    this.bondLength = (sorted.length > 0 ? sorted[sorted.length >> 1] : 1.42) * this.scale;
    this.colors = new Uint8Array(4 * state.count);
    this.order = shuffled(state.count);
    this.#makeAtoms();
  }

  #makeAtoms() {
    const { count } = this.state;
    const positions = new Float32Array(3 * count);
    const radii = new Float32Array(count);
    for (let place = 0; place < count; ++place) {
      const atom = this.order[place];
      for (let axis = 0; axis < 3; ++axis) positions[3 * place + axis] = this.positions[3 * atom + axis];
      radii[place] = this.radii[atom];
    }
    this.atoms = drawable(three.Points, {
      position: [positions, 3], radius: [radii, 1], color: [new Uint8Array(4 * count), 4, true],
    }, material(shaders.atoms, this.uniforms));
    this.scene.add(this.atoms);
  }

  /** Bonds and rings are made when they are first shown: most large shells are never seen so near. */
  #makeBonds() {
    const { bondPlaces } = this.state;
    const n = bondPlaces.length / 2;
    const ends = new Float32Array(12 * n);
    const others = new Float32Array(12 * n);
    const corners = new Int8Array(8 * n);
    const indices = new Uint32Array(6 * n);
    for (let bond = 0; bond < n; ++bond) {
      const pair = [bondPlaces[2 * bond], bondPlaces[2 * bond + 1]];
      for (let corner = 0; corner < 4; ++corner) {
        const end = corner >> 1;
        for (let axis = 0; axis < 3; ++axis) {
          ends[12 * bond + 3 * corner + axis] = this.positions[3 * pair[end] + axis];
          others[12 * bond + 3 * corner + axis] = this.positions[3 * pair[1 - end] + axis];
        }
        corners[8 * bond + 2 * corner] = corner & 1 ? 1 : -1;
        corners[8 * bond + 2 * corner + 1] = end ? -1 : 1;
      }
      [0, 1, 2, 2, 1, 3].forEach((corner, i) => { indices[6 * bond + i] = 4 * bond + corner; });
    }
    this.bonds = drawable(three.Mesh, {
      position: [ends, 3], other: [others, 3], corner: [corners, 2],
      color: [new Uint8Array(16 * n), 4, true], otherColor: [new Uint8Array(16 * n), 4, true],
    }, material(shaders.bonds, this.uniforms));
    this.bonds.geometry.setIndex(new three.BufferAttribute(indices, 1));
    this.scene.add(this.bonds);
    this.#paintBonds();
  }

  #makeRings() {
    const { ringStarts, ringPlaces, ringSizes } = this.state;
    const positions = new Float32Array(9 * ringPlaces.length);
    let at = 0;
    for (let ring = 0; ring < ringSizes.length; ++ring) {
      const places = ringPlaces.subarray(ringStarts[ring], ringStarts[ring + 1]);
      const center = [0, 0, 0];
      for (const place of places) {
        for (let axis = 0; axis < 3; ++axis) center[axis] += this.positions[3 * place + axis] / places.length;
      }
      places.forEach((place, i) => {
        const next = places[(i + 1) % places.length];
        positions.set(center, at);
        positions.set(this.positions.subarray(3 * place, 3 * place + 3), at + 3);
        positions.set(this.positions.subarray(3 * next, 3 * next + 3), at + 6);
        at += 9;
      });
    }
    this.rings = drawable(three.Mesh, {
      position: [positions, 3], color: [new Uint8Array(12 * ringPlaces.length), 4, true],
    }, material(shaders.rings, this.uniforms, { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    this.scene.add(this.rings);
    this.#paintRings();
  }

  /** Colors all by a map, in front of what is not selected; selected is one byte per atom, or null.
   *  Atoms of the walls in a set are hidden. */
  paint(map, scale, selected, hiddenWalls) {
    this.map = map;
    this.mapScale = scale;
    this.selected = selected;
    const colorOf = colorFunction({ ...map, scale });
    const { values } = this.state.maps.get(map.name) ?? { values: null };
    const walls = hiddenWalls.size > 0 ? this.state.maps.get('wall')?.values : null;
    const cache = new Map();
    const steps = 1023;
    for (let atom = 0; atom < this.state.count; ++atom) {
      // The scale of energies is carbon's.
      const hasColor = values && !(map.name === 'energy' && this.state.species[atom] === 1);
      const value = hasColor ? values[atom] : NaN;
      let key = value;
      if (scale && !Number.isNaN(value)) {
        key = Math.round(Math.min(1, Math.max(0, (value - scale.low) / (scale.high - scale.low))) * steps);
      }
      let color = cache.get(key);
      if (!color) {
        color = colorOf(scale && !Number.isNaN(value) ? scale.low + (key / steps) * (scale.high - scale.low) : value);
        cache.set(key, color);
      }
      this.colors[4 * atom] = color[0];
      this.colors[4 * atom + 1] = color[1];
      this.colors[4 * atom + 2] = color[2];
      this.colors[4 * atom + 3] = walls && hiddenWalls.has(walls[atom]) ? hiddenAlpha
        : !selected || selected[atom] ? 255 : 0;
    }
    const { array } = this.atoms.geometry.attributes.color;
    const from = new Uint32Array(this.colors.buffer);
    const to = new Uint32Array(array.buffer);
    for (let place = 0; place < this.order.length; ++place) to[place] = from[this.order[place]];
    this.atoms.geometry.attributes.color.needsUpdate = true;
    if (this.bonds) this.#paintBonds();
    if (this.rings) this.#paintRings();
  }

  #paintBonds() {
    const from = new Uint32Array(this.colors.buffer);
    const { color, otherColor } = this.bonds.geometry.attributes;
    const here = new Uint32Array(color.array.buffer);
    const there = new Uint32Array(otherColor.array.buffer);
    const { bonds } = this.state;
    for (let i = 0; i < bonds.length / 2; ++i) {
      const a = from[bonds[2 * i]];
      const b = from[bonds[2 * i + 1]];
      here.fill(a, 4 * i, 4 * i + 2);
      here.fill(b, 4 * i + 2, 4 * i + 4);
      there.fill(b, 4 * i, 4 * i + 2);
      there.fill(a, 4 * i + 2, 4 * i + 4);
    }
    color.needsUpdate = true;
    otherColor.needsUpdate = true;
  }

  /** Rings show the mean of their atoms, or their own size where sizes are what is shown. */
  #paintRings() {
    const colorOf = colorFunction({ ...this.map, scale: this.mapScale });
    const map = this.state.maps.get(this.map.name);
    const { ringStarts, ringAtoms, ringSizes } = this.state;
    const { color } = this.rings.geometry.attributes;
    const to = new Uint32Array(color.array.buffer);
    const bytes = new Uint8ClampedArray(4);
    const word = new Uint32Array(bytes.buffer);
    for (let ring = 0; ring < ringSizes.length; ++ring) {
      const atoms = ringAtoms.subarray(ringStarts[ring], ringStarts[ring + 1]);
      let sum = 0;
      let kept = 0;
      let isHidden = false;
      for (const atom of atoms) {
        sum += map ? map.values[atom] : NaN;
        kept += this.colors[4 * atom + 3] > 0 ? 1 : 0;
        isHidden ||= this.colors[4 * atom + 3] === hiddenAlpha;
      }
      const mean = sum / atoms.length;
      const value = this.map.name === 'ring_size' ? ringSizes[ring]
        : this.map.categories ? Math.round(mean) : mean;
      bytes.set([...colorOf(value), isHidden ? hiddenAlpha : 2 * kept >= atoms.length ? 255 : 0]);
      to.fill(word[0], 3 * ringStarts[ring], 3 * ringStarts[ring + 1]);
    }
    color.needsUpdate = true;
  }

  /** Draws into the current viewport; fraction is the share of the atoms that there is time for. */
  draw(renderer, camera, look) {
    const { show, fraction, pixelsPerUnit } = look;
    const bondsAreVisible = show.bonds && this.bondLength * pixelsPerUnit > 5 && fraction === 1;
    if (bondsAreVisible && !this.bonds && this.state.bonds.length > 0) this.#makeBonds();
    if (show.rings && !this.rings && this.state.ringSizes.length > 0) this.#makeRings();
    this.atoms.visible = show.atoms;
    if (this.bonds) this.bonds.visible = bondsAreVisible;
    if (this.rings) this.rings.visible = show.rings;
    this.atoms.geometry.setDrawRange(0, Math.ceil(this.state.count * fraction));
    const near = this.bondLength * pixelsPerUnit > 12 && show.bonds;
    this.uniforms.radiusFactor.value = (show.rings || near ? 0.55 : 1.1) / Math.sqrt(fraction);
    this.uniforms.bondRadius.value = 0.09 * this.bondLength;
    this.uniforms.pixelsPerUnit.value = pixelsPerUnit * look.pixelRatio;
    this.uniforms.depthPerUnit.value = 1 / (camera.far - camera.near);
    this.uniforms.background.value.copy(look.background);
    this.scene.quaternion.copy(look.turn);
    renderer.render(this.scene, camera);
  }

  /** The atom in front at a place of the view, or -1; reach is in view units. */
  pick(x, y, turn, reach) {
    const matrix = new three.Matrix4().makeRotationFromQuaternion(turn).elements;
    let best = -1;
    let highest = -Infinity;
    const { positions } = this;
    for (let atom = 0, at = 0; atom < this.state.count; ++atom, at += 3) {
      if (this.colors[4 * atom + 3] === hiddenAlpha) continue;
      const [px, py, pz] = [positions[at], positions[at + 1], positions[at + 2]];
      const dx = matrix[0] * px + matrix[4] * py + matrix[8] * pz - x;
      const dy = matrix[1] * px + matrix[5] * py + matrix[9] * pz - y;
      const radius = Math.max(reach, this.radii[atom]);
      const square = radius * radius - dx * dx - dy * dy;
      if (square < 0) continue;
      const height = matrix[2] * px + matrix[6] * py + matrix[10] * pz + Math.sqrt(square);
      if (height > highest) { highest = height; best = atom; }
    }
    return best;
  }

  place(atom) {
    return new three.Vector3().fromArray(this.positions, 3 * atom);
  }
}

/** The input surface as a ghost, or a ring around the atom that is looked at. */
export function makeGhost({ points, triangles }, state, shownRadius, uniforms) {
  const scale = shownRadius / state.radius;
  const positions = points.map((coordinate, i) => (coordinate - state.center[i % 3]) * scale);
  const object = drawable(three.Mesh, { position: [positions, 3] },
    material(shaders.ghost, uniforms, { transparent: true, depthWrite: false }));
  object.geometry.setIndex(new three.BufferAttribute(new Uint32Array(triangles), 1));
  return object;
}

export function makeMarker(uniforms) {
  return drawable(three.Points, { position: [new Float32Array(3), 3] },
    material(shaders.marker, uniforms, { depthTest: false, transparent: true }));
}
