import type { Result } from "./index.js";

/** `<lumen-vessel src="aorta.stl" pass-band="0.01" iterations="100" reduction="90" controls>`. Every setting is an attribute. */
export interface LumenVessel extends HTMLElement {
  /** What the last work came to; the event `result` has it as its detail. */
  readonly result: Result | null;
}

declare global {
  interface HTMLElementTagNameMap {
    "lumen-vessel": LumenVessel;
  }
}
