### The bars, menus and sheets of the window; sentences about opening, saving, sharing and what comes back; the desktop.

## What Lumen is

# In the bar below, on the sheet "About", and on pictures. Without a full stop.
about-not-clinical = Not for clinical decisions
app-about-purpose = Makes a blood-vessel surface from a CT or MR scan light enough to simulate on: keeps the largest piece, smooths it, reduces it.
app-about-privacy = Everything happens on this machine. No file, and no part of one, is sent anywhere.
# The title in quotes stays as it is.
app-about-method = The method is that of "Mesh Optimization of Vessel Surface Model for Computer-Aided Simulation of Percutaneous Coronary Intervention". Smoothing: Taubin, Zhang and Golub (1996). Decimation: Schroeder, Zarge and Lorensen (1992); Garland and Heckbert (1997). Progressive meshes: Hoppe (1996).
app-about-licence = Licence: MIT or Apache-2.0, as you choose.
app-about-letters = Letters: Ubuntu Light derivative Lumen, (c) Canonical Ltd, Ubuntu Font Licence 1.0.

## The bar above: labels are short, for all of them stand in one row

app-open = Open...
app-open-help = A surface or settings (Ctrl+O); or drop a file
# A menu of units: "mm...", "cm...", "m...".
app-open-in = Open in
app-open-units = Unit of the file's numbers
app-open-in-help = Open a file whose numbers are in another unit than mm (glTF: m)
# A menu of vessels that everybody has.
app-sample = Sample
app-save = Save
# On a phone: menus of what can be saved.
app-save-surface = Surface
app-save-vessels = Vessels
app-save-record = For the record
app-undo = Undo
app-undo-help = Undo (Ctrl+Z)
app-redo = Redo
app-redo-help = Redo (Ctrl+Shift+Z)
# One picture, in two parts: as opened, and as it is now.
app-split = Split
app-split-help = As opened and as it is now in one picture; drag the line between them (R)
# Held, it shows the surface as it was opened.
app-before = Before
app-before-help = Hold to see the surface as it was opened (or hold B)
app-prepare = Prepare
app-prepare-help = The method's steps: keep the largest piece, smooth, reduce
app-compare = Compare
app-compare-help = Several settings side by side (C)
app-trial = Trial
app-trial-help = Steer a guidewire through the level that is shown
app-vessels = Vessels
app-vessels-help = The vessels, and what smoothing and reduction made of the calibre of each (V)
app-measure = Measure
app-measure-help = Lengths, diameters, cross-sections and angles, and a plane that cuts the surface open (M)
app-view = View
app-view-help = From where the surface is looked at, and what is shown of it
app-learn = Learn
app-about = About
app-about-help = What Lumen is, and what its numbers rest on
app-help = Help
app-help-help = Keys and gestures (F1)
app-theme = Theme
app-theme-help = Light or dark (T)
app-menu = Menu
app-menu-help = More
# In the menu of a narrow window.
app-show-before = Show before
app-split-view = Split view

## The menu "Save"

# $unit: "mm" or "m".
app-save-lengths = Lengths in { $unit }
app-save-levels = GLB with levels...
app-save-levels-help = The level and coarser ones, with a half, a quarter and so on of its triangles, for viewers that know glTF's MSFT_lod
app-save-all-lengths = Lengths in mm; in m for glTF
app-save-settings = Settings...
app-save-settings-help = For whoever has the same file, and for lumen optimise --settings; opened as a surface is
app-copy-link = Copy link
app-copy-link-help = The settings, the view and the first digits of the file's hash, and nothing of the surface
app-whole = Open in Lumen
app-whole-help = The same surface and settings in a window of its own, with everything else
app-keep-surface = Keep opened surfaces on this device
app-keep-surface-help = The file that is open, for the next start, in this browser; otherwise only its name, the settings and the view
app-forget = Forget what is kept here
app-forget-help = Settings, names and surfaces that are kept in this browser

