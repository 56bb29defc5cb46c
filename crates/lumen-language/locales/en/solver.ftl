### The step that makes a level ready for a flow or structure solver.

solver-title = For a solver
solver-does = Cuts, extends and closes the ends of the level and makes its triangles even, for flow and structure solvers.
solver-work = Making the surface ready for a solver

## What is done

solver-wrap = Wrap it watertight
solver-wrap-help = A closed surface near to this one in its place: crossing, double and inner triangles and gaps narrower than the tolerance are gone
solver-wrap-mm = Tolerance
solver-uncross = Take crossing triangles apart
solver-uncross-help = Triangles that run into others are pushed apart, or cut out and closed again
solver-clip = Cut the ends
solver-clip-help = Square to the centreline
solver-clip-none = as they are
solver-clip-round = where round
solver-clip-distance = at a distance
solver-clip-by = Distance from the end
solver-extend = Extend each end
solver-extend-help = A straight tube that leaves along the wall and becomes a circle of the same area
solver-extend-by = Length of the extensions
solver-radii-help = In radii of the vessel at its end
solver-radii = { " " }radii
solver-cap = Close the ends
solver-cap-help = With a patch of its own at each end
solver-cap-none = leave open
solver-cap-planar = flat, even triangles
solver-cap-fan = flat, a fan
solver-cap-smooth = a dome
solver-remesh = Make the triangles anew
solver-remesh-help = Nearly equilateral triangles, as large as the calibre asks for
solver-around = Edges around a vessel
solver-least = Shortest edge
solver-largest = Longest edge
solver-bound = Bound the deviation
solver-bound-help = Smaller triangles where the surface bends
solver-bound-mm = Largest deviation
solver-prepare = Make ready
solver-prepare-help = Of the level that is shown; the level itself stays as it is
solver-show-level = Show the level
solver-show-made = Show the result

## Where single ends are cut

solver-show-cuts = Show the cuts
solver-show-cuts-help = Where each end is cut, and what goes; move a cut there
solver-cuts-help = What is cut off is in colour. Drag a ring along its vessel, or type how far it is from the end.
solver-cut-end = End { $number }
solver-cut-distance = Distance of the cut from end { $number }
solver-cut-not = End { $number } is not cut: { $why }.
solver-cuts-reset = All ends alike

## What came of it

solver-triangles = { $count ->
    [one] one triangle
   *[other] { $count } triangles
}
solver-failed = The level cannot be made ready: { $why }.
solver-older = Made of another level, or by other settings than now.
solver-ready = Nothing was found that stops a volume mesher.
solver-not-ready = A volume mesher will not take it:
solver-crossed = Crossing triangles: { $before } before, { $after } left.
solver-result-triangles = Triangles
solver-quality = Mean quality
solver-quality-help = 4√3 times the area over the sum of the squared sides: 1 for equilateral triangles
solver-below = Under 30°
solver-below-help = Triangles with a smaller angle
solver-deviation = Deviation
solver-deviation-help = The largest distance between the surface before and after its triangles were made anew
solver-go = Go there
solver-go-to = Go there: { $what }
solver-name = Name
solver-name-of = Name of { $name }
solver-id = Id
solver-area = mm²
solver-radius = r, mm
solver-names = Names can be edited; files have them.
solver-save = Save for a solver
