// The surface in a page that was saved, drawn by draw.js, which stands before it. It asks for nothing: its data stand in the page.
(() => {
  const section = document.getElementById("viewer");
  const carried = JSON.parse(document.getElementById("surface").textContent);
  const levels = carried.levels.map(unpacked);
  const tall = matchMedia("(max-width:600px)");
  const view = surfaceView(section.querySelector("canvas"), () => tall.matches);
  // Then the pictures below are all there is.
  if (!view) return;

  /** A level as it stands in the page: positions in steps of 1/65,535 of the box around it, and corners of triangles. */
  function unpacked({ low, size, wide, positions, triangles }) {
    const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
    const grid = new Uint16Array(bytes(positions));
    const place = Float32Array.from(grid, (step, i) => low[i % 3] + (step / 65535) * size[i % 3]);
    return { place, corners: wide ? new Uint32Array(bytes(triangles)) : Uint32Array.from(new Uint16Array(bytes(triangles))) };
  }

  /** Gives the level that is shown as binary glTF, whose unit is the metre and whose y is up. */
  function save({ place, corners }) {
    const metres = Float32Array.from(place, (mm) => mm / 1000);
    const [least, most] = [Math.min, Math.max].map((of) => [0, 1, 2].map((k) => metres.reduce((found, x, i) => (i % 3 === k ? of(found, x) : found), metres[k])));
    const description = {
      asset: { version: "2.0", generator: "Lumen. Not for clinical decisions." },
      scene: 0,
      scenes: [{ nodes: [0] }],
      nodes: [{ mesh: 0, rotation: [-Math.SQRT1_2, 0, 0, Math.SQRT1_2] }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
      buffers: [{ byteLength: metres.byteLength + corners.byteLength }],
      bufferViews: [
        { buffer: 0, byteLength: metres.byteLength, target: 34962 },
        { buffer: 0, byteOffset: metres.byteLength, byteLength: corners.byteLength, target: 34963 },
      ],
      accessors: [
        { bufferView: 0, componentType: 5126, count: metres.length / 3, type: "VEC3", min: least, max: most },
        { bufferView: 1, componentType: 5125, count: corners.length, type: "SCALAR" },
      ],
    };
    const text = new TextEncoder().encode(JSON.stringify(description));
    const padded = new Uint8Array(Math.ceil(text.length / 4) * 4).fill(32);
    padded.set(text);
    const chunk = (kind, length) => new Uint32Array([length, kind]);
    const length = 12 + 8 + padded.length + 8 + metres.byteLength + corners.byteLength;
    const parts = [new Uint32Array([0x46546c67, 2, length]), chunk(0x4e4f534a, padded.length), padded, chunk(0x004e4942, metres.byteLength + corners.byteLength), metres, corners];
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob(parts, { type: "model/gltf-binary" }));
    link.download = "surface.glb";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }

  let shown = levels[0];
  for (const choice of section.querySelectorAll("input")) {
    choice.addEventListener("change", () => {
      shown = levels[Number(choice.value)];
      view.show(shown);
    });
  }
  section.querySelector("button").addEventListener("click", () => save(shown));
  tall.addEventListener("change", view.redraw);

  section.hidden = false;
  view.frame(levels[levels.length - 1], carried.across);
  view.show(shown);
})();
