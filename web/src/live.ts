import { Cockpit, type Craft } from './cockpit';
import type { Body } from './data';
import { element } from './dom';
import { LiveClock } from './live_clock';
import { LiveRun } from './live_data';
import { LiveLink, type LinkState } from './live_link';
import { Pace } from './pace';
import { PathView } from './path_view';
import { PlotBoard } from './plots';
import { Player } from './player';
import type { Note, PaceNews, Scene, ServerMessage, State } from './protocol';
import { RunBar } from './run_bar';
import type { SceneView } from './scene';
import { toggleTheme } from './theme';
import { choiceOf, sceneOf, themeButton } from './views';

const SHOWN = 20; // s of simulated time that curves show
const DRIVE_EVERY = 50; // ms: the server stops a craft of which it hears nothing for 0.25 s
const PLOT_EVERY = 100; // ms
const PATH_EVERY = 250; // ms
const MOST_NOTES = 4;
const WORDS: Record<LinkState, string> = {
  connecting: 'connecting …',
  open: 'live',
  lost: 'connection lost: trying again',
  foreign: 'this page is older or newer than its server: load it again',
};

/** What is built of a scene. */
interface Stage {
  run: LiveRun;
  player: Player;
  clock: LiveClock;
  view: SceneView | undefined;
  path: PathView;
  board: PlotBoard;
  craft: Craft[];
  newest: State | undefined;
}

/** The page that is fed live. */
class LivePage {
  private readonly status = element('span', { class: 'chip status', role: 'status' });
  private readonly viewers = element('span', { class: 'chip' });
  private readonly notes = element('ul', { class: 'notes', 'aria-live': 'polite' });
  private readonly main = element('main');
  private readonly cockpit: Cockpit;
  private readonly bar: RunBar;
  private readonly link: LiveLink;
  private readonly pace = new Pace();
  private stage: Stage | undefined;
  private news: PaceNews | undefined;
  private state: LinkState = 'connecting';
  private before = performance.now();
  private plottedAt = 0;
  private pathAt = 0;

  constructor() {
    const send = (message: Parameters<LiveLink['send']>[0]): void => { this.link.send(message); };
    this.cockpit = new Cockpit(send, (craft) => this.appliedTo(craft));
    this.bar = new RunBar(send);
    const name = element('input', { type: 'text', maxlength: '24', placeholder: 'your name', 'aria-label': 'your name' });
    name.addEventListener('change', () => { send({ op: 'name', name: name.value }); });
    this.naming = () => { if (name.value !== '') send({ op: 'name', name: name.value }); };
    document.body.append(
      element('header', {}, element('h1', {}, 'hovercraft_sim'), element('div', { class: 'chips' }, this.status, this.viewers), name, themeButton()),
      this.main,
      this.bar.root,
    );
    this.link = new LiveLink({ onMessage: (message) => { this.take(message); }, onState: (state) => { this.onState(state); } });
    window.addEventListener('keydown', (event) => { this.onKey(event); });
    window.setInterval(() => { this.cockpit.drive(); }, DRIVE_EVERY);
    requestAnimationFrame((now) => { this.frame(now); });
  }
  private readonly naming: () => void;

  private onState(state: LinkState): void {
    this.state = state;
    if (state === 'lost' || state === 'foreign') {
      this.news = undefined;
      this.bar.show(undefined);
      this.cockpit.part();
    }
    this.showStatus();
  }
  private showStatus(): void {
    const isGone = this.state === 'open' && this.news?.there === false;
    this.status.textContent = isGone ? 'the simulation does not answer' : WORDS[this.state];
    this.status.classList.toggle('bad', isGone || this.state !== 'open');
  }

  private take(message: ServerMessage): void {
    switch (message.type) {
      case 'hello':
        this.naming();
        this.cockpit.welcome(message.you);
        break;
      case 'scene':
        this.build(message);
        break;
      case 'state':
        this.takeState(message);
        break;
      case 'pace':
        this.news = message;
        this.bar.show(message);
        if (this.stage) this.stage.player.playing = !message.paused;
        this.showStatus();
        break;
      case 'seats':
        this.viewers.textContent = message.viewers === 1 ? '1 viewer' : `${message.viewers} viewers`;
        this.cockpit.showSeats(message);
        break;
      case 'note':
        this.showNote(message);
        break;
    }
  }

