// Copyright 2026 The roller_sim_ros developers
// SPDX-License-Identifier: Apache-2.0

// The connection to the panel's server, and what it says, shown.

import { Charts } from "./charts.js";
import { Controls } from "./controls.js";

const RETRY_MS = 500, LONGEST_RETRY_MS = 4000;

const element = (id) => document.getElementById(id);

let socket = null, retry = RETRY_MS, waiting = false, drawn = 0;
const charts = new Charts();
const controls = new Controls((order) => {
  if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(order));
});

function link(state, says) {
  element("link").dataset.state = state;
  if (element("link").textContent !== says) element("link").textContent = says;
}

function connect() {
  const scheme = location.protocol === "https:" ? "wss" : "ws";
  socket = new WebSocket(`${scheme}://${location.host}/socket${location.search}`);
  socket.binaryType = "arraybuffer";
  socket.onopen = () => { retry = RETRY_MS; };
  socket.onmessage = ({ data }) => (typeof data === "string" ? told(JSON.parse(data)) : frame(data));
  socket.onclose = () => {
    link("lost", "the panel's server is gone; trying again");
    setTimeout(connect, retry);
    retry = Math.min(2 * retry, LONGEST_RETRY_MS);
  };
}

function told(message) {
  if (message.kind === "hello") {
    charts.facts = message;
    element("node").textContent = message.node;
    document.title = `Roller ${message.node}`;
    controls.greet(message);
    element("modes").replaceChildren(...message.modes.map((label, mode) => {
      const item = Object.assign(document.createElement("i"), { textContent: label });
      item.style.setProperty("--swatch", `var(--mode-${mode})`);
      return item;
    }));
  } else if (message.kind === "state") {
    if (message.heard) link("live", "live");
    else link("silent", `no roller heard as ${charts.facts.node}`);
    charts.point = message.exciter;
    controls.show(message);
    put("chainage", message.site.chainage_m, 2);
    put("pass", message.site.pass_number, 0);
    put("speed", message.site.speed_m_s, 2);
    put("frequency", message.exciter.frequency_hz, 2);
    put("amplitude", 1e3 * message.exciter.amplitude_m, 3);
  } else if (message.kind === "map") {
    charts.latestMap = message;
    const at = `at G ${(message.shear_modulus_pa / 1e6).toFixed(1)} MPa, p ${(1e3 * message.plastic_parameter_m).toFixed(2)} mm; mm over Hz`;
    element("map-ground").textContent = message.fine ? at : `${at} (coarse)`;
  } else if (message.kind === "answer") {
    element("answer").textContent = message.failure;
  }
}

function frame(data) {
  const length = new DataView(data).getUint32(0, true);
  const values = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
  let offset = Math.ceil((4 + length) / 4) * 4;
  const arrays = {};
  for (const [name, count] of values.arrays) {
    arrays[name] = new Float32Array(data, offset, count);
    offset += 4 * count;
  }
  charts.take(values, arrays);
  numbers(values);
  if (waiting) return;
  waiting = true;
  requestAnimationFrame((now) => {
    waiting = false;
    charts.draw(now);
    drawn++;
    element("rate").dataset.drawn = drawn;
  });
}

function numbers({ meter, truth }) {
  put("cmv", meter.cmv, 1);
  put("rmv", meter.rmv, 1);
  element("cmv").dataset.sample = meter.last_sample;
  const mode = element("mode");
  const label = charts.facts.modes[meter.mode] || "–";
  if (mode.textContent !== label) mode.textContent = label;
  mode.style.setProperty("--swatch", `var(--mode-${meter.mode ?? 0})`);
  mode.dataset.sample = meter.last_sample;
  put("force-ratio", truth.force_ratio_max, 2);
  put("air", 100 * truth.air_fraction, 0);
}

function put(id, value, digits) {
  const shown = Number.isFinite(value) ? value.toFixed(digits) : "–";
  if (element(id).textContent !== shown) element(id).textContent = shown;
}

let counted = 0, then = performance.now();
setInterval(() => {
  const now = performance.now();
  element("rate").textContent = ((drawn - counted) * 1e3 / (now - then)).toFixed(0);
  counted = drawn;
  then = now;
}, 1000);

connect();
