import { element } from './dom';
import { numberText, timeText } from './format';
import type { ClientMessage, PaceNews } from './protocol';

const FACTORS = [0, 0.1, 0.25, 0.5, 1, 2, 5, 10];
const SECONDS_SHOWN = 100; // ms between two looks at the clock

/** The bar with which a live run is paused, stepped, reset, hurried and slowed. */
export class RunBar {
  readonly root: HTMLElement;
  private readonly button = element('button', { type: 'button', class: 'play', title: 'Pause or resume (space)' });
  private readonly steps = element('input', { type: 'number', min: '1', max: '100000', value: '10', 'aria-label': 'steps' });
  private readonly step = element('button', { type: 'button', class: 'quiet' }, 'Step');
  private readonly seed = element('input', { type: 'number', placeholder: 'seed', 'aria-label': 'seed' });
  private readonly reset = element('button', { type: 'button', class: 'quiet' }, 'Reset');
  private readonly factor = element('select', { 'aria-label': 'real-time factor', title: 'Simulated time per wall time' });
  private readonly reached = element('span', { class: 'note reached' });
  private readonly clock = element('output', { class: 'clock', 'aria-label': 'simulated time' });
  private pace: PaceNews | undefined;
  private shownAt = -Infinity;

  constructor(private readonly send: (message: ClientMessage) => void) {
    this.root = element(
      'div',
      { class: 'timeline run', role: 'group', 'aria-label': 'Run' },
      this.button,
      this.clock,
      element('span', { class: 'row' }, this.steps, this.step),
      element('span', { class: 'row' }, this.seed, this.reset),
      element('span', { class: 'row' }, this.factor, this.reached),
    );
    this.offer(FACTORS);
    this.button.addEventListener('click', () => { this.toggle(); });
    this.step.addEventListener('click', () => {
      const steps = Math.round(Number(this.steps.value));
      if (steps >= 1) this.send({ op: 'step', steps: Math.min(100000, steps) });
    });
    this.reset.addEventListener('click', () => {
      const seed = this.seed.value === '' ? undefined : Math.round(Number(this.seed.value));
      this.send(seed === undefined ? { op: 'reset' } : { op: 'reset', seed });
    });
    this.factor.addEventListener('change', () => { this.send({ op: 'pace', factor: Number(this.factor.value) }); });
    this.show(undefined);
  }

  toggle(): void {
    if (this.pace?.there) this.send({ op: 'pause', paused: !this.pace.paused });
  }

  /** @param pace nothing: no connection. */
  show(pace: PaceNews | undefined): void {
    this.pace = pace;
    const isThere = pace?.there ?? false;
    const isPaused = pace?.paused ?? false;
    for (const part of [this.button, this.reset, this.factor]) part.disabled = !isThere;
    this.step.disabled = !isThere || !isPaused;
    this.button.textContent = isPaused ? '▶' : '❚❚';
    this.button.setAttribute('aria-label', isPaused ? 'resume' : 'pause');
    if (!pace) {
      this.reached.textContent = '';
      return;
    }
    if (!FACTORS.includes(pace.wanted)) this.offer([...FACTORS, pace.wanted].sort((a, b) => a - b));
    this.factor.value = String(pace.wanted);
    this.reached.textContent = isPaused ? 'paused' : `reached: ${numberText(pace.reached, 3)}×`;
  }

  private offer(factors: readonly number[]): void {
    this.factor.replaceChildren(...factors.map((factor) =>
      element('option', { value: String(factor) }, factor === 0 ? 'as fast as it can' : `${factor}×`)));
  }

  showTime(time: number, now: number): void {
    if (now - this.shownAt < SECONDS_SHOWN) return;
    this.shownAt = now;
    this.clock.textContent = timeText(time);
  }
}