  private showNote({ text, failure }: Note): void {
    this.notes.prepend(element('li', failure ? { class: 'bad' } : {}, text));
    while (this.notes.childElementCount > MOST_NOTES) this.notes.lastElementChild?.remove();
  }

  private takeState(state: State): void {
    const { stage } = this;
    if (!stage) return;
    stage.newest = state;
    stage.run.take(state);
    stage.clock.take(state.t);
    stage.player.end = Math.max(state.t, 1e-3);
  }

  private appliedTo(name: string): readonly (number | null)[] {
    const i = this.stage?.craft.findIndex((craft) => craft.name === name) ?? -1;
    return this.stage?.newest?.applied[i] ?? [];
  }

  /** A scene, also after a connection was lost: everything begins anew. */
  private build(scene: Scene): void {
    this.stage?.view?.dispose();
    const run = new LiveRun(scene);
    const player = new Player(1e-3);
    player.playing = true;
    const { view, root } = sceneOf(run.report, player, true);
    const path = new PathView(run.report, player, true);
    const board = new PlotBoard(player, true);
    const bodies = run.report.runs[0]?.bodies ?? [];
    const craft = scene.controls.map((controls, i) => ({ name: bodies[i]?.name ?? '', controls }));
    this.stage = { run, player, clock: new LiveClock(), view, path, board, craft, newest: undefined };
    this.main.replaceChildren(
      element('div', { class: 'stage' }, root, path.root),
      ...(bodies.length > 1 ? [choiceOf(bodies, (body) => { this.choose(body); })] : []),
      this.cockpit.root,
      this.notes,
      board.root,
    );
    this.choose(bodies[0]);
  }

  private choose(body: Body | undefined): void {
    const { stage } = this;
    if (!stage || !body) return;
    stage.view?.follow(body);
    if (!body.craft) return; // its driver stays at the helm
    stage.board.show(body.panels.map((panel) => ({ panel, other: undefined })));
    this.cockpit.choose(stage.craft.find(({ name }) => name === body.name));
  }

  private onKey(event: KeyboardEvent): void {
    const { target, key } = event;
    const isElsewhere = target instanceof HTMLButtonElement || target instanceof HTMLSelectElement || (target instanceof HTMLInputElement && target.type !== 'range');
    if (isElsewhere || event.repeat || event.ctrlKey || event.metaKey || event.altKey) return;
    if (key === 'l') toggleTheme();
    if (key !== ' ') return;
    event.preventDefault();
    this.bar.toggle();
  }

  private frame(now: number): void {
    requestAnimationFrame((next) => { this.frame(next); });
    const seconds = Math.min(0.25, Math.max(0, (now - this.before) / 1000));
    this.before = now;
    this.pace.next(seconds);
    if (this.stage) this.draw(this.stage, seconds, now);
  }

  private draw({ player, clock, view, path, board }: Stage, seconds: number, now: number): void {
    const factor = this.news?.paused ? 0 : this.news?.wanted || this.news?.reached || 1;
    const shown = clock.advance(seconds, factor);
    if (shown !== player.time) player.seek(shown);
    if (now - this.pathAt > PATH_EVERY) {
      this.pathAt = now;
      view?.grow();
      path.grow();
    }
    view?.draw();
    if (this.pace.hasTime) path.draw();
    if (now - this.plottedAt > PLOT_EVERY && this.pace.hasTime) {
      this.plottedAt = now;
      if (player.playing) board.grow(Math.max(0, shown - SHOWN), Math.max(SHOWN, shown));
    }
    board.draw();
    this.bar.showTime(player.shown, now);
  }
}

/** Shows a simulation as it runs. */
export function startLive(): void {
  new LivePage();
}
