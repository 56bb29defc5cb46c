### The panel beside the views: the steps of the method with their settings, and the result in numbers. It is 296 points
### wide: a name on the left shares its row with a value or a list on the right.

## Controls

# Beside a field that holds a number.
panel-type = Drag, or click to type
# For assistive tools: the field beside the slider $name.
panel-value = { $name } value
# On the button that sets a value back; $unit begins with a space, where there is one.
panel-back-to = Back to { $value }{ $unit }
# For assistive tools: $name is "pass band".
panel-reset = Reset { $name }

# On a button: goes to a place in the view, or marks places there.
panel-show = Show
# On a button: sets what was found.
panel-go-there = Go there
# The head of what is folded up in a step.
panel-advanced = Advanced
panel-advanced-help = What seldom needs another setting
# For assistive tools: $step is "Smooth" or "Reduce".
panel-advanced-of = Advanced: { $step }

## Step 1: the surface

panel-surface = Surface
panel-surface-does = The largest connected piece is kept.
panel-surface-none = Open a surface, or drop a file here.
# Beside the name of step 1 while it is folded: keep it short.
panel-surface-to-mend = needs mending
panel-in-file = Triangles in file
panel-in-file-help = As the file holds them, polygons split
panel-kept = Kept
panel-triangle-count = { $count ->
    [one] { $count } triangle
   *[other] { $count } triangles
}
panel-left-out = Left out
panel-left-out-help = Pieces that share no vertex with the one that is kept
# $count triangles.
panel-left-out-count = { $pieces ->
    [one] { $count } in { $pieces } piece
   *[other] { $count } in { $pieces } pieces
}
panel-show-left-out = Show what is left out
panel-show-left-out-help = Click a piece in the view to keep that one; with Shift or Ctrl to add it or take it away
panel-unit = Unit of the file
panel-unit-help = What a length of 1 in the file means
# For assistive tools: the list of units.
panel-unit-list = Unit
panel-all-pieces = All pieces
# In place of a list of them: from 2 to 16.
panel-pieces = { $count } pieces
panel-piece-add = Keeps this piece as well, or no longer
# For assistive tools: $piece is "1,234 triangles, 56.7 mm".
panel-piece-keep = Keep the piece of { $piece }
# A piece in a list.
panel-piece = { $count ->
    [one] { $count } triangle, { $size } mm
   *[other] { $count } triangles, { $size } mm
}
# For assistive tools: the list of pieces.
panel-piece-list = Piece

## Step 1: the axes of the file

panel-axes = Axes of the file
panel-axes-help = What the coordinates grow towards: left, posterior, superior (LPS, as in DICOM) or right, anterior, superior (RAS)
panel-axes-unknown = Unknown
# Before the choice of axes in the menu of files, and for assistive tools the list in the panel.
panel-axes-list = Axes
panel-axes-written-help = What the coordinates of saved surfaces grow towards; files that have a place for it say so, as 3D Slicer writes it
panel-axes-unknown-help = The file does not say which way its axes point: choose it in step 1, then they can be turned
# On a narrow button beside LPS and RAS: saved surfaces keep their axes.
panel-axes-kept = As they are
panel-axes-save-kept = Save axes as they are
# $axes is LPS or RAS.
panel-axes-save = Save in { $axes }

## Step 1: the arrays of the file

panel-colour = Colour by
panel-colour-help = What the file says of its vertices and triangles, in the shaded view
panel-colour-none = Nothing
# An array of a file: its $name in the file, and $kind the type of its numbers, such as uint8. $on is "vertices" or "triangles".
panel-array-identifiers = { $on ->
    [vertices] { $name }: labels on vertices, { $kind }
   *[triangles] { $name }: labels on triangles, { $kind }
}
panel-array-labels = { $on ->
    [vertices] { $name }: { $count ->
        [one] { $count } label on vertices
       *[other] { $count } labels on vertices
    }, { $kind }
   *[triangles] { $name }: { $count ->
        [one] { $count } label on triangles
       *[other] { $count } labels on triangles
    }, { $kind }
}
panel-array-scalar = { $on ->
    [vertices] { $name }: scalar on vertices, { $kind }
   *[triangles] { $name }: scalar on triangles, { $kind }
}
panel-array-components = { $on ->
    [vertices] { $name }: { $count } components on vertices, { $kind }
   *[triangles] { $name }: { $count } components on triangles, { $kind }
}
# $array is one of the messages above.
panel-array-range = { $array }, { $least } to { $most }
# Below the labels that the legend of an array names.
panel-labels-more = and { $count } more

