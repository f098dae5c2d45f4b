// Copyright 2026 The roller_sim_ros developers
// SPDX-License-Identifier: Apache-2.0

// Axes and lines on a canvas. A plot is drawn as a whole each time: it has at most as many points as pixels, some thousand.

const TICKS = [1, 2, 5, 10];

function step(span, most) {
  const rough = span / most;
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * TICKS.find((tick) => tick * power >= rough * 0.999);
}

export function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export class Plot {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.colours = {};
    this.readColours();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.readColours());
  }

  readColours() {
    for (const name of ["text", "soft", "rule", "grid", "card", "one", "two", "bad"]) this.colours[name] = colour(name);
    this.modes = [0, 1, 2, 3, 4, 5].map((mode) => colour(`mode-${mode}`));
  }

  // Begins a drawing: x and y are [low, high]; logarithmic y where asked for; equal scales where asked for.
  begin(x, y, { logarithmic = false, equal = false, below = 22 } = {}) {
    const { canvas, context } = this;
    const density = Math.min(window.devicePixelRatio || 1, 2);
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * density) || canvas.height !== Math.round(height * density)) {
      canvas.width = Math.round(width * density);
      canvas.height = Math.round(height * density);
    }
    context.setTransform(density, 0, 0, density, 0, 0);
    context.clearRect(0, 0, width, height);
    this.area = { left: 42, top: 6, width: width - 50, height: height - 6 - below };
    this.logarithmic = logarithmic;
    let [x0, x1] = x, [y0, y1] = logarithmic ? y.map(Math.log10) : y;
    if (equal) {
      const scale = Math.max((x1 - x0) / this.area.width, (y1 - y0) / this.area.height);
      const middleX = (x0 + x1) / 2, middleY = (y0 + y1) / 2;
      [x0, x1] = [middleX - scale * this.area.width / 2, middleX + scale * this.area.width / 2];
      [y0, y1] = [middleY - scale * this.area.height / 2, middleY + scale * this.area.height / 2];
    }
    this.x = [x0, x1];
    this.y = [y0, y1];
    this.axes();
  }

  atX(value) { return this.area.left + (value - this.x[0]) / (this.x[1] - this.x[0]) * this.area.width; }

  atY(value) {
    const at = this.logarithmic ? Math.log10(Math.max(value, 1e-30)) : value;
    return this.area.top + (this.y[1] - at) / (this.y[1] - this.y[0]) * this.area.height;
  }

  axes() {
    const { context, area } = this;
    context.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    context.lineWidth = 1;
    context.strokeStyle = this.colours.grid;
    context.fillStyle = this.colours.soft;
    context.textAlign = "center";
    context.textBaseline = "top";
    const stepX = step(this.x[1] - this.x[0], Math.max(2, area.width / 60));
    const digits = (size) => Math.max(0, -Math.floor(Math.log10(size) + 1e-9));
    context.beginPath();
    for (let n = Math.ceil(this.x[0] / stepX - 1e-9); n * stepX <= this.x[1] + 1e-9 * stepX; n++) {
      const at = this.atX(n * stepX);
      context.moveTo(at, area.top);
      context.lineTo(at, area.top + area.height);
      context.fillText((n * stepX).toFixed(digits(stepX)), at, area.top + area.height + 4);
    }
    context.textAlign = "right";
    context.textBaseline = "middle";
    const stepY = this.logarithmic ? Math.max(1, Math.round((this.y[1] - this.y[0]) / 4)) : step(this.y[1] - this.y[0], Math.max(2, area.height / 36));
    for (let n = Math.ceil(this.y[0] / stepY - 1e-9); n * stepY <= this.y[1] + 1e-9 * stepY; n++) {
      const at = area.top + (this.y[1] - n * stepY) / (this.y[1] - this.y[0]) * area.height;
      context.moveTo(area.left, at);
      context.lineTo(area.left + area.width, at);
      const label = this.logarithmic ? String(Number((10 ** (n * stepY)).toPrecision(3))) : (n * stepY).toFixed(digits(stepY));
      context.fillText(label, area.left - 5, at);
    }
    context.stroke();
  }

  // Draws inside the axes only.
  inside(draw) {
    const { context, area } = this;
    context.save();
    context.beginPath();
    context.rect(area.left, area.top, area.width, area.height);
    context.clip();
    draw(context);
    context.restore();
  }

  // A line; where an abscissa or ordinate is no number, or `gap` says so, it is broken.
  line(xs, ys, name, { width = 1.3, gap = () => false, scale = 1 } = {}) {
    this.inside((context) => {
      context.strokeStyle = this.colours[name];
      context.lineWidth = width;
      context.lineJoin = "round";
      context.beginPath();
      let down = false;
      for (let n = 0; n < xs.length; n++) {
        const at = this.atX(xs[n]), up = this.atY(ys[n] * scale);
        if (!Number.isFinite(at) || !Number.isFinite(up)) { down = false; continue; }
        if (down && !gap(n)) context.lineTo(at, up);
        else context.moveTo(at, up);
        down = true;
      }
      context.stroke();
    });
  }

  nothing(why) {
    this.begin([0, 1], [0, 1]);
    const { context, area } = this;
    context.clearRect(0, 0, this.canvas.clientWidth, this.canvas.clientHeight);
    context.fillStyle = this.colours.soft;
    context.textAlign = "center";
    context.fillText(why, area.left + area.width / 2, area.top + area.height / 2);
  }
}

// Low and high of numbers, with room on both sides; kept from `before` as long as they fit it well, so that axes do not tremble.
export function range(values, before, least) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (!(low <= high)) return before || [-least, least];
  const span = Math.max(high - low, least), middle = (low + high) / 2;
  if (before && low >= before[0] && high <= before[1] && span > 0.5 * (before[1] - before[0])) return before;
  return [middle - 0.62 * span, middle + 0.62 * span];
}
