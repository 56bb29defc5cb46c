// A scan of our own, as files of several formats, written by what their descriptions say and by nothing of Lumen's.

import { gzipSync } from "node:zlib";

/** Voxels along the axes, and mm between them. */
export const SIZE = [64, 56, 48];
const SPACING = [0.5, 0.6, 0.75];
const ORIGIN = [-16, 30, 400];
/** In CT, arteries with contrast. */
export const THRESHOLD = 180;
export const MIDDLE = [15.75, 16.5, 17.625];

/** A bent vessel of 4 mm in air-filled tissue: Hounsfield units, columns running fastest. */
export function values() {
  const [columns, rows, slices] = SIZE;
  const all = new Int16Array(columns * rows * slices);
  let at = 0;
  for (let k = 0; k < slices; k++) {
    for (let j = 0; j < rows; j++) {
      for (let i = 0; i < columns; i++) {
        const [x, y, z] = [i * SPACING[0], j * SPACING[1], k * SPACING[2]].map((place, axis) => place - MIDDLE[axis]);
        const away = Math.hypot(x - 4 * Math.sin(z / 8), y - 3 * Math.cos(z / 10)) - 4;
        // 60 HU a mm at the wall; a corner of air, by which it is known as CT.
        all[at++] = i + j + k < 6 ? -1000 : Math.round(Math.min(400, Math.max(0, THRESHOLD + 0.5 - 60 * away)));
      }
    }
  }
  return all;
}

const bytesOf = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength);

/** A header of NIfTI for numbers of 16 bits: voxels along the axes, mm between them, the place of the first in LPS. */
export function niftiHeader(size, spacing, origin) {
  const header = Buffer.alloc(352);
  header.writeInt32LE(348, 0);
  [3, ...size, 1, 1, 1, 1].forEach((n, index) => header.writeInt16LE(n, 40 + 2 * index));
  header.writeInt16LE(4, 70);
  header.writeInt16LE(16, 72);
  [1, ...spacing].forEach((n, index) => header.writeFloatLE(n, 76 + 4 * index));
  header.writeFloatLE(352, 108);
  header.writeFloatLE(1, 112);
  header[123] = 2;
  header.writeInt16LE(1, 254);
  // To RAS, row by row: x and y run the other way there.
  for (let row = 0; row < 3; row++) {
    const sign = row < 2 ? -1 : 1;
    const [step, place] = [sign * spacing[row], sign * origin[row]];
    [0, 1, 2].forEach((column) => header.writeFloatLE(column === row ? step : 0, 280 + 16 * row + 4 * column));
    header.writeFloatLE(place, 280 + 16 * row + 12);
  }
  header.write("n+1\0", 344, "latin1");
  return header;
}

/** One file of NIfTI, packed. */
export function nifti() {
  const header = niftiHeader(SIZE, SPACING, ORIGIN);
  return [{ name: "vessel.nii.gz", buffer: gzipSync(Buffer.concat([header, bytesOf(values())])) }];
}

/** A header of MetaImage and its data. */
export function metaimage() {
  const header = [
    "ObjectType = Image",
    "NDims = 3",
    "BinaryData = True",
    `Offset = ${ORIGIN.join(" ")}`,
    `ElementSpacing = ${SPACING.join(" ")}`,
    `DimSize = ${SIZE.join(" ")}`,
    "ElementType = MET_SHORT",
    "ElementDataFile = vessel.raw",
  ];
  return [
    { name: "vessel.raw", buffer: bytesOf(values()) },
    { name: "vessel.mhd", buffer: Buffer.from(`${header.join("\n")}\n`) },
  ];
}

/** An element of DICOM, explicit VR, little-endian. */
function element(group, number, kind, value) {
  const text = typeof value === "string";
  let body = text ? Buffer.from(value, "latin1") : value;
  if (body.length % 2) body = Buffer.concat([body, Buffer.from([kind === "UI" ? 0 : 32])]);
  const long = ["OB", "OW"].includes(kind);
  const head = Buffer.alloc(long ? 12 : 8);
  head.writeUInt16LE(group, 0);
  head.writeUInt16LE(number, 2);
  head.write(kind, 4, "latin1");
  if (long) head.writeUInt32LE(body.length, 8);
  else head.writeUInt16LE(body.length, 6);
  return Buffer.concat([head, body]);
}

const short = (n) => {
  const bytes = Buffer.alloc(2);
  bytes.writeUInt16LE(n);
  return bytes;
};

/** A series of DICOM, its slices in no order. */
export function dicom() {
  const [columns, rows, slices] = SIZE;
  const all = values();
  const syntax = element(0x0002, 0x0010, "UI", "1.2.840.10008.1.2.1");
  const length = Buffer.alloc(4);
  length.writeUInt32LE(syntax.length);
  const files = Array.from({ length: slices }, (_, k) => {
    const pixels = all.subarray(k * columns * rows, (k + 1) * columns * rows);
    const elements = [
      element(0x0002, 0x0000, "UL", length),
      syntax,
      element(0x0008, 0x0060, "CS", "CT"),
      element(0x0020, 0x000e, "UI", "1.2.3.4"),
      element(0x0020, 0x0013, "IS", String(k + 1)),
      element(0x0020, 0x0032, "DS", [ORIGIN[0], ORIGIN[1], ORIGIN[2] + k * SPACING[2]].join("\\")),
      element(0x0020, 0x0037, "DS", "1\\0\\0\\0\\1\\0"),
      element(0x0028, 0x0002, "US", short(1)),
      element(0x0028, 0x0004, "CS", "MONOCHROME2"),
      element(0x0028, 0x0010, "US", short(rows)),
      element(0x0028, 0x0011, "US", short(columns)),
      element(0x0028, 0x0030, "DS", `${SPACING[1]}\\${SPACING[0]}`),
      element(0x0028, 0x0100, "US", short(16)),
      element(0x0028, 0x0101, "US", short(16)),
      element(0x0028, 0x0102, "US", short(15)),
      element(0x0028, 0x0103, "US", short(1)),
      element(0x0028, 0x1052, "DS", "0"),
      element(0x0028, 0x1053, "DS", "1"),
      element(0x7fe0, 0x0010, "OW", bytesOf(pixels)),
    ];
    return { name: `IM${String((k * 29) % slices).padStart(4, "0")}`, buffer: Buffer.concat([Buffer.alloc(128), Buffer.from("DICM"), ...elements]) };
  });
  return files.sort((a, b) => (a.name < b.name ? -1 : 1));
}
