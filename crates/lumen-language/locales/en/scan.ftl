### Scans and masks: their panel and views, what can be wrong with their files, and what the browser says of files.

## The panel

# The title of the panel, in large letters.
scan-title = Scan
scan-what = The surface is made where values reach the threshold, or of a label; then it is smoothed and reduced.
# What a scan of several files is called; also a part of file names.
scan-name = Scan
scan-format = Format
scan-voxels = Voxels
scan-voxels-help = Columns, rows and slices
scan-spacing = Spacing
scan-spacing-help = Between columns, rows and slices
scan-values = Values
# $unit is empty, or a space and "HU".
scan-values-range = { $low } to { $high }{ $unit }
# Which of several volumes in the files, such as phases of a heart.
scan-volume = Volume
scan-volume-help = Which of the volumes in the files is shown; another is read anew
# One of them: what tells it from the others, or its series, and how many slices it has.
scan-volume-offer = { $slices ->
    [one] { $what } ({ $slices } slice)
   *[other] { $what } ({ $slices } slices)
}
scan-volume-series = series { $number }
scan-threshold = Threshold
scan-threshold-help = What has this value and more is the vessel; contrast-filled vessels in CT have 150 to 500 HU.
# For assistive tools.
scan-histogram = Histogram, with the threshold
# Which label of the mask is the vessel.
scan-vessel = Vessel
scan-vessel-help = Which label of the mask is the vessel
scan-vessel-label = Label of the vessel
scan-label = Label { $label }
scan-label-named = Label { $label }: { $name }
scan-all-labels = All labels
# The voxel that the vessel is connected to; a click in the slice sets it.
scan-seed = Seed
scan-seed-help = Only what is connected to this voxel becomes the surface
scan-seed-remove = Remove
scan-seed-click = Click the vessel in the slice: only what is connected to it becomes the surface.
# Where the threshold lies that was found around the seed. $unit is empty, or a space and "HU".
scan-half-way = The threshold is half way between the vessel ({ $vessel }{ $unit }) and what is around it ({ $around }{ $unit }).
# How the surface of a mask is made.
scan-method = Surface by
scan-method-help = Surface nets relax the steps of the voxels within each voxel, by which thin vessels are nearest to their calibre; marching cubes keep them for smoothing to remove
scan-surface-nets = Surface nets
scan-marching-cubes = Marching cubes
# By how many mm the wall would move outwards, with a sign where inwards.
scan-shifts = With a threshold 10 % lower the wall would lie { $lower } mm farther out, with one 10 % higher { $higher } mm.
# The part of the scan that is looked at.
scan-box = Box
scan-box-help = Only these voxels are looked at: what lies outside, such as bone, is left out
# The axes of the grid.
scan-columns = Columns
scan-rows = Rows
scan-slices = Slices
scan-box-ends = The first and the last, from 0
# For assistive tools; $axis is one of the three axes, as it stands within a sentence.
scan-last-of = Last of { $axis }
scan-first-of = First of { $axis }
scan-whole = Whole scan
# Before buttons with the three axes: which way the slice lies.
scan-across = Across
scan-across-help = Which way the slice that is shown lies
scan-slice = Slice
scan-preview = Preview
scan-preview-help = The surface at reduced resolution
scan-triangles = { $count ->
    [one] { $count } triangle
   *[other] { $count } triangles
}
# $block is, for example, 2 x 2 x 2.
scan-preview-coarse = The preview has one voxel for each { $block }, where anything in these is inside: thin vessels look wider than they are.
scan-cancel = Cancel
# The key that does it.
scan-cancel-help = Esc
scan-make = Make the surface
scan-make-help = At full resolution, and open it
scan-close = Close the scan

## What is being done: in the panel, and in the bar before a percentage

scan-fetching = The part of Lumen that reads scans is still being fetched
scan-part-missing = Not opened: the part of Lumen that reads files could not be downloaded yet. Try again in a moment
scan-reading = Reading the scan
scan-surveying = Counting values
scan-making = Making the surface
# For assistive tools.
scan-progress = Progress of the scan
scan-engine-stopped = The scan's engine has stopped ({ $reason }): open the scan again.

