import type { Body, Contact, Difference, Ledger, Manoeuvre, Run } from './data';
import { element } from './dom';
import { numberText, timeText } from './format';
import { measuresOf } from './measures';
import type { Player } from './player';

const MOST_ROWS = 500;

function table(heads: string[], rows: HTMLTableRowElement[]): HTMLElement {
  return element(
    'div',
    { class: 'scroll' },
    element(
      'table',
      {},
      element('thead', {}, element('tr', {}, ...heads.map((head) => element('th', { scope: 'col' }, head)))),
      element('tbody', {}, ...rows),
    ),
  );
}

function section(title: string, ...children: (HTMLElement | string)[]): HTMLElement {
  return element('section', { class: 'card' }, element('h2', {}, title), ...children);
}

function impulseOf({ impulse }: Contact): number {
  return Math.hypot(...impulse);
}

/** Contacts in the order of their times; a click goes to one. */
export function contactsSection({ contacts }: Run, player: Player): HTMLElement {
  const rows = contacts.slice(0, MOST_ROWS).map((contact) => {
    const button = element('button', { type: 'button', class: 'link' }, timeText(contact.time));
    const row = element(
      'tr',
      { class: 'clickable' },
      element('td', {}, button),
      element('td', {}, contact.kind),
      element('td', {}, `${contact.a} – ${contact.b}`),
      element('td', { class: 'number' }, numberText(impulseOf(contact), 3)),
      element('td', { class: 'number' }, contact.point.map((value) => numberText(value, 3)).join(', ')),
    );
    row.addEventListener('click', () => { player.seek(contact.time); });
    return row;
  });
  const made = section('Contacts', table(['time', 'kind', 'bodies', 'impulse (N s)', 'at (m)'], rows));
  if (contacts.length > MOST_ROWS) made.append(element('p', {}, `The first ${MOST_ROWS} of ${contacts.length}.`));
  return made;
}

/** What a manoeuvre came to; a click goes to its first execute. */
export function manoeuvreSection({ craft, name, kind, complete, time, end, text }: Manoeuvre, whose: string, player: Player): HTMLElement {
  const button = element('button', { type: 'button', class: 'link' }, timeText(time));
  button.addEventListener('click', () => { player.seek(time); });
  const list = element('dl', {}, ...measuresOf(text).flatMap(([label, value]) => [element('dt', {}, label), element('dd', {}, value)]));
  const made = section(`${whose}${name}`, element('p', {}, `${craft}, ${kind}: `, button, ` to ${timeText(end)}`));
  if (!complete) made.append(element('p', { class: 'note' }, text.split('\n')[0] ?? ''));
  made.append(list);
  return made;
}

const LEDGER_ROWS: [keyof Ledger, string][] = [
  ['begin', 'at the first state'],
  ['engines', 'work of the engines'],
  ['drag', 'work of the drag'],
  ['contacts', 'at contacts'],
  ['others', 'all else: cushion, pushes, resets, the steps of these sums'],
  ['end', 'at the last state'],
];

/** Where the energy of a craft came from and went. */
export function ledgerSection({ name }: Body, ledger: Ledger): HTMLElement {
  const most = Math.max(...LEDGER_ROWS.map(([key]) => Math.abs(ledger[key])), 1e-300);
  const rows = LEDGER_ROWS.map(([key, label]) => {
    const isState = key === 'begin' || key === 'end';
    const bar = element('span', { class: ledger[key] < 0 ? 'bar loss' : 'bar' });
    bar.style.width = `${(100 * Math.abs(ledger[key])) / most}%`;
    return element(
      'tr',
      isState ? { class: 'sum' } : {},
      element('td', {}, label),
      element('td', { class: 'number' }, `${!isState && ledger[key] > 0 ? '+' : ''}${numberText(ledger[key])}`),
      element('td', { class: 'bars' }, bar),
    );
  });
  return section(`Energy of ${name}`, table(['', 'J', ''], rows));
}

/** What two runs have to do with each other. */
export function differenceSection({ name, greatest, greatestTime, rms, greatestAttitude, parted }: Difference, player: Player): HTMLElement {
  const made = section(`A and B: ${name}`);
  if (parted) {
    const button = element('button', { type: 'button', class: 'link' }, timeText(parted.time));
    button.addEventListener('click', () => { player.seek(parted.time); });
    made.append(element('p', {}, 'They part at ', button, `: ${parted.quantity} is ${parted.a} in A and ${parted.b} in B.`));
  } else {
    made.append(element('p', {}, 'Every pose at a time that both have is the same to the last bit.'));
  }
  made.append(
    element(
      'p',
      {},
      `Greatest difference ${numberText(greatest)} m (at ${timeText(greatestTime)}) and ${numberText(greatestAttitude)} rad; ` +
        `root mean square ${numberText(rms)} m.`,
    ),
  );
  return made;
}

/** What is known of a run besides curves. */
export function runSection({ source, facts, notes, scenario, marks }: Run, stride: number): HTMLElement {
  const list = element('dl', {}, ...facts.flatMap(([label, value]) => [element('dt', {}, label), element('dd', {}, value)]));
  const made = section(source, list);
  for (const { time, text } of marks.slice(0, MOST_ROWS)) made.append(element('p', {}, `${timeText(time)}: ${text}`));
  for (const note of notes) made.append(element('p', { class: 'note' }, note));
  made.append(
    element(
      'p',
      { class: 'note' },
      'Curves and ways are rounded for this picture: to 1/65,534 of the range of a curve, positions to 1/1,048,574.' +
        (stride > 1 ? ` Of long recordings every ${stride}th sample is drawn.` : '') +
        ' The bag has every bit.',
    ),
  );
  if (scenario) made.append(element('details', {}, element('summary', {}, 'Scenario'), element('pre', {}, scenario)));
  return made;
}
