import type { Run } from './data';
import { element, fitCanvas } from './dom';
import { timeText } from './format';
import { nearestOf } from './nearest';
import type { Player } from './player';
import { currentTheme, onThemeChange } from './theme';

const KNOB = 8; // px, half of the slider's knob
const REACH = 6; // px, from a mark that a click goes to
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 10];

/** The bar with which a run is played: a button, a slider with the contacts on it, a speed. */
export class Timeline {
  readonly root: HTMLElement;
  private readonly button = element('button', { type: 'button', class: 'play', title: 'Play or pause (space)' });
  private readonly slider = element('input', { type: 'range', min: '0', step: 'any', 'aria-label': 'time' });
  private readonly clock = element('output', { class: 'clock' });
  private readonly speed = element('select', { 'aria-label': 'speed', title: 'Speed (+ and \u2212)' });
  private isStale = false;
  private readonly marks = element('canvas', { class: 'marks', 'aria-hidden': 'true' });

  constructor(
    private readonly run: Run | undefined,
    private readonly player: Player,
  ) {
    this.slider.max = String(player.end);
    this.slider.value = '0';
    for (const speed of SPEEDS) this.speed.append(element('option', { value: String(speed) }, `${speed}×`));
    this.root = element(
      'div',
      { class: 'timeline', role: 'group', 'aria-label': 'Playing' },
      this.button,
      element('div', { class: 'track' }, this.marks, this.slider),
      this.clock,
      this.speed,
    );
    this.button.addEventListener('click', () => { player.toggle(); });
    this.slider.addEventListener('input', () => { player.seek(Number(this.slider.value)); });
    this.listenToMarks();
    this.speed.addEventListener('change', () => { player.setSpeed(Number(this.speed.value)); });
    player.onTime(() => { this.isStale = true; });
    player.onChange(() => { this.showState(); });
    new ResizeObserver(() => { this.drawMarks(); }).observe(this.marks);
    onThemeChange(() => { this.drawMarks(); });
    this.showTime(0);
    this.showState();
  }

  /** A click beside a mark goes to it: to a contact, a manoeuvre, what else happened. */
  private listenToMarks(): void {
    const { contacts = [], manoeuvres = [], marks = [] } = this.run ?? {};
    const times = [...contacts, ...manoeuvres, ...marks].map(({ time }) => time);
    let pressed = NaN;
    this.slider.addEventListener('pointerdown', (event) => { pressed = event.clientX; });
    this.slider.addEventListener('click', (event) => {
      if (!(Math.abs(event.clientX - pressed) < 3)) return; // it was drawn along
      const pixel = this.player.end / Math.max(1, this.slider.clientWidth - 2 * KNOB);
      const time = nearestOf(times, Number(this.slider.value), REACH * pixel);
      if (time !== undefined) this.player.seek(time);
    });
  }

  /** Shows the time, if it has changed. */
  draw(): void {
    if (!this.isStale) return;
    this.isStale = false;
    this.showTime(this.player.shown);
  }

  /** The next faster or slower speed. */
  change(step: number): void {
    const at = SPEEDS.indexOf(this.player.speed);
    this.player.setSpeed(SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, at + step))] ?? 1);
  }

  private showTime(time: number): void {
    this.slider.value = String(time);
    this.clock.textContent = `${timeText(time)} of ${timeText(this.player.end)}`;
  }

  private showState(): void {
    this.button.textContent = this.player.playing ? '❚❚' : '▶';
    this.button.setAttribute('aria-label', this.player.playing ? 'pause' : 'play');
    this.speed.value = String(this.player.speed);
  }

  /** Contacts, and what else happened, above the slider. */
  private drawMarks(): void {
    const context = fitCanvas(this.marks);
    if (!context || !this.run) return;
    const theme = currentTheme();
    const room = KNOB;
    const width = this.marks.clientWidth - 2 * room;
    const height = this.marks.clientHeight;
    const draw = (time: number, colour: string, share: number): void => {
      context.fillStyle = colour;
      context.fillRect(room + (width * time) / (this.player.end || 1) - 0.75, height * (1 - share), 1.5, height * share);
    };
    for (const { time, kind } of this.run.contacts) draw(time, theme.alarm, kind === 'rest' ? 0.5 : 1);
    for (const { time } of this.run.manoeuvres) draw(time, theme.text, 0.7);
    for (const { time } of this.run.marks) draw(time, theme.text, 1);
  }
}
