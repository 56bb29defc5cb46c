// A surface in a canvas, shaded and as wireframe, side by side, to be turned and zoomed. A page that was saved has it (viewer.js),
// and the element of the npm package.
"use strict";

/**
 * Draws levels: `place` has three numbers a vertex in mm, `corners` three a triangle, and `normals`, where they are there, three
 * a vertex. `isTall()` says whether one picture stands above the other, `takesWheel(event)` whether a turn of the wheel zooms or is
 * the page's. Colours are the style's --ground and --ink. Null where there is no WebGL2. After `end()` the canvas is of no use.
 */
function surfaceView(canvas, isTall, takesWheel = () => true) {
  const gl = canvas.getContext("webgl2", { antialias: true });
  if (!gl) return null;

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
    buffers = new Map();
  }

  /** A level in graphics memory, from when it is first shown. */
  function uploaded(level) {
    if (!buffers.has(level)) {
      const owned = [];
      const whole = (target, data) => {
        const buffer = gl.createBuffer();
        owned.push(buffer);
        gl.bindBuffer(target, buffer);
        gl.bufferData(target, data, gl.STATIC_DRAW);
        return buffer;
      };
      const attributes = gl.createVertexArray();
      gl.bindVertexArray(attributes);
      for (const [name, data] of [["place", level.place], ["normal", level.normals ?? normals(level)]]) {
        whole(gl.ARRAY_BUFFER, data);
        const slot = gl.getAttribLocation(program, name);
        gl.enableVertexAttribArray(slot);
        gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, 0, 0);
      }
      const lines = edges(level);
      gl.bindVertexArray(null);
      const faces = whole(gl.ELEMENT_ARRAY_BUFFER, level.corners);
      buffers.set(level, { attributes, faces, lines: whole(gl.ELEMENT_ARRAY_BUFFER, lines), ends: lines.length, owned });
    }
    return buffers.get(level);
  }

  function forget(level) {
    const known = buffers.get(level);
    if (!known) return;
    for (const buffer of known.owned) gl.deleteBuffer(buffer);
    gl.deleteVertexArray(known.attributes);
    buffers.delete(level);
  }

  // The camera: turned about the middle of the box, which it sees from the patient's front.
  let [middle, radius] = [[0, 0, 0], 1];
  const WHOLE = { across: 0, up: 0, distance: 1, aside: [0, 0] };
  // In radii of what is seen, and how large that is: all of it is in the picture.
  const [DISTANCE, SCALE] = [3.2, 3];
  let camera = { ...WHOLE, aside: [0, 0] };
  let shown = null;

  /** Looks at all of a level; the patient's front is turned by so many radians from the -y of the file. */
  function frame({ place }, across) {
    const [least, most] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    for (let i = 0; i < place.length; i++) {
      least[i % 3] = Math.min(least[i % 3], place[i]);
      most[i % 3] = Math.max(most[i % 3], place[i]);
    }
    middle = least.map((low, k) => (low + most[k]) / 2);
    radius = farthest(place) || 1;
    WHOLE.across = across;
    home();
  }

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
    if (!shown || !canvas.isConnected || gl.isContextLost()) return;
    const [wide, high] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * devicePixelRatio)));
    if (canvas.width !== wide || canvas.height !== high) [canvas.width, canvas.height] = [wide, high];
    const [ground, line] = [colour("--ground"), colour("--ink")];
    const { attributes, faces, lines, ends } = uploaded(shown);
    gl.bindVertexArray(attributes);
    // One above the other where there is no room beside.
    const half = isTall() ? [wide, Math.floor(high / 2)] : [Math.floor(wide / 2), high];
    gl.uniformMatrix4fv(at.view, false, view());
    gl.uniformMatrix4fv(at.projection, false, projection(half[0] / half[1]));
    gl.uniform3fv(at.ground, ground);
    gl.uniform3fv(at.line, line);
    const faced = (look, back) => {
      gl.uniform1i(at.look, look);
      gl.uniform1f(at.back, back);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, faces);
      gl.drawElements(gl.TRIANGLES, shown.corners.length, gl.UNSIGNED_INT, 0);
    };
    for (const side of [0, 1]) {
      const box = isTall() ? [0, (1 - side) * half[1], ...half] : [side * half[0], 0, ...half];
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
    const half = isTall() ? [canvas.clientWidth, canvas.clientHeight / 2] : [canvas.clientWidth / 2, canvas.clientHeight];
    const step = (2 * DISTANCE * camera.distance) / (SCALE * Math.min(...half));
    camera.aside[0] += x * step;
    camera.aside[1] -= y * step;
    ask();
  }
  function home() {
    camera = { ...WHOLE, aside: [0, 0] };
    ask();
  }

  const ended = new AbortController();
  const on = (kind, act, options) => canvas.addEventListener(kind, act, { ...options, signal: ended.signal });
  const held = new Map();
  const between = () => {
    const [a, b] = [...held.values()];
    return { distance: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  };
  on("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  on("pointermove", (event) => {
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
  for (const end of ["pointerup", "pointercancel"]) on(end, (event) => held.delete(event.pointerId));
  on("contextmenu", (event) => event.preventDefault());
  on(
    "wheel",
    (event) => {
      if (!takesWheel(event)) return;
      event.preventDefault();
      zoom(Math.exp(Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) * 0.0015));
    },
    { passive: false },
  );
  on("dblclick", home);
  const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const arrow = ([x, y], shifts) => (shifts ? shift(20 * x, 20 * y) : turn(0.1 * x, 0.1 * y));
  const KEYS = {
    "+": () => zoom(0.9),
    "=": () => zoom(0.9),
    "-": () => zoom(1 / 0.9),
    0: home,
  };
  on("keydown", (event) => {
    const { key } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || !(key in ARROWS || key in KEYS)) return;
    event.preventDefault();
    if (key in ARROWS) arrow(ARROWS[key], event.shiftKey);
    else KEYS[key]();
  });
  on("webglcontextlost", (event) => event.preventDefault());
  on("webglcontextrestored", () => (made(), ask()));
  const dark = matchMedia("(prefers-color-scheme:dark)");
  dark.addEventListener("change", ask, { signal: ended.signal });
  const sizes = new ResizeObserver(ask);
  sizes.observe(canvas);

  made();
  return {
    frame,
    forget,
    redraw: ask,
    show(level) {
      shown = level;
      ask();
    },
    end() {
      shown = null;
      ended.abort();
      sizes.disconnect();
      gl.getExtension("WEBGL_lose_context")?.loseContext();
    },
  };
}
