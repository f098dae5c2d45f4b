// Copyright 2026 The roller_sim_ros developers
// SPDX-License-Identifier: Apache-2.0

// What the page draws of frames and maps.

import { Plot, range } from "./plot.js";

const GRAVITY = 9.81;
const SHOWN_S = 0.5;
const HELD = 8192;
const ROW = 5;
const MOST_ROWS = 12000;
const DRAWN_ROWS = 1500;
const HISTORY_EVERY_MS = 250;

const element = (id) => document.getElementById(id);

export class Charts {
  constructor() {
    this.plots = Object.fromEntries(["acceleration", "orbit", "loop", "spectrum", "map", "history"].map((id) => [id, new Plot(element(id))]));
    this.ranges = {};
    this.facts = null;
    this.latestMap = null;
    this.point = null;
    this.shownHistory = 0;
    this.forget();
    for (const choice of document.getElementsByName("over")) choice.addEventListener("change", () => { this.shownHistory = 0; });
  }

  forget() {
    this.time = new Float64Array(2 * HELD);
    this.vertical = new Float32Array(2 * HELD);
    this.horizontal = new Float32Array(2 * HELD);
    this.held = 0;
    this.rows = [];
    this.newest = {};
  }

  take(values, arrays) {
    if (values.anew) this.forget();
    const count = arrays.time.length;
    if (this.held + count > this.time.length) {
      const from = Math.max(0, this.held - HELD);
      for (const column of [this.time, this.vertical, this.horizontal]) column.copyWithin(0, from, this.held);
      this.held -= from;
    }
    for (let n = 0; n < count; n++) this.time[this.held + n] = values.time_s + arrays.time[n];
    this.vertical.set(arrays.vertical, this.held);
    this.horizontal.set(arrays.horizontal, this.held);
    this.held += count;
    for (let n = 0; n < arrays.rows.length; n += ROW) this.rows.push(arrays.rows.slice(n, n + ROW));
    if (this.rows.length > MOST_ROWS) this.rows.splice(0, this.rows.length - MOST_ROWS);
    this.newest = arrays;
  }

  draw(now) {
    this.drawAcceleration();
    this.drawOrbit();
    this.drawLoop();
    this.drawSpectrum();
    if (now - this.shownHistory < HISTORY_EVERY_MS) return;
    this.shownHistory = now;
    this.drawHistory();
    this.drawMap();
  }

  keptRange(name, values, least) {
    this.ranges[name] = range(values, this.ranges[name], least);
    return this.ranges[name];
  }

  drawAcceleration() {
    const plot = this.plots.acceleration;
    if (!this.held) return plot.nothing("no acceleration heard");
    const end = this.time[this.held - 1];
    let first = this.held - 1;
    while (first > 0 && this.time[first - 1] >= end - SHOWN_S) first--;
    const times = this.time.subarray(first, this.held);
    const vertical = this.vertical.subarray(first, this.held), horizontal = this.horizontal.subarray(first, this.held);
    const [low, high] = this.keptRange("acceleration", [...minMax(vertical), ...minMax(horizontal)], 0.2 * GRAVITY);
    plot.begin([end - SHOWN_S, end], [low / GRAVITY, high / GRAVITY]);
    const gap = (n) => times[n] - times[n - 1] > 0.02;
    plot.line(times, horizontal, "two", { gap, scale: 1 / GRAVITY });
    plot.line(times, vertical, "one", { gap, scale: 1 / GRAVITY });
  }

  drawOrbit() {
    const plot = this.plots.orbit, { forward, up } = this.newest;
    if (!forward?.length) return plot.nothing("the eccentric stands");
    plot.begin(this.keptRange("forward", forward, 0.1), this.keptRange("up", up, 0.1), { equal: true });
    plot.line(forward, up, "one");
  }

  drawLoop() {
    const plot = this.plots.loop, { up, force } = this.newest;
    if (!up?.length) return plot.nothing("the eccentric stands");
    const down = up.map((value) => -value);
    const [, high] = this.keptRange("force", force, 1);
    plot.begin(this.keptRange("down", down, 0.1), [-0.04 * high, high]);
    plot.line(down, force, "one");
  }

