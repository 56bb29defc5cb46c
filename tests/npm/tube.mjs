// A vessel for tests of the npm package: a bent tube that widens, with the steps of a scan on its wall.

/** Binary STL of 2 x `around` x `along` triangles, open at both ends; lengths in mm. */
export function tube({ around = 48, along = 120, radius = 4 } = {}) {
  const ring = (i, j) => {
    const [t, turn] = [i / along, (2 * Math.PI * j) / around];
    const wide = radius * (1 + 0.2 * Math.sin(5 * t)) + 0.1 * ((7 * i + 3 * j) % 3);
    const out = 30 + wide * Math.cos(turn);
    return [out * Math.cos(2 * t), out * Math.sin(2 * t), wide * Math.sin(turn)];
  };
  const triangles = [];
  for (let i = 0; i < along; i++) {
    for (let j = 0; j < around; j++) {
      const [a, b, c, d] = [ring(i, j), ring(i + 1, j), ring(i + 1, (j + 1) % around), ring(i, (j + 1) % around)];
      triangles.push([a, b, c], [a, c, d]);
    }
  }
  const bytes = Buffer.alloc(84 + 50 * triangles.length);
  bytes.writeUInt32LE(triangles.length, 80);
  triangles.forEach((corners, t) => corners.flat().forEach((x, k) => bytes.writeFloatLE(x, 84 + 50 * t + 12 + 4 * k)));
  return bytes;
}