## The menu "View"

app-fit = Fit
app-flat = Flat triangles
app-flat-help = Each triangle with its own normal
app-raking = Raking light
app-raking-help = From the side, nearly along the wall: stair-steps and dents stand out (K)
app-occlusion = Ambient occlusion
app-occlusion-help = Darker where walls stand close together, as in folds and forks; not under colours
app-see-through = See-through wireframe
app-see-through-help = Shows hidden lines, faintly
app-split-lines = Wireframe split too
app-split-lines-help = While the view is split: its edges as opened left of the line too, and as they are now right of it
app-colour-deviation = Colour by deviation
app-colour-deviation-help = Mean distance between this and the smoothed surface around each vertex, both ways, in mm
app-colour-calibre = Colour by change of calibre
app-colour-calibre-help = How much wider or narrower each vessel is than as opened, in percent of its radius
app-colour-classes = Colour by vertex class
app-colour-classes-help = What decimation takes each vertex for: simple, complex, boundary, interior edge or corner (Schroeder 1992)
app-feature-lines = Feature edges and open ends
app-feature-lines-help = Edges sharper than the feature angle, as decimation found them, and the boundary
app-present = Present
app-present-help = For a projector: larger letters, keys are shown as they are pressed, of the panel only what is dragged (P)
app-language = Language
# Beside the languages: the one that the system or the browser is set to.
app-language-system = As the system

## The menu "Learn"

app-lesson-help = A lesson of a few steps, which sets the app
app-open-lesson = Open a lesson...
app-open-lesson-help = A file that ends in .lesson; it can be dropped here, too
app-collapses = Collapses, one by one
app-collapses-help = What decimation takes next, where it goes and what it costs; a click asks why a vertex may not go
app-playback = Play the reduction
app-playback-help = From all triangles to 99.9 % fewer and back, again and again
app-glossary = Glossary
app-glossary-help = The words of the method, in a sentence each

## The bar below

app-progress = Progress
app-cancel = Cancel
# The name of a key.
app-cancel-help = Esc
app-triangles = { $count ->
    [one] { $count } triangle
   *[other] { $count } triangles
}

## The views on a phone, and the handle of its panel

app-tab-shaded = Shaded
app-tab-shaded-help = The shaded view; a swipe along the strip goes there too
app-tab-wireframe = Wireframe
app-tab-wireframe-help = The wireframe view
app-panel-low = Panel height: low
app-panel-half = Panel height: half
app-panel-full = Panel height: full
# Name of a panel's edge, which is dragged to resize it; for assistive tools.
app-panel-edge = Panel size
# On the handle of a panel that is folded away.
app-panel-folded = Sliders
app-panel-help = Drag it up or down; a tap or an arrow key goes to the next height

## Over the sample, until a file is opened

# Followed by a button with the next message; they read as one sentence.
app-invite-drop = Drop a vessel here, or
app-invite-open = open one
# On the button where a finger points, which drops nothing.
app-invite-open-alone = Open a vessel
app-invite-open-help = Choose a file: nothing leaves this machine
# For assistive tools, and its tooltip.
app-invite-close = Close the invitation
app-invite-close-help = The sample stays open

## The sheet of keys: what is pressed, and what it does

