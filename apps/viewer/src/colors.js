// Colors of values, as the data define them.

const noValue = [150, 150, 150];

const channels = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

/** A function from a value to [red, green, blue], 0 to 255. */
export function colorFunction(map) {
  if (map.categories) {
    const categories = map.categories.map(({ value, color }) => ({ value, color: channels(color) }));
    return (value) => {
      if (Number.isNaN(value)) return noValue;
      let best = null;
      for (const category of categories) {
        // 0 means "none" and is nobody's neighbor.
        if ((category.value === 0) !== (value === 0)) continue;
        const closer = best === null || Math.abs(category.value - value) < Math.abs(best.value - value);
        if (closer) best = category;
      }
      return best ? best.color : noValue;
    };
  }
  const { low, high } = map.scale;
  const stops = map.scale.colors.map(channels);
  const last = stops.length - 1;
  return (value) => {
    if (Number.isNaN(value)) return noValue;
    const position = Math.min(1, Math.max(0, (value - low) / (high - low))) * last;
    const stop = Math.min(Math.floor(position), last - 1);
    const fraction = position - stop;
    return stops[stop].map((from, i) => from + (stops[stop + 1][i] - from) * fraction);
  };
}
