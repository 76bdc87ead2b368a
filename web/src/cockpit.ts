import { element } from './dom';
import { numberText } from './format';
import { drivingKey, levelsOf, wishOfKeys, wishOfPads } from './helm';
import type { ClientMessage, Control, Levels, Seats } from './protocol';

export interface Craft {
  name: string;
  controls: readonly Control[];
}

/** One control: its name, a slider, its level. */
class Slider {
  readonly root: HTMLElement;
  private readonly input: HTMLInputElement;
  private readonly output = element('output', { class: 'level' });

  /** @param springs whether it goes back when it is let go. */
  constructor(
    readonly control: Control,
    springs: () => boolean,
  ) {
    const { name, unit, least, most, rest } = control;
    this.input = element('input', { type: 'range', min: String(least), max: String(most), step: 'any', 'aria-label': `${name}${unit ? `, ${unit}` : ''}` });
    this.root = element('label', { class: 'control' }, element('span', {}, name), this.input, this.output);
    this.value = rest;
    this.input.addEventListener('input', () => { this.showValue(); });
    for (const end of ['pointerup', 'pointercancel', 'keyup', 'blur']) {
      this.input.addEventListener(end, () => { if (springs()) this.spring(); });
    }
  }

  get value(): number {
    return Number(this.input.value);
  }
  set value(level: number) {
    this.input.value = String(level);
    this.showValue();
  }
  set disabled(isDisabled: boolean) {
    this.input.disabled = isDisabled;
  }
  /** A lift fan stays where it was put: the craft hovers on it. */
  spring(): void {
    if (this.control.unit !== '') this.value = 0;
  }
  private showValue(): void {
    const { unit } = this.control;
    this.output.textContent = `${numberText(this.value, 3)}${unit ? ` ${unit}` : ''}`;
  }
}

/** Where a craft is driven from: who drives, sliders, keys, gamepad. What it sends holds for 0.3 s at most. */
export class Cockpit {
  readonly root: HTMLElement;
  private readonly who = element('span', { class: 'who' });
  private readonly take = element('button', { type: 'button', class: 'primary' });
  private readonly keep = element('input', { type: 'checkbox' });
  private readonly pad = element('span', { class: 'note' });
  private readonly sliders = element('div', { class: 'controls' });
  private readonly keys = new Set<string>();
  private all: Slider[] = [];
  private craft: Craft | undefined;
  private seats: Seats | undefined;
  private you = 0;
  /** Wanted, though a connection may be lost or the page hidden for a while. */
  private wants = false;

  /** @param appliedTo the levels that act on a craft, in the order of its controls. */
  constructor(
    private readonly send: (message: ClientMessage) => void,
    private readonly appliedTo: (craft: string) => readonly (number | null)[],
  ) {
    this.root = element(
      'section',
      { class: 'card helm', 'aria-label': 'Helm' },
      element('div', { class: 'row' }, element('h2', {}, 'Helm'), this.who, this.take, element('label', { class: 'keep' }, this.keep, 'sliders stay where they are put'), this.pad),
      this.sliders,
      element('p', { class: 'note' }, 'Keys: W or ↑ ahead, S or ↓ back, A or ← and D or → turn. Gamepad: hold a shoulder button; left stick ahead, right stick turns. Whatever is let go stops.'),
    );
    this.take.addEventListener('click', () => { this.press(); });
    document.addEventListener('visibilitychange', () => { this.onVisibility(); });
    window.addEventListener('blur', () => { this.letGo(); });
    window.addEventListener('keydown', (event) => { this.onKey(event, true); });
    window.addEventListener('keyup', (event) => { this.onKey(event, false); });
  }

  get drives(): boolean {
    return this.you !== 0 && this.seat?.driver === this.you;
  }
  private get seat(): Seats['seats'][number] | undefined {
    return this.seats?.seats.find(({ craft }) => craft === this.craft?.name);
  }

  /** Another craft is looked at. The helm of the last one is left. */
  choose(craft: Craft | undefined): void {
    if (craft?.name === this.craft?.name && craft) {
      this.craft = craft;
      return;
    }
    this.leave();
    this.craft = craft;
    this.all = (craft?.controls ?? []).map((control) => new Slider(control, () => !this.keep.checked));
    this.sliders.replaceChildren(...this.all.map(({ root }) => root));
    this.show();
  }