app-keys = Keys and gestures
app-close = Close
app-touch-one = One finger
app-touch-two = Two fingers
app-touch-two-does = Move, and zoom by pinching
app-touch-double = Double tap
# Above the keys, where what stands before is for fingers.
app-keys-keyboard = With mouse and keyboard
app-key-drag = Drag
app-key-drag-does = Turn
app-key-move = Shift or right button + drag, two fingers
app-key-move-does = Move
app-key-zoom = Wheel, pinch
app-key-zoom-does = Zoom towards the pointer
app-key-arrows = Arrows, + and -
app-key-arrows-does = Turn and zoom
app-key-fit = F, double click
app-key-fit-does = Fit into the view
app-key-sides = 1 to 6
app-key-sides-does = Anterior, posterior, left, right, superior, inferior
app-key-before = B or Space, held
app-key-before-does = The surface as it was opened
app-key-split = R
app-key-split-does = As opened and as it is now in one picture; drag the line between
app-key-left-out = L
app-key-left-out-does = Show what is left out; click a piece to keep it
app-key-deviation = D
app-key-deviation-does = Colour by deviation
app-key-raking = K
app-key-raking-does = Light from the side, which shows stair-steps
app-key-vessels = V
app-key-vessels-does = The vessels and what became of their calibre
app-key-measure = M
app-key-measure-does = Measure, and cut the surface open; Enter measures at the middle of the view
app-key-compare = C
app-key-compare-does = Compare several settings; Enter takes the focused one
app-key-compare-first = X, held
app-key-compare-first-does = In the comparison: the first settings in every cell
app-key-present = P
app-key-present-does = Present: larger letters, keys shown, no panel
app-key-open = Ctrl+O
app-key-open-does = Open
app-key-save = Ctrl+S
app-key-save-does = Save as STL
app-key-undo = Ctrl+Z
app-key-undo-does = Undo
app-key-redo = Ctrl+Shift+Z, Ctrl+Y
app-key-redo-does = Redo
app-key-escape = Esc
app-key-escape-does = Close what is on top, cancel, leave the comparison
app-key-theme = T
app-key-theme-does = Light or dark
app-key-tab = Tab
app-key-tab-does = Next control; arrows, Page up, Page down, Home and End move a slider
app-key-sheet = F1
app-key-sheet-does = This sheet

## The same while a trial is shown

app-trial-key-feed = W and S, up and down
app-trial-key-feed-does = Feed and withdraw the wire
app-trial-key-roll = A and D, left and right
app-trial-key-roll-does = Roll it left and right
app-trial-key-faster = Shift with these
app-trial-key-faster-does = Faster
app-trial-key-gamepad = Gamepad (in a browser)
app-trial-key-gamepad-does = Left stick feeds, right stick rolls
app-trial-key-autopilot = G
app-trial-key-autopilot-does = Autopilot
app-trial-key-fluoroscopy = Space
app-trial-key-fluoroscopy-does = Fluoroscopy on or off
app-trial-key-enlarge = F
app-trial-key-enlarge-does = Fluoroscopy as the large picture, and back
app-trial-key-contrast = C
app-trial-key-contrast-does = A puff of contrast
app-trial-key-arm = 1 to 4
app-trial-key-arm-does = C-arm: AP, LAO 45, LAT, RAO 30
app-trial-key-turn-arm = Drag in the fluoroscopy
app-trial-key-turn-arm-does = Turn the C-arm
app-trial-key-magnify = Wheel, pinch there
app-trial-key-magnify-does = Magnify
app-trial-key-restart = R
app-trial-key-restart-does = Restart
app-trial-key-pause = P
app-trial-key-pause-does = Pause
app-trial-key-back = Z
app-trial-key-back-does = A second back
app-trial-key-slow = M
app-trial-key-slow-does = Slow motion
app-trial-key-escape = Esc
app-trial-key-escape-does = Close what is on top, at last the trial
app-trial-key-view = Drag, wheel in the vessel's view
app-trial-key-view-does = Turn, zoom
app-trial-key-sheet = F1
app-trial-key-sheet-does = This sheet

## Opening

# $name is a file's, $why a sentence.
app-open-failed = { $name }: { $why }
app-open-failed-kept = { $name }: { $why } What was open still is.
app-not-opened-again = The surface could not be opened again.
app-opening-cancelled = Opening was cancelled.
app-opening-cancelled-kept = Opening was cancelled; what was open still is.
# $percent: less than 90.
app-told-again = { $text } ({ $count } times)
app-open-next = Open next
app-open-next-help = Open the next of the files that came together, in place of this one
app-take-away = Dismiss
app-take-away-help = Take this message away
app-others = { $rest ->
    [0] { $next } came with it.
    [1] { $next } and one more came with it.
   *[other] { $next } and { $rest } more came with it.
}
app-gone-back = Reduced by { $percent } %: more would not be safe.
app-gone-back-kept = Reduced by { $percent } %: more would not keep the calibre where it is measured.
app-gone-back-pinched = Reduced by { $percent } %: more would pinch a vessel.
app-scan-cancelled = Cancelled; the scan was not opened.

