// Lumen for programs. Not for clinical decisions.

import type { Certificate, ImportReport, Keep, Report, Settings, SettingsByName, Target, VerdictReport } from "./types.js";

export type * from "./types.js";

/** How far a piece of work is. */
export interface Progress {
  /** What is done, in English: `Smoothing`. */
  stage: string;
  /** The part of the stage that is done, 0 to 1. */
  fraction: number;
}

export interface Cancellable {
  /** Cancels: the promise is rejected with the signal's reason, and what was made before stays. */
  signal?: AbortSignal;
  /** What it throws cancels, too, and rejects the promise. */
  progress?: (progress: Progress) => void;
}

/**
 * Settings over the defaults: as they stand in a settings file under `settings`, whole or in part, or by the names of the
 * command line, such as `"pass-band": 0.01`. The target is said once.
 */
export type AnySettings = { [Part in keyof Settings]?: Part extends "keep" ? Keep | "largest" | "all" | number : Settings[Part] extends Target | string ? Settings[Part] : Partial<Settings[Part]> } & SettingsByName;

/** What was made. */
export interface Result {
  /** What `lumen optimise --report` writes. */
  report: Report;
  /** What there is to say of the result, the weightiest first; it stands in the report, too. */
  verdict: VerdictReport;
  /** The calibre of each vessel; null where it was not measured, or there is no vessel. */
  certificate: Certificate | null;
}

/** A level of detail. The arrays are the program's own. */
export interface Level {
  /** Three numbers a vertex, in mm. */
  positions: Float32Array;
  /** Three corners a triangle, counter-clockwise from outside. */
  indices: Uint32Array;
  /** Three numbers a vertex. */
  normals: Float32Array;
}

/** The middle of each vessel of the surface as it was opened, station by station. */
export interface Centrelines {
  /** Three numbers a station, in mm. */
  positions: Float32Array;
  /** Of the largest ball inside, in mm. */
  radii: Float32Array;
  /** Of the circle as large as the cross-section, in mm; NaN where that does not close. */
  sectionRadii: Float32Array;
  /** The first station of each branch, and behind them the number of all. */
  starts: Uint32Array;
  /** The branch that each comes out of, from 0; -1 for the first of a tree. */
  parents: Int32Array;
}

/**
 * An opened surface. It has a Worker of its own; after that has died, the next call begins anew from the file. An argument of the
 * wrong kind rejects with a TypeError, a number out of range with a RangeError, and nothing else happens.
 */
export interface Surface {
  /** What `lumen inspect --json` says of the file. */
  readonly info: ImportReport;
  /**
   * Keeps a piece, smooths and reduces it. `measures` says how much is measured: the levels alone (false), deviation, shape and
   * lumen (true), or the calibre of each vessel, too ("certificate", the default). Newer settings take the place of older ones
   * that are not done yet.
   */
  optimise(settings?: AnySettings, options?: Cancellable & { measures?: boolean | "certificate" }): Promise<Result>;
  /** The level after a reduction by so many percent, 0 to 99.9; the one that the settings ask for where that is not said. */
  level(reduction?: number): Promise<Level>;
  /** Where the vessels were measured. */
  centrelines(): Promise<Centrelines>;
  /** A level as a file: the bytes that `lumen optimise` writes. */
  save(format: "stl" | "ply" | "obj" | "vtp" | "vtk" | "glb", reduction?: number): Promise<Uint8Array>;
  /** Ends the Worker and gives back its memory. What is asked afterwards is refused: `npm-closed`. */
  close(): void;
}

/** Reads a surface: STL, PLY, OBJ, VTP, VTK, glTF. The name matters where the content does not tell the format. */
export function open(
  bytes: Uint8Array | ArrayBuffer | Blob,
  name?: string,
  options?: Cancellable & { unit?: "mm" | "cm" | "m" | "auto" },
): Promise<Surface>;

/** An error of Lumen's own; its message is plain English. */
export class LumenError extends Error {
  /** What went wrong: `errors-file-empty`, `npm-stopped`. */
  readonly id: string;
  /** The numbers and words of the message, by their names. */
  readonly values: Record<string, unknown>;
}
