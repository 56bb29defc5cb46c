### The compare view: up to six settings of one surface side by side, and the figures that are drawn of them.

## How the pictures stand: entries of a list some 96 points wide

compare-shaded = Shaded
compare-shaded-help = The surfaces
compare-wireframe = Wireframe
compare-wireframe-help = Their edges
compare-both = Both
compare-both-help = Edges over the surface
compare-stacked = Stacked
compare-stacked-help = The surface above its edges

## The bar above the grid: buttons, short

compare-add = Add current
# On a phone.
compare-add-short = Add
compare-add-long = Add current settings
compare-add-help = Compare the current settings too
compare-full = Six are compared at most: remove one first
compare-there-already = The current settings are compared already
compare-figure-6 = Figure 6
compare-figure-6-help = The six smoothing settings of the paper's Figure 6
compare-figure-7 = Figure 7
compare-figure-7-help = The three reduction rates of the paper's Figure 7
compare-show-as = Show as
# Of the settings that are compared, the first.
compare-first = First
compare-first-help = Hold to see the first settings in every cell, and let go: what moves is the difference (or hold X)
# A is the first of the surfaces.
compare-difference = Difference from A
compare-difference-help = Colours how far each surface is from A, the first, in mm
compare-most = Where they differ most
compare-most-help = Goes to where a surface is farthest from A, a few vessel diameters high
compare-whole = Whole vessel
compare-whole-help = All of the surface (F)
# A menu with what a phone has no room for.
compare-more = More
compare-more-help = How the pictures stand, the difference, a picture for a file
compare-done = Done
compare-done-help = Back to the two views (C)

## What is compared

compare-heading = Settings side by side
compare-heading-smoothing = More and less smoothing
compare-heading-triangles = Fewer and fewer triangles
compare-paper-figure-6 = Figure 6 of the paper
compare-paper-figure-7 = Figure 7 of the paper
compare-paper-rates = Rates of Figure 7 of the paper, smoothed as set
compare-nothing = Nothing is compared yet: add the current settings, or take those of a figure of the paper.
compare-slow = more than { $count } triangles a cell: turning may be slow

## Colours of the difference: the beginning and the end of a scale

compare-distance-coming = The distance from A is being measured.
compare-distance-unknown = The distance from A is not known.
compare-distance-from = Distance from A, mean around: 0 mm
compare-distance-to = { $most } mm and more

## A cell

compare-reference = A: the reference
compare-from-a = From A: mean { $mean } mm, at most { $most } mm
compare-no-area = No area to measure
compare-first-settings = The first settings
compare-waiting = Waiting for the engine
compare-try-again = Try again
compare-remove = Remove { $title }
compare-remove-help = Compare this no more
compare-not-drawn = The surface cannot be drawn: { $why }.
compare-no-device = There is no graphics device to draw with.

## A setting in words. Its parts stand in a row with commas between; the first letter of a row is made large.

compare-not-smoothed = not smoothed
compare-pass-band = pass band { $value }
compare-iterations = { $value ->
    [one] 1 iteration
   *[other] { $value } iterations
}
# The name of a window function: Hamming window.
compare-window = { $value } window
# $value is the name of the rule.
compare-boundary = rule { $value } at open ends
compare-volume-preserved = volume preserved
compare-suits = suits this surface
compare-adapted = adapted to calibre
compare-no-crossing = no crossing
compare-caps-held = caps held
# The name of a method of decimation: Schroeder method.
compare-method = { $value } method
compare-feature-angle = feature angle { $value }°
compare-thin-spared = thin vessels spared
compare-labels-kept = label borders kept
compare-not-reduced = not reduced
compare-auto = automatic reduction
compare-reduction = reduction { $percent } %
compare-triangles-wanted = { $count ->
    [one] { $count } triangle wanted
   *[other] { $count } triangles wanted
}
compare-deviation-up-to = deviation up to { $most } mm

## The numbers of a cell: short, a column is some 110 points wide

compare-triangles = Triangles
compare-triangles-help = After the reduction
compare-removed = Removed
compare-removed-help = The part of the kept triangles that is gone
compare-volume = Volume
compare-volume-help = Change from the kept pieces as opened, open ends capped
# The head of the two numbers below.
compare-deviation = Deviation
compare-deviation-unit = mean / max, mm
compare-from-smoothed = From smoothed
compare-from-smoothed-help = Deviation from the smoothed surface in mm, mean and maximum, measured both ways
compare-from-original = From original
compare-from-original-help = Deviation from the kept pieces as opened in mm, mean and maximum, measured both ways

## Below a figure

compare-figure-legend = Deviation: distance between two surfaces, measured both ways over { $samples } samples of each; smoothed: the surface before reduction, original: before smoothing. Volume: change from the original, open ends capped.

## Why a figure cannot be drawn: said after a colon, a full stop follows

compare-error-device = there is no graphics device to draw with, not even in software: a Vulkan or OpenGL driver is missing, such as Debian's mesa-vulkan-drivers
compare-error-too-large = the picture would be { $width } x { $height } pixels; this graphics device draws at most { $limit } each way