  /** A connection was made. Who drove before drives again, if nobody else does. */
  welcome(you: number): void {
    this.you = you;
    this.seats = undefined;
    this.show();
  }
  /** It was lost. */
  part(): void {
    this.you = 0;
    this.letGo();
    this.show();
  }
  showSeats(seats: Seats): void {
    const drove = this.drives;
    this.seats = seats;
    if (this.drives && !drove) this.begin();
    if (!this.drives && this.wants && this.seat?.driver === 0 && document.visibilityState === 'visible') this.ask(true);
    if (this.seat && this.seat.driver !== 0 && !this.drives) this.wants = false;
    this.show();
  }

  private press(): void {
    if (this.drives) this.leave();
    else {
      this.wants = true;
      this.ask(true);
    }
  }
  private leave(): void {
    this.wants = false;
    this.letGo();
    if (this.drives) this.ask(false);
  }
  private ask(take: boolean): void {
    if (this.craft) this.send({ op: 'seat', craft: this.craft.name, take });
  }
  /** What holds without a driver is where it is. */
  private begin(): void {
    const applied = this.appliedTo(this.craft?.name ?? '');
    this.all.forEach((slider, i) => {
      const level = applied[i] ?? slider.control.rest;
      slider.value = slider.control.holds ? level : 0;
    });
  }
  private letGo(): void {
    this.keys.clear();
    for (const slider of this.all) slider.spring();
  }
  private onVisibility(): void {
    if (document.visibilityState === 'visible') {
      if (this.wants && this.seat?.driver === 0) this.ask(true);
      return;
    }
    this.letGo();
    if (this.drives) this.ask(false);
  }

  private onKey(event: KeyboardEvent, isDown: boolean): void {
    const key = drivingKey(event.key);
    if (!key) return;
    if (!isDown) {
      this.keys.delete(key);
      return;
    }
    const { target } = event;
    const isOther = target instanceof HTMLInputElement && target.type !== 'checkbox' && (target.type !== 'range' || key.startsWith('Arrow'));
    if (isOther || target instanceof HTMLSelectElement || event.ctrlKey || event.metaKey || event.altKey || !this.drives) return;
    event.preventDefault();
    this.keys.add(key);
  }

  /** Says what is wanted: as often as the server must hear it. */
  drive(): void {
    const pads = typeof navigator.getGamepads === 'function' ? navigator.getGamepads() : [];
    const wish = wishOfPads(pads) ?? (this.keys.size > 0 ? wishOfKeys(this.keys) : undefined);
    const hasPad = [...pads].some((pad) => pad?.connected);
    this.pad.textContent = hasPad ? `gamepad: ${wishOfPads(pads) ? 'drives' : 'hold a shoulder button'}` : '';
    if (!this.drives || !this.craft) return;
    this.follow(wish ? levelsOf(this.craft.controls, wish) : undefined);
    const levels: Levels = {};
    for (const { control, value } of this.all) levels[control.name] = value;
    this.send({ op: 'drive', craft: this.craft.name, levels });
  }
  private wished = false;
  /** Sliders show what keys and gamepad ask for; when these are let go, they go back. */
  private follow(levels: Levels | undefined): void {
    if (!levels && this.wished) this.letGo();
    this.wished = levels !== undefined;
    for (const slider of this.all) {
      const level = levels?.[slider.control.name];
      if (level !== undefined) slider.value = level;
    }
  }

  private show(): void {
    const { seat, drives } = this;
    const isConnected = this.you !== 0;
    this.root.classList.toggle('driving', drives);
    this.who.textContent = !isConnected ? 'no connection' : !seat ? '' : drives ? `You drive ${seat.craft}` : seat.driver === 0 ? `Nobody drives ${seat.craft}` : `${seat.name} drives ${seat.craft}`;
    this.take.textContent = drives ? 'Leave the helm' : 'Take the helm';
    this.take.disabled = !isConnected || !seat || (seat.driver !== 0 && !drives);
    for (const slider of this.all) slider.disabled = !drives;
  }
}