## Work that ends before it is done

app-cancelled = Cancelled.
app-cancelled-result-stands = Cancelled; the last result stands.
app-computation-stopped = The computation stopped.
# $reason: a few words, often of the system.
app-engine-stopped = The computation stopped ({ $reason }).
app-engine-keeps-stopping = The computation keeps stopping ({ $reason }).
# Behind one of these two.
app-engine-try-again = What is shown is still there and can be saved; change a setting or open a file to try again.
# Behind that, in a browser.
app-engine-memory = The desktop program has more memory.
app-engine-stopped-opening = { $name } could not be opened: the computation stopped ({ $reason }).
app-engine-restarted = The computation stopped ({ $reason }) and was started again.
# Behind that.
app-nothing-lost = Nothing was lost.
# What $reason above can be.
app-thread-ended = its thread has ended
app-reason-unknown = for an unknown reason
app-graphics-restarted = The graphics were interrupted and have been started again. Nothing was lost.

## Saving

app-nothing-to-save = There is nothing to save yet.
app-not-saved = { $name } was not saved: { $why }
app-save-again = { $name } was not saved: save it again.
app-saved = { $name } was saved.
app-not-written = { $name } could not be written: { $error }.
app-pair-saved = { $first } and { $second } were saved in { $folder }.
app-pair-there-already = Nothing was saved: { $name } is there already. Choose another name.
app-pair-not-written = Nothing was saved: { $name } could not be written: { $error }.

## Presenting

app-presenting = Presenting: larger letters, keys are shown, of the panel only what is dragged. P or Esc ends it.

## Settings for others: as a file and in a link

app-settings-taken = The settings of { $name } are in force.
# Behind that; they are the file's.
app-measures-of-other = Its measures belong to another surface, and were left out.
app-measures-too-early = Its measures were left out: open it again once the surface is read in its unit.
app-measures-shown = Its measures are shown.
app-measures-not-saved = The measures are not with the settings: this surface has no file to know it by.
app-link-copied-file = The link was copied. It has the settings and the first digits of the file's hash, and nothing of the surface: whoever opens it needs the same file.
app-link-copied-sample = The link was copied. It has the settings and says which sample they are for.
app-link-nothing = There is nothing yet that a link could be to.
app-link-fewer = This sample has fewer triangles than it has by itself: no link leads to it. Open the page without ?samples=.
app-step-link-copied = The link to this step was copied.
app-link-taken = The settings of the link are in force.
app-link-same = This is what the link belongs to: you see the same.
# $opened and $wanted: sixteen hexadecimal digits each.
app-link-other-file = This is another file than the one that the link belongs to: its SHA-256 begins with { $opened }, not with { $wanted }. The settings are those of the link.
app-link-needs-file = This link belongs to a file whose SHA-256 begins with { $digits }; open it and you will see the same.

## Why a link or a file of settings was not taken

app-link-long = The link is longer than any that Lumen makes: it has { $bytes } bytes.
app-link-newer = The link was made by a newer Lumen: its version is { $found }, and this Lumen reads { $known }.
# $pair, $key and $value stand in the link as they are.
app-link-missing = The link is not whole: it does not say "{ $pair }".
app-link-twice = The link says "{ $pair }" twice.
app-link-unknown = The link says "{ $pair }", which means nothing here.
app-link-value = The link cannot be read: "{ $value }" is no value for "{ $key }".
app-link-range = The link cannot be used: { $why }.
app-settings-none = This is no file of Lumen's settings.
app-settings-newer = These settings were written by a newer Lumen: their version is { $found }, and this Lumen reads up to { $known }.
app-settings-field = The settings cannot be read: { $why }.
app-settings-range = The settings cannot be used: { $why }.
app-measures-unsound = The measures cannot be shown: they are too many, or a number among them is none.