## Step 1: mending

panel-mending = Mending
panel-faults-sought = The file is being looked through...
panel-faults-none = Nothing was found that needs mending.
panel-holes = Holes
panel-holes-help = Openings of the wall that no vessel ends in
panel-holes-count = { $count }, up to { $size } mm
# Edges of more than two triangles.
panel-edges = Crowded edges
panel-edges-help = Edges of more than two triangles: the surface is no manifold there
panel-points = Touching points
panel-points-help = Vertices where parts of the surface touch in a point: it is no manifold there
panel-ends = Open ends
panel-ends-help = Where vessels end: they stay open
# On a button: goes to the next place.
panel-fault-next = Next
panel-fault-show-help = Marks them in the view and goes to one after the other
# For assistive tools: $faults is "holes", "crowded edges", ...
panel-fault-next-of = Next: { $faults }
panel-fault-show = Show: { $faults }
panel-wall = A wall with two sides
panel-wall-help = The surface is a wall with two sides, an outer and an inner one: the blood is in the inner
panel-wall-thickness = { $thickness } mm thick
panel-dropped = Dropped triangles
panel-dropped-help = Triangles with a repeated vertex; mended as it was read
panel-double = Double triangles
panel-double-help = Triangles over the same three vertices as another
panel-turned = Turned triangles
panel-turned-help = Turned to agree with the neighbours as it was read
panel-turned-pieces = Turned pieces
panel-turned-pieces-help = Pieces that were inside out; turned as the file was read
# What is said of a place that the view goes to.
panel-edge-place = Crowded edge
panel-point-place = Touching point
panel-hole-place = Hole of { $size } mm
panel-end-place = Open end of { $size } mm
# Ticked, and followed by a field with a length.
panel-fill = Fill holes up to
panel-fill-help = Closes holes in walls that are at most so far across; ends of vessels stay open
panel-weld = Weld edges within
panel-weld-help = Joins open edges that nearly meet. Nothing collapses: less is taken where triangles are as small
panel-split = Split crowded edges
panel-split-help = Parts the sheets that share an edge or touch in a point, and drops double triangles
panel-lumen = Take the lumen
panel-lumen-help = Of a wall with two sides: keeps the inner one, cut at the rims, as the boundary of the blood
# What was mended, in a list with commas.
panel-mended-welded = { $count ->
    [one] { $count } vertex welded
   *[other] { $count } vertices welded
}
panel-mended-edges = { $count ->
    [one] { $count } edge split
   *[other] { $count } edges split
}
panel-mended-vertices = { $count ->
    [one] { $count } vertex split
   *[other] { $count } vertices split
}
panel-mended-double = { $count ->
    [one] { $count } double triangle left out
   *[other] { $count } double triangles left out
}
panel-mended-holes = { $count ->
    [one] { $count } hole filled
   *[other] { $count } holes filled
}
panel-mended-wall = { $count ->
    [one] { $count } triangle of the wall left out
   *[other] { $count } triangles of the wall left out
}

## Step 2: smoothing

panel-smooth = Smooth
panel-smooth-does = Takes off the stair-steps of the scan.
panel-strength = Strength
panel-strength-help = Suits this surface: as the paper, and nowhere so much that a vessel loses its calibre or triangles cross. The paper's: pass band 0.01, 100 iterations, the same everywhere.
# Settings of one's own, in the list of the strength.
panel-strength-own = Own
panel-pass-band = Pass band
panel-pass-band-help = What passes the filter: 0.001 leaves the broad form alone, 2 leaves everything. Without unit.
panel-iterations = Iterations
panel-iterations-help = Degree of the filter: more make it sharper. 0 turns smoothing off.
# The window function of the filter.
panel-window = Window
panel-window-help = How the filter is tapered. Hamming is the paper's; Nuttall ripples least.
panel-adapt = Adapt to calibre
panel-adapt-help = Smooths thin vessels less, so that each keeps its calibre. The pass band is that of the wide ones.
panel-guard = No crossings
panel-guard-help = Smooths less where triangles would be drawn through others: at folds, between vessels.
panel-hold-caps = Hold caps
panel-hold-caps-help = Flat ends of closed vessels stay flat and keep their areas: inlets and outlets of a flow.
panel-volume-held = Preserve volume
panel-volume-held-help = Gives back what smoothing takes off, where it does: open ends capped, held to 0.01 %.
panel-smoothed-less = { $count ->
    [one] Smoothed less at { $count } vertex: no crossings.
   *[other] Smoothed less at { $count } vertices: no crossings.
}
panel-smoothed-less-help = Goes to where it is smoothed least
# What is said of the place that the view goes to.
panel-smoothed-less-place = Smoothed less

