### Measuring by hand: the tools, the clip plane and the list of measures. What was found is said in app.ftl.

## The panel

measure-title = Measure
# On a button at the top of the panel.
measure-close = Close
# The same where the panel takes the whole window.
measure-back = Back
# The keys that do it.
measure-close-help = M, Esc
measure-no-surface = There is no surface yet.
measure-choose = Choose a tool, then click the surface in either view.
# Where a finger points.
measure-choose-touch = Choose a tool, then tap the surface in a view.
# $hint is one of the sentences below that say where to click, without its full stop.
measure-hint = { $hint }. Enter: the middle of the view; Esc: done.

## The tools: short names on buttons that stand in a row, also before the number of a measure ("Ruler 1")

measure-ruler = Ruler
measure-ruler-help = Straight distance of two places of the surface, in mm
measure-diameter = Diameter
measure-diameter-help = Largest ball inside that touches the wall at a place: its diameter in mm
# A cross-section.
measure-section = Section
measure-section-help = Square to the centreline beside a place: area in mm², least and largest width and the diameter of the circle of the same area in mm
measure-angle = Angle
measure-angle-help = At the second of three places, in degrees
# Where a vessel divides.
measure-fork = Fork
measure-fork-help = Between two branches of the nearest fork, where each is a vessel of its own, in degrees

## What the next click does

measure-click-first = Click the first place on the surface
measure-click-end = Click the other end
measure-click-vertex = Click the vertex of the angle
measure-click-last = Click the last place
measure-point-wall = Point at the wall to see its diameter; click to keep it
measure-click-vessel = Click a vessel
measure-click-branch = Click a branch beside a fork
# The same by a finger.
measure-tap-first = Tap the first place on the surface
measure-tap-end = Tap the other end
measure-tap-vertex = Tap the vertex of the angle
measure-tap-last = Tap the last place
measure-tap-wall = Tap the wall to measure its diameter
measure-tap-vessel = Tap a vessel
measure-tap-branch = Tap a branch beside a fork

## Why nothing was measured

measure-same-places = Two of the places are the same.
measure-no-ball = No wall faces this place, so no ball fits in between.
# $why is a sentence without its full stop.
measure-no-section = No cross-section: { $why }.
measure-no-angle = No angle: { $why }.
measure-not-yet = The centrelines are still being found: try again in a moment.
measure-no-centreline = There is no centreline: { $why }.

## The clip plane

measure-clip = Clip plane
measure-clip-help = Leaves out what lies on one side of a plane, in both views; drag its handle, or the slider
# Before a list, on one line with it.
measure-square-to = Square to
measure-square-to-help = An axis, the line of sight, or the centreline of a vessel, along which it moves
measure-lost-centreline = There is no such centreline any more.
measure-position = Position
measure-position-help = Along the axis or the centreline, in mm
measure-flip = Flip
measure-flip-help = Leave out the other side
# For assistive tools.
measure-clip-handle = Clip plane handle
# $axis is x, y or z.
measure-across-axis = Across { $axis }
measure-facing = Facing the view
measure-centreline = Centreline
# $vessel is the name of a vessel.
measure-along = Along { $vessel }

## The list

measure-none = No measures yet
measure-measures = Measures
measure-in-views = In the views
measure-in-views-help = Draw the measures over both views
measure-kept = They are kept with the surface while it is open, by undo, in a settings file and in the report.
measure-name-help = Its name: click to change it
# For assistive tools.
measure-name-of = Name of measure { $number }
# On a small button in each row.
measure-show = Show
measure-show-help = The camera goes there
measure-show-named = Show { $name }
measure-delete = Delete
measure-delete-named = Delete { $name }

## In the views

# In a view, beside the measure.
measure-mark = { $name }: { $value }
