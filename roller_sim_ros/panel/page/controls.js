// Copyright 2026 The roller_sim_ros developers
// SPDX-License-Identifier: Apache-2.0

// What the page can do to the roller, and how that shows.

const SETTLE_MS = 1500;
const SEND_EVERY_MS = 120;
const STEPS = 1000;
const MASTER_SCENARIO = 1, MASTER_COMMAND = 2;

const element = (id) => document.getElementById(id);

// Slider and number for one value; the roller's own shows unless someone has just moved it.
class Slider {
  constructor(root, unit, logarithmic, changed) {
    this.slider = root.querySelector("input[type=range]");
    this.number = root.querySelector("input[type=number]");
    this.unit = unit;
    this.logarithmic = logarithmic;
    this.touched = -Infinity;
    this.limits = null;
    this.si = null;
    this.slider.min = 0;
    this.slider.max = STEPS;
    this.slider.step = 1;
    this.slider.addEventListener("input", () => this.set(this.fromPlace(Number(this.slider.value)), changed));
    this.number.addEventListener("change", () => {
      if (this.number.value !== "" && Number.isFinite(this.number.valueAsNumber)) this.set(this.number.valueAsNumber * unit, changed);
    });
  }

  set(si, changed) {
    this.touched = performance.now();
    this.show(si);
    changed();
  }

  fromPlace(place) {
    const [low, high] = this.limits, share = place / STEPS;
    const value = this.logarithmic ? low * (high / low) ** share : low + share * (high - low);
    return Number((value / this.unit).toPrecision(4)) * this.unit;
  }

  toPlace(si) {
    const [low, high] = this.limits;
    return STEPS * (this.logarithmic ? Math.log(si / low) / Math.log(high / low) : (si - low) / (high - low));
  }

  show(si) {
    this.si = si;
    const shown = Number((si / this.unit).toPrecision(4));
    if (document.activeElement !== this.number || this.number.value === "") this.number.value = shown;
    if (this.limits) this.slider.value = Math.round(this.toPlace(si));
    this.slider.setAttribute("aria-valuetext", String(shown));
  }

  bound(limits) {
    if (this.limits && limits[0] === this.limits[0] && limits[1] === this.limits[1]) return;
    this.limits = limits;
    this.number.min = limits[0] / this.unit;
    this.number.max = limits[1] / this.unit;
    if (this.si !== null) this.show(this.si);
  }

  heard(si) {
    if (si === undefined || si === null || performance.now() - this.touched < SETTLE_MS) return;
    if (si !== this.si) this.show(si);
  }
}

// Calls at most so often, and once more after the last time.
function rarely(act) {
  let timer = 0, last = -Infinity;
  return () => {
    clearTimeout(timer);
    const wait = last + SEND_EVERY_MS - performance.now();
    const now = () => { last = performance.now(); act(); };
    if (wait <= 0) now();
    else timer = setTimeout(now, wait);
  };
}

export class Controls {
  constructor(send) {
    this.send = send;
    this.vibrating = false;
    this.recording = false;
    const slider = (name, unit, logarithmic, changed) => new Slider(document.querySelector(`[data-name="${name}"]`), unit, logarithmic, rarely(changed));
    this.frequency = slider("exciter.frequency_hz", 1, false, () => this.command(this.vibrating));
    this.amplitude = slider("exciter.amplitude_m", 1e-3, false, () => this.command(this.vibrating));
    this.shearModulus = slider("soil.shear_modulus_pa", 1e6, true, () => send({ do: "soil", "soil.shear_modulus_pa": this.shearModulus.si }));
    this.plastic = slider("soil.plastic_parameter_m", 1e-3, true, () => send({ do: "soil", "soil.plastic_parameter_m": this.plastic.si }));
    for (const form of document.forms) form.addEventListener("submit", (event) => event.preventDefault());
    element("vibrate").addEventListener("click", () => this.command(!this.vibrating));
    element("release").addEventListener("click", () => send({ do: "release" }));
    element("record").addEventListener("click", () => send({ do: "record", on: !this.recording }));
    element("clear-all").addEventListener("click", () => send({ do: "clear", handle: 0 }));
  }

  command(vibrate) {
    if (this.frequency.si === null) return;
    this.send({ do: "command", vibrate, frequency_hz: this.frequency.si, amplitude_m: this.amplitude.si });
  }

