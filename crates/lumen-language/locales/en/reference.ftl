### The open surface beside another file, whoever made it.

## Where it begins: an entry of a menu, a button beside a notice

reference-open = Compare with a file...
reference-open-help = Another file as the reference: how far the surface is from it, and each vessel's calibre on both
reference-back = Back to { $name }
reference-back-help = The comparison with this file
reference-take-next = Compare with it
reference-take-next-help = Takes the next of the files as the reference for this one

## What is compared, and how: in the panel

reference-heading = Two surfaces
reference-close-help = Back to the two views (Esc)
reference-reference = Reference
reference-reference-help = What the surface is compared with; another file can be dropped here
reference-other = Other...
reference-other-help = Compare with another file
reference-unit = Unit:
reference-unit-help = Of the numbers in the reference's file
reference-surface = Surface:
reference-surface-help = What is judged
reference-opened = as opened
reference-level = reduced
# The name of the surface in the report.
reference-level-of = { $name }, reduced
reference-mended = { $name }, mended
reference-move = Move it:
reference-move-help = Whether the surface is moved onto the reference first
reference-still = not
reference-still-help = Both where their files have them
reference-axes = axes
reference-axes-help = Turned where one file is in LPS and the other in RAS
reference-rigid = best fit
reference-rigid-help = Turned and shifted as the two fit best
reference-work = Comparing with the reference

## What came of it

reference-coming = The two are being compared...
reference-no-level = There is no reduced surface yet.
reference-again = Compare again
reference-failed = They cannot be compared: { $why }.
reference-moved = Moved by { $mm } mm on the mean, turned by { $degrees }°.
reference-fit = After the fit the nearest four fifths of the surface are { $mm } mm away (RMS), { $before } mm before.
reference-apart = They lie { $mm } mm apart on the mean.
reference-bring-together = Bring them together
reference-axes-differ = One is in LPS, the other in RAS: left and right are not on the same side.
reference-turn = Turn it
# Of the reference's file; $note is a sentence.
reference-note = Reference: { $note }
reference-column-reference = Reference
reference-column-surface = Surface
reference-triangles = Triangles
reference-area = Area
reference-volume = Volume
reference-mean = Distance, mean
reference-rms = Distance, RMS
reference-p95 = Distance, 95 %
reference-distance-help = Between the two, measured both ways over samples of each
reference-signed-help = Outside and inside in colours of their own, or only how far
reference-farthest-reference = Farthest on reference
reference-farthest-surface = Farthest on surface
reference-farthest-help = How far the farthest point of it is from the other: no point is farther than { $most } mm, for certain
reference-go = Go there
reference-go-long = Go there: { $what }
reference-no-vessels = Calibre: { $why }.
reference-changed = { $all ->
    [one] The vessel changed by more than { $tolerance } %.
   *[other] { $changed } of { $all } vessels changed by more than { $tolerance } %.
}
reference-kept = Kept within { $tolerance } % where measured.
reference-not-measured = No vessel can be measured.
reference-measured = Measured: { $percent } % of the length.
reference-column-vessel = Vessel
reference-column-vessel-help = As numbered on the reference
reference-column-radius-help = Mean radius in mm, of the circle of the same area
reference-column-change = Change
reference-column-change-help = The largest change of its radius from the reference
reference-column-verdict = Calibre
reference-save-numbers = Save JSON
reference-save-numbers-help = All numbers, as lumen compare writes them
reference-save-stations = Save CSV
reference-save-stations-help = Area and radius on both at each place of each vessel

## Over the pictures

reference-distance-title = Distance from the other
reference-legend = Distance
reference-legend-sides = surface outside red, inside blue
