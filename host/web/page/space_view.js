// SPDX-License-Identifier: Apache-2.0
// The pendulum in space, to scale: pivot, rod, disc, sensors, mass, its trail and their shadow on the ground.
import { Camera } from './camera.js';
import { addToTrail, cleanSheet, fadingTrail } from './sheet.js';
import { curveColour, faded, theme } from './theme.js';

const kTurn_rad = Math.PI / 36;
const kTurnPerPixel_rad = 0.008;
const kKeys = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class SpaceView {
  /// `rig` as `session` has it; `onTurn` is called when the view was turned.
  constructor(section, rig, onTurn) {
    this.canvas = section.querySelector('canvas');
    this.rig = rig;
    this.camera = new Camera();
    this.onTurn = onTurn;
    this.canvas.addEventListener('keydown', (event) => this.key(event));
    this.canvas.addEventListener('pointerdown', (event) => this.canvas.setPointerCapture(event.pointerId));
    this.canvas.addEventListener('pointermove', (event) => this.drag(event));
    this.canvas.addEventListener('dblclick', () => this.goHome());
  }

  key(event) {
    const turn = kKeys[event.key];
    if (turn) {
      this.camera.turn(turn[0] * kTurn_rad, turn[1] * kTurn_rad);
      this.onTurn();
    } else if (event.key === 'Home') {
      this.goHome();
    } else {
      return;
    }
    event.preventDefault();
  }

  drag(event) {
    if (this.canvas.hasPointerCapture(event.pointerId)) {
      this.camera.turn(-event.movementX * kTurnPerPixel_rad, event.movementY * kTurnPerPixel_rad);
      this.onTurn();
    }
  }

  goHome() {
    this.camera.home();
    this.onTurn();
  }

  /// Rows [from, to) of `series` as the trail, the mass at row `now` (-1: nowhere).
  draw(series, from, to, now) {
    const { context, width, height } = cleanSheet(this.canvas);
    const length = this.rig.length_m;
    const project = this.camera.projection([0, 0, -0.55 * length], 0.66 * length, width, height);
    const ground = -1.08 * length;
    const { x, y, z } = series.columns;
    const point = (row) => [x[row] / 1000, y[row] / 1000, z[row] / 1000];
    const answered = (row) => row >= 0 && !Number.isNaN(x[row]) && !Number.isNaN(z[row]);
    const trail = [];
    const shadow = [];
    for (let row = from; row < to; ++row) {
      const [px, py, pz] = point(row);
      addToTrail(trail, answered(row) ? project([px, py, pz]) : null);
      addToTrail(shadow, answered(row) ? project([px, py, ground]) : null);
    }
    this.drawGround(context, project, ground, length);
    fadingTrail(context, shadow, faded(theme.quiet, 0.45), 1.25);
    const mass = answered(now) ? point(now) : [0, 0, -length];
    this.drawDisc(context, project, mass);
    this.drawRod(context, project, mass, answered(now));
    fadingTrail(context, trail, theme.ink, 2);
    this.drawMass(context, project, mass, answered(now), length);
  }

  drawGround(context, project, ground, length) {
    context.strokeStyle = theme.grid;
    context.lineWidth = 1;
    for (const radius of [0.13, 0.26, 0.39]) {
      polygon(context, circle([0, 0, ground], [1, 0, 0], [0, 1, 0], radius * length).map(project));
      context.stroke();
    }
    context.fillStyle = theme.quiet;
    context.font = `12px ${theme.font}`;
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    for (const [name, end] of [['x', [0.39, 0]], ['y', [0, 0.39]]]) {
      const [ex, ey] = end.map((value) => value * length);
      line(context, project([-ex, -ey, ground]), project([ex, ey, ground]));
      const label = project([1.13 * ex, 1.13 * ey, ground]);
      context.fillText(name, label.x, label.y);
    }
  }

  drawRod(context, project, mass, answered) {
    const pivot = project([0, 0, 0]);
    context.strokeStyle = answered ? theme.ink : theme.grid;
    context.lineWidth = 2;
    line(context, pivot, project(mass));
    const half = 0.12 * this.rig.length_m;
    context.strokeStyle = theme.quiet;
    context.lineWidth = 3;
    line(context, project([-half, 0, 0]), project([half, 0, 0]));
    line(context, project([0, -half, 0]), project([0, half, 0]));
    context.fillStyle = theme.ink;
    dot(context, pivot, 3);
  }

  /// The disc, perpendicular to the rod, and each sensor with its beam straight down to it.
  drawDisc(context, project, mass) {
    const { disc, sensors } = this.rig;
    if (!disc) {
      return;
    }
    const norm = Math.hypot(...mass);
    const along = mass.map((value) => value / norm);
    const centre = along.map((value) => value * disc.offset_m);
    const first = normalised([-along[2], 0, along[0]]);
    const second = cross(along, first);
    polygon(context, circle(centre, first, second, disc.diameter_m / 2).map(project));
    context.fillStyle = faded(theme.quiet, 0.16);
    context.fill();
    context.strokeStyle = theme.quiet;
    context.lineWidth = 1.25;
    context.stroke();
    sensors.forEach(({ x_m, y_m, z_m }, i) => {
      const seen_m = (disc.offset_m - along[0] * x_m - along[1] * y_m) / along[2];
      const face = project([x_m, y_m, z_m]);
      context.strokeStyle = curveColour(i);
      context.fillStyle = curveColour(i);
      context.lineWidth = 1.5;
      line(context, face, project([x_m, y_m, seen_m]));
      context.fillRect(face.x - 4, face.y - 6, 8, 6);
    });
  }

  drawMass(context, project, mass, answered, length) {
    const at = project(mass);
    const edge = project([mass[0], mass[1], mass[2] + 0.035 * length]);
    const radius = Math.max(5, Math.hypot(edge.x - at.x, edge.y - at.y));
    context.fillStyle = answered ? theme.ink : theme.grid;
    dot(context, at, radius);
    context.strokeStyle = theme.paper;
    context.lineWidth = 1.5;
    context.stroke();
  }
}

function circle(centre, first, second, radius) {
  return Array.from({ length: 64 }, (_, i) => {
    const [c, s] = [radius * Math.cos((i * Math.PI) / 32), radius * Math.sin((i * Math.PI) / 32)];
    return centre.map((value, axis) => value + c * first[axis] + s * second[axis]);
  });
}

function normalised(vector) {
  const norm = Math.hypot(...vector);
  return vector.map((value) => value / norm);
}

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function polygon(context, points) {
  context.beginPath();
  points.forEach(({ x, y }) => context.lineTo(x, y));
  context.closePath();
}

function line(context, from, to) {
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(to.x, to.y);
  context.stroke();
}

function dot(context, { x, y }, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fill();
}
