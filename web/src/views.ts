import type { Body, Report } from './data';
import { element } from './dom';
import type { Player } from './player';
import { SceneView } from './scene';
import { currentTheme, onThemeChange, seriesColour, toggleTheme } from './theme';

/** A button that makes the page light or dark. */
export function themeButton(): HTMLElement {
  const button = element('button', { type: 'button', class: 'quiet', title: 'Light or dark (l)', 'aria-label': 'light or dark' }, '◐');
  button.addEventListener('click', toggleTheme);
  return button;
}

/** Buttons for the bodies of a run; the plots and the camera go with the chosen one. */
export function choiceOf(bodies: readonly Body[], choose: (body: Body) => void): HTMLElement {
  const dots: HTMLElement[] = [];
  const buttons = bodies.map((body) => {
    const dot = element('span', { class: 'dot' });
    dots.push(dot);
    const button = element('button', { type: 'button', class: 'choice', 'aria-pressed': 'false' }, dot, body.name);
    button.addEventListener('click', () => {
      for (const each of buttons) each.setAttribute('aria-pressed', String(each === button));
      choose(body);
    });
    return button;
  });
  const colour = (): void => {
    const theme = currentTheme();
    bodies.forEach((body, i) => {
      dots[i]?.style.setProperty('background', body.craft ? seriesColour(theme, i) : theme.body);
    });
  };
  colour();
  onThemeChange(colour);
  buttons[0]?.setAttribute('aria-pressed', 'true');
  return element('nav', { class: 'choices', 'aria-label': 'Bodies' }, ...buttons);
}

/** The view in three dimensions; nothing, with a word about it, where there is no WebGL. */
export function sceneOf(report: Report, player: Player, isLive = false): { view: SceneView | undefined; root: HTMLElement } {
  try {
    const view = new SceneView(report, player, isLive);
    return { view, root: view.root };
  } catch {
    return { view: undefined, root: element('div', { class: 'view empty' }, 'This browser draws nothing in three dimensions (no WebGL).') };
  }
}
