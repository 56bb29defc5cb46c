### Reports: what stands on the page for the record (PDF and web page). The names of rows are narrow in the PDF: some 22 letters; the heads of columns some 10.

report-title = Vessel surface
report-not-clinical = Not for clinical decisions.
report-page = Page { $page } of { $count }
report-date = Date
report-case = Case
report-comment = Comment

## Heads of the parts

report-file = File
report-settings = Settings
report-numbers = Numbers
report-by-hand = Measured by hand
report-solver = Ready for a solver: wall, inlets and outlets
report-stretches = Narrower and wider than on either side
report-view-reduced = Reduced: { $count ->
    [one] one triangle
   *[other] { $count } triangles
}
report-view-before = Before: { $count ->
    [one] one triangle
   *[other] { $count } triangles
}
report-view-less = Less reduced: { $count ->
    [one] one triangle
   *[other] { $count } triangles
} of { $all }
report-view-help = Drag to turn, wheel or two fingers to zoom, Shift and drag to move, double-click for the whole; or arrow keys, + and -, 0.
report-view-save = Save as GLB

## The file: the names of rows, and what stands in them

report-fingerprint = Fingerprint (SHA-256)
report-no-fingerprint = none: not from a file
report-format = Format
# A format and the unit of lengths: STL, in mm.
report-format-in = { $format }, in { $unit }
report-opened = Opened
report-counts = { $triangles ->
    [one] { $triangles } triangle
   *[other] { $triangles } triangles
} in { $pieces ->
    [one] one piece
   *[other] { $pieces } pieces
}
report-size = Size
report-size-mm = { $x } x { $y } x { $z } mm
report-axes = Axes
report-axes-unknown = unknown
# That of the scan that the surface was made of, and by how much others would move its wall.
report-threshold = Threshold
report-threshold-moves = { $value }; 10 % lower the wall lies { $lower } mm farther out, 10 % higher { $higher } mm

## Settings

# The pieces of the surface that are kept.
report-keep = Kept
report-keep-largest = the largest piece
report-keep-piece = piece { $number }
report-keep-pieces = pieces { $numbers }
report-keep-all = all pieces
report-mending = Mending
report-no-mending = none
report-lumen-taken = the lumen of a wall taken
report-welded = welded to { $value } mm
# Sheets of triangles that meet in one edge or vertex.
report-split = sheets split
report-filled = holes up to { $value } mm filled
report-smoothing = Smoothing
report-no-smoothing = none
report-filter = pass band { $band }, { $count ->
    [one] { $count } iteration
   *[other] { $count } iterations
}, { $window }
# A preset, and what it stands for.
report-preset = { $preset }: { $filter }
report-no-crossings = no crossings
report-volume-held = volume held
report-reduction = Reduction
report-target-reduction = { $percent } % of the triangles
report-target-auto = { $percent } % of the triangles, chosen automatically
report-target-auto-safe = { $percent } % of the triangles, chosen automatically: as far as is safe
report-target-auto-kept = { $percent } % of the triangles, chosen automatically: as far as vessels are kept where they are measured
report-target-auto-pinched = { $percent } % of the triangles, chosen automatically: as far as no vessel is pinched
report-target-triangles = { $count ->
    [one] to { $count } triangle
   *[other] to { $count } triangles
}
report-target-deviation = within { $most } mm
report-method = Method
report-allowed = Allowed change of calibre

## Numbers

report-triangles = Triangles
report-triangles-of = { $left } of { $all }
report-from-smoothed = Deviation from smoothed
report-from-opened = Deviation from opened
report-distance = { $mean } mm mean, { $most } mm at most
report-volume-change = Change of volume
report-area-change = Change of area
report-half-gain = Half gain of smoothing
report-crossing = Triangles that cross
report-caps = Inlets and outlets
report-smallest-lumen = Smallest lumen
report-measured = Vessels measured
report-output-fingerprint = Surface's fingerprint

## Heads of columns, and cells

report-calibre = Calibre
report-radius = Radius as opened, mm
report-diameter = Diameter
report-by-area = By area
report-diameter-mm = Diameter, mm
# Where along the vessel the reference is measured.
report-reference-at = Reference at, mm
report-at-mm = At, mm
# The least or largest diameter of a stretch, and the reference.
report-diameter-of = { $diameter } of { $reference }
report-measure = Measure
report-found = Found
# On which surface it was measured.
report-made-on = Made on
report-middle = Middle, mm
report-area = Area, mm²
report-end-radius = Radius, mm
report-normal = Normal, outwards
report-point = ({ $x }, { $y }, { $z })
# After a finding: where it is.
report-at = At ({ $x }, { $y }, { $z }) mm.

## Curves: titles, axes and legends, short

report-response = What smoothing leaves of a wave
report-wave-length = Length of a wave, mm
report-eigenvalue = Eigenvalue
# What is left of a wave: an axis, and the curve.
report-left = Left
report-left-curve = left
report-pass-band = pass band
report-change = Change, %
report-change-allowed = allowed: ±{ $percent } %

## Why there is no picture: said after a colon, a full stop follows

report-error-size = a picture of { $width } x { $height } pixels came with { $bytes } bytes
report-error-png = the picture cannot be written: { $why }

report-sweep = Guidewire by reduction: { $file }
report-sweep-rate = Reduction, %
report-sweep-tip = Tip off the unreduced path, mm
report-sweep-deviation = largest
report-sweep-median = median
report-sweep-noise = noise
report-sweep-arrived = Arrive, %
report-sweep-force = Peak wall force, mN
