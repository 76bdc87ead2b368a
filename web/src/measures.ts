/** What a manoeuvre came to: a name and a value from each line of its text but the first, which tells of it. */
export function measuresOf(text: string): [string, string][] {
  return text.split('\n').slice(1).flatMap((line): [string, string][] => {
    // Names may have a colon of their own: step 1: rise time.
    const colon = line.lastIndexOf(': ');
    return colon < 0 ? [] : [[line.slice(0, colon).trim(), line.slice(colon + 2)]];
  });
}
