import type { Body, Report, Vector } from './data';
import { element, fitCanvas } from './dom';
import { headingOf, indexAt, poseAt } from './motion';
import { cornersOf, outlineOf, place } from './outline';
import type { Player } from './player';
import { levelShade, shadesOf } from './relief';
import { currentTheme, onThemeChange, seriesColour, type Theme } from './theme';

const MARGIN = 34;
const MOST_POINTS = 4000;
const TICK_PIXELS = 9;
const LIVE_ROOM = 0.35; // of the extent, that a live picture keeps free around what was passed
const LIVE_SPARE = 4; // times the room that is needed: then it is drawn larger

interface View {
  scale: number;
  x: number;
  y: number;
  width: number;
  height: number;
}

interface Box {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

interface Track {
  body: Body;
  colour: number;
  isOther: boolean;
  corners: Vector[];
  /** Indices of the samples that are drawn. */
  shown: number[];
}

/** A step between lines of the grid of 1, 2 or 5 times a power of ten, at least `least`. */
export function roundStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5, 10].find((factor) => factor * power >= least) ?? 10);
}

function samplesOf(count: number): number[] {
  const stride = Math.max(1, Math.ceil(count / MOST_POINTS));
  const shown = [];
  for (let i = 0; i < count; i += stride) shown.push(i);
  if (count > 0 && shown.at(-1) !== count - 1) shown.push(count - 1);
  return shown;
}

/** The run from above: ways with the heading, obstacles, contacts, and where everything is at the time that is shown. */
export class PathView {
  readonly root = element('div', { class: 'view' });
  private readonly still = element('canvas', { 'aria-hidden': 'true' });
  private readonly moving = element('canvas', { role: 'img', 'aria-label': 'The way from above' });
  private readonly tracks: Track[];
  private view: View = { scale: 1, x: 0, y: 0, width: 1, height: 1 };
  private theme: Theme = currentTheme();
  private isStale = true;

  /** @param isLive motions grow: see grow(). */
  constructor(
    private readonly report: Report,
    private readonly player: Player,
    private readonly isLive = false,
  ) {
    this.tracks = report.runs.flatMap((run, runIndex) =>
      run.bodies.map((body, i) => ({
        body,
        colour: i,
        isOther: runIndex > 0,
        corners: cornersOf(body.shapes),
        shown: samplesOf(body.motion.times.length),
      })),
    );
    this.root.append(this.still, this.moving);
    new ResizeObserver(() => { this.drawAll(); }).observe(this.root);
    onThemeChange(() => { this.drawAll(); });
    player.onTime(() => { this.isStale = true; });
    if (!isLive) this.moving.addEventListener('click', (event) => { this.seekNear(event.offsetX, event.offsetY); });
  }

  /** Draws the ways anew as far as they go by now. */
  grow(): void {
    for (const track of this.tracks) track.shown = samplesOf(track.body.motion.times.length);
    this.drawAll();
  }

  /** Draws where everything is, if that has changed. */
  draw(): void {
    if (this.isStale) this.drawMoving();
  }

  private drawAll(): void {
    this.theme = currentTheme();
    this.fit();
    const context = fitCanvas(this.still);
    if (!context) return;
    this.drawRelief(context);
    this.drawGrid(context);
    for (const run of this.report.runs.slice(0, 1)) {
      for (const obstacle of run.obstacles) {
        this.polygon(context, outlineOf(cornersOf(obstacle.shapes)), this.theme.obstacle, 0.45);
      }
    }
    for (const track of this.tracks) this.drawWay(context, track);
    this.drawContacts(context);
    this.drawMoving();
  }

