// The open feeder behind `navigator.hid`, as a browser would have it: in the page, where it can be asked for, and in the
// Worker, where its reports go. A script for either, after fake-feeder.js; COLLECTIONS is what Chromium tells of its descriptor
// (crates/lumen-haptics/fixtures/feeder-collections.json). Exact lengths, states and user activation are enforced as WebHID says.
//
// Page and Worker share a channel: the test moves the hand and pulls the plug in the page, and reads there what the
// device has heard. With SERVED_IN_PAGE, in front of this script, Workers have no `navigator.hid`, as before Chromium 131, and
// the page alone can open the device.
(() => {
  const isPage = typeof window !== "undefined";
  const isServedInPage = typeof SERVED_IN_PAGE !== "undefined" && SERVED_IN_PAGE;
  if (isServedInPage && !isPage) {
    Object.defineProperty(navigator, "hid", { value: undefined, configurable: true });
    return;
  }
  const channel = new BroadcastChannel("fake-hid");
  const failed = (name, message) => Promise.reject(new DOMException(message, name));
  const now = () => performance.timeOrigin + performance.now();

  /** Bytes of each report, by kind and id. */
  const { outputReports, featureReports } = COLLECTIONS[0];
  const lengths = { output: reportLengths(outputReports), feature: reportLengths(featureReports) };

  class FakeDevice extends EventTarget {
    vendorId = 0x1209;
    productId = 0x0001;
    productName = "Lumen feeder";
    collections = COLLECTIONS;
    opened = false;
    isPlugged = true;
    feeder = new FakeFeeder();

    async open() {
      if (isPage !== isServedInPage) throw new DOMException("the test wants it served elsewhere", "NotAllowedError");
      if (!this.isPlugged) throw new DOMException("unplugged", "NetworkError");
      if (this.opened) throw new DOMException("already open", "InvalidStateError");
      this.opened = true;
      this.tick();
    }

    async close() {
      const ms = globalThis.fakeHid?.closingMs;
      if (ms) await new Promise((done) => setTimeout(done, ms));
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
      if (wrong) return told({ wrong: id }), wrong;
      const bytes = Array.from(new Uint8Array(data.buffer ?? data, data.byteOffset ?? 0, data.byteLength));
      this.feeder.hear(id, bytes);
      told({ heard: { id, bytes, at: now() } });
      // Done in a task of its own, at once: a timer would take 4 ms.
      return new Promise((done) => {
        const { port1, port2 } = new MessageChannel();
        port1.onmessage = () => (port1.close(), done());
        port2.postMessage(0);
      });
    }

    sendFeatureReport(id, data) {
      const wrong = this.#check("feature", id, data);
      if (wrong) return told({ wrong: id }), wrong;
      this.feeder.load();
      return Promise.resolve();
    }

    receiveFeatureReport(id) {
      const wrong = this.#check("feature", id);
      if (wrong) return wrong;
      const body = id === 0x12 ? this.feeder.loaded : new Array(lengths.feature[id]).fill(0);
      // The id comes first, as Chromium has it.
      return Promise.resolve(new DataView(new Uint8Array([id, ...body]).buffer));
    }

    async forget() {}

    report() {
      this.dispatchEvent(Object.assign(new Event("inputreport"), { device: this, reportId: 1, data: this.feeder.input() }));
    }

    /** Sends its reports, each as an event of its own. */
    tick() {
      const { port1, port2 } = new MessageChannel();
      const isOn = () => this.opened && this.isPlugged;
      port1.onmessage = () => isOn() && this.report();
      this.feeder.tick(isOn, () => port2.postMessage(0));
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
  const note = (data) => {
    if (data.heard) globalThis.fakeHid.heard.push(data.heard);
    if ("wrong" in data) globalThis.fakeHid.wrong.push(data.wrong);
  };
  /** What the device tells the test: a channel is not heard by whoever speaks on it. */
  const told = (data) => (isPage ? note(data) : channel.postMessage(data));
  const go = (to, ms) => (isServedInPage ? device.feeder.go(to, ms) : channel.postMessage({ go: to, ms }));
  channel.onmessage = ({ data }) => {
    if (isPage) return note(data);
    if (data.go) device.feeder.go(data.go, data.ms);
    if ("plug" in data) plug(data.plug);
  };
  if (isPage) {
    globalThis.fakeHid = {
      heard: [],
      wrong: [],
      /** How long the page's device takes to close. */
      closingMs: 0,
      now,
      go: (feed, roll, ms) => go([feed, roll], ms),
      plug: (is) => (channel.postMessage({ plug: is }), plug(is)),
      /** The page hangs for so many ms, and what the hand reports meanwhile on its way, by parts of the feed, comes then. */
      hang: (ms, feeds) => {
        for (const until = now() + ms; now() < until; );
        for (const feed of feeds) device.feeder.put([feed, 0]), device.report();
      },
    };
  }
})();
