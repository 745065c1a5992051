// SPDX-License-Identifier: Apache-2.0
// Draws what changed and can be seen, once a frame; once a second for those who asked for less motion.
const kCalm_ms = 1000;

export class Painter {
  constructor() {
    this.views = new Map();
    this.scheduled = false;
    this.timer = 0;
    this.latest_ms = -Infinity;
    this.calm = matchMedia('(prefers-reduced-motion: reduce)');
    this.sight = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) {
        const view = this.views.get(target);
        view.seen = isIntersecting;
        this.schedule();
      }
    }, { rootMargin: '100px' });
    this.size = new ResizeObserver((entries) => entries.forEach(({ target }) => this.changed(target)));
  }

  /// `draw` is called for `element` after changed(), while it is in sight.
  add(element, draw) {
    this.views.set(element, { draw, seen: true, dirty: true });
    this.sight.observe(element);
    this.size.observe(element);
    this.schedule();
  }

  /// `element`, or everything, is to be drawn anew; `atOnce` where a person turned it.
  changed(element = null, atOnce = false) {
    for (const [key, view] of this.views) {
      view.dirty ||= element === null || key === element;
    }
    if (atOnce) {
      this.latest_ms = -Infinity;
      if (this.timer) {
        clearTimeout(this.timer);
        this.goOn();
      }
    }
    this.schedule();
  }

  schedule() {
    if (!this.scheduled) {
      this.scheduled = true;
      requestAnimationFrame((now_ms) => this.frame(now_ms));
    }
  }

  /// A wait is over.
  goOn() {
    this.timer = 0;
    this.scheduled = false;
    this.schedule();
  }

  frame(now_ms) {
    this.scheduled = false;
    const views = [...this.views.values()].filter((view) => view.dirty && view.seen);
    const wait_ms = this.calm.matches ? kCalm_ms - (now_ms - this.latest_ms) : 0;
    if (views.length > 0 && wait_ms > 0) {
      this.scheduled = true;
      this.timer = setTimeout(() => this.goOn(), wait_ms);
      return;
    }
    this.latest_ms = views.length > 0 ? now_ms : this.latest_ms;
    for (const view of views) {
      view.dirty = false;
      view.draw();
    }
  }
}
