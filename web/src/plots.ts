import uPlot from 'uplot';
import type { Panel } from './data';
import { element } from './dom';
import { numberText, timeText } from './format';
import { tableOf, type Table } from './overlay';
import type { Player } from './player';
import { rangeOf } from './range';
import { drawSteps } from './steps';
import { currentTheme, onThemeChange, seriesColour, type Theme } from './theme';

const HEIGHT = 190;
const BAND_HEIGHT = 5;

/** A panel and, of a second run, the one that is laid over it. */
export interface PlotRequest {
  panel: Panel;
  other: Panel | undefined;
}

/** Colours go by labels: a demand, and the curve of the other run, have that of the curve that they belong to. */
function coloursOf(table: Table): number[] {
  const labels: string[] = [];
  return table.curves.map(({ label }) => {
    if (!labels.includes(label)) labels.push(label);
    return labels.indexOf(label);
  });
}

function greatestOf(values: ArrayLike<number | null>): number {
  let greatest = 0;
  for (let i = 0; i < values.length; ++i) greatest = Math.max(greatest, Math.abs(values[i] ?? 0));
  return greatest;
}

/** What is smaller than the steps that curves are rounded to is 0. */
function valueText(value: number, greatest: number): string {
  return numberText(Math.abs(value) < 2e-5 * greatest ? 0 : value);
}

function seriesOf(table: Table, theme: Theme, isLive: boolean): uPlot.Series[] {
  const colours = coloursOf(table);
  const hasOther = table.curves.some(({ isOther }) => isOther);
  const sizes = table.curves.map(({ values }) => greatestOf(values));
  return table.curves.map(({ label, demand, isOther }, i) => ({
    label: `${label}${demand ? ' demanded' : ''}${hasOther ? (isOther ? ' B' : ' A') : ''}`,
    stroke: seriesColour(theme, colours[i] ?? 0),
    width: demand ? 1 : isOther ? 1.25 : 1.75,
    spanGaps: hasOther,
    points: { show: !isLive && table.times.length < 30 },
    ...(demand ? { paths: stepsOf } : {}),
    value: (_: uPlot, value: number | null) => (value === null ? '–' : valueText(value, sizes[i] ?? 0)),
  }));
}

/** Demands hold until the next one. */
function stepsOf(plot: uPlot, series: number, first: number, last: number): uPlot.Series.Paths {
  const stroke = new Path2D();
  drawSteps(stroke, plot.data[0], (plot.data[series] ?? []) as ArrayLike<number | null>, {
    first,
    last,
    x: (time) => plot.valToPos(time, 'x', true),
    y: (value) => plot.valToPos(value, 'y', true),
  });
  return { stroke, fill: null, clip: null, band: null, flags: 0 };
}

/** Dashes of a line that goes up and down in each column of pixels would be neither seen nor drawn in time. */
function setDashes(plot: uPlot, table: Table): void {
  const { min = 0, max = 0 } = plot.scales['x'] ?? {};
  const whole = (table.times[table.times.length - 1] ?? 0) - (table.times[0] ?? 0);
  const shown = whole > 0 ? (table.times.length * (max - min)) / whole : 0;
  const isDense = shown > 4 * plot.bbox.width;
  table.curves.forEach(({ demand, isOther }, i) => {
    const series = plot.series[i + 1];
    if (series) series.dash = isDense ? [] : demand ? [2, 3] : isOther ? [7, 4] : [];
  });
}

/** Bars at the upper edge: in the colour of its engine while it was saturated, grey while it was timed out. */
function drawBands(plot: uPlot, panel: Panel, theme: Theme): void {
  const { ctx, bbox } = plot;
  const labels = panel.curves().map(({ label }) => label).filter((label, i, all) => all.indexOf(label) === i);
  const thickness = BAND_HEIGHT * (window.devicePixelRatio || 1);
  ctx.save();
  panel.bands.forEach(({ label, kind, spans }, row) => {
    ctx.fillStyle = kind === 'saturated' ? seriesColour(theme, labels.indexOf(label)) : theme.muted;
    for (const [begin, end] of spans) {
      const left = Math.max(bbox.left, plot.valToPos(begin, 'x', true));
      const right = Math.min(bbox.left + bbox.width, plot.valToPos(end, 'x', true));
      if (right > left) ctx.fillRect(left, bbox.top + row * (thickness + 1), Math.max(right - left, 1), thickness);
    }
  });
  ctx.restore();
}

