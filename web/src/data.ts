import { bytesOf, unpackCurve, unpackTimes, type PackedColumn } from './unpack';

/** What the program `report` writes into the page (page.cpp). Lengths in m, times in s from the start of the run. */

export type Vector = readonly [number, number, number];
export type Quaternion = readonly [x: number, y: number, z: number, w: number];

export interface Shape {
  kind: 'box' | 'cylinder' | 'cone' | 'sphere' | 'faces';
  role: string;
  /** Edges of a box; radius and length; radius. */
  size: Vector;
  position: Vector;
  orientation: Quaternion;
  vertices?: Vector[];
  faces?: number[][];
}

export interface Engine {
  name: string;
  position: Vector;
  direction: Vector;
  full: number;
}

export interface Ledger {
  begin: number;
  engines: number;
  drag: number;
  contacts: number;
  others: number;
  end: number;
}

export interface Contact {
  time: number;
  kind: string;
  a: string;
  b: string;
  point: Vector;
  normal: Vector;
  impulse: Vector;
}

export interface Band {
  label: string;
  kind: string;
  spans: [number, number][];
}

interface PackedPanel {
  title: string;
  source: string;
  unit: string;
  main: boolean;
  t: PackedColumn;
  curves: { label: string; demand: boolean; y: PackedColumn }[];
  bands: Band[];
}

/** A manoeuvre that a pilot has flown; `time` is its first execute, `text` what it came to, a line each. */
export interface Manoeuvre {
  craft: string;
  name: string;
  kind: string;
  complete: boolean;
  time: number;
  end: number;
  text: string;
}

interface PackedBody {
  name: string;
  craft: boolean;
  shapes: Shape[];
  engines: Engine[];
  motion: { source: string; t: PackedColumn; p: PackedColumn[]; q: PackedColumn[] };
  panels: PackedPanel[];
  ledger?: Ledger;
}

interface PackedGround {
  height: number;
  normal: Vector;
  columns: number;
  spacing: number;
  x: number;
  y: number;
  heights: PackedColumn;
}

interface PackedRun {
  ground?: PackedGround;
  source: string;
  end: number;
  bodies: PackedBody[];
  obstacles: { name: string; shapes: Shape[] }[];
  contacts: Contact[];
  manoeuvres: Manoeuvre[];
  panels: PackedPanel[];
  marks: { time: number; text: string }[];
  facts: [string, string][];
  notes: string[];
  scenario: string;
}

interface PackedDifference {
  name: string;
  t: PackedColumn;
  position: PackedColumn;
  attitude: PackedColumn;
  greatest: number;
  greatestTime: number;
  rms: number;
  greatestAttitude: number;
  parted?: { time: number; quantity: string; a: string; b: string };
}

export interface PackedReport {
  format: number;
  runs: PackedRun[];
  comparison: PackedDifference[];
  stride: number;
  numbers: string;
}

export interface Curve {
  label: string;
  demand: boolean;
  values: Float64Array;
}

export interface Panel {
  title: string;
  source: string;
  unit: string;
  main: boolean;
  bands: Band[];
  /** Unpacked when they are first looked at. */
  times: () => Float64Array;
  curves: () => Curve[];
}

export interface Motion {
  source: string;
  times: Float64Array;
  /** x, y, z. */
  position: Float64Array[];
  /** x, y, z, w. */
  orientation: Float64Array[];
}

export interface Body {
  name: string;
  craft: boolean;
  shapes: Shape[];
  engines: Engine[];
  motion: Motion;
  panels: Panel[];
  ledger: Ledger | undefined;
}

/** A plane, or heights row by row; of a plane there are no columns. */
export interface Ground extends Omit<PackedGround, 'heights'> {
  heights: Float64Array;
}

export interface Run extends Omit<PackedRun, 'bodies' | 'panels' | 'ground'> {
  bodies: Body[];
  panels: Panel[];
  ground: Ground | undefined;
}

export interface Difference extends Omit<PackedDifference, 't' | 'position' | 'attitude'> {
  panels: Panel[];
}

export interface Report {
  runs: Run[];
  comparison: Difference[];
  stride: number;
}

function once<Value>(make: () => Value): () => Value {
  let made: Value | undefined;
  return () => (made ??= make());
}

function panelOf(bytes: Uint8Array, packed: PackedPanel): Panel {
  return {
    title: packed.title,
    source: packed.source,
    unit: packed.unit,
    main: packed.main,
    bands: packed.bands,
    times: once(() => unpackTimes(bytes, packed.t)),
    curves: once(() =>
      packed.curves.map(({ label, demand, y }) => ({ label, demand, values: unpackCurve(bytes, y) })),
    ),
  };
}

function bodyOf(bytes: Uint8Array, packed: PackedBody): Body {
  const { motion } = packed;
  return {
    name: packed.name,
    craft: packed.craft,
    shapes: packed.shapes,
    engines: packed.engines,
    motion: {
      source: motion.source,
      times: unpackTimes(bytes, motion.t),
      position: motion.p.map((column) => unpackCurve(bytes, column)),
      orientation: motion.q.map((column) => unpackCurve(bytes, column)),
    },
    panels: packed.panels.map((panel) => panelOf(bytes, panel)),
    ledger: packed.ledger,
  };
}

function differenceOf(bytes: Uint8Array, packed: PackedDifference): Difference {
  const { t, position, attitude, ...words } = packed;
  const panel = (title: string, unit: string, y: PackedColumn): Panel =>
    panelOf(bytes, {
      title,
      source: `${packed.name}, B against A`,
      unit,
      main: true,
      t,
      curves: [{ label: 'difference', demand: false, y }],
      bands: [],
    });
  return {
    ...words,
    panels: [panel('Difference of position', 'm', position), panel('Difference of attitude', 'rad', attitude)],
  };
}

/** Unpacks the data of a page. */
export function reportOf(packed: PackedReport): Report {
  if (packed.format !== 1) throw new Error(`this page has data of format ${packed.format}, not 1`);
  const bytes = bytesOf(packed.numbers);
  return {
    runs: packed.runs.map((run) => ({
      ...run,
      bodies: run.bodies.map((body) => bodyOf(bytes, body)),
      panels: run.panels.map((panel) => panelOf(bytes, panel)),
      ground: run.ground ? { ...run.ground, heights: unpackCurve(bytes, run.ground.heights) } : undefined,
    })),
    comparison: packed.comparison.map((difference) => differenceOf(bytes, difference)),
    stride: packed.stride,
  };
}