## The views of a scan

scan-preview-view = Preview of the surface
scan-preview-made = The preview is being made
scan-preview-not-drawn = The preview cannot be drawn: { $why }.
scan-no-device = There is no graphics device to draw with.
scan-slice-view = Slice of the scan
scan-slice-number = Slice { $number }

## Slices behind the surface

scan-slices-title = Slices of the scan
scan-across-columns = Across columns
scan-across-rows = Across rows
scan-across-slices = Across slices
# The planes of the patient, which a clip plane can be square to as well.
scan-sagittal = Sagittal
scan-coronal = Coronal
scan-axial = Axial
scan-plane-help = Show this plane of the scan behind the surface; the keys 1 to 6 look at it from its front
scan-slice-place = { $slice } of { $count }, { $mm } mm
scan-slice-place-help = Which slice, and how far it is from the first
scan-plane-slider-help = Moves the plane through the scan
# For assistive tools; $plane is one of the six above.
scan-plane-slice = { $plane } slice
scan-outline = Outline of the surface
scan-outline-help = Where the plane cuts the surface that is shown; it should run along the border of the vessel
scan-keep = Keep the scan for slices ({ $mb } MB)
scan-keep-help = The scan stays in memory, with what has read it, so that its slices can be shown behind the surface

## The window of values: what is black and white in a slice

scan-window = Window
scan-window-help = The values that are black and white
scan-window-name = Window of values
scan-window-most = Most values
scan-window-all = All values
# Neither of those that have a name.
scan-window-own = Own
scan-level-width = Level, width
scan-level-width-help = The value half way between black and white, and how far these are apart
scan-width = Width of the window
scan-level = Level of the window

## Why there is no surface, preview or slice

scan-none-open = No scan is open yet.
scan-no-slice = There is no such slice.

## Why a file was not opened

scan-no-memory = There is not enough memory here to read { $mb } MB.
scan-file-gone = The file is not there any more.

## The browser

scan-part-gone = A file of the scan could not be read; it may have been moved or changed since it was chosen.
scan-part-memory = The browser has no memory left to read the scan.
scan-folder-lost = The browser could not read the folder.
scan-folder-empty = There are no files in the folder.
scan-file-large = { $name } has { $gb } GB; in the browser Lumen opens surfaces of up to { $limit } GB.
scan-file-lost = The browser could not read { $name }; it may have been moved or changed since it was chosen.
scan-file-memory = { $name } has { $mb } MB, for which this browser has no memory left.
scan-no-dialog = The browser opened no file dialog.
scan-saved = { $name } was saved.
scan-both-saved = { $first } and { $second } were saved.
scan-not-saved = { $name } was not saved: the browser has no memory left for { $mb } MB.
scan-not-kept = { $name } is not kept: this browser has no room for { $mb } MB.
scan-not-forgotten = The browser could not be asked to forget the surface: clear this page's data in its settings.
# For assistive tools: the field that takes what is typed.
scan-typed = What is typed

# Why an engine has stopped: $reason in the sentence that says so, mostly in brackets.
scan-not-fetched = its program could not be fetched: { $reason }
scan-not-handed-over = the files could not be handed over: { $why }
scan-not-sent = a command could not be sent: { $why }
scan-not-understood = an answer could not be read: { $why }
scan-no-worker = no Worker could be started: { $why }
scan-memory-ends = there is no memory left beyond its { $gb } GB
scan-message-unread = The message could not be read.
scan-script-unloaded = The Worker's script could not be loaded.
# Mostly behind a colon.
scan-browser-memory = the browser has no memory left for { $mb } MB
scan-language-not-handed-over = the language could not be handed over: { $why }
scan-language-failed = The words for { $name } could not be fetched: { $reason }. What is shown stays as it is.
