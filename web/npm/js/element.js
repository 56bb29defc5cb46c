// <lumen-vessel src="aorta.stl" pass-band="0.01" iterations="100" reduction="90" controls>: a surface in a page, shaded and as
// wireframe, smoothed and reduced there. Every setting is an attribute by the name that the command line has, and `unit`. It asks for `src`
// and for its own files, and for nothing else. Not for clinical decisions.

import { surfaceView } from "./draw.js";
import { LumenError, open } from "./index.js";
import { SETTINGS } from "./settings.js";

/** The settings that have a slider. */
const SLIDERS = { "pass-band": "Pass band", iterations: "Iterations", reduction: "Reduction" };
/** The ways to say the target: where nothing else changes, the level is there at once. */
const TARGETS = ["reduction", "triangles", "max-deviation"];
/** How long a slider has to stand still before numbers are measured anew. */
const STILL_MS = 300;
/** A surface that is narrower has one picture above the other. */
const NARROW = 600;

const STYLE = `
  :host { --ink: #1d252c; --weak: #5c6770; --line: #d5dbe0; --ground: #fff; --accent: #0b6e8a; --bad: #b3261e;
    display: block; color-scheme: light dark; color: var(--ink); background: var(--ground); font: 14px/1.45 system-ui, sans-serif;
    font-variant-numeric: tabular-nums; border: 1px solid var(--line); border-radius: 6px; overflow: hidden }
  @media (prefers-color-scheme: dark) {
    :host { --ink: #e6eaed; --weak: #a0abb4; --line: #3a444c; --ground: #14191d; --accent: #5cc3de; --bad: #ff8a80 } }
  :host([hidden]), [hidden] { display: none !important }
  .stage { position: relative }
  canvas { display: block; width: 100%; height: min(56vh, 420px); touch-action: pan-y } canvas:focus { touch-action: none }
  .tall canvas { height: min(56vh, 480px) }
  canvas:focus-visible { outline: 2px solid var(--accent); outline-offset: -2px }
  .stage span { position: absolute; top: 8px; left: 12px; color: var(--weak); pointer-events: none }
  .stage span + span { left: calc(50% + 12px) }
  .tall span + span { left: 12px; top: calc(50% + 8px) }
  progress { position: absolute; bottom: 0; left: 0; width: 100%; height: 3px; appearance: none; border: 0; background: none }
  progress::-webkit-progress-bar { background: none } progress::-webkit-progress-value { background: var(--accent) }
  progress::-moz-progress-bar { background: var(--accent) }
  .below { padding: 8px 12px 10px; border-top: 1px solid var(--line) }
  p { margin: 2px 0 } .weak { color: var(--weak) } .failure { color: var(--bad) }
  .verdict { border-left: 4px solid var(--weak); padding-left: 8px } .safe { border-color: var(--accent) } .grave { border-color: var(--bad) }
  .controls { display: grid; grid-template-columns: repeat(auto-fit, minmax(180px, 1fr)); gap: 4px 20px; margin-top: 6px }
  label { display: grid; grid-template-columns: 1fr auto } input { grid-column: 1 / -1; width: 100%; min-height: 28px; margin: 0; accent-color: var(--accent) }
`;

const SHADOW = `
<div class="stage" hidden>
  <canvas tabindex="0" role="img" aria-label="The surface, shaded and as wireframe. Arrow keys turn it, with Shift they move it, + and - zoom, 0 shows the whole."></canvas>
  <span>Shaded</span><span>Wireframe</span><progress aria-label="Progress" hidden></progress>
</div>
<div class="below">
  <p class="verdict" role="status"></p>
  <p class="failure" role="alert" hidden></p>
  <p class="weak">Not for clinical decisions.</p>
  <p class="counts"></p>
  <div class="controls" hidden></div>
</div>`;

class LumenVessel extends HTMLElement {
  static observedAttributes = ["src", "unit", "controls", ...Object.keys(SETTINGS)];

  #parts;
  #view;
  #surface;
  /** What is under way; a newer one aborts it. */
  #work = new AbortController();
  #asked = false;
  /** Unit and address of what is opened, the settings of its levels but for the target, and how many triangles there are. */
  #opened = "";
  #smoothed = "";
  #entering = 0;
  #shown;
  /** The result of the last work that came to its end. */
  result = null;

