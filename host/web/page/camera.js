// SPDX-License-Identifier: Apache-2.0
// A camera that goes round a point: from metres to the pixels of a sheet, nearer things larger.
const kHome = { yaw: -0.9, pitch: 0.32 };
const kFarthestPitch = 1.5;

export class Camera {
  constructor() {
    this.home();
  }

  home() {
    this.yaw = kHome.yaw;
    this.pitch = kHome.pitch;
  }

  /// Turns by radians, never over the top.
  turn(yaw, pitch) {
    this.yaw = (this.yaw + yaw) % (2 * Math.PI);
    this.pitch = Math.min(kFarthestPitch, Math.max(-kFarthestPitch, this.pitch + pitch));
  }

  /// Where the camera stands, seen from what it looks at: degrees anticlockwise from x, and degrees above the ground.
  get direction() {
    const degrees = 180 / Math.PI;
    return [Math.atan2(-Math.cos(this.yaw), Math.sin(this.yaw)) * degrees, this.pitch * degrees];
  }

  /// A function from a point [x, y, z] to { x, y } on a sheet of `width` by `height`, such that a ball of `radius`
  /// about `centre` fits.
  projection(centre, radius, width, height) {
    const [cosYaw, sinYaw] = [Math.cos(this.yaw), Math.sin(this.yaw)];
    const [cosPitch, sinPitch] = [Math.cos(this.pitch), Math.sin(this.pitch)];
    const distance = 4 * radius;
    const scale = (Math.min(width, height) / 2) * (Math.sqrt(distance * distance - radius * radius) / radius);
    return (point) => {
      const [x, y, z] = point.map((value, i) => value - centre[i]);
      const right = x * cosYaw + y * sinYaw;
      const away = -x * sinYaw + y * cosYaw;
      const up = z * cosPitch + away * sinPitch;
      const depth = distance + away * cosPitch - z * sinPitch;
      return { x: width / 2 + (scale * right) / depth, y: height / 2 - (scale * up) / depth };
    };
  }
}
