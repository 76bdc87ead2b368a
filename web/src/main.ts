import { reportOf, type Body, type PackedReport, type Panel, type Report } from './data';
import { element } from './dom';
import { fileName } from './format';
import { listenToKeys } from './keys';
import { startLive } from './live';
import { Pace } from './pace';
import { PathView } from './path_view';
import { PlotBoard, type PlotRequest } from './plots';
import { Player } from './player';
import type { SceneView } from './scene';
import style from './style.css';
import { contactsSection, differenceSection, ledgerSection, manoeuvreSection, runSection } from './tables';
import { Timeline } from './timeline';
import { choiceOf, sceneOf, themeButton } from './views';
import uplotStyle from 'uplot/dist/uPlot.min.css';

/** The same panel of the second run. */
function otherOf(panel: Panel, panels: readonly Panel[]): Panel | undefined {
  return panels.find(({ title, source }) => title === panel.title && source === panel.source)
    ?? panels.find(({ title, main }) => panel.main && main && title === panel.title);
}

/** Everything that is plotted while a body is looked at. */
function requestsOf({ runs, comparison }: Report, body: Body | undefined): PlotRequest[] {
  const [first, second] = runs;
  const partner = second?.bodies.find(({ name }) => name === body?.name) ?? (second?.bodies.length === 1 ? second.bodies[0] : undefined);
  const difference = comparison.find(({ name }) => name === body?.name);
  const own = (body?.panels ?? []).map((panel) => ({ panel, other: otherOf(panel, partner?.panels ?? []) }));
  return [
    ...(difference?.panels ?? []).map((panel) => ({ panel, other: undefined })),
    ...own.filter(({ panel }) => panel.main),
    ...own.filter(({ panel }) => !panel.main),
    ...(first?.panels ?? []).map((panel) => ({ panel, other: otherOf(panel, second?.panels ?? []) })),
  ];
}

function headerOf(report: Report): HTMLElement {
  const [first, second] = report.runs;
  const title = [first, second].flatMap((run) => (run ? [fileName(run.source)] : [])).join('  against  ');
  document.title = `${title}: report`;
  const chips = (first?.facts ?? []).filter(([label]) => !label.includes('hash')).slice(0, 5).map(([label, value]) =>
    element('span', { class: 'chip' }, element('small', {}, label), value));
  return element('header', {}, element('h1', {}, title), element('div', { class: 'chips' }, ...chips), themeButton());
}

function tablesOf(report: Report, player: Player): HTMLElement {
  const [first] = report.runs;
  return element(
    'div',
    { class: 'cards' },
    ...report.comparison.map((difference) => differenceSection(difference, player)),
    ...(first && first.contacts.length > 0 ? [contactsSection(first, player)] : []),
    ...report.runs.flatMap((run, i) =>
      run.manoeuvres.map((each) => manoeuvreSection(each, report.runs.length > 1 ? `${'AB'[i] ?? ''}: ` : '', player)),
    ),
    ...(first?.bodies ?? []).flatMap((body) => (body.ledger ? [ledgerSection(body, body.ledger)] : [])),
    ...report.runs.map((run) => runSection(run, report.stride)),
  );
}

function show(report: Report): void {
  const [first] = report.runs;
  const player = new Player(Math.max(1e-3, ...report.runs.map((run) => run.end)));
  const timeline = new Timeline(first, player);
  const { view, root } = sceneOf(report, player);
  const path = new PathView(report, player);
  const board = new PlotBoard(player);
  const bodies = first?.bodies ?? [];
  const choose = (body: Body | undefined): void => {
    board.show(requestsOf(report, body));
    view?.follow(body);
  };
  document.body.append(
    headerOf(report),
    element(
      'main',
      {},
      element('div', { class: 'stage' }, root, path.root),
      ...(bodies.length > 1 ? [choiceOf(bodies, choose)] : []),
      board.root,
      tablesOf(report, player),
    ),
    timeline.root,
  );
  choose(bodies[0]);
  listenToKeys(player, timeline, first?.contacts ?? []);
  playOn(player, view, [path, board, timeline]);
}

/** Draws what has changed, picture by picture. */
function playOn(player: Player, view: SceneView | undefined, others: { draw: () => void }[]): void {
  const pace = new Pace();
  let before = performance.now();
  const frame = (now: number): void => {
    const seconds = (now - before) / 1000;
    before = now;
    pace.next(seconds);
    player.advance(Math.min(0.25, Math.max(0, seconds)));
    view?.draw();
    if (!player.playing || pace.hasTime) {
      for (const other of others) other.draw();
    }
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}

function start(): void {
  document.head.append(element('style', {}, uplotStyle, style));
  if (document.body.hasAttribute('data-live')) {
    startLive();
    return;
  }
  const text = document.getElementById('data')?.textContent ?? '';
  try {
    show(reportOf(JSON.parse(text) as PackedReport));
  } catch (error) {
    document.body.append(element('p', { class: 'failure' }, `This page cannot be shown: ${String(error)}`));
    throw error;
  }
}

start();