  connectedCallback() {
    if (!this.#parts) {
      const shadow = this.attachShadow({ mode: "open" });
      shadow.innerHTML = SHADOW;
      // A page whose policy forbids styles in it allows this one.
      const style = new CSSStyleSheet();
      style.replaceSync(STYLE);
      shadow.adoptedStyleSheets = [style];
      const names = ["stage", "controls", "counts", "verdict", "failure"];
      this.#parts = Object.fromEntries(names.map((name) => [name, shadow.querySelector(`.${name}`)]));
      this.#parts.progress = shadow.querySelector("progress");
      this.#parts.controls.append(...Object.keys(SLIDERS).map((key) => this.#slider(key)));
    }
    this.#ask();
  }

  disconnectedCallback() {
    // One that is moved in the page is connected again before that.
    queueMicrotask(() => {
      if (this.isConnected) return;
      this.#work.abort();
      this.#forget();
      this.#view?.end();
      this.#view = undefined;
      // Its context is lost for good.
      const canvas = this.#parts.stage.querySelector("canvas");
      canvas.replaceWith(canvas.cloneNode());
    });
  }

  attributeChangedCallback(_, before, now) {
    if (before !== now) this.#ask();
  }

  /** Several attributes that are set one after the other are one change. */
  #ask() {
    if (this.#asked || !this.#parts || !this.isConnected) return;
    this.#asked = true;
    queueMicrotask(() => {
      this.#asked = false;
      this.#update();
    });
  }