  greet(hello) {
    const faults = element("faults");
    faults.replaceChildren(...hello.faults.map(({ id, doc }) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = id.replaceAll("_", " ");
      button.title = doc;
      button.dataset.fault = id;
      button.addEventListener("click", () => this.send({ do: "inject", fault: id, duration_s: element("duration").valueAsNumber }));
      return button;
    }));
  }

  show(state) {
    const { exciter, soil, limits } = state;
    this.frequency.bound(limits["exciter.frequency_hz"]);
    this.amplitude.bound(limits["exciter.amplitude_m"]);
    this.shearModulus.bound(limits["soil.shear_modulus_pa"]);
    this.plastic.bound(limits["soil.plastic_parameter_m"]);
    this.frequency.heard(exciter.commanded_frequency_hz);
    this.amplitude.heard(exciter.commanded_amplitude_m);
    this.shearModulus.heard(soil.shear_modulus_pa);
    this.plastic.heard(soil.plastic_parameter_m);
    this.vibrating = Boolean(exciter.vibrating);
    element("vibrate").textContent = this.vibrating ? "Stop" : "Start";
    element("vibrate").setAttribute("aria-pressed", String(this.vibrating));
    const says = element("exciter-says");
    says.textContent = exciter.refusal || (exciter.frequency_hz === undefined ? "" : `${this.vibrating ? "vibrates" : "stands or runs down"}, ${(exciter.force_n / 1e3).toFixed(0)} kN`);
    says.classList.toggle("bad", Boolean(exciter.refusal));
    element("release").hidden = exciter.master !== MASTER_COMMAND;
    if (exciter.master === MASTER_SCENARIO) says.textContent += ", as the scenario has it";
    this.showRecording(state.diagnostics.find((entry) => entry.name === "recording"));
    this.showFaults(state.faults, state.held_back);
    this.showDiagnostics(state.diagnostics);
    document.querySelectorAll("#controls button, #controls input, #faults button, #clear-all").forEach((control) => { control.disabled = !state.heard; });
  }

  showRecording(entry) {
    const values = entry?.values || {};
    this.recording = Boolean(values.path) && values.state !== "failed";
    const says = element("recording-says");
    says.textContent = values.path ? `${entry.message}, ${(Number(values.bytes_written) / 1e6).toFixed(1)} MB` : entry?.message || "unknown";
    says.classList.toggle("bad", (entry?.level || 0) > 1);
    element("record").textContent = this.recording ? "Stop recording" : "Record";
    element("record").setAttribute("aria-pressed", String(this.recording));
  }

  showFaults(faults, heldBack) {
    const key = JSON.stringify([faults, heldBack]);
    if (key === this.shownFaults) return;
    this.shownFaults = key;
    element("active-faults").replaceChildren(
      ...faults.map((fault) => {
        const line = document.createElement("p"), name = document.createElement("span"), button = document.createElement("button");
        const values = Object.entries(fault.parameters).map(([parameter, value]) => `${parameter} ${value}`).join(", ");
        name.textContent = `${fault.id.replaceAll("_", " ")}${values ? `: ${values}` : ""}`;
        name.className = "warn";
        button.type = "button";
        button.textContent = "Clear";
        button.setAttribute("aria-label", `Clear ${fault.id}`);
        button.addEventListener("click", () => this.send({ do: "clear", handle: fault.handle }));
        line.dataset.active = fault.id;
        line.append(name, button);
        return line;
      }),
      ...heldBack.map((why) => Object.assign(document.createElement("p"), { textContent: why })),
    );
  }

  // The entries stay, so that one that is open stays open.
  showDiagnostics(entries) {
    const list = element("diagnostics");
    for (const entry of entries) {
      let details = list.querySelector(`[data-name="${CSS.escape(entry.name)}"]`);
      if (!details) {
        details = document.createElement("details");
        details.dataset.name = entry.name;
        details.append(document.createElement("summary"), document.createElement("dl"));
        list.append(details);
      }
      const [summary, values] = details.children;
      summary.textContent = `${["", "warning: ", "error: ", "stale: "][entry.level]}${entry.name}: ${entry.message}`;
      summary.className = ["", "warn", "bad", "warn"][entry.level];
      values.replaceChildren(...Object.entries(entry.values).flatMap(([name, value]) => [
        Object.assign(document.createElement("dt"), { textContent: name }),
        Object.assign(document.createElement("dd"), { textContent: value }),
      ]));
    }
  }
}
