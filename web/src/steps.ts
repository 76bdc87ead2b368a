/** What a path can take: a Path2D, or the list of a test. */
export interface Pen {
  moveTo(x: number, y: number): void;
  lineTo(x: number, y: number): void;
}

/**
 * Draws values that hold until the next one. Where more than one change falls on a column of pixels, that column is one upright line
 * over all of them: a recording of 60,000 samples has no more corners than the picture has pixels.
 * @param x, y pixels of a time and of a value. @param first, last indices that are drawn.
 */
export function drawSteps(
  pen: Pen,
  times: ArrayLike<number>,
  values: ArrayLike<number | null>,
  { first, last, x, y }: { first: number; last: number; x: (time: number) => number; y: (value: number) => number },
): void {
  let held: number | undefined; // y of the value that holds
  let column = NaN;
  let low = 0; // of the changes in the column
  let high = 0;
  const endColumn = (): void => {
    if (held === undefined || Number.isNaN(column)) return;
    if (low !== high) {
      pen.lineTo(column, low);
      pen.lineTo(column, high);
    }
    pen.lineTo(column, held);
    column = NaN;
  };
  for (let i = first; i <= last; ++i) {
    const value = values[i];
    if (value === null || value === undefined) {
      endColumn();
      if (held !== undefined) pen.lineTo(Math.round(x(times[i] ?? 0)), held);
      held = undefined;
      continue;
    }
    const to = y(value);
    const at = Math.round(x(times[i] ?? 0));
    if (held === undefined) {
      pen.moveTo(at, to);
    } else if (to !== held) {
      if (at !== column) {
        endColumn();
        pen.lineTo(at, held);
        column = at;
        low = high = held;
      }
      low = Math.min(low, to);
      high = Math.max(high, to);
    }
    held = to;
  }
  endColumn();
  if (held !== undefined) pen.lineTo(Math.round(x(times[last] ?? 0)), held);
}