  #settings() {
    const given = Object.keys(SETTINGS).filter((key) => this.hasAttribute(key));
    return Object.fromEntries(given.map((key) => [key, this.getAttribute(key).trim()]));
  }

  async #update() {
    this.#work.abort();
    const { signal } = (this.#work = new AbortController());
    const { controls, failure, progress, verdict } = this.#parts;
    controls.hidden = !this.hasAttribute("controls");
    this.#showSliders();
    const settings = this.#settings();
    try {
      await this.#open(signal);
      if (!this.#surface) return;
      const rest = JSON.stringify(Object.entries(settings).filter(([key]) => !TARGETS.includes(key)));
      const options = { signal, progress: ({ fraction }) => ((progress.hidden = false), (progress.value = fraction)) };
      verdict.textContent = "Being measured...";
      verdict.className = "verdict";
      const reduction = settings.reduction ? Number(settings.reduction) : NaN;
      const isRate = reduction >= SETTINGS.reduction.least && reduction <= SETTINGS.reduction.most;
      if (this.#smoothed === rest && isRate && !this.#isCounted()) {
        this.#show(await this.#surface.level(reduction), signal);
        await new Promise((still) => setTimeout(still, STILL_MS));
        signal.throwIfAborted();
      } else {
        const { report } = await this.#surface.optimise(settings, { ...options, measures: false });
        this.#entering = report.after_connectivity.triangles;
        this.#smoothed = rest;
        this.#show(await this.#surface.level(), signal);
      }
      this.result = await this.#surface.optimise(settings, options);
      signal.throwIfAborted();
      this.#judge(this.result.verdict);
      failure.hidden = true;
      this.dispatchEvent(new CustomEvent("result", { detail: this.result }));
    } catch (why) {
      // What is newer says how it goes on.
      if (signal.aborted) return;
      verdict.textContent = "";
      if (!this.#shown) this.#parts.counts.textContent = "";
      failure.textContent = why instanceof LumenError || why instanceof Failure ? sentence(why.message) : `This surface cannot be shown: ${why.message}`;
      failure.hidden = false;
    }
    progress.hidden = true;
  }

  async #open(signal) {
    const src = this.getAttribute("src");
    const unit = this.getAttribute("unit") ?? undefined;
    // What is no address is refused by `fetch`, in its words.
    const address = src !== null && URL.canParse(src, document.baseURI) ? new URL(src, document.baseURI).href : src;
    const asked = `${unit} ${address}`;
    if (src !== null && asked === this.#opened) return;
    this.#forget();
    if (src === null) return;
    this.#parts.counts.textContent = "Loading...";
    const answer = await fetch(address, { signal }).catch((why) => {
      signal.throwIfAborted();
      throw new Failure(`The surface cannot be loaded: ${why.message}.`);
    });
    if (!answer.ok) throw new Failure(`The surface cannot be loaded: the server answers ${answer.status}.`);
    const surface = await open(await answer.blob(), nameOf(address), { unit, signal });
    if (signal.aborted) surface.close();
    signal.throwIfAborted();
    [this.#surface, this.#opened] = [surface, asked];
  }

  /** Shows nothing, and what was shown before it is gone. */
  #forget() {
    const { stage, counts, failure, progress, verdict } = this.#parts;
    this.#surface?.close();
    [this.#surface, this.#opened, this.#smoothed, this.result] = [undefined, "", "", null];
    if (this.#shown) this.#view.forget(this.#shown.level);
    this.#view?.show(null);
    this.#shown = undefined;
    stage.hidden = failure.hidden = progress.hidden = true;
    failure.textContent = counts.textContent = verdict.textContent = "";
    verdict.className = "verdict";
  }

  /** Whether something else than the rate says the target. */
  #isCounted() {
    return this.hasAttribute("triangles") || this.hasAttribute("max-deviation");
  }

  #show({ positions, indices, normals }, signal) {
    signal.throwIfAborted();
    const { stage, counts } = this.#parts;
    const count = indices.length / 3;
    const percent = this.#entering > 0 ? (100 * (1 - count / this.#entering)).toFixed(1) : 0;
    counts.textContent = `${count.toLocaleString("en")} of ${this.#entering.toLocaleString("en")} triangles, ${percent} % fewer`;
    stage.hidden = false;
    if (!this.#view) {
      const canvas = stage.querySelector("canvas");
      // A page that is scrolled past goes on scrolling.
      this.#view = surfaceView(canvas, () => this.#isTall(), (event) => event.ctrlKey || event.metaKey || canvas.matches(":focus"));
    }
    if (!this.#view) {
      stage.hidden = true;
      throw new Failure("This browser cannot draw the surface: it has no WebGL2.");
    }
    this.#isTall();
    const level = { place: positions, corners: indices, normals };
    if (this.#shown?.of !== this.#surface) this.#view.frame(level, this.#surface.info.axes === "ras" ? Math.PI : 0);
    if (this.#shown) this.#view.forget(this.#shown.level);
    this.#shown = { level, of: this.#surface };
    this.#view.show(level);
  }

  #isTall() {
    return this.#parts.stage.classList.toggle("tall", this.clientWidth < NARROW);
  }

  #judge({ head, calibre, is_safe, findings }) {
    const { verdict } = this.#parts;
    // What is grave of the calibre stands in both.
    const told = new Set([head, calibre, ...findings.filter(({ is_grave }) => is_grave).map(({ text }) => text)].filter(Boolean).map(sentence));
    verdict.textContent = [...told].join(" ");
    verdict.className = `verdict ${is_safe === true ? "safe" : is_safe === false ? "grave" : ""}`;
  }

  #slider(key) {
    const { least, most, decimals, unit, logarithmic } = SETTINGS[key];
    const [label, value, input] = ["label", "span", "input"].map((name) => document.createElement(name));
    const [to, from] = logarithmic ? [Math.log, Math.exp] : [Number, Number];
    const chosen = () => Number(from(Number(input.value)).toFixed(decimals));
    Object.assign(input, { type: "range", name: key, min: to(least), max: to(most), step: logarithmic ? (to(most) - to(least)) / 200 : 10 ** -decimals });
    input.addEventListener("input", () => this.setAttribute(key, String(chosen())));
    label.append(SLIDERS[key], value, input);
    label.show = (number) => {
      input.disabled = key === "reduction" && this.#isCounted();
      // One that is dragged stays between the steps.
      if (chosen() !== number) input.value = to(number ?? least);
      value.textContent = input.disabled ? "" : number === undefined ? "auto" : `${number} ${unit}`;
      input.setAttribute("aria-valuetext", value.textContent);
    };
    label.key = key;
    return label;
  }

  #showSliders() {
    for (const label of this.#parts.controls.children) {
      const { key } = label;
      const said = this.getAttribute(key);
      label.show(said !== null && said.trim() !== "" && Number.isFinite(Number(said)) ? Number(said) : SETTINGS[key].preset);
    }
  }
}

/** A failure that says itself what it is. */
class Failure extends Error {}

/** The name of the file at an address; a % that is no escape stays one. */
function nameOf(address) {
  const name = new URL(address).pathname.split("/").pop();
  try {
    return decodeURIComponent(name);
  } catch {
    return name;
  }
}

const sentence = (text) => (/[.!?]$/.test(text) ? text : `${text}.`).replace(/^./, (letter) => letter.toUpperCase());

customElements.define("lumen-vessel", LumenVessel);
