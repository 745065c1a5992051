// SPDX-License-Identifier: Apache-2.0
// The colours and the font of the style sheet, for what is drawn on canvas.
const kNames = ['paper', 'ink', 'quiet', 'rule', 'grid', 'first', 'second', 'third', 'fourth', 'ellipse'];

/// What the style sheet says now, by name; kept up with the system's choice of light or dark.
export const theme = {};

/// The colour of the i-th curve, sensor or angle.
export function curveColour(i) {
  return theme[['first', 'second', 'third', 'fourth'][i % 4]];
}

/// `colour` (#rrggbb) with an opacity of 0 to 1.
export function faded(colour, opacity) {
  return colour + Math.round(255 * opacity).toString(16).padStart(2, '0');
}

/// Reads the colours; calls `onChange` whenever they change.
export function followTheme(onChange) {
  const read = () => {
    const style = getComputedStyle(document.documentElement);
    for (const name of kNames) {
      theme[name] = style.getPropertyValue(`--${name}`).trim();
    }
    theme.font = getComputedStyle(document.body).fontFamily;
  };
  read();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    read();
    onChange();
  });
}
