/** Where a column lies among the packed bytes: first byte, number of values, least value, step. */
export type PackedColumn = readonly [begin: number, count: number, least: number, step: number];

/** Bytes of base64. */
export function bytesOf(base64: string): Uint8Array {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** The whole numbers of a column, one after the other: see packed_numbers.h. */
function differencesOf(bytes: Uint8Array, begin: number, count: number): Float64Array {
  const differences = new Float64Array(count);
  let at = begin;
  const next = (): number => {
    let value = 0;
    let weight = 1;
    for (;;) {
      if (at >= bytes.length) throw new RangeError('the numbers of this page end too early');
      const byte = bytes[at++];
      value += (byte & 0x7f) * weight;
      if (byte < 0x80) return value;
      weight *= 128;
    }
  };
  for (let i = 0; i < count; ++i) {
    const code = next();
    if (code === 0) {
      i += next(); // a run of zeros, one of which the loop counts
    } else {
      differences[i] = code % 2 === 0 ? code / 2 : -(code + 1) / 2;
    }
  }
  return differences;
}

/** Values of a curve; a gap is NaN. */
export function unpackCurve(bytes: Uint8Array, [begin, count, least, step]: PackedColumn): Float64Array {
  const values = differencesOf(bytes, begin, count);
  let whole = 0;
  for (let i = 0; i < count; ++i) {
    whole += values[i];
    values[i] = whole === 0 ? NaN : least + step * (whole - 1);
  }
  return values;
}

/** Times in s. */
export function unpackTimes(bytes: Uint8Array, [begin, count, , step]: PackedColumn): Float64Array {
  const values = differencesOf(bytes, begin, count);
  let time = 0;
  let difference = 0;
  for (let i = 0; i < count; ++i) {
    difference += values[i];
    time += difference;
    values[i] = time * step;
  }
  return values;
}
