import type { PackedReport } from './data';

/** What a live page and its server say to each other (doc/web.md). Lengths in m, times in s, angles in rad. */

/** One engine or actuator of a craft. */
export interface Control {
  name: string;
  unit: string;
  least: number;
  most: number;
  rest: number;
  holds: boolean;
  /** 1, 0 or -1: what of it goes with "ahead", and with "turn left". */
  ahead: number;
  turn: number;
}

export interface Hello {
  type: 'hello';
  protocol: number;
  you: number;
  name: string;
}
export interface Scene {
  type: 'scene';
  /** Of each craft. */
  controls: Control[][];
  report: PackedReport;
}
type Numbers = (number | null)[];
export interface State {
  type: 'state';
  t: number;
  tick: number;
  episode: number;
  /** x, y, z, and the quaternion x, y, z, w: of craft, then of loose bodies. */
  poses: Numbers[];
  /** Of craft, in their own axes: u, v, w, p, q, r. */
  motions: Numbers[];
  /** Of craft, in the order of their controls. */
  applied: Numbers[];
  demanded: Numbers[];
}
export interface PaceNews {
  type: 'pace';
  there: boolean;
  paused: boolean;
  wanted: number;
  reached: number;
}
export interface Seats {
  type: 'seats';
  viewers: number;
  /** 0: nobody drives. */
  seats: { craft: string; driver: number; name: string }[];
}
export interface Note {
  type: 'note';
  text: string;
  failure: boolean;
}
export type ServerMessage = Hello | Scene | State | PaceNews | Seats | Note;

export type Levels = Record<string, number>;
export type ClientMessage =
  | { op: 'drive'; craft: string; levels: Levels }
  | { op: 'seat'; craft: string; take: boolean }
  | { op: 'pause'; paused: boolean }
  | { op: 'step'; steps: number }
  | { op: 'reset'; seed?: number }
  | { op: 'pace'; factor: number }
  | { op: 'name'; name: string };

export const PROTOCOL = 1;
