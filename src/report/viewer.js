// The surface in a page that was saved: shaded and as wireframe, side by side, to be turned and zoomed. It asks for nothing: its
// data stand in the page.
"use strict";
(() => {
  const section = document.getElementById("viewer");
  const canvas = section.querySelector("canvas");
  const carried = JSON.parse(document.getElementById("surface").textContent);
  const levels = carried.levels.map(unpacked);
  const gl = canvas.getContext("webgl2", { antialias: true });
  // Then the pictures below are all there is.
  if (!gl) return;

  /** A level as it stands in the page: positions in steps of 1/65,535 of the box around it, and corners of triangles. */
  function unpacked({ low, size, wide, positions, triangles }) {
    const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
    const grid = new Uint16Array(bytes(positions));
    const place = Float32Array.from(grid, (step, i) => low[i % 3] + (step / 65535) * size[i % 3]);
    return { low, size, place, corners: wide ? new Uint32Array(bytes(triangles)) : Uint32Array.from(new Uint16Array(bytes(triangles))) };
  }

  /** At each vertex the mean of the normals of its triangles, by their areas. */
  function normals({ place, corners }) {
    const sums = new Float32Array(place.length);
    for (let t = 0; t < corners.length; t += 3) {
      const [a, b, c] = [corners[t] * 3, corners[t + 1] * 3, corners[t + 2] * 3];
      const [u, v] = [b, c].map((corner) => [0, 1, 2].map((k) => place[corner + k] - place[a + k]));
      const across = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      for (const corner of [a, b, c]) for (let k = 0; k < 3; k++) sums[corner + k] += across[k];
    }
    return sums;
  }

  /** Each edge once: its ends as one number, in order, so that what stands twice stands side by side. */
  function edges({ place, corners }) {
    const count = place.length / 3;
    const both = Float64Array.from(corners, (a, t) => {
      const b = corners[t % 3 === 2 ? t - 2 : t + 1];
      return Math.min(a, b) * count + Math.max(a, b);
    }).sort();
    const once = both.filter((edge, i) => edge !== both[i - 1]);
    const ends = new Uint32Array(once.length * 2);
    once.forEach((edge, i) => ends.set([Math.floor(edge / count), edge % count], 2 * i));
    return ends;
  }

  const SHADED = 0, GROUND = 1, LINES = 2;
  const VERTEX = `#version 300 es
    uniform mat4 view, projection;
    uniform float back;
    in vec3 place, normal;
    centroid out vec3 seen, turned;
    void main() {
      seen = (view * vec4(place, 1)).xyz;
      turned = mat3(view) * normal;
      gl_Position = projection * vec4(seen, 1);
      gl_Position.z += back * gl_Position.w;
    }`;
  const FRAGMENT = `#version 300 es
    precision highp float;
    uniform int look;
    uniform vec3 ground, line;
    centroid in vec3 seen, turned;
    out vec4 colour;
    void main() {
      if (look == ${GROUND}) {
        colour = vec4(ground, 1);
        return;
      }
      vec3 n = normalize(turned) * (gl_FrontFacing ? 1. : -1.);
      if (look == ${LINES}) {
        // Softer where the surface faces the eye, so that many lines still show its form.
        colour = vec4(mix(line, ground, .5 * abs(n.z)), 1);
        return;
      }
      vec3 outside = vec3(.604, .246, .178), inside = vec3(.254, .04, .034), rim = vec3(.195, .035, .03);
      vec3 own = gl_FrontFacing ? mix(outside, rim, .8 * pow(1. - max(dot(n, normalize(-seen)), 0.), 3.)) : inside;
      vec3 light = mix(vec3(.15, .13, .12), vec3(.42, .44, .48), .5 * n.y + .5) + vec3(.82, .8, .77) * max(dot(n, vec3(-.42, .56, .71)), 0.);
      colour = vec4(pow(own * light, vec3(1. / 2.2)), 1);
    }`;

  let program, at, buffers;
  function made() {
    program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(program));
    gl.useProgram(program);
    at = Object.fromEntries(["view", "projection", "back", "look", "ground", "line"].map((name) => [name, gl.getUniformLocation(program, name)]));
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.SCISSOR_TEST);
    buffers = levels.map(() => null);
  }

  /** A level in graphics memory, from when it is first shown. */
  function uploaded(number) {
    if (!buffers[number]) {
      const level = levels[number];
      const whole = (target, data) => {
        const buffer = gl.createBuffer();
        gl.bindBuffer(target, buffer);
        gl.bufferData(target, data, gl.STATIC_DRAW);
        return buffer;
      };
      const attributes = gl.createVertexArray();
      gl.bindVertexArray(attributes);
      for (const [name, data] of [["place", level.place], ["normal", normals(level)]]) {
        whole(gl.ARRAY_BUFFER, data);
        const slot = gl.getAttribLocation(program, name);
        gl.enableVertexAttribArray(slot);
        gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, 0, 0);
      }
      const lines = edges(level);
      gl.bindVertexArray(null);
      const faces = whole(gl.ELEMENT_ARRAY_BUFFER, level.corners);
      buffers[number] = { attributes, faces, lines: whole(gl.ELEMENT_ARRAY_BUFFER, lines), ends: lines.length };
    }
    return buffers[number];
  }

  // The camera: turned about the middle of the box, which it sees from the patient's front.
  const { low, size } = levels[levels.length - 1];
  const middle = low.map((least, k) => least + size[k] / 2);
  const radius = farthest(levels[levels.length - 1].place) || 1;
  const WHOLE = { across: carried.across, up: 0, distance: 1, aside: [0, 0] };
  // In radii of what is seen, and how large that is: all of it is in the picture.
  const [DISTANCE, SCALE] = [3.2, 3];
  const tall = matchMedia("(max-width:600px)");
  let camera = { ...WHOLE, aside: [0, 0] };
  let shown = 0;

  function farthest(place) {
    let squared = 0;
    for (let i = 0; i < place.length; i += 3) {
      squared = Math.max(squared, (place[i] - middle[0]) ** 2 + (place[i + 1] - middle[1]) ** 2 + (place[i + 2] - middle[2]) ** 2);
    }
    return Math.sqrt(squared);
  }

  /** By columns. */
  function view() {
    const [ca, sa, cu, su] = [Math.cos(camera.across), Math.sin(camera.across), Math.cos(camera.up), Math.sin(camera.up)];
    // From the patient's axes to the eye's: x to the right, z up, y away from the eye; turned about z, then tilted.
    const rows = [
      [ca, sa, 0],
      [sa * su, -ca * su, cu],
      [sa * cu, -ca * cu, -su],
    ];
    const shift = rows.map((row) => -row.reduce((sum, part, k) => sum + part * middle[k], 0));
    shift[0] += camera.aside[0] * radius;
    shift[1] += camera.aside[1] * radius;
    shift[2] -= radius * DISTANCE * camera.distance;
    return [0, 1, 2].flatMap((k) => [rows[0][k], rows[1][k], rows[2][k], 0]).concat(shift, 1);
  }

  function projection(aspect) {
    const far = radius * (DISTANCE * camera.distance + 4);
    const near = Math.max(radius * (DISTANCE * camera.distance - 2), far / 2000);
    // The whole fits, whichever side is the shorter.
    const scale = SCALE * Math.min(1, aspect);
    return [scale / aspect, 0, 0, 0, 0, scale, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
  }

  let asked = false;
  function ask() {
    if (asked) return;
    asked = true;
    requestAnimationFrame(draw);
  }

  /** "rgb(1, 2, 3)" */
  const colour = (name) => {
    canvas.style.color = `var(${name})`;
    return getComputedStyle(canvas).color.match(/[\d.]+/g).slice(0, 3).map((part) => part / 255);
  };

  function draw() {
    asked = false;
    if (gl.isContextLost()) return;
    const [wide, high] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * devicePixelRatio)));
    if (canvas.width !== wide || canvas.height !== high) [canvas.width, canvas.height] = [wide, high];
    const [ground, line] = [colour("--ground"), colour("--ink")];
    const { attributes, faces, lines, ends } = uploaded(shown);
    gl.bindVertexArray(attributes);
    // One above the other where there is no room beside.
    const half = tall.matches ? [wide, Math.floor(high / 2)] : [Math.floor(wide / 2), high];
    gl.uniformMatrix4fv(at.view, false, view());
    gl.uniformMatrix4fv(at.projection, false, projection(half[0] / half[1]));
    gl.uniform3fv(at.ground, ground);
    gl.uniform3fv(at.line, line);
    const faced = (look, back) => {
      gl.uniform1i(at.look, look);
      gl.uniform1f(at.back, back);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, faces);
      gl.drawElements(gl.TRIANGLES, levels[shown].corners.length, gl.UNSIGNED_INT, 0);
    };
    for (const side of [0, 1]) {
      const box = tall.matches ? [0, (1 - side) * half[1], ...half] : [side * half[0], 0, ...half];
      gl.viewport(...box);
      gl.scissor(...box);
      gl.clearColor(...ground, 1);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      if (side === 0) faced(SHADED, 0);
      else {
        // What is behind the surface is not seen through it.
        faced(GROUND, 2e-4);
        gl.uniform1i(at.look, LINES);
        gl.uniform1f(at.back, 0);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, lines);
        gl.drawElements(gl.LINES, ends, gl.UNSIGNED_INT, 0);
      }
    }
  }

  const TURN = 0.008;
  function turn(x, y) {
    camera.across -= x;
    camera.up = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, camera.up - y));
    ask();
  }
  function zoom(by) {
    camera.distance = Math.max(0.02, Math.min(4, camera.distance * by));
    ask();
  }
  /** By pixels. */
  function shift(x, y) {
    const half = tall.matches ? [canvas.clientWidth, canvas.clientHeight / 2] : [canvas.clientWidth / 2, canvas.clientHeight];
    const step = (2 * DISTANCE * camera.distance) / (SCALE * Math.min(...half));
    camera.aside[0] += x * step;
    camera.aside[1] -= y * step;
    ask();
  }
  function home() {
    camera = { ...WHOLE, aside: [0, 0] };
    ask();
  }

  const held = new Map();
  const between = () => {
    const [a, b] = [...held.values()];
    return { distance: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = held.get(event.pointerId);
    if (!last) return;
    const before = held.size === 2 ? between() : null;
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const [x, y] = [event.clientX - last.x, event.clientY - last.y];
    if (before) {
      const now = between();
      if (now.distance > 0 && before.distance > 0) zoom(before.distance / now.distance);
      shift(now.x - before.x, now.y - before.y);
    } else if (held.size === 1) {
      if (event.shiftKey || event.buttons & 6) shift(x, y);
      else turn(x * TURN, y * TURN);
    }
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => held.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      zoom(Math.exp(Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) * 0.0015));
    },
    { passive: false },
  );
  canvas.addEventListener("dblclick", home);
  const KEYS = {
    ArrowLeft: () => turn(-0.1, 0),
    ArrowRight: () => turn(0.1, 0),
    ArrowUp: () => turn(0, -0.1),
    ArrowDown: () => turn(0, 0.1),
    "+": () => zoom(0.9),
    "=": () => zoom(0.9),
    "-": () => zoom(1 / 0.9),
    0: home,
  };
  canvas.addEventListener("keydown", (event) => {
    const act = !event.ctrlKey && !event.metaKey && !event.altKey && KEYS[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  for (const choice of section.querySelectorAll("input")) {
    choice.addEventListener("change", () => {
      shown = Number(choice.value);
      ask();
    });
  }
  section.querySelector("button").addEventListener("click", () => save(levels[shown]));
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => (made(), ask()));
  for (const media of [tall, matchMedia("(prefers-color-scheme:dark)")]) media.addEventListener("change", ask);
  new ResizeObserver(ask).observe(canvas);

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

  made();
  section.hidden = false;
  ask();
})();
