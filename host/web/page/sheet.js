// SPDX-License-Identifier: Apache-2.0
// A canvas in CSS pixels, sharp on every screen.

const kEye_px = 0.7;
const kShades = 24;

/// Clears `canvas` and returns its context, scaled to CSS pixels, with `width` and `height` in them.
export function cleanSheet(canvas) {
  const ratio = devicePixelRatio;
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  context.lineJoin = 'round';
  context.lineCap = 'round';
  return { context, width, height };
}

/// Appends `point` ({x, y}, or null for a break) unless the eye cannot tell it from the one before.
export function addToTrail(points, point) {
  const last = points[points.length - 1];
  if (!point || !last || Math.hypot(point.x - last.x, point.y - last.y) >= kEye_px) {
    points.push(point);
  }
}

/// Strokes `points` ({x, y} or null for a break), oldest first, as a trail that fades to nothing.
export function fadingTrail(context, points, colour, lineWidth) {
  context.lineWidth = lineWidth;
  context.strokeStyle = colour;
  for (let shade = 0; shade < kShades; ++shade) {
    const from = Math.floor((shade * points.length) / kShades);
    const to = Math.min(points.length - 1, Math.floor(((shade + 1) * points.length) / kShades));
    context.globalAlpha = ((shade + 1) / kShades) ** 1.6;
    context.beginPath();
    let drawing = false;
    for (let i = from; i <= to; ++i) {
      const point = points[i];
      if (point && drawing) {
        context.lineTo(point.x, point.y);
      } else if (point) {
        context.moveTo(point.x, point.y);
      }
      drawing = point !== null;
    }
    context.stroke();
  }
  context.globalAlpha = 1;
}
