// The open feeder behind `navigator.hid`, as a browser would have it: in the page, where it can be asked for, and in the
// Worker, where its reports go. A script for either; COLLECTIONS is what Chromium tells of its descriptor
// (tests/haptics/feeder-collections.json). Exact lengths, states and user activation are enforced as WebHID says.
//
// Page and Worker share a channel: the test moves the hand and pulls the plug in the page, and reads there what the
// device has heard.
(() => {
  const isPage = typeof window !== "undefined";
  const channel = new BroadcastChannel("fake-hid");
  const failed = (name, message) => Promise.reject(new DOMException(message, name));
  const now = () => performance.timeOrigin + performance.now();

  /** Bytes of each report, by kind and id. */
  const lengths = { output: {}, feature: {}, input: {} };
  for (const [kind, key] of [["output", "outputReports"], ["feature", "featureReports"], ["input", "inputReports"]]) {
    for (const report of COLLECTIONS[0][key]) {
      const bits = report.items.reduce((sum, item) => sum + item.reportSize * item.reportCount, 0);
      lengths[kind][report.reportId] = Math.ceil(bits / 8);
    }
  }

  class FakeDevice extends EventTarget {
    vendorId = 0x1209;
    productId = 0x0001;
    productName = "Lumen feeder";
    collections = COLLECTIONS;
    opened = false;
    isPlugged = true;
    /** Where the hand has the axes, -32767 to 32767, and where it takes them by when. */
    at = [0, 0];
    way = null;
    effects = new Map();
    loaded = [0, 2, 0, 0];

    async open() {
      if (isPage) throw new DOMException("the test wants it served in the Worker", "NotAllowedError");
      if (!this.isPlugged) throw new DOMException("unplugged", "NetworkError");
      if (this.opened) throw new DOMException("already open", "InvalidStateError");
      this.opened = true;
      this.tick();
    }

    async close() {
      this.opened = false;
    }

    #check(kind, id, data) {
      if (!this.opened) return failed("InvalidStateError", "not open");
      if (!this.isPlugged) return failed("NetworkError", "unplugged");
      const length = lengths[kind][id];
      if (length === undefined) return Promise.reject(new TypeError(`there is no ${kind} report ${id}`));
      if (data !== undefined && data.byteLength !== length) return failed("NotAllowedError", `report ${id} has ${length} bytes, not ${data.byteLength}`);
      return null;
    }

    sendReport(id, data) {
      const wrong = this.#check("output", id, data);
      if (wrong) return channel.postMessage({ wrong: id }), wrong;
      const bytes = Array.from(new Uint8Array(data.buffer ?? data, data.byteOffset ?? 0, data.byteLength));
      channel.postMessage({ heard: { id, bytes, at: now() } });
      // Done in a task of its own, at once: a timer would take 4 ms.
      return new Promise((done) => {
        const { port1, port2 } = new MessageChannel();
        port1.onmessage = () => (port1.close(), done());
        port2.postMessage(0);
      });
    }

    sendFeatureReport(id, data) {
      const wrong = this.#check("feature", id, data);
      if (wrong) return channel.postMessage({ wrong: id }), wrong;
      const index = [1, 2, 3, 4].find((free) => !this.effects.has(free));
      this.loaded = index ? [index, 1, 0, 0] : [0, 2, 0, 0];
      if (index) this.effects.set(index, data);
      return Promise.resolve();
    }

    receiveFeatureReport(id) {
      const wrong = this.#check("feature", id);
      if (wrong) return wrong;
      const body = id === 0x12 ? this.loaded : new Array(lengths.feature[id]).fill(0);
      // The id comes first, as Chromium has it.
      return Promise.resolve(new DataView(new Uint8Array([id, ...body]).buffer));
    }

    async forget() {}

    /** Sends a report for each ms that has passed, each as an event of its own. */
    tick() {
      let last = performance.now();
      const port = new MessageChannel();
      port.port1.onmessage = () => this.report();
      const again = () => {
        if (!this.opened || !this.isPlugged) return;
        const due = Math.min(20, Math.floor(performance.now() - last));
        last += due;
        for (let i = 0; i < due; i++) port.port2.postMessage(0);
        setTimeout(again, 1);
      };
      again();
    }

    report() {
      if (!this.opened || !this.isPlugged) return;
      if (this.way) {
        const part = Math.min(1, (performance.now() - this.way.from) / this.way.ms);
        this.at = this.at.map((_, i) => Math.round(this.way.start[i] + (this.way.end[i] - this.way.start[i]) * part));
        if (part === 1) this.way = null;
      }
      const data = new DataView(new ArrayBuffer(5));
      data.setInt16(1, this.at[0], true);
      data.setInt16(3, this.at[1], true);
      this.dispatchEvent(Object.assign(new Event("inputreport"), { device: this, reportId: 1, data }));
    }
  }

  const device = new FakeDevice();
  let isPaired = !isPage;

  class FakeHid extends EventTarget {
    async getDevices() {
      return isPaired && device.isPlugged ? [device] : [];
    }
    requestDevice({ filters }) {
      if (!isPage) return failed("NotSupportedError", "pages ask");
      if (!navigator.userActivation.isActive) return failed("SecurityError", "Must be handling a user gesture to show a permission request.");
      const fits = (filter) => filter.vendorId === device.vendorId || (filter.usagePage === 1 && filter.usage === 4);
      if (!filters.some(fits) || !device.isPlugged) return Promise.resolve([]);
      isPaired = true;
      return Promise.resolve([device]);
    }
  }

  const hid = new FakeHid();
  Object.defineProperty(navigator, "hid", { value: hid, configurable: true });
  const plug = (is) => {
    device.isPlugged = is;
    if (!is) device.opened = false;
    hid.dispatchEvent(Object.assign(new Event(is ? "connect" : "disconnect"), { device }));
  };
  channel.onmessage = ({ data }) => {
    if (isPage) {
      if (data.heard) globalThis.fakeHid.heard.push(data.heard);
      if ("wrong" in data) globalThis.fakeHid.wrong.push(data.wrong);
      return;
    }
    if (data.go) device.way = { from: performance.now(), ms: data.ms, start: device.at, end: data.go.map((part) => Math.round(32767 * part)) };
    if ("plug" in data) plug(data.plug);
  };
  if (isPage) {
    globalThis.fakeHid = {
      heard: [],
      wrong: [],
      now,
      /** Moves the hand to these parts of half of the axes' ways, -1 to 1, within so many ms. */
      go: (feed, roll, ms) => channel.postMessage({ go: [feed, roll], ms }),
      plug: (is) => (channel.postMessage({ plug: is }), plug(is)),
    };
  }
})();