/** One plot in its frame. It is drawn when it first comes into sight. */
class Plot {
  readonly root: HTMLElement;
  private readonly place = element('div', { class: 'plot' });
  private plot: uPlot | undefined;
  private isSeen = false;
  private isInSight = false;

  constructor(
    private readonly request: PlotRequest,
    private readonly board: PlotBoard,
  ) {
    const { title, unit, source } = request.panel;
    this.root = element(
      'figure',
      { class: 'panel' },
      element('figcaption', {}, element('span', { class: 'title' }, unit ? `${title} (${unit})` : title), element('span', { class: 'source' }, source)),
      this.place,
    );
    for (const text of this.bandTexts()) this.root.append(element('p', { class: 'bands' }, text));
  }

  private bandTexts(): string[] {
    const words: Record<string, string> = { saturated: 'saturated', timed_out: 'timed out' };
    return this.request.panel.bands.map(({ label, kind, spans }) => {
      const seconds = spans.reduce((sum, [begin, end]) => sum + end - begin, 0);
      return `▬ ${label} ${words[kind] ?? kind}: ${numberText(seconds, 3)} s`;
    });
  }

  /** It came into sight, or went out of it. */
  see(isInSight = true): void {
    this.isInSight = isInSight;
    if (!isInSight) return;
    if (this.isSeen) {
      this.showTime(this.board.player.shown);
      return;
    }
    this.isSeen = true;
    this.build();
  }

  build(): void {
    if (!this.isSeen) return;
    this.plot?.destroy();
    const theme = currentTheme();
    const table = tableOf(this.request.panel, this.request.other);
    const data = [table.times, ...table.curves.map(({ values }) => values)] as unknown as uPlot.AlignedData;
    this.plot = new uPlot(this.optionsOf(table, theme), data, this.place);
    this.showTime(this.board.player.shown);
  }

  private optionsOf(table: Table, theme: Theme): uPlot.Options {
    const axis: uPlot.Axis = {
      stroke: theme.muted,
      grid: { stroke: theme.grid, width: 1 },
      ticks: { stroke: theme.grid, width: 1, size: 4 },
      font: '11px system-ui, sans-serif',
    };
    const { board } = this;
    return {
      width: Math.max(1, this.place.clientWidth),
      height: HEIGHT,
      legend: { live: true },
      cursor: { drag: { x: !board.isLive, y: false }, points: { size: 5 }, y: false },
      scales: { x: { time: false, min: board.range[0], max: board.range[1] }, y: { range: (_, min, max) => rangeOf(min, max) } },
      axes: [
        { ...axis, size: 26 },
        { ...axis, size: 52, values: (_, ticks) => ticks.map((tick) => String(tick).replace('-', '\u2212')) },
      ],
      series: [{ label: 't', value: (_: uPlot, value: number | null) => (value === null ? '–' : timeText(value)) }, ...seriesOf(table, theme, board.isLive)],
      hooks: {
        drawClear: [(plot) => { setDashes(plot, table); }],
        draw: [(plot) => { drawBands(plot, this.request.panel, theme); }],
        setScale: [(plot, key) => { if (key === 'x') board.zoom(plot.scales['x']?.min ?? 0, plot.scales['x']?.max ?? 0, this); }],
        ready: [(plot) => { this.listen(plot); }],
      },
    };
  }