## Step 2: the response of the filter

# $k is the eigenvalue, $length a length with its unit.
panel-half-gain = Half gain at k = { $k }: waves of { $length }; shorter ones are smoothed away.
panel-half-gain-adapted = Half gain at k = { $k }: waves of { $length }; shorter ones go, in thin vessels less.
panel-half-gain-bare = Half gain at k = { $k }.
panel-half-gain-none = Nothing is smoothed away: everything passes.
panel-response = Response
panel-response-help = How much of a wave on the surface is left, by its length
panel-response-length = Length of a wave, mm
panel-response-eigenvalue = Eigenvalue k
# Beside lines and points of the picture.
panel-response-thinnest = thinnest measured: { $length }
panel-response-pass-band = pass band
panel-response-half = half
# Beside the pointer, in two lines.
panel-response-at =
    { $length }: { $percent } % is left
    k = { $k }
panel-response-at-bare =
    { $percent } % is left
    k = { $k }
panel-wave = Wave
panel-wave-help = Its length on the surface; drag here or on the curve
# $wave is a length with its unit, or "k = 0.0234".
panel-wave-left = A wave of { $wave }: { $percent } % is left.
panel-wave-left-thinnest = Around the thinnest vessel that is measured, { $length }: { $percent } %.
panel-wave-left-thinnest-adapted = Around the thinnest vessel that is measured, { $length }: { $percent } %, more as it is adapted.
panel-windows = Windows side by side
panel-windows-help = The other three at the same pass band and iterations
panel-windows-drawn = Thin: the others in the order of the list, dashed, dotted, in long dashes.
panel-laplacian = Laplacian beside it
panel-laplacian-help = What moving each vertex to its neighbours' mean would leave, as often as there are iterations
panel-laplacian-seen = In the picture, too
panel-laplacian-seen-help = In the split view, at the left what as many Laplacian passes make of the surface: thin vessels shrink
panel-laplacian-left = { $passes ->
    [one] Red: { $passes } Laplacian pass, λ = { $factor }: { $percent } % of the wave is left.
   *[other] Red: { $passes } Laplacian passes, λ = { $factor }: { $percent } % of the wave is left.
}
# Diameters with their unit: as it is, after Laplacian smoothing, after windowed-sinc smoothing.
panel-laplacian-thinnest = The thinnest vessel, { $whole }, becomes { $laplacian }; by windowed sinc { $sinc }.
panel-laplacian-thinnest-adapted = The thinnest vessel, { $whole }, becomes { $laplacian }; by windowed sinc { $sinc } (more as it is adapted).
# The terms of the Chebyshev series.
panel-terms = Terms
panel-terms-help = The Chebyshev series up to this term, as a thin curve; the last is that of the iterations
panel-terms-drawn = Thin line: terms 0 to { $last } of { $iterations }, up to { $percent } % off the whole.

## Step 3: the reduction