  /** Everything that was passed, and what of the obstacles lies around it. */
  private fit(): void {
    const box: Box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
    const take = (x: number, y: number, room: number): void => {
      if (!Number.isFinite(x) || !Number.isFinite(y)) return;
      box.left = Math.min(box.left, x - room);
      box.right = Math.max(box.right, x + room);
      box.bottom = Math.min(box.bottom, y - room);
      box.top = Math.max(box.top, y + room);
    };
    for (const { body, shown, corners } of this.tracks) {
      const room = Math.max(0.1, ...corners.map(([x, y]) => Math.hypot(x, y)));
      const [xs, ys] = body.motion.position;
      for (const i of shown) take(xs?.[i] ?? NaN, ys?.[i] ?? NaN, room);
    }
    if (!(box.right > box.left && box.top > box.bottom)) return; // nothing was heard yet
    if (this.isLive && this.stillFits(box)) return;
    if (this.isLive) {
      const room = LIVE_ROOM * Math.max(box.right - box.left, box.top - box.bottom);
      take(box.left, box.bottom, room);
      take(box.right, box.top, room);
    }
    const width = this.root.clientWidth || 1;
    const height = this.root.clientHeight || 1;
    const scale = Math.min((width - 2 * MARGIN) / (box.right - box.left), (height - 2 * MARGIN) / (box.top - box.bottom));
    this.view = { scale: Math.max(scale, 1e-9), x: (box.left + box.right) / 2, y: (box.bottom + box.top) / 2, width, height };
  }

  /** Whether a live picture can stay as it is: everything is in it, and it is not far too large. */
  private stillFits({ left, right, bottom, top }: Box): boolean {
    const { view } = this;
    if (view.width !== this.root.clientWidth || view.height !== this.root.clientHeight) return false;
    const [x1, y2] = this.toScreen(left, bottom);
    const [x2, y1] = this.toScreen(right, top);
    const isSmall = LIVE_SPARE * (x2 - x1) < view.width && LIVE_SPARE * (y2 - y1) < view.height;
    return x1 >= 0 && x2 <= view.width && y1 >= 0 && y2 <= view.height && !isSmall;
  }

  private toScreen(x: number, y: number): [number, number] {
    const { view } = this;
    return [view.width / 2 + (x - view.x) * view.scale, view.height / 2 - (y - view.y) * view.scale];
  }

  /** Hills and hollows of a height map, as a picture that is light on one side. */
  private drawRelief(context: CanvasRenderingContext2D): void {
    const ground = this.report.runs[0]?.ground;
    if (!ground || ground.columns === 0) return;
    const shades = shadesOf(ground);
    const { columns, spacing } = ground;
    const rows = shades.length / columns;
    const picture = element('canvas', { width: String(columns), height: String(rows) });
    const pixels = picture.getContext('2d');
    if (!pixels) return;
    const data = pixels.createImageData(columns, rows);
    const level = 255 * levelShade;
    for (let i = 0; i < shades.length; ++i) {
      const above = (rows - 1 - Math.floor(i / columns)) * columns + (i % columns); // y is up
      const excess = shades[i] - level;
      const tone = excess > 0 ? 255 : 0;
      data.data.set([tone, tone, tone, Math.min(150, 6 * Math.abs(excess))], 4 * above);
    }
    pixels.putImageData(data, 0, 0);
    const [left, bottom] = this.toScreen(ground.x - spacing / 2, ground.y - spacing / 2);
    const size = spacing * this.view.scale;
    context.drawImage(picture, left, bottom - rows * size, columns * size, rows * size);
  }

  private drawGrid(context: CanvasRenderingContext2D): void {
    const { view, theme } = this;
    const step = roundStep(64 / view.scale);
    context.strokeStyle = theme.grid;
    context.fillStyle = theme.muted;
    context.font = '11px system-ui, sans-serif';
    context.lineWidth = 1;
    const halfWidth = view.width / 2 / view.scale;
    const halfHeight = view.height / 2 / view.scale;
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const line = (x1: number, y1: number, x2: number, y2: number): void => {
      context.beginPath();
      context.moveTo(x1, y1);
      context.lineTo(x2, y2);
      context.stroke();
    };
    for (let i = Math.ceil((view.x - halfWidth) / step); i * step <= view.x + halfWidth; ++i) {
      const [x] = this.toScreen(i * step, 0);
      line(x, 0, x, view.height);
      context.fillText((i * step).toFixed(digits), x + 3, view.height - 5);
    }
    for (let i = Math.ceil((view.y - halfHeight) / step); i * step <= view.y + halfHeight; ++i) {
      const [, y] = this.toScreen(0, i * step);
      line(0, y, view.width, y);
      if (y < view.height - 24) context.fillText(`${(i * step).toFixed(digits)} m`, 4, y - 3);
    }
  }

