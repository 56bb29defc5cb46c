// Made from Rust: LUMEN_WRITE=1 cargo test -p lumen-npm

export interface Adapted {
  vertices_percent: number;
  widest_pass_band: number;
}

export interface Angles {
  min_deg: number;
  p1_deg: number;
  mean_min_deg: number;
  below_10_percent: number;
  histogram: [number, number, number, number, number, number, number, number, number, number, number, number, number, number, number, number, number, number];
}

export interface ArrayInfo {
  name: string;
  on: Association;
  kind: ArrayKind;
  type: Scalar;
  components: number;
  range: [number, number] | null;
  labels: number[];
}

export type ArrayKind = "continuous" | "label";

export type Association = "point" | "triangle";

export interface AutoReport {
  percent: number;
  steps: number;
  is_decided: boolean;
}

export type Axes = "lps" | "ras" | "unknown";

export interface BoundReport {
  max_deviation_mm: number;
  steps: number;
  next_coarser_mm: number | null;
}

export type Boundary = "Loop" | "Vtk15";

export interface Bounds {
  min: [number, number, number];
  max: [number, number, number];
}

export interface BranchCalibre {
  number: number;
  name: string;
  parent: number | null;
  length_mm: number;
  tortuosity: number | null;
  verdict: Verdict;
  verdict_smoothed: Verdict;
  stations_counted: number;
  abscissas_mm: number[];
  at_mm: [number, number, number][];
  standings: StationStatus[];
  opened: OnSurface;
  smoothed: OnSurface;
  reduced: OnSurface;
  variations: Variation[];
}

export interface BranchSafe {
  number: number;
  name: string;
  changed_by_smoothing: boolean;
  kept_to_percent: number | null;
  changed_from_percent: number | null;
}

export interface CalibreReport {
  tolerance_percent: number;
  verdict: Verdict | null;
  coverage: Coverage | null;
  measured_percent: number | null;
  refused: string | null;
  ms: number;
}

export interface CapArea {
  before_mm2: number;
  after_mm2: number;
  centre: [number, number, number];
}

export interface Certificate {
  tolerance_percent: number;
  verdict: Verdict;
  coverage: Coverage;
  branches: BranchCalibre[];
  openings_without_branch: number;
}

export interface Change {
  percent: number;
  at_mm: [number, number, number];
  abscissa_mm: number;
}

export interface Counts {
  vertices: number;
  triangles: number;
  components: number;
}

export interface Coverage {
  length_mm: number;
  measured_mm: number;
  ends_mm: number;
  forks_mm: number;
  thin_mm: number;
  unclear_mm: number;
  vessels: number;
  vessels_measured: number;
}

export interface Decimation {
  method: Method;
  feature_angle: number;
  spare_thin: boolean;
  keep_labels: boolean;
}

export interface Deviation {
  mean: number;
  rms: number;
  p95: number;
  max: number;
  max_at_mm: [[number, number, number], [number, number, number]];
}

export interface FaultCounts {
  non_manifold_edges: number;
  non_manifold_vertices: number;
  holes: number;
  largest_hole_mm: number | null;
  vessel_ends: number;
  sheet_edges: number;
  wall: Wall | null;
}

export interface FindingReport {
  text: string;
  is_grave: boolean;
  place: PlaceReport | null;
  remedies: RemedyReport[];
}

export interface ImportReport {
  format: string;
  unit: Unit;
  unit_by_size: boolean;
  scale_to_mm: number;
  axes: Axes;
  triangles: number;
  vertices: number;
  polygons_triangulated: number;
  degenerate_triangles: number;
  duplicate_triangles: number;
  components: number;
  largest_component_triangles: number;
  boundary_edges: number;
  non_manifold_edges: number;
  winding_flips: number;
  reoriented_triangles: number;
  components_turned: number;
  orientable: boolean;
  area_mm2: number;
  volume_mm3: number | null;
  bounds_mm: Bounds;
  moved_mm: [number, number, number];
  threshold: ThresholdReport | null;
  arrays: ArrayInfo[];
  skipped: Skipped;
  warnings: string[];
}

