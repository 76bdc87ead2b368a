/** The one of some times that is nearest to a time, if it is no farther than `reach`. */
export function nearestOf(times: readonly number[], time: number, reach: number): number | undefined {
  let nearest: number | undefined;
  for (const each of times) {
    const least = nearest === undefined ? reach : Math.abs(nearest - time);
    if (Math.abs(each - time) <= least) nearest = each;
  }
  return nearest;
}
