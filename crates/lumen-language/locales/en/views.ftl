### What the two views, the pictures and the collapses say: titles, legends, what stands where nothing can be drawn.

## The views

# Both are told to assistive tools; the titles stand in the pictures.
views-shaded = Shaded view
views-wireframe = Wireframe view
views-shaded-title = Shaded
views-wireframe-title = Wireframe
# Beside the line between the two states of the surface, and as a title: keep them short.
views-as-opened = As opened
views-now = Now
# The same where Laplacian smoothing is shown instead.
views-laplacian = { $passes ->
    [one] { $passes } Laplacian pass
   *[other] { $passes } Laplacian passes
}
# Names of the line that is dragged, for assistive tools.
views-divider = Divider between as opened and now
views-divider-other = Divider between { $before } and now
views-divider-wireframe = Divider in the wireframe
views-divider-wireframe-other = Divider in the wireframe between { $before } and now
# In the status bar: nothing moves.
views-idle = idle
# Frames a second.
views-rate = { $rate } fps
# Beside a ring in the view: the diameter of a vessel before the reduction pinched it.
views-pinched = Pinched: { $before } mm before
views-lost = Lost: { $before } mm before
# Below the small axes, where the file does not say which way the patient lies.
views-axes-unknown = Axes unknown

## The legend of colours: titles and notes stand right-aligned above and below a narrow bar

views-calibre = Change of calibre
# Beside a patch of grey.
views-calibre-note = not measured
# In the trial, of the wall.
views-peak-force = Peak force
# $value is a number with its unit: the colour at this end stands for all beyond it as well.
views-legend-more = { $value } and more
views-legend-less = { $value } and less

## Where something cannot be drawn

views-no-memory = The graphics memory is full, so this surface cannot be drawn; it is still open and can be reduced further or saved.
views-no-device = There is no graphics device to draw with.
# $error is a clause without a full stop, here and below.
views-failed = The views cannot be drawn: { $error }.
views-surface-failed = The surface cannot be drawn: { $error }.
views-slices-failed = The slices cannot be drawn: { $error }.
views-not-drawn = It was not drawn: { $error }.
# Clauses that stand for $error. $what is one of positions, normals, scalars, triangles and edges, or another word of the program.
views-too-large = { $what ->
    [triangles] its triangles need { $needed } MB of graphics memory in one piece, and this machine gives { $limit } MB; reduce it further
    [edges] its edges need { $needed } MB of graphics memory in one piece, and this machine gives { $limit } MB; reduce it further
   *[other] its { $what } need { $needed } MB of graphics memory in one piece, and this machine gives { $limit } MB
}
# $what is one of normals, scalars and pixels.
views-miscounted = { $found } { $what } for { $expected } nodes
views-no-node = node { $index } of { $nodes }
views-picture-kept = the GPU did not hand over the picture: { $error }
views-picture-lost = the GPU went away before the picture was read

## What is told before a large file is opened

views-large = { $name } has about { $count } triangles, for which some { $needed } GB of memory may be needed; here there are { $limit }. It is tried: should it fail, what was open still is. The desktop program has no such limit.

## Sides that a view can look from: on buttons of a menu

# Where it is known how the patient lies.
views-anterior = Anterior
views-posterior = Posterior
views-left = Left
views-right = Right
views-superior = Superior
views-inferior = Inferior
# Where it is not: sides of the surface as it stands.
views-front = Front
views-rear = Back
views-left-side = Left side
views-right-side = Right side
views-top = Top
views-bottom = Bottom

## What a view shows, told to assistive tools

# Sides that follow "from", as a part of views-seen, views-seen-laplacian and views-seen-opened.
views-side-left = the left
views-side-right = the right
views-side-front = the front
views-side-back = the back
views-side-above = above
views-side-below = below
# $axis is +X, -Z and the like.
views-side-axis = { $axis }
views-seen-laplacian = { $passes ->
    [one] { $name } after { $passes } Laplacian pass, from { $side }
   *[other] { $name } after { $passes } Laplacian passes, from { $side }
}
views-seen-opened = { $count ->
    [one] { $name } as it was opened, from { $side }, { $count } triangle
   *[other] { $name } as it was opened, from { $side }, { $count } triangles
}
# With the next two behind it, after commas.
views-seen = { $name } from { $side }
views-seen-triangles = { $count ->
    [one] { $count } triangle
   *[other] { $count } triangles
}
views-seen-narrowest = narrowest { $diameter } mm
# $verdict is one or two sentences.
views-news = { $count ->
    [one] { $name }, { $count } triangle. { $verdict }
   *[other] { $name }, { $count } triangles. { $verdict }
}

## Below the pictures of a report

views-reduced = Smoothed and reduced
views-triangles = Its triangles
views-calibre-meaning = Change of calibre, { $from } % (dark) to { $to } % (bright); grey: not measured
views-deviation-meaning = Deviation, { $from } mm (dark) to { $to } mm (bright)

## The collapses, one by one

# Buttons.
views-back = One back
views-back-help = Takes the last collapse back: one or two triangles more
views-on = One on
views-on-help = Does the next collapse: one or two triangles fewer
views-play = Play
views-play-help = One after the other, slowly
# A box to tick.
views-follow = Go to each
views-follow-help = The camera goes to where the next is
views-close = Close
views-close-help = No more collapses (Esc)
# $number is that of the collapse, $all of them there are; $before triangles become $after.
views-next-vertex = { $before ->
    [one] Next, { $number } of { $all }: a vertex of the class { $class } goes to a neighbour; { $before } triangle becomes { $after }.
   *[other] Next, { $number } of { $all }: a vertex of the class { $class } goes to a neighbour; { $before } triangles become { $after }.
}
views-next-edge = { $before ->
    [one] Next, { $number } of { $all }: an edge becomes a vertex of its own place; { $before } triangle becomes { $after }.
   *[other] Next, { $number } of { $all }: an edge becomes a vertex of its own place; { $before } triangles become { $after }.
}
views-next-error = Its error is { $cost } mm: the root mean square distance from the planes that it stands for. The largest so far is { $largest } mm.
views-next-error-line = Its error is { $cost } mm: the root mean square distance from the planes that it stands for, or its distance from its line where that is more. The largest so far is { $largest } mm.
views-last-level = This is the last level: no vertex may go any more.
views-click-vertex = Click a vertex in a view to see where it may go.
views-click-vertex-touch = Tap a vertex in a view to see where it may go.

## Where a vertex may go: sentences that stand one behind the other

# $class is one of the classes above.
views-vertex = { $class } vertex.
views-stays-by-rule = It stays by rule: the surface is no disc there.
views-stays-crowded = Too many triangles meet there: it waits for its neighbours.
views-goes-never = In this run it never goes.
views-goes-at = { $count ->
    [one] In this run it goes at { $count } triangle, for { $cost } mm.
   *[other] In this run it goes at { $count } triangles, for { $cost } mm.
}
# $ways is a list of the next six, with commas.
views-ways = { $count ->
    [one] Way to its one neighbour: { $ways }.
   *[other] Ways to its { $count } neighbours: { $ways }.
}
views-way-open = { $count } open
views-way-eased = { $count } open once shape may suffer more
views-way-off-line = { $count } off its line
views-way-link = { $count } against the link condition: the topology would change
views-way-flip = { $count } closed: a triangle would turn over
views-way-sliver = { $count } closed: a triangle would become a sliver
views-unseen = Crossings are not looked at here.
views-unseen-quadric = Shape and crossings are not looked at here: where it would be placed, the run alone knows.
# Behind one of those two.
views-unseen-borders = Nor are borders between labels.
