// What the open feeder is behind any mock of it (fake-hid.js, fake-serial.js), which this script goes before: the hand on its
// axes, the memory for effects, and when it reports. The layout of its reports is that of docs/haptic-device.md.

/** Bytes of each report in a list that Chromium tells, by id. */
function reportLengths(reports) {
  const bits = ({ items }) => items.reduce((sum, item) => sum + item.reportSize * item.reportCount, 0);
  return Object.fromEntries(reports.map((report) => [report.reportId, Math.ceil(bits(report) / 8)]));
}

class FakeFeeder {
  /** Where the hand has the axes, -32767 to 32767, and where it takes them by when. */
  #at = [0, 0];
  #way = null;
  #effects = new Set();
  /** The answer about the effect that was made last: its number, and that it was made, or that there is no room. */
  loaded = [0, 2, 0, 0];

  /** Moves the hand to these parts of half of the axes' ways, -1 to 1, within so many ms. */
  go(to, ms) {
    this.#way = { from: performance.now(), ms, start: this.#at, end: to.map((part) => Math.round(32767 * part)) };
  }

  /** The hand has the axes there. */
  put(to) {
    [this.#at, this.#way] = [to.map((part) => Math.round(32767 * part)), null];
  }

  /** The input report of now. */
  input() {
    if (this.#way) {
      const { from, ms, start, end } = this.#way;
      const part = Math.min(1, (performance.now() - from) / ms);
      this.#at = start.map((at, i) => Math.round(at + (end[i] - at) * part));
      if (part === 1) this.#way = null;
    }
    const data = new DataView(new ArrayBuffer(5));
    this.#at.forEach((at, i) => data.setInt16(1 + 2 * i, at, true));
    return data;
  }

  /** Takes an output report: one of them frees an effect, another all. */
  hear(id, bytes) {
    if (id === 5) this.#effects.delete(bytes[0]);
    if (id === 6 && bytes[0] === 4) this.#effects.clear();
  }

  /** Makes an effect, if one of four is free. */
  load() {
    const index = [1, 2, 3, 4].find((free) => !this.#effects.has(free));
    this.loaded = index ? [index, 1, 0, 0] : [0, 2, 0, 0];
    if (index) this.#effects.add(index);
  }

  /** Reports once for each ms that has passed, as long as it `isOn()`. */
  tick(isOn, report) {
    let last = performance.now();
    const again = () => {
      if (!isOn()) return;
      const due = Math.min(20, Math.floor(performance.now() - last));
      last += due;
      for (let i = 0; i < due; i++) report();
      setTimeout(again, 1);
    };
    again();
  }
}