## What was measured, and on what

app-measure-diameter = { $mm } mm diameter
# Area, least and largest width, and the diameter of the circle of the same area.
app-measure-section = { $area } mm², { $least } to { $largest } mm wide, as a circle { $round } mm
app-measured-opened = As opened
# $vessel: "branch 1".
app-measured-opened-vessel = As opened, { $vessel }
app-measured-opened-fork = As opened, { $vessel }, at a fork
# On a level of so many triangles.
app-measured-level = { $count ->
    [one] On { $count } triangle
   *[other] On { $count } triangles
}
app-measured-level-vessel = { $count ->
    [one] On { $count } triangle, { $vessel }
   *[other] On { $count } triangles, { $vessel }
}
app-measured-level-fork = { $count ->
    [one] On { $count } triangle, { $vessel }, at a fork
   *[other] On { $count } triangles, { $vessel }, at a fork
}

## What comes back at the next start

app-file-back = { $name } is back, with the settings and the view that it was left with.
app-settings-back = The settings and the view are as they were left.
app-file-before = { $name } was open before. Open it again: the settings are as they were, and the view will be.
app-file-before-given-up = { $name } was open before. The program has ended twice while it was being opened, so it is kept here no longer. Open it again: the settings are as they were, and the view will be.
app-surfaces-kept = Each surface file that is opened from now on is kept on this device for the next start, in place of the one before.
app-surfaces-kept-and-this = { $name }, and each surface file that is opened after it, is kept on this device for the next start, in place of the one before.
app-surfaces-not-kept = No surface is kept on this device any more.
app-forgotten = Everything that was kept on this device is forgotten: settings, names, and surfaces. Nothing is kept until another surface is opened.

## The desktop: dialogs, files and devices

# What a dialog offers to open.
app-dialog-opened = Surfaces, scans, logs and settings
app-dialog-all = All files
app-no-file = No file was chosen.
app-not-read = { $name } could not be read: { $error }.
app-no-scans = This build of Lumen was made without scans and masks (feature scans).
app-folder-empty = There are no files in the folder.
app-scan-not-found = cannot read { $name }: { $error }.
app-scan-file-gone = A file of the scan is not there any more.
app-scan-file-not-read = A file of the scan cannot be read: { $error }.
# In the system's own dialog, with "Close" beside it.
app-graphics-keep-failing = The graphics keep failing on this machine. What was open is still here.
app-try-again = Try again
# Among the names of haptic devices: one that is not there.
app-virtual-device = Virtual device
app-devices-not-listed = the system does not list its devices: { $error }
app-device-not-opened = { $name } cannot be opened: { $error } (on Linux it needs a udev rule, see docs/haptics.md)
# An arm of the company Haply, which a program of theirs on the same computer speaks for.
app-haply-not-there = Haply's service does not answer on this computer ({ $address }): start it, and choose the device again ({ $error })
app-haply-no-arm = Haply's service has no Inverse3: connect it, and choose the device again

## The reduction, played from all triangles to the fewest and back

app-playback-play = Play
app-playback-pause = Pause
app-playback-play-help = From all triangles to 99.9 % fewer and back; the same part fewer in each second
app-playback-period = there and back
app-playback-period-help = How long that takes, in seconds
app-playback-level = { $count ->
    [one] { $percent } %: { $count } triangle
   *[other] { $percent } %: { $count } triangles
}
app-playback-save = Save (APNG)...
app-playback-save-help = The same as a picture that moves, from where the view looks now
app-playback-close = Close
app-playback-close-help = Closes it; the reduction that was set before comes back
