/**
 * What an axis shows of values from `least` to `most`, with some room. What differs by rounding only is one value: an axis of that extent would have no
 * labels that differ.
 */
export function rangeOf(least: number | null, most: number | null): [number, number] {
  if (least === null || most === null || !Number.isFinite(least) || !Number.isFinite(most)) return [0, 1];
  const size = Math.max(Math.abs(least), Math.abs(most));
  const extent = most - least;
  if (extent <= Math.max(1e-12, 1e-6 * size)) {
    const middle = (least + most) / 2;
    const room = size > 1e-12 ? size / 2 : 0.5;
    return [middle - room, middle + room];
  }
  return [least - 0.06 * extent, most + 0.06 * extent];
}
