import type { Control, Levels } from './protocol';

/** What is asked for, each from -1 to 1; left is positive. */
export interface Wish {
  ahead: number;
  turn: number;
}

export const NOTHING: Wish = { ahead: 0, turn: 0 };

const DEAD_ZONE = 0.12; // of a stick that is let go
const KEYS: ReadonlyMap<string, Wish> = new Map([
  ['w', { ahead: 1, turn: 0 }],
  ['ArrowUp', { ahead: 1, turn: 0 }],
  ['s', { ahead: -1, turn: 0 }],
  ['ArrowDown', { ahead: -1, turn: 0 }],
  ['a', { ahead: 0, turn: 1 }],
  ['ArrowLeft', { ahead: 0, turn: 1 }],
  ['d', { ahead: 0, turn: -1 }],
  ['ArrowRight', { ahead: 0, turn: -1 }],
]);

function bounded(value: number): number {
  return Math.min(1, Math.max(-1, value));
}

/** The name under which a key is known here; nothing for one that does not drive. */
export function drivingKey(key: string): string | undefined {
  const name = key.length === 1 ? key.toLowerCase() : key;
  return KEYS.has(name) ? name : undefined;
}

/** What the keys ask for that are down. */
export function wishOfKeys(keys: ReadonlySet<string>): Wish {
  let ahead = 0;
  let turn = 0;
  for (const key of keys) {
    ahead += KEYS.get(key)?.ahead ?? 0;
    turn += KEYS.get(key)?.turn ?? 0;
  }
  return { ahead: bounded(ahead), turn: bounded(turn) };
}

function stick(value: number | undefined): number {
  if (value === undefined || !Number.isFinite(value) || Math.abs(value) <= DEAD_ZONE) return 0;
  return Math.sign(value) * bounded((Math.abs(value) - DEAD_ZONE) / (1 - DEAD_ZONE));
}

type Pad = Pick<Gamepad, 'axes' | 'buttons' | 'connected'>;

/** Left stick ahead, right stick to the side, and only while a shoulder button is held (dead man). */
export function wishOfPads(pads: readonly (Pad | null)[]): Wish | undefined {
  for (const pad of pads) {
    if (!pad?.connected || !(pad.buttons[4]?.pressed || pad.buttons[5]?.pressed)) continue;
    return { ahead: -stick(pad.axes[1]) || 0, turn: -stick(pad.axes[2]) || 0 };
  }
  return undefined;
}

/** A share of what a control can do, -1 to 1, as its level. */
function levelOf({ least, most }: Control, share: number): number {
  return share >= 0 ? share * most : -share * least;
}

/** The levels of a wish; nothing of controls that neither push ahead nor turn. */
export function levelsOf(controls: readonly Control[], { ahead, turn }: Wish): Levels {
  const levels: Levels = {};
  for (const control of controls) {
    if (control.ahead === 0 && control.turn === 0) continue;
    levels[control.name] = levelOf(control, bounded(control.ahead * ahead + control.turn * turn));
  }
  return levels;
}