export type Keep = "Largest" | { Component: number } | { Pieces: number[] } | "All";

export interface MendReport {
  vertices_welded: number;
  weld_limited: number;
  reoriented_triangles: number;
  components_turned: number;
  wall: Wall | null;
  wall_triangles_left_out: number;
  wall_not_parted: boolean;
  edges_split: number;
  vertices_split: number;
  duplicates_left_out: number;
  holes_filled: number;
  holes_left: number;
  triangles_added: number;
}

export interface Mending {
  weld_mm: number | null;
  split: boolean;
  fill_mm: number | null;
  lumen: boolean;
}

export type Method = "Schroeder" | "Quadric";

export interface Narrowest {
  diameter_mm: number;
  at_mm: [number, number, number];
}

export interface Narrowing {
  ratio: number;
  at_mm: [number, number, number];
  diameter_before_mm: number;
  diameter_after_mm: number;
  pinched_places: number;
}

export interface OnSurface {
  radius_mm: Spread | null;
  inscribed_radius_mm: Spread | null;
  largest_change: Change | null;
  areas_mm2: (number | null)[];
  radii_mm: (number | null)[];
  inscribed_radii_mm: (number | null)[];
  changes_percent: (number | null)[];
}

export interface Pinch {
  from_percent: number;
  triangles: number;
  at_mm: [number, number, number];
  diameter_before_mm: number;
  diameter_after_mm: number;
}

export interface PlaceReport {
  at_mm: [number, number, number];
  width_mm: number;
  label: string;
}

export type Remedied = { settings: Settings } | { unit: Unit };

export interface RemedyReport {
  words: string;
  change: Remedied;
}

export interface Report {
  disclaimer: string;
  lumen: string;
  input: string;
  opened: Counts;
  after_connectivity: Counts;
  output: Counts;
  output_fingerprint: string;
  axes: Axes;
  unit: UnitReport | null;
  threshold: ThresholdReport | null;
  settings: Settings;
  mending: MendReport | null;
  faults: FaultCounts | null;
  reduction_percent: number;
  shortfall: string | null;
  bound: BoundReport | null;
  auto: AutoReport | null;
  pass_band_missed: boolean;
  smoothing_response: SmoothingResponse | null;
  volume_held: boolean | null;
  smoothing_adapted: Adapted | null;
  smoothing_weakened: WeakenedReport | null;
  stages_ms: StageTimes;
  deviation_mm: Deviation | null;
  deviation_from_original_mm: Deviation | null;
  volume_change_percent: number | null;
  area_change_percent: number | null;
  volume_change_from_smoothed_percent: number | null;
  area_change_from_smoothed_percent: number | null;
  arrays: ArrayInfo[] | null;
  smoothed_shape: Shape | null;
  output_shape: Shape | null;
  narrowing: Narrowing | null;
  caps: CapArea[] | null;
  pinch: Pinch | null;
  safe: SafeReport | null;
  calibre: CalibreReport | null;
  branches: BranchCalibre[] | null;
  verdict: VerdictReport | null;
}

export interface Roughness {
  rms_deg: number;
  p95_deg: number;
  max_deg: number;
}

export interface SafeReport {
  tolerance_percent: number;
  percent: number | null;
  triangles: number | null;
  coverage: Coverage | null;
  is_covered: boolean;
  stopped_by: string | null;
  branches: BranchSafe[];
  refused: string | null;
}

export type Scalar = "int8" | "uint8" | "int16" | "uint16" | "int32" | "uint32" | "int64" | "uint64" | "float32" | "float64";

export interface Settings {
  mending?: Mending;
  keep: Keep;
  smoothing: Smoothing;
  decimation: Decimation;
  target: Target;
  tolerance_percent: number;
}

export interface Shape {
  roughness: Roughness | null;
  angles: Angles | null;
  self_intersecting_faces: number;
  smallest_lumen: Narrowest | null;
}

export interface Side {
  abscissa_mm: number;
  diameter_mm: number;
}

export interface Skipped {
  short_faces: number;
  lines: number;
  points: number;
}

