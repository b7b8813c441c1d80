// Which atoms are selected: one range of one quantity at a time.

const inside = (value, low, high) => value >= low && (value < high || high === Infinity);

/** One byte per atom, for a range of the values of a map. */
export function selectByMap(state, name, low, high) {
  const map = state.maps.get(name);
  return Uint8Array.from({ length: state.count },
    (_, atom) => Number(Boolean(map) && inside(map.values[atom], low, high)));
}

/** Atoms of the bonds with lengths in a range. */
export function selectByBondLength(state, low, high) {
  const selected = new Uint8Array(state.count);
  state.bondLengths.forEach((length, bond) => {
    if (!inside(length, low, high)) return;
    selected[state.bonds[2 * bond]] = 1;
    selected[state.bonds[2 * bond + 1]] = 1;
  });
  return selected;
}

/** Atoms of the rings with sizes in a range. */
export function selectByRingSize(state, low, high) {
  const selected = new Uint8Array(state.count);
  state.ringSizes.forEach((size, ring) => {
    if (!inside(size, low, high)) return;
    for (let i = state.ringStarts[ring]; i < state.ringStarts[ring + 1]; ++i) selected[state.ringAtoms[i]] = 1;
  });
  return selected;
}

/** The carbon atoms of highest energy, highest first; the lower number first among equals. */
export function worstAtoms(state, howMany) {
  const energy = state.maps.get('energy');
  if (!energy) return [];
  const { values } = energy;
  const worst = [];
  for (let atom = 0; atom < state.count; ++atom) {
    if (state.species[atom] !== 6) continue;
    if (worst.length === howMany && !(values[atom] > values[worst[howMany - 1]])) continue;
    let place = worst.length;
    while (place > 0 && values[worst[place - 1]] < values[atom]) --place;
    worst.splice(place, 0, atom);
    if (worst.length > howMany) worst.pop();
  }
  return worst;
}