  private drawWay(context: CanvasRenderingContext2D, { body, colour, isOther, shown }: Track): void {
    const [xs, ys] = body.motion.position;
    if (!xs || !ys) return;
    context.strokeStyle = body.craft ? seriesColour(this.theme, colour) : this.theme.body;
    context.lineWidth = isOther ? 1.5 : 2;
    context.setLineDash(isOther ? [6, 4] : []);
    context.lineJoin = 'round';
    context.beginPath();
    for (const i of shown) context.lineTo(...this.toScreen(xs[i], ys[i]));
    context.stroke();
    context.setLineDash([]);
    if (body.craft && !isOther) this.drawTicks(context, body, xs, ys);
    const first = shown[0];
    if (first === undefined || isOther) return;
    const [x, y] = this.toScreen(xs[first], ys[first]);
    context.fillStyle = this.theme.panel;
    context.lineWidth = 2;
    context.beginPath();
    context.arc(x, y, 4.5, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
  }

  /** Short lines along the heading, at even times. */
  private drawTicks(context: CanvasRenderingContext2D, { motion }: Body, xs: Float64Array, ys: Float64Array): void {
    const begin = motion.times[0] ?? 0;
    const span = (motion.times[motion.times.length - 1] ?? 0) - begin;
    if (!(span > 0)) return;
    const step = roundStep(span / 40);
    context.lineWidth = 1.5;
    for (let time = Math.ceil(begin / step) * step; time <= begin + span; time += step) {
      const i = indexAt(motion.times, time);
      const [x, y] = this.toScreen(xs[i], ys[i]);
      const heading = headingOf(poseAt(motion, time).orientation);
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x + TICK_PIXELS * Math.cos(heading), y - TICK_PIXELS * Math.sin(heading));
      context.stroke();
    }
  }

  private drawContacts(context: CanvasRenderingContext2D): void {
    context.strokeStyle = this.theme.alarm;
    context.lineWidth = 1.5;
    for (const { point } of this.report.runs[0]?.contacts.slice(0, MOST_POINTS) ?? []) {
      const [x, y] = this.toScreen(point[0], point[1]);
      context.beginPath();
      context.moveTo(x - 4, y - 4);
      context.lineTo(x + 4, y + 4);
      context.moveTo(x - 4, y + 4);
      context.lineTo(x + 4, y - 4);
      context.stroke();
    }
  }

  private polygon(context: CanvasRenderingContext2D, corners: [number, number][], colour: string, alpha: number): void {
    context.fillStyle = colour;
    context.strokeStyle = colour;
    context.lineWidth = 1.5;
    context.beginPath();
    for (const [x, y] of corners) context.lineTo(...this.toScreen(x, y));
    context.closePath();
    context.globalAlpha = alpha;
    context.fill();
    context.globalAlpha = 1;
    context.stroke();
  }

  private drawMoving(): void {
    this.isStale = false;
    const context = fitCanvas(this.moving);
    if (!context) return;
    for (const { body, colour, isOther, corners } of this.tracks) {
      const { position, orientation } = poseAt(body.motion, this.player.shown);
      const fill = body.craft ? seriesColour(this.theme, colour) : this.theme.body;
      const placed = corners.map((corner) => place(corner, position, orientation));
      if (placed.length > 0) this.polygon(context, outlineOf(placed), fill, isOther ? 0.15 : 0.5);
      const heading = headingOf(orientation);
      const [x, y] = this.toScreen(position[0], position[1]);
      context.strokeStyle = this.theme.text;
      context.lineWidth = 2;
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x + 16 * Math.cos(heading), y - 16 * Math.sin(heading));
      context.stroke();
    }
  }

  /** Goes to the time at which a way passed nearest to a point of the screen. */
  private seekNear(x: number, y: number): void {
    let best = { distance: 400, time: NaN }; // pixels squared
    for (const { body, shown } of this.tracks) {
      const [xs, ys] = body.motion.position;
      for (const i of shown) {
        const [u, v] = this.toScreen(xs?.[i] ?? NaN, ys?.[i] ?? NaN);
        const distance = (u - x) ** 2 + (v - y) ** 2;
        if (distance < best.distance) best = { distance, time: body.motion.times[i] };
      }
    }
    if (!Number.isNaN(best.time)) this.player.seek(best.time);
  }
}
