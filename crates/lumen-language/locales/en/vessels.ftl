### The vessels: what smoothing and reduction made of the calibre of each, in the app and in reports.

## What can be saved: entries of a menu

vessels-save-vtp = Centrelines (VTP)...
vessels-save-vtp-help = Of the surface as opened, with the radius of the inscribed ball, as vmtk names its arrays
vessels-save-csv = Centrelines (CSV)...
vessels-save-csv-help = Of the surface as opened, a row a place
vessels-save-calibre = Calibre (CSV)...
vessels-save-calibre-help = Area and radius as opened, smoothed and reduced, a row a place

## The head of the vessels below the views

vessels-heading = Vessels
vessels-coming = The vessels are being measured...
# After the sentence on all vessels, which is of older settings.
vessels-newer = Newer numbers are on their way.
vessels-allowed = Allowed change
vessels-allowed-help = Of the radius of each vessel, from the surface as opened
vessels-colour = Colour the surface
vessels-colour-help = How much wider or narrower each vessel is than as opened
vessels-copy = Copy
vessels-copy-help = The table as text, a tab between columns
vessels-save = Save CSV
vessels-save-help = Area and radius at each place of each vessel
vessels-back = Back
vessels-close = Close

## The table: a row a vessel, as narrow as can be

vessels-column-vessel = Vessel
vessels-column-vessel-help = Click to see the radius along it and to go where it changes most
vessels-column-verdict = Verdict
vessels-column-verdict-help = Whether it keeps its calibre as reduced, within the change that is allowed
vessels-column-measured = Measured
vessels-column-measured-help = The part of its length where it is measured: elsewhere the verdict says nothing
vessels-column-reduced = Reduced
vessels-column-reduced-help = The largest change of its radius, as reduced, from the surface as opened
vessels-column-smoothed = Smoothed
vessels-column-smoothed-help = The largest change of its radius, as smoothed, from the surface as opened
vessels-column-safe = Safe to
vessels-column-safe-help = The reduction up to which it was seen to keep its calibre
vessels-column-radius-help = Of the circle of the same area, as opened: mean, and least to largest
vessels-column-uneven = Uneven
vessels-column-uneven-help = Where its diameter, as opened, is most narrower or wider than on either side, a quarter at least; over which length
vessels-column-length = Length, mm
vessels-column-length-help = Along its centreline
vessels-column-tortuosity = Tortuosity
vessels-column-tortuosity-help = Length over the distance of the ends
# The first line of a table that is copied.
vessels-table = { $name }, allowed change { $tolerance } %
# Follows it after a comma.
vessels-table-measured = measured over { $coverage }

## Why a vessel is nowhere measured

vessels-too-thin = It is less than two edges wide: too coarse to say.
vessels-not-closed = Its cross-sections do not close.
vessels-ambiguous = Its wall is folded there: a cross-section has more than one outline, and which one it is changes with the surface.
vessels-at-forks = It is too short: all of it lies at forks or ends.
vessels-at-ends = It is too short: all of it lies at ends or forks.

## The radius along a vessel

vessels-radius-head = Radius along { $name }:
# Above it: a stretch that is narrower or wider than on either side, and what it is compared with.
vessels-uneven = { $stretch }: { $reference }
# The narrowest place beside another that the user has chosen.
vessels-refer = Own reference
vessels-refer-help = Compares the narrowest place of this branch with the place that you choose, by the diameter of the circle of the same area: drag the line in the plot
vessels-refer-at = Reference at
vessels-refer-at-help = Drag, or type a place along the branch
vessels-refer-reduced = Reduced: { $percent } %
vessels-refers-here = reference { $diameter } mm
vessels-reference-line = reference
vessels-radius-along = Radius along { $name }
# The three surfaces, in a legend.
vessels-as-opened = as opened
vessels-smoothed = smoothed
vessels-reduced = reduced
vessels-dotted = dotted: ±{ $percent } %
vessels-no-section = No cross-section of it can be measured.
vessels-along = Along the vessel, mm
vessels-radius = Radius, mm
# Beside the pointer, in three lines.
vessels-hover =
    { $surface }
    { $radius } mm at { $at } mm
    Click to go there

## What became of them

# In the panel, short.
vessels-all-kept-short = kept, to { $tolerance } %
# Where too little is measured.
vessels-kept-short = kept over { $percent } %
vessels-some-changed-short = { $changed } of { $all } changed
vessels-not-here = { $name }: not measured here
