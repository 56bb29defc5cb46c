// The open feeder behind `navigator.serial`, as a browser without WebHID would have it: in the page, where it can be asked
// for, and in the Worker, where its bytes go. A script for either, after fake-feeder.js; FEEDER has the report descriptor's bytes and what Chromium
// tells of it (for the reports' lengths). States and user activation are enforced as Web Serial says; the frames are taken
// apart here by docs/haptic-device.md, without the app's code. What the device sends is cut where no frame ends.
//
// Page and Worker share a channel, as in fake-hid.js.
(() => {
  const isPage = typeof window !== "undefined";
  const channel = new BroadcastChannel("fake-serial");
  const failed = (name, message) => Promise.reject(new DOMException(message, name));
  const now = () => performance.timeOrigin + performance.now();
  const [INPUT, OUTPUT, SET, GET, DESCRIPTOR, REFUSED] = [1, 2, 3, 4, 5, 6];

  const lengths = reportLengths(FEEDER.collections[0].outputReports);

  const crc = (bytes) => {
    let sum = 0xffff;
    for (const byte of bytes) {
      sum ^= byte << 8;
      for (let i = 0; i < 8; i++) sum = sum & 0x8000 ? ((sum << 1) ^ 0x1021) & 0xffff : sum << 1;
    }
    return sum;
  };

  /** A frame's bytes; shorter than the 254 from which stuffing has another rule. */
  const pack = (kind, id, data = []) => {
    const body = [kind, id, ...data];
    const sum = crc(body);
    const frame = [];
    let block = [];
    for (const byte of [...body, sum & 0xff, sum >> 8, 0]) {
      if (byte === 0) {
        frame.push(block.length + 1, ...block);
        block = [];
      } else {
        block.push(byte);
      }
    }
    return [...frame, 0];
  };

  const unpack = (frame) => {
    const body = [];
    for (let at = 0; at < frame.length; ) {
      const next = at + frame[at];
      body.push(...frame.slice(at + 1, next));
      at = next;
      if (at < frame.length) body.push(0);
    }
    const [high, low] = [body.pop(), body.pop()];
    if (crc(body) !== low + 256 * high) return null;
    const [kind, id, ...data] = body;
    return { kind, id, data };
  };

  class FakePort extends EventTarget {
    isPlugged = true;
    isOpen = false;
    listens = false;
    readable = null;
    writable = null;
    feeder = new FakeFeeder();
    #reads = null;
    #writes = null;
    #frame = [];
    #cuts = 0;

    getInfo() {
      return { usbVendorId: 0x1209, usbProductId: 0x0001 };
    }

    async open({ baudRate }) {
      if (isPage) throw new DOMException("the test wants it served in the Worker", "NotAllowedError");
      if (this.isOpen) throw new DOMException("The port is already open.", "InvalidStateError");
      if (!(baudRate > 0)) throw new TypeError("Requested baud rate must be greater than zero.");
      if (!this.isPlugged) throw new DOMException("Failed to open serial port.", "NetworkError");
      this.isOpen = true;
      this.readable = new ReadableStream({ start: (controller) => void (this.#reads = controller), cancel: () => void (this.#reads = null) });
      this.writable = new WritableStream({
        start: (controller) => void (this.#writes = controller),
        write: (chunk) => {
          if (!(chunk instanceof Uint8Array)) throw new TypeError("bytes are written");
          for (const byte of chunk) this.#take(byte);
        },
      });
      channel.postMessage({ isOpen: true });
      // What a modem's program left, and half of a frame.
      this.#send([0x41, 0x54, 0, 9, 1, 1]);
    }

    async close() {
      if (!this.isOpen) throw new DOMException("The port is already closed.", "InvalidStateError");
      if (this.readable?.locked || this.writable?.locked) throw new TypeError("Cannot cancel a locked stream");
      [this.isOpen, this.listens, this.readable, this.writable] = [false, false, null, null];
      channel.postMessage({ isOpen: false });
    }

    async setSignals({ dataTerminalReady }) {
      if (!this.isOpen) throw new DOMException("The port is closed.", "InvalidStateError");
      if (dataTerminalReady && !this.listens) {
        this.listens = true;
        const report = () => this.#send(pack(INPUT, 1, new Uint8Array(this.feeder.input().buffer)));
        this.feeder.tick(() => this.listens, report);
      }
    }

    plug(is) {
      this.isPlugged = is;
      if (!is && this.isOpen) {
        const lost = () => new DOMException("The device has been lost.", "NetworkError");
        this.#reads?.error(lost());
        this.#writes?.error(lost());
        [this.isOpen, this.listens, this.readable, this.writable, this.#reads] = [false, false, null, null, null];
      }
    }

    /** Gives the stream bytes, in chunks of odd lengths. */
    #send(bytes) {
      for (let at = 0; at < bytes.length && this.#reads; ) {
        const length = [1, 5, 2, 13, 3][this.#cuts++ % 5];
        this.#reads.enqueue(Uint8Array.from(bytes.slice(at, at + length)));
        at += length;
      }
    }

    #take(byte) {
      if (byte !== 0) return void this.#frame.push(byte);
      const frame = this.#frame;
      this.#frame = [];
      if (frame.length === 0) return;
      const heard = unpack(frame);
      if (!heard) return void channel.postMessage({ wrong: frame });
      const { kind, id, data } = heard;
      if (kind === OUTPUT) {
        if (data.length !== lengths[id]) channel.postMessage({ wrong: heard });
        this.feeder.hear(id, data);
        channel.postMessage({ heard: { id, bytes: data, at: now() } });
      } else if (kind === SET && id === 0x11 && data.length === 3) {
        this.feeder.load();
        this.#send(pack(SET, id));
      } else if (kind === GET && id === 0x12) {
        this.#send(pack(GET, id, this.feeder.loaded));
      } else if (kind === DESCRIPTOR) {
        this.#send(pack(DESCRIPTOR, id, FEEDER.descriptor.slice(56 * id, 56 * id + 56)));
      } else {
        channel.postMessage({ wrong: heard });
        this.#send(pack(REFUSED, id));
      }
    }
  }

  const port = new FakePort();
  let isPaired = !isPage;

  class FakeSerial extends EventTarget {
    async getPorts() {
      return isPaired && port.isPlugged ? [port] : [];
    }
    requestPort({ filters }) {
      if (!isPage) return failed("NotSupportedError", "pages ask");
      if (!navigator.userActivation.isActive) return failed("SecurityError", "Must be handling a user gesture to show a permission request.");
      const { usbVendorId, usbProductId } = port.getInfo();
      const fits = (filter) => filter.usbVendorId === usbVendorId && (filter.usbProductId ?? usbProductId) === usbProductId;
      if (!filters.some(fits) || !port.isPlugged) return failed("NotFoundError", "No port selected by the user.");
      isPaired = true;
      return Promise.resolve(port);
    }
  }

  const serial = new FakeSerial();
  Object.defineProperty(navigator, "serial", { value: serial, configurable: true });
  Object.defineProperty(navigator, "hid", { value: undefined, configurable: true });
  const plug = (is) => {
    port.plug(is);
    serial.dispatchEvent(Object.assign(new Event(is ? "connect" : "disconnect"), { port }));
  };
  channel.onmessage = ({ data }) => {
    if (isPage) {
      if (data.heard) globalThis.fakeSerial.heard.push(data.heard);
      if ("wrong" in data) globalThis.fakeSerial.wrong.push(data.wrong);
      if ("isOpen" in data) globalThis.fakeSerial.isOpen = data.isOpen;
      return;
    }
    if (data.go) port.feeder.go(data.go, data.ms);
    if ("plug" in data) plug(data.plug);
  };
  if (isPage) {
    globalThis.fakeSerial = {
      heard: [],
      wrong: [],
      isOpen: false,
      go: (feed, roll, ms) => channel.postMessage({ go: [feed, roll], ms }),
      plug: (is) => (channel.postMessage({ plug: is }), plug(is)),
    };
  }
})();