export interface Smoothing {
  window: Window;
  pass_band: number;
  iterations: number;
  boundary: Boundary;
  preserve_volume: boolean;
  adapt: boolean;
  guard: boolean;
  hold_caps: boolean;
}

export interface SmoothingResponse {
  pass_band: number;
  half_gain: number | null;
  wavelength_mm_at_pass_band: number | null;
  wavelength_mm_at_half_gain: number | null;
  edge_length_mm: number;
}

export interface Spread {
  least: number;
  mean: number;
  largest: number;
}

export interface StageTimes {
  read: number;
  mending: number;
  connectivity: number;
  adjacency: number;
  smoothing: number;
  decimation: number;
  bound: number;
  level: number;
  normals: number;
  areas: number;
  deviation: number;
  arrays: number;
  measures: number;
  calibre: number;
  faults: number;
  safe: number;
  write: number;
}

export type StationStatus = "counts" | "end" | "fork" | "thin" | "not_closed" | "ambiguous";

export type Target = "Auto" | { Reduction: number } | { Triangles: number } | { Deviation: number };

export interface ThresholdReport {
  value: number;
  lower_mm: number;
  higher_mm: number;
}

export type Unit = "mm" | "cm" | "m";

export interface UnitReport {
  unit: Unit;
  by_size: boolean;
}

export interface Variation {
  kind: VariationKind;
  degree_percent: number;
  area_percent: number;
  reduced_degree_percent: number | null;
  diameter_mm: number;
  reference_mm: number;
  sides: [Side | null, Side | null];
  from_mm: number;
  to_mm: number;
  length_mm: number;
  abscissa_mm: number;
  at_mm: [number, number, number];
}

export type VariationKind = "narrower" | "wider";

export type Verdict = "kept" | "changed" | "not_measured";

export interface VerdictReport {
  head: string;
  is_safe: boolean | null;
  calibre: string | null;
  findings: FindingReport[];
}

export interface Wall {
  thickness_mm: number;
  thinner_mm: number;
  thicker_mm: number;
  is_two_pieces: boolean;
}

export interface WeakenedReport {
  triangles_spared: number;
  vertices: number;
  at_mm: [number, number, number];
}

export type Window = "Hamming" | "Hanning" | "Blackman" | "Nuttall";

/** Settings by the names of the command line. */
export interface SettingsByName {
  /** `mending.weld_mm` in a settings file. */
  "weld"?: number;
  /** `mending.split` in a settings file. */
  "split"?: boolean;
  /** `mending.fill_mm` in a settings file. */
  "fill-holes"?: number;
  /** `mending.lumen` in a settings file. */
  "lumen"?: boolean;
  /** `smoothing.window` in a settings file. */
  "window"?: "hamming" | "hanning" | "blackman" | "nuttall";
  /** `smoothing.pass_band` in a settings file. */
  "pass-band"?: number;
  /** `smoothing.iterations` in a settings file. */
  "iterations"?: number;
  /** `smoothing.boundary` in a settings file. */
  "boundary"?: "loop" | "vtk15";
  /** `smoothing.preserve_volume` in a settings file. */
  "preserve-volume"?: boolean;
  /** `smoothing.adapt` in a settings file. */
  "adapt"?: boolean;
  /** `smoothing.guard` in a settings file. */
  "guard"?: boolean;
  /** `smoothing.hold_caps` in a settings file. */
  "hold-caps"?: boolean;
  /** `decimation.method` in a settings file. */
  "method"?: "schroeder" | "quadric";
  /** `decimation.feature_angle` in a settings file. */
  "feature-angle"?: number;
  /** `decimation.spare_thin` in a settings file. */
  "spare-thin"?: boolean;
  /** `decimation.keep_labels` in a settings file. */
  "keep-labels"?: boolean;
  /** `target` in a settings file. */
  "reduction"?: "auto" | number;
  /** `target` in a settings file. */
  "triangles"?: number;
  /** `target` in a settings file. */
  "max-deviation"?: number;
  /** `tolerance_percent` in a settings file. */
  "tolerance"?: number;
}
