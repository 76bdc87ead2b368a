/** Where a column lies among the packed bytes: first byte, number of values, least value, step. */
export type PackedColumn = readonly [begin: number, count: number, least: number, step: number];

/** Bytes of base64: by the browser itself where it can. */
export function bytesOf(base64: string): Uint8Array {
  const native = (Uint8Array as { fromBase64?: (text: string) => Uint8Array }).fromBase64;
  if (native) return native.call(Uint8Array, base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** Reads whole numbers one after the other: see packed_numbers.h. Most take one byte or two. */
class NumberReader {
  constructor(
    private readonly bytes: Uint8Array,
    private at: number,
  ) {}

  next(): number {
    const { bytes } = this;
    const first = bytes[this.at++];
    if (first < 0x80) return first;
    const second = bytes[this.at++];
    if (second < 0x80) return (first & 0x7f) + 128 * second;
    let value = (first & 0x7f) + 128 * (second & 0x7f);
    for (let weight = 16384; ; weight *= 128) {
      if (this.at >= bytes.length) throw new RangeError(TOO_SHORT);
      const byte = bytes[this.at++];
      value += (byte & 0x7f) * weight;
      if (byte < 0x80) return value;
    }
  }

  /** Throws if bytes beyond the end were read. */
  check(): void {
    if (this.at > this.bytes.length) throw new RangeError(TOO_SHORT);
  }
}
const TOO_SHORT = 'the numbers of this page end too early';

function differenceOf(code: number): number {
  return code % 2 === 0 ? code / 2 : -(code + 1) / 2;
}

/** Values of a curve; a gap is NaN. */
export function unpackCurve(bytes: Uint8Array, [begin, count, least, step]: PackedColumn): Float64Array {
  const values = new Float64Array(count);
  const reader = new NumberReader(bytes, begin);
  let whole = 0;
  for (let i = 0; i < count; ) {
    const code = reader.next();
    const run = code === 0 ? 1 + reader.next() : 1; // a run of zeros
    if (code !== 0) whole += differenceOf(code);
    const value = whole === 0 ? NaN : least + step * (whole - 1);
    for (const end = Math.min(count, i + run); i < end; ++i) values[i] = value;
  }
  reader.check();
  return values;
}

/** Times in s. */
export function unpackTimes(bytes: Uint8Array, [begin, count, , step]: PackedColumn): Float64Array {
  const values = new Float64Array(count);
  const reader = new NumberReader(bytes, begin);
  let time = 0;
  let difference = 0;
  for (let i = 0; i < count; ) {
    const code = reader.next();
    const run = code === 0 ? 1 + reader.next() : 1;
    if (code !== 0) difference += differenceOf(code);
    for (const end = Math.min(count, i + run); i < end; ++i) {
      time += difference;
      values[i] = time * step;
    }
  }
  reader.check();
  return values;
}
