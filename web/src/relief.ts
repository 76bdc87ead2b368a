import type { Ground } from './data';

/** A grid of heights as triangles: corners and the corners of each. */
export function reliefOf({ columns, spacing, x, y, heights }: Ground): { corners: Float32Array; triangles: Uint32Array } {
  const rows = columns > 0 ? Math.floor(heights.length / columns) : 0;
  const corners = new Float32Array(3 * columns * rows);
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const i = row * columns + column;
      corners.set([x + column * spacing, y + row * spacing, heights[i] ?? 0], 3 * i);
    }
  }
  const triangles: number[] = [];
  for (let row = 0; row + 1 < rows; ++row) {
    for (let column = 0; column + 1 < columns; ++column) {
      const i = row * columns + column;
      triangles.push(i, i + 1, i + columns, i + 1, i + columns + 1, i + columns);
    }
  }
  return { corners, triangles: Uint32Array.from(triangles) };
}

/** How bright level ground is, of 1. */
export const levelShade = 1 / (Math.SQRT2 * 1.2);

/** How bright each height is drawn from above, 0 to 255: lit from the north-west, so that hills are seen as hills. */
export function shadesOf({ columns, spacing, heights }: Ground): Uint8ClampedArray {
  const rows = columns > 0 ? Math.floor(heights.length / columns) : 0;
  const shades = new Uint8ClampedArray(columns * rows);
  const at = (column: number, row: number): number =>
    heights[Math.min(rows - 1, Math.max(0, row)) * columns + Math.min(columns - 1, Math.max(0, column))] ?? 0;
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const east = (at(column + 1, row) - at(column - 1, row)) / (2 * spacing);
      const north = (at(column, row + 1) - at(column, row - 1)) / (2 * spacing);
      const light = ((east - north + 2) / (2 * Math.hypot(east, north, 1))) * levelShade;
      shades[row * columns + column] = 255 * Math.min(1, Math.max(0, light));
    }
  }
  return shades;
}
