// Frames as a WebM video, by the browser's own recorder (web/src/video.rs asks).

const KINDS = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];
const kind = () => KINDS.find((kind) => globalThis.MediaRecorder?.isTypeSupported(kind));
const BITS_PER_SECOND = 8e6;
/** What is asked for a frame: a track by the standard, the stream in Firefox. */
const REQUESTS = [globalThis.CanvasCaptureMediaStreamTrack, globalThis.CanvasCaptureMediaStream];

const after = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const shown = () => new Promise((resolve) => addEventListener("visibilitychange", resolve, { once: true }));

globalThis.lumenVideo = {
  /** Whether the browser can record. */
  can: () => kind() !== undefined && "captureStream" in HTMLCanvasElement.prototype && REQUESTS.some((of) => of?.prototype.requestFrame),

  /** The bytes of a video of these frames (RGBA, rows from the top), each of which is seen for `pause` ms. It takes as long as it plays. */
  async record(frames, width, height, pause) {
    const canvas = Object.assign(document.createElement("canvas"), { width, height });
    const context = canvas.getContext("2d");
    const stream = canvas.captureStream(0);
    const [track] = stream.getVideoTracks();
    const recorder = new MediaRecorder(stream, { mimeType: kind(), videoBitsPerSecond: BITS_PER_SECOND });
    const parts = [];
    const stopped = new Promise((resolve, reject) => {
      recorder.ondataavailable = ({ data }) => parts.push(data);
      recorder.onstop = resolve;
      recorder.onerror = ({ error }) => reject(error);
    });
    recorder.start();
    for (const pixels of frames) {
      // A hidden page's clock is slow: nothing of that is to be seen.
      while (document.hidden) {
        recorder.pause();
        await shown();
        recorder.resume();
      }
      context.putImageData(new ImageData(pixels, width, height), 0, 0);
      (track.requestFrame ? track : stream).requestFrame();
      await after(pause);
    }
    recorder.stop();
    await stopped;
    track.stop();
    return new Uint8Array(await new Blob(parts).arrayBuffer());
  },
};
