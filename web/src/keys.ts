import type { Contact } from './data';
import type { Player } from './player';
import { toggleTheme } from './theme';

/** What keys can change besides the player. */
export interface Speeds {
  change(step: number): void;
}

/** The time of the next contact after (or before) a time. */
export function neighbour(contacts: readonly Pick<Contact, 'time'>[], time: number, forward: boolean): number | undefined {
  const slack = 1e-6; // s: not the one that is shown
  if (forward) return contacts.find((contact) => contact.time > time + slack)?.time;
  return [...contacts].reverse().find((contact) => contact.time < time - slack)?.time;
}

/** What a key does; nothing for one that has no meaning here. */
export function actionOf(key: string, isFast: boolean, player: Player, speeds: Speeds, contacts: readonly Contact[]): (() => void) | undefined {
  const step = isFast ? 1 : 0.1; // s
  const toContact = (forward: boolean) => (): void => {
    const time = neighbour(contacts, player.time, forward);
    if (time !== undefined) player.seek(time);
  };
  const actions: Record<string, () => void> = {
    ' ': () => { player.toggle(); },
    ArrowLeft: () => { player.seek(player.time - step); },
    ArrowRight: () => { player.seek(player.time + step); },
    Home: () => { player.seek(0); },
    End: () => { player.seek(player.end); },
    '+': () => { speeds.change(1); },
    '-': () => { speeds.change(-1); },
    n: toContact(true),
    p: toContact(false),
    l: toggleTheme,
  };
  return actions[key];
}

/** Space plays and pauses, arrows go 0.1 s (with shift 1 s), Home and End to the ends, n and p to the next and the previous contact. */
export function listenToKeys(player: Player, speeds: Speeds, contacts: readonly Contact[]): void {
  window.addEventListener('keydown', (event) => {
    const { target } = event;
    const isTyping = target instanceof HTMLSelectElement || (target instanceof HTMLInputElement && event.key !== ' ');
    if (isTyping || event.ctrlKey || event.metaKey || event.altKey) return;
    if (target instanceof HTMLButtonElement && event.key === ' ') return; // it presses the button
    const action = actionOf(event.key, event.shiftKey, player, speeds, contacts);
    if (!action) return;
    event.preventDefault();
    action();
  });
}