panel-reduce = Reduce
panel-reduce-does = Removes what matters least; topology stays.
panel-stop = Stop at
panel-stop-help = What says how far the reduction goes
panel-stop-deviation = Deviation
panel-stop-rate = Rate or count
panel-bound = Largest deviation
panel-bound-help = As few triangles as stay within this of the smoothed surface everywhere, both ways.
panel-next-coarser = Next coarser level
panel-next-coarser-help = A deviation that was found in the level with one step more
# There is no coarser level.
panel-next-coarser-none = none
panel-reduction = Reduction
panel-reduction-help = The part of the triangles that is removed.
panel-back-to-auto = Back to automatic
# Behind the name of a rate that is set by itself, in brackets: keep it short.
panel-auto-short = auto
panel-auto = Automatic: 90 %, or as far as is safe
# $percent is the rate that was come to: at most 90.
panel-auto-most = Automatic: { $percent } %
panel-auto-safe = Automatic: { $percent } %, as far as is safe
panel-auto-kept = Automatic: { $percent } %, kept where measured
panel-auto-pinched = Automatic: { $percent } %, none pinched
panel-auto-deciding = Automatic: finding how far is safe
panel-auto-help = Reduces by 90 %, or as far as every vessel keeps its calibre to { $tolerance } % and none is pinched, whichever is less. The slider sets a number instead.
# Followed by a rate: reduction up to it changes no vessel too much.
panel-safe = Safe to
panel-safe-help = Up to here every vessel that can be measured keeps its calibre to { $tolerance } %, none is pinched, and no triangles cross that did not.
# $why is a part of a sentence.
panel-safe-refused = There is no such rate here: { $why }.
# In place of "Safe to" where too little is measured to call the surface safe.
panel-kept-to = Kept to
# What the rate rests on: $coverage is "52 % of the length, 4 of 17 vessels".
panel-safe-rests = Measured at { $percent } % over { $coverage }; the verdict goes by the level that is shown.
panel-safe-rests-at = Reduced by { $percent } %: over { $coverage }
panel-safe-changed = Branches that smoothing itself changes by more do not count: { $count }.
panel-safe-go-help = Sets the reduction to the mark under the slider
panel-wanted = Triangles wanted
panel-wanted-help = The same as a number; drag, or click to type
panel-method = Method
panel-method-help = Schroeder is the paper's: it deletes vertices and moves none. Quadric moves them: half the mean deviation, better shape.
panel-feature-angle = Feature angle
panel-feature-angle-help = Edges sharper than this are kept as edges.
panel-spare-thin = Spare thin vessels
panel-spare-thin-help = An error counts the more, the thinner the vessel is: thin ones keep more of the triangles, wide ones fewer.
panel-keep-labels = Keep label borders
panel-keep-labels-help = Edges between two labels of the file's arrays are held as edges: vertices move along them alone

## Step 3: the error against the triangles

panel-error = Error against triangles
panel-error-help = What every rate costs on this surface, from its one progressive mesh
panel-error-mm = Error, mm
# Beside lines of the picture.
panel-error-now = now
panel-error-safe = safe
panel-error-kept = kept
panel-error-is = { $count ->
    [one] Error against triangles: { $error } mm at { $count } triangle
   *[other] Error against triangles: { $error } mm at { $count } triangles
}
panel-error-schroeder = Error: the method's own, which orders its steps. Root mean square distance from the planes that a vertex stood for; on edges and open ends at least that from their line. No bound: the points are measured.
panel-error-quadric = Error: the method's own, which orders its steps. Root mean square distance of the new vertex from the planes that it stands for. No bound: the points are measured.
panel-error-other = Grey: { $method }, from the same surface.
panel-error-other-none = { $method } stands beside it once it was chosen: it takes a run of its own.
# Beside the pointer, in three lines; $curve is what the curve is of.
panel-error-at =
    { $curve }
    { $error } mm at { $count ->
        [one] { $count } triangle
       *[other] { $count } triangles
    }
    Click to go there

## The result

panel-result = Result
# Below the heading, as long as the surface that was opened has no level yet.
panel-result-follows = Being computed...
panel-triangles = Triangles
panel-vertices = Vertices
# After and before the reduction; also which of how many.
panel-of = { $count } of { $all }
panel-of-help = After and before the reduction
panel-removed = Removed
panel-calibre = Calibre
panel-calibre-help = Whether every vessel that can be measured keeps its calibre
panel-vessels = Vessels
panel-vessels-help = What became of each, and where
panel-deviation-mean = Deviation, mean
panel-deviation-max = Deviation, max
panel-deviation-help = Distance from the smoothed surface, measured both ways
panel-volume = Volume
panel-volume-help = Change from the kept pieces as opened, open ends capped
panel-area = Area
panel-area-help = Change from the kept pieces as opened
panel-notes = Notes on the file

