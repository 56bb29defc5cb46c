### The verdict on a result above the views, what helps, and what the panel, the command line and reports repeat of it.

## The strip above the views

# In a few words, and bold. The rest of the line stands beside it.
verdict-safe = Safe to simulate on
verdict-nothing-wrong = Nothing wrong was found
verdict-not-measured = Not measured
verdict-coming = Being measured...
# $count is 1 at least.
verdict-to-look-at = { $count ->
    [one] One thing to look at
   *[other] { $count } things to look at
}
# Beside "Being measured...".
verdict-follows = Calibre and shape follow.
# Beside "Not measured".
verdict-stopped = It was cancelled, or the computation has stopped: change a setting to go on.
# Buttons: keep them short. This one opens a list of findings with what helps.
verdict-what-to-do = What to do
# Opens the list of the other findings; $count is 1 at least.
verdict-more = { $count } more
verdict-notes = { $count ->
    [one] { $count } note
   *[other] { $count } notes
}
verdict-show-vessels = Show vessels
verdict-show-vessels-help = What became of each, and where (V)
verdict-remedy-help = Would help; can be undone
# Goes to the place of a finding.
verdict-show-place = Show me
verdict-show-place-help = Goes to where it is

## What would help: on buttons

verdict-reduce-to = Reduce to { $percent } %
# $unit is mm, cm or m.
verdict-read-in = Read in { $unit }
verdict-take-lumen = Take the lumen
verdict-fill = Fill
verdict-split = Split
# Smooths so that no triangles cross.
verdict-no-crossings = No crossings

## Findings about the file

verdict-wall = The surface is a wall with two sides, { $thickness } mm thick.
# $diameter is that of the largest.
verdict-holes = { $count ->
    [one] The wall has a hole of { $diameter } mm.
   *[other] The wall has { $count } holes, the largest of { $diameter } mm.
}
verdict-crowded = At { $count } edges and points surfaces meet that should be apart.

## Findings about vessels that are pinched: narrowed to almost nothing, or lost altogether

verdict-pinched-first = A vessel of { $before } mm is pinched, first at { $percent } %.
verdict-lost-first = A vessel of { $before } mm is lost, first at { $percent } %.
# Without a full stop; $x, $y and $z are a place in mm.
verdict-pinched-at-first = A vessel of { $before } mm is pinched at ({ $x }, { $y }, { $z }), first at { $percent } %
verdict-lost-at-first = A vessel of { $before } mm is lost at ({ $x }, { $y }, { $z }), first at { $percent } %
verdict-pinched-to = A vessel of { $before } mm is pinched to { $after } mm at ({ $x }, { $y }, { $z }).
verdict-lost-at = A vessel of { $before } mm is lost at ({ $x }, { $y }, { $z }).
# Behind one of those two; $count is 2 at least.
verdict-worst-of = It is the worst of { $count } places.

## Findings about the smoothing, the volume and the triangles

verdict-all-but-shut = A vessel is all but shut at ({ $x }, { $y }, { $z }): { $diameter } mm are left of it.
verdict-drawn-shut = Smoothing has drawn a vessel shut at ({ $x }, { $y }, { $z }): it takes away waves below { $wave } mm, the way around a vessel of { $around } mm. A wider pass band keeps thin vessels open.
# $change has a sign; $cause is one of the next two.
verdict-volume-changed = The volume changed by { $change } %: { $cause }.
verdict-volume-narrow = the pass band is too narrow for vessels as thin as these
verdict-volume-few = so few triangles do not carry this shape
# "Adapt to calibre" is a box in the panel, --smoothing auto the same on the command line.
verdict-volume-adapt = Adapt to calibre (--smoothing auto) keeps it.
verdict-volume-put-back = The volume is not held to 0.01 %: vertices were put back, so that no triangles cross.
verdict-volume-none = The volume could not be held, because the surface encloses none: it is smoothed as without it.
verdict-volume-thin = The volume could not be held, because vessels as thin as these would tear or swell at this pass band: the surface is smoothed as without it.
verdict-crossing = { $count } triangles run into others.
verdict-crossing-before = { $count } triangles run into others; { $before } did before the reduction.
verdict-few-iterations = Too few iterations for this pass band: more are needed to smooth.
# Without a full stop: why there are not as few triangles as $wanted.
verdict-shortfall-topology = { $reached } triangles is as far as this surface goes ({ $wanted } were asked for): removing more would close an open end or pinch a vessel
verdict-shortfall-geometry = { $reached } triangles is as far as this surface goes ({ $wanted } were asked for): removing more would fold the surface over itself
verdict-shortfall-complex = { $reached } triangles is as far as this surface goes ({ $wanted } were asked for): the rest lies on edges of more than two triangles, which are kept as they are

## Labels beside a ring around the place of a finding

verdict-place-hole = Hole
verdict-place-here = Here
verdict-place-narrowed = Pinched
verdict-place-pinched = pinched
verdict-place-lost = lost
verdict-place-shut = Drawn shut

## How far a reduction is safe: sentences without a full stop

verdict-safe-none-kept = smoothing itself changes every vessel that can be measured
verdict-safe-none-measured = no vessel can be measured
# $name is that of a branch, $by the change of its calibre with a sign.
verdict-safe-changed = At { $rate } % { $name } changes by { $by } %, at ({ $x }, { $y }, { $z })
verdict-safe-unmeasured = At { $rate } % { $name } can no longer be measured

## The filter

# Where half passes: $k has no unit, $length has one.
verdict-half-gain = k = { $k }: waves of { $length }
