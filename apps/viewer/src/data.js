// The data of the page, as packed_integers.cpp and shell_page.cpp wrote them.

async function inflated(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Packed integers as an Int32Array. */
async function unpacked({ count, stride, bytes, data }) {
  const plain = await inflated(data);
  const values = new Int32Array(count);
  for (let plane = 0; plane < bytes; ++plane) {
    const shift = 8 * plane;
    const start = plane * count;
    for (let i = 0; i < count; ++i) values[i] |= plain[start + i] << shift;
  }
  for (let i = 0; i < count; ++i) values[i] = (values[i] >>> 1) ^ -(values[i] & 1);
  if (stride > 0) for (let i = stride; i < count; ++i) values[i] += values[i - stride];
  return values;
}

async function unpackedPoints(packed, step) {
  const multiples = await unpacked(packed);
  const points = new Float32Array(multiples.length);
  for (let i = 0; i < points.length; ++i) points[i] = multiples[i] * step;
  return points;
}

/** Values of a map; NaN where an atom has none. */
async function unpackedValues(map) {
  const multiples = await unpacked(map.values);
  const values = new Float64Array(multiples.length);
  for (let i = 0; i < values.length; ++i) {
    const multiple = multiples[i];
    values[i] = multiple === 0 ? NaN : (multiple - (multiple > 0 ? 1 : 0)) * map.step;
  }
  return values;
}

async function unpackedBonds(packed) {
  const bonds = await unpacked(packed);
  for (let i = 0, before = 0; i < bonds.length; i += 2) {
    bonds[i] += before;
    bonds[i + 1] += bonds[i];
    before = bonds[i];
  }
  return bonds;
}

/** Where each ring starts in the list of their atoms, with the end as last entry. */
function startsOf(sizes) {
  const starts = new Int32Array(sizes.length + 1);
  for (let i = 0; i < sizes.length; ++i) starts[i + 1] = starts[i] + sizes[i];
  return starts;
}

/** Neighbors of every atom: atoms neighbors[starts[i]] to neighbors[starts[i + 1] - 1], and the
 *  numbers of the bonds to them. */
function neighborsOf(bonds, count) {
  const starts = new Int32Array(count + 1);
  for (const atom of bonds) ++starts[atom + 1];
  for (let i = 0; i < count; ++i) starts[i + 1] += starts[i];
  const next = starts.slice();
  const neighbors = new Int32Array(bonds.length);
  const neighborBonds = new Int32Array(bonds.length);
  for (let i = 0; i < bonds.length; ++i) {
    neighborBonds[next[bonds[i]]] = i >> 1;
    neighbors[next[bonds[i]]++] = bonds[i ^ 1];
  }
  return { starts, neighbors, neighborBonds };
}

function distance(points, a, b) {
  return Math.hypot(points[3 * a] - points[3 * b], points[3 * a + 1] - points[3 * b + 1],
    points[3 * a + 2] - points[3 * b + 2]);
}

function boundsOf(points) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; ++i) {
    if (points[i] < low[i % 3]) low[i % 3] = points[i];
    if (points[i] > high[i % 3]) high[i % 3] = points[i];
  }
  const center = low.map((value, axis) => 0.5 * (value + high[axis]));
  let square = 0;
  for (let i = 0; i < points.length; i += 3) {
    square = Math.max(square, (points[i] - center[0]) ** 2 + (points[i + 1] - center[1]) ** 2 + (points[i + 2] - center[2]) ** 2);
  }
  const ball = 0.8; // what an atom needs around its center
  return { center, radius: Math.sqrt(square) + ball };
}

/** One state of the shell with its arrays; lengths in Å. Behind the positions of its atoms are those
 *  of images across the faces of a periodic cell; bondPlaces and ringPlaces are places in that list,
 *  bonds and ringAtoms the atoms that stand there. */
async function loadState(packed) {
  const [positions, images, species, bondPlaces, ringSizes, ringPlaces, sample] = await Promise.all([
    unpackedPoints(packed.positions, packed.step), unpacked(packed.images), unpacked(packed.species),
    unpackedBonds(packed.bonds), unpacked(packed.rings.sizes), unpacked(packed.rings.atoms),
    packed.sample ? unpacked(packed.sample) : null]);
  const count = species.length;
  const bondLengths = new Float32Array(bondPlaces.length / 2);
  for (let i = 0; i < bondLengths.length; ++i) {
    bondLengths[i] = distance(positions, bondPlaces[2 * i], bondPlaces[2 * i + 1]);
  }
  const atomsAt = (places) => (images.length === 0 ? places
    : places.map((place) => (place < count ? place : images[place - count])));
  const bonds = atomsAt(bondPlaces);
  const maps = new Map();
  for (const map of packed.maps) maps.set(map.name, { ...map, values: await unpackedValues(map) });
  return {
    name: packed.name, total: packed.total_atoms, count, positions, species, bonds, bondPlaces, bondLengths,
    ringSizes, ringStarts: startsOf(ringSizes), ringAtoms: atomsAt(ringPlaces), ringPlaces, maps,
    ...neighborsOf(bonds, count), ...boundsOf(positions),
    id: (atom) => (sample ? sample[atom] : atom) + 1,
  };
}

/** Reads the page's data: texts at once, states when they are asked for. */
export function readData() {
  const node = document.getElementById('shell-data');
  const data = JSON.parse(node.textContent);
  node.remove(); // the text is as large as all the rest
  const loading = new Map();
  return {
    ...data,
    states: data.states.map(({ name, total_atoms: total }) => ({ name, total })),
    state(index) {
      if (!loading.has(index)) loading.set(index, loadState(data.states[index]));
      return loading.get(index);
    },
    async surface() {
      if (!data.surface) return null;
      const [points, triangles] = await Promise.all([
        unpackedPoints(data.surface.points, data.surface.step), unpacked(data.surface.triangles)]);
      return { points, triangles };
    },
    hasSurface: Boolean(data.surface),
  };
}