  drawSpectrum() {
    const plot = this.plots.spectrum, { spectrum } = this.newest;
    if (!spectrum?.length || !this.facts) return plot.nothing("no window of whole revolutions yet");
    const { highest_order: highest, window_revolutions: window, orders } = this.facts;
    const [low, high] = [1e-2, 1e3];
    plot.begin([0, highest + 0.25], [low, high], { logarithmic: true });
    const used = new Map();
    for (const order of orders.RMV) used.set(order, "two");
    for (const order of orders.CMV) used.set(order, "one");
    plot.inside((context) => {
      const bottom = plot.atY(low);
      for (let n = 1; n < spectrum.length; n++) {
        const order = n / window, name = used.get(order);
        context.strokeStyle = plot.colours[name || "soft"];
        context.lineWidth = name ? 3.5 : 1;
        context.beginPath();
        context.moveTo(plot.atX(order), bottom);
        context.lineTo(plot.atX(order), plot.atY(Math.max(spectrum[n], low)));
        context.stroke();
      }
    });
  }

  drawHistory() {
    const plot = this.plots.history, rows = this.rows;
    const over = document.querySelector("input[name=over]:checked").value;
    if (rows.length < 2) return plot.nothing("no meter value yet");
    const column = over === "time" ? 0 : 1;
    const stride = Math.ceil(rows.length / DRAWN_ROWS);
    // Counted from the end of the record, so that the same rows are drawn again and the line stands still.
    const drawn = rows.filter((_, n) => n % stride === 0);
    const xs = drawn.map((row) => row[column]);
    const [low, high] = minMax(xs);
    if (!(high > low)) return plot.nothing(over === "time" ? "no meter value yet" : "the roller stands");
    let top = 10;
    for (const row of drawn) for (const value of [row[2], row[3]]) if (value > top) top = value;
    plot.begin([low, high], [0, 1.05 * top], { below: 34 });
    const gap = over === "time" ? (n) => xs[n] - xs[n - 1] > 2 * stride : (n) => Math.abs(xs[n] - xs[n - 1]) > stride;
    plot.line(xs, drawn.map((row) => row[3]), "two", { gap });
    plot.line(xs, drawn.map((row) => row[2]), "one", { gap });
    const { context, area } = plot, y = area.top + area.height + 22;
    for (let n = 1; n < drawn.length; n++) {
      const from = plot.atX(xs[n - 1]), to = plot.atX(xs[n]);
      context.fillStyle = plot.modes[drawn[n][4]] || plot.modes[0];
      context.fillRect(Math.min(from, to), y, Math.abs(to - from) + 0.6, 9);
    }
  }

  drawMap() {
    const plot = this.plots.map, map = this.latestMap;
    if (!map) return plot.nothing("is being computed");
    const xs = map.frequencies_hz, ys = map.amplitudes_m.map((value) => 1e3 * value);
    const stepX = xs[1] - xs[0], stepY = ys[1] - ys[0];
    plot.begin([xs[0] - stepX / 2, xs.at(-1) + stepX / 2], [ys[0] - stepY / 2, ys.at(-1) + stepY / 2]);
    plot.inside((context) => {
      map.modes.forEach((row, r) => row.forEach((mode, c) => {
        const left = Math.floor(plot.atX(xs[c] - stepX / 2)), top = Math.floor(plot.atY(ys[r] + stepY / 2));
        context.fillStyle = plot.modes[mode];
        context.fillRect(left, top, Math.ceil(plot.atX(xs[c] + stepX / 2)) - left, Math.ceil(plot.atY(ys[r] - stepY / 2)) - top);
      }));
      if (!this.point) return;
      const x = plot.atX(this.point.frequency_hz), y = plot.atY(1e3 * this.point.amplitude_m);
      for (const [colour, width] of [[plot.colours.card, 6], [plot.colours.text, 2.5]]) {
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.beginPath();
        context.arc(x, y, 7, 0, 2 * Math.PI);
        context.moveTo(x - 13, y);
        context.lineTo(x + 13, y);
        context.moveTo(x, y - 13);
        context.lineTo(x, y + 13);
        context.stroke();
      }
    });
  }
}

function minMax(values) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}