  /** A pointer on the plot shows its time everywhere; a click goes there. */
  private listen(plot: uPlot): void {
    const { player } = this.board;
    const timeOf = (event: MouseEvent): number => plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, 'x');
    let pressed = NaN;
    plot.over.addEventListener('mousemove', (event) => { player.hover(timeOf(event)); });
    plot.over.addEventListener('mouseleave', () => { player.hover(undefined); });
    if (this.board.isLive) return;
    plot.over.addEventListener('mousedown', (event) => { pressed = event.clientX; });
    plot.over.addEventListener('click', (event) => {
      if (Math.abs(event.clientX - pressed) < 4) player.seek(timeOf(event));
    });
    plot.over.addEventListener('dblclick', () => { this.board.zoomOut(); });
  }

  /** Shows a panel that has grown. */
  grow(min: number, max: number): void {
    const { plot } = this;
    if (!plot || !this.isInSight) return;
    const table = tableOf(this.request.panel, undefined);
    plot.batch(() => {
      plot.setData([table.times, ...table.curves.map(({ values }) => values)] as unknown as uPlot.AlignedData, false);
      plot.setScale('x', { min, max });
    });
    this.showTime(this.board.player.shown);
  }

  setRange(min: number, max: number): void {
    this.plot?.setScale('x', { min, max });
  }

  showTime(time: number): void {
    const { plot } = this;
    if (!plot || !this.isInSight) return;
    plot.setCursor({ left: plot.valToPos(time, 'x'), top: 0 }, false);
  }

  fit(): void {
    const width = this.place.clientWidth;
    if (this.plot && width > 0 && width !== this.plot.width) this.plot.setSize({ width, height: HEIGHT });
  }
}

/** All plots of a page: one range of time, one cursor. */
export class PlotBoard {
  readonly root = element('div', { class: 'board' });
  range: [number, number];
  private plots: Plot[] = [];
  private isZooming = false;
  private isStale = false;
  private readonly seen = new Map<Element, Plot>();
  private readonly sight = new IntersectionObserver(
    (entries) => {
      for (const { isIntersecting, target } of entries) this.seen.get(target)?.see(isIntersecting);
    },
    { rootMargin: '300px' },
  );

  /** @param isLive panels grow, and show the last seconds: there is no zoom. */
  constructor(readonly player: Player, readonly isLive = false) {
    this.range = [0, player.end];
    player.onTime(() => { this.isStale = true; });
    onThemeChange(() => { for (const plot of this.plots) plot.build(); });
    new ResizeObserver(() => { for (const plot of this.plots) plot.fit(); }).observe(this.root);
    window.addEventListener('beforeprint', () => { for (const plot of this.plots) plot.see(); });
  }

  /** Shows these plots in the place of the others. */
  show(requests: PlotRequest[]): void {
    this.sight.disconnect();
    this.seen.clear();
    this.plots = requests.map((request) => new Plot(request, this));
    this.root.replaceChildren(...this.plots.map(({ root }) => root));
    for (const plot of this.plots) {
      this.seen.set(plot.root, plot);
      this.sight.observe(plot.root);
    }
  }

  /** Shows the time in every plot, if that has changed. */
  draw(): void {
    if (!this.isStale) return;
    this.isStale = false;
    for (const plot of this.plots) plot.showTime(this.player.shown);
  }

  /** Shows this range of panels that have grown. */
  grow(min: number, max: number): void {
    this.isZooming = true;
    this.range = [min, max];
    for (const plot of this.plots) plot.grow(min, max);
    this.isZooming = false;
  }

  /** One plot was zoomed: all follow. */
  zoom(min: number, max: number, by: Plot): void {
    if (this.isZooming || (min === this.range[0] && max === this.range[1])) return;
    this.isZooming = true;
    this.range = [min, max];
    for (const plot of this.plots) {
      if (plot !== by) plot.setRange(min, max);
    }
    this.isZooming = false;
    this.player.seek(this.player.time);
  }

  zoomOut(): void {
    this.isZooming = true;
    this.range = [0, this.player.end];
    for (const plot of this.plots) plot.setRange(0, this.player.end);
    this.isZooming = false;
  }
}