## The result: the shape

panel-shape = Shape
# Of the level, and of the smoothed surface before.
panel-shape-was = { $now }, was { $before }
panel-shape-narrowest = Narrowest at ({ $x }, { $y }, { $z }) mm
panel-roughness = Roughness
panel-roughness-help = RMS angle between neighbouring triangles; "was" is the smoothed surface. Fewer triangles bend more.
# Triangles with a very small angle.
panel-slivers = Slivers
panel-slivers-help = Triangles with an angle below 10 degrees, as a part of all
panel-self-intersecting = Self-intersecting
panel-self-intersecting-help = Triangles that run into others
panel-caps = Inlets and outlets
panel-caps-help = Flat ends, and by how much their areas change
# How many, and the least and largest change in percent.
panel-caps-changed = { $count }, { $least } to { $most } %
panel-smallest-lumen = Smallest lumen
panel-smallest-lumen-help = Diameter of the vessels where they are narrowest: of the largest ball inside that touches the wall

## The result: what each stage took

panel-times = Time a stage
panel-time-reading = Reading
panel-time-mending = Mending
panel-time-connectivity = Connectivity
panel-time-smoothing = Smoothing
panel-time-decimation = Decimation, all rates
panel-time-bound = Finding the level
panel-time-level = Level
panel-time-normals = Normals
panel-time-deviation = Deviation
panel-time-measures = Shape and lumen
panel-time-calibre = Calibre

## The deviation, as colours

panel-from-opened = From as opened
panel-from-opened-help = How far the level is from the surface as it was opened, not from the smoothed one
panel-signed = Inside and outside
panel-signed-help = Where the level lies outside of that surface, and where inside
# Followed by four small buttons: 95 %, 0.1 mm, 0.25 mm, 0.5 mm.
panel-up-to = Up to
panel-up-to-help = The deviation that has the last colour
panel-up-to-percentile = 95 %: what 95 % of the samples are within
# For assistive tools.
panel-up-to-value = Colours up to { $value }
# Above the legend in the view.
panel-legend-opened = Deviation from as opened
panel-legend-smoothed = Deviation, mean around
# Below the legend.
panel-legend-sides = Below: inside, above: outside
# Below the histogram.
panel-beyond = { $percent } % beyond { $deviation } mm
panel-largest-deviation = Largest deviation: { $deviation } mm
# $place is the message above.
panel-largest-deviation-go = { $place }. Click to go there

## The vertex classes, as colours

# Above the legend in the view.
panel-class = Vertex class
# In the legend: a class and how many vertices there are of it.
panel-class-count = { $class } { $count }
# For assistive tools: the classes with how many there are of each, with commas.
panel-classes = Vertex classes: { $classes }
panel-classes-help = Simple: on no feature edge. Complex: the surface is no disc there. Boundary: at an open end. Interior edge: two feature edges meet. Corner: one or more than two.

## What the computation does, in the status bar, before its percentage

panel-work-reading = Reading
panel-work-comparing = Comparing

## The equations

panel-equations = Equations
panel-equations-of = Equations: { $step }
panel-equations-help = The equations of the paper. Point at a symbol in colour: its slider and its mark in the response light up, and the other way round.
panel-equation-1 = How far a vertex lies from the mean of its neighbours; its weights w add up to 1.
panel-equation-2 = The same for all vertices at once, with K = I − W.
panel-equation-3 = Smoothing: a function of K, applied to the coordinates.
panel-equation-4 = The surface is a sum of waves e. Of each the part f(k) is left; its eigenvalue k is near 0 for long waves, at most 2 for the shortest.
panel-equation-5 = The response: Chebyshev polynomials T up to the degree N. θ stands for the pass band, moved by a little so that the pass band itself is kept.
panel-equation-6 = The window { $window }: without these weights a series that ends would ripple.
panel-equation-7 = The reduction: the part of the m triangles that is gone, in percent; m' are left.
panel-tied-pass-band = Pass band: { $value }
panel-tied-iterations = Iterations: { $count }
panel-tied-window = Window: { $window }
panel-tied-reduction = Reduction
panel-tied-wave = Eigenvalue of a wave; the plot marks the one that you try
panel-tied-response = Response: the part of a wave that stays
