/** Colours that people who see fewer of them tell apart: Okabe and Ito 2008, lighter ones on a dark page. */

export interface Theme {
  dark: boolean;
  /** Of curves and bodies, in order. */
  series: string[];
  text: string;
  muted: string;
  grid: string;
  panel: string;
  ground: string;
  sky: string;
  lines: string;
  obstacle: string;
  body: string;
  alarm: string;
  skirt: string;
}

const LIGHT: Theme = {
  dark: false,
  series: ['#0072b2', '#d55e00', '#009e73', '#b0568f', '#8a6d00', '#2a8fc4', '#444444'],
  text: '#1b2430',
  muted: '#5d6b7a',
  grid: '#e3e8ee',
  panel: '#ffffff',
  ground: '#e9edf1',
  sky: '#f7f9fb',
  lines: '#c3ccd6',
  obstacle: '#9aa5b1',
  body: '#b8935a',
  alarm: '#c0392b',
  skirt: '#4a525b',
};

const DARK: Theme = {
  dark: true,
  series: ['#56b4e9', '#f0883e', '#2fc49a', '#e39ac9', '#f0e442', '#9ecbff', '#cccccc'],
  text: '#e6ebf1',
  muted: '#93a1b1',
  grid: '#2a333e',
  panel: '#161c23',
  ground: '#1a212a',
  sky: '#0f141a',
  lines: '#35414e',
  obstacle: '#5e6a77',
  body: '#c9a46a',
  alarm: '#ff7b72',
  skirt: '#707b87',
};

const query = '(prefers-color-scheme: dark)';

/** What the reader chose on this page, else what the system says; paper is white. */
export function currentTheme(): Theme {
  const chosen = document.documentElement.dataset['theme'];
  const isDark = chosen === undefined ? window.matchMedia(query).matches : chosen === 'dark';
  return isDark && !window.matchMedia('print').matches ? DARK : LIGHT;
}

export function toggleTheme(): void {
  document.documentElement.dataset['theme'] = currentTheme().dark ? 'light' : 'dark';
}

/** Calls `listener` when the page becomes dark or light. */
export function onThemeChange(listener: () => void): void {
  window.matchMedia(query).addEventListener('change', listener);
  window.matchMedia('print').addEventListener('change', listener);
  new MutationObserver(listener).observe(document.documentElement, { attributes: true, attributeFilter: ['data-theme'] });
}

/** The colour of the i-th thing. */
export function seriesColour(theme: Theme, i: number): string {
  return theme.series[i % theme.series.length] ?? theme.text;
}
