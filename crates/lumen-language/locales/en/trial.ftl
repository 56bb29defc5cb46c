### The guidewire trial: a virtual wire is fed through the vessel, by hand or by an autopilot. Its part of the panel, its
### three views, the tables of the paper, and what the engine says of a trial.

## The panel

trial-title = Trial
trial-title-help = Steers a guidewire through the level that is shown.
trial-adapt = Adapt smoothing to the calibre and start
trial-adapt-help = Smooths thin vessels less, so that they stay as wide as they are; Undo takes it back
trial-start = Start trial
# Of the paper that the method is from.
trial-tables = Tables III and IV
trial-tables-help = The paper's trial at several reduction rates
trial-restart-to-try = Restart to try the wire and seed as they are set now.
# What a screen reader calls the bar.
trial-preparing = Preparing the trial
trial-finding = Finding the lumen and the way...
trial-at-entry = The wire is at the entry.
trial-none-on = No trial is on.
trial-awaits = Adapting the smoothing: the trial starts when the new level is there.

## Buttons. Letters in brackets are keys

trial-restart = Restart
trial-restart-help = From the entry (R)
trial-autopilot = Autopilot
trial-autopilot-help = Steers by itself; a hand on the wire takes it back (G)
trial-pause = Pause
trial-pause-help = Stands still (P)
trial-slow = Slow motion
trial-slow-help = A quarter of the speed (M)
trial-step-back = Step back
trial-step-back-help = A second back, and stand still (Z)
trial-close = Close
trial-close-help = Back to the surface (Esc)
trial-save-log = Save log
trial-save-log-help = Samples as CSV and a summary as JSON
trial-open-log = Open log...
trial-open-log-help = Replays a saved log (CSV) on this level

## What could not be done

trial-no-surface = There is no surface to steer through yet.
trial-computation-stopped = The computation stopped.
trial-stopped = The trial stopped ({ $reason }). The surface is still open; start again.
trial-cancelled = Cancelled.

## How the trial stands, in one sentence

trial-success = Success: the tip arrived after { $time } s; largest wall force { $force }.
trial-success-exchanged = Success: the tip arrived after { $time } s with the wire { $wire }, after { $failed } had failed; largest wall force { $force }.
# Why is one of trial-end-...
trial-failed = Failed after { $time } s: { $why }
trial-failed-exchanged = Failed after { $time } s with the wire { $wire }, after { $failed } had failed: { $why }
trial-arrived = Success: the tip is at the target.
trial-timed-out = Failed: the time is over.
trial-gave-up = Failed: the autopilot gave up.
trial-input-over = The recorded input is over.
trial-paused = Paused.
trial-looped = The wire has turned back on itself: withdraw.
trial-wrong-branch = Wrong branch: withdraw and roll.
trial-behind = The machine is behind: the trial runs slower than time.
# What it is doing is one of those that follow, in English and French with a small first letter.
trial-steers = Autopilot: { $doing }.
# W, S, A, D are keys.
trial-feed-first = Feed (W, S) and roll (A, D) the wire to the target, or let the autopilot steer: time runs from then on.
trial-feed = Feed (W, S) and roll (A, D) the wire to the target, or let the autopilot steer.
# The same where a finger points: by the pads under the thumbs.
trial-feed-first-touch = Feed and roll the wire to the target by the pads, or let the autopilot steer: time runs from then on.
trial-feed-touch = Feed and roll the wire to the target by the pads, or let the autopilot steer.

## Gauges and numbers. The names are short: the number stands beside them

trial-more-numbers = More numbers
trial-wall-force = Wall force
trial-wall-force-help = The largest normal force at one place of the wall; the bar grows with the largest so far
trial-push-force = Push force
trial-push-force-help = What it takes to hold the wire at the guide: negative when it is held back. The bar shows how much
trial-insertion = Insertion
trial-insertion-help = Length of wire outside the guide; the bar ends with the way to the target
# What a screen reader calls a bar: what it shows, and where it ends.
trial-bar-up-to = { $what }, up to { $most }
trial-to-target = To target
trial-to-target-help = Distance of the tip from the target's cross-section
trial-elapsed = Elapsed
trial-elapsed-help = Simulated time
trial-beam-time-help = Time that the beam was on
trial-contacts = Contacts
trial-contacts-sum = { $count }, { $force } in all
trial-contacts-help = Places where the wire lies against the wall, and the sum of their forces
trial-tip-force = Force at the tip
trial-tip-force-help = On the wall within 5 mm of the tip
trial-torque = Torque
trial-torque-help = The moment about the wire's axis at the guide
trial-branch = Branch
trial-branch-on = { $branch }, on the route
trial-branch-off = { $branch }, off the route
trial-branch-help = The branch of the vessel tree that the tip is in
# Of the computation.
trial-steps = Steps
trial-steps-rate = { $rate } a second
trial-steps-help = What this machine can do; 500 a second keep up with time
trial-unbalanced = Unbalanced steps
trial-unbalanced-help = Where something snaps, steps are braked or the guide waits, so that their forces are not in balance: forces are those of the last step that was
# The last step: its forces had not settled, it was damped, the guide waited, or the wire was held where it was.
trial-unbalanced-unsettled = { $share } %, now not settled
trial-unbalanced-braked = { $share } %, now braked
trial-unbalanced-waiting = { $share } %, now waiting
trial-unbalanced-held = { $share } %, now held
trial-fed = Fed
trial-fed-of = { $fed } of { $wanted } mm/s
trial-fed-help = What the guide fed in the last step, of what was asked for

## The wire

trial-wire = Wire
trial-wire-help = What the wire is made of, one that suits the way unless another is chosen; the numbers are in the fold below
# Stands in the lists of wires, entries and targets for the one that Lumen proposes.
trial-proposed = Proposed
# Diameters are in inches, as wires are sold.
trial-wire-floppy = 0.014 in floppy
trial-wire-workhorse = 0.014 in workhorse
trial-wire-stiff = 0.014 in stiff
trial-wire-workhorse-j = 0.014 in J tip
trial-wire-035-j = 0.035 in J tip
trial-wire-035-stiff-j = 0.035 in stiff J
trial-wire-035-curve = 0.035 in, catheter's curve
trial-wire-035-angled = 0.035 in angled, long bend
trial-wire-035-angled-20 = 0.035 in angled, tip of 20 mm
# The head of a fold.
trial-wire-numbers = Tip, stiffness, friction
trial-tip-angle = Tip angle
trial-tip-angle-help = The angle by which the tip is bent before it is let into the vessel
trial-tip-length = Tip length
trial-tip-length-help = Length of the bent tip, from its end
trial-tip-stiffness = Tip stiffness
trial-tip-stiffness-help = Bending stiffness EI at the tip
trial-shaft-stiffness = Shaft stiffness
trial-shaft-stiffness-help = Bending stiffness EI of the shaft
trial-friction = Friction
trial-friction-help = Coefficient of friction while the wire sticks to the wall; while it slides it keeps its part of this

## Where it enters and should go

trial-entry = Entry
trial-entry-help = Where the wire comes out of its sheath or guide catheter
# Also written beside the target in the view.
trial-target = Target
trial-target-help = Where it should go
trial-direction = Direction
trial-direction-help = From which end the wire comes
trial-swap = Swap
trial-swap-help = In where it should go, and on to where it came in
trial-swap-refused = No wire can come in where it should go
# Buttons beside the lists of entries and targets; the next two are what a screen reader calls them.
trial-pick = Pick
trial-pick-entry = Pick entry
trial-pick-target = Pick target
trial-pick-help = Then click the vessel
trial-click-entry = Click the vessel where the wire enters.
trial-click-target = Click the vessel where it should go.
trial-click-entry-touch = Tap the vessel where the wire enters.
trial-click-target-touch = Tap the vessel where it should go.
trial-seed = Seed
trial-seed-help = Varies entry, roll and friction a little; 0 varies nothing. Takes effect on restart

## The fluoroscope

# A button that turns the beam on or off, the title of its picture, and of the time that the beam was on.
trial-fluoroscopy = Fluoroscopy
trial-pedal-help = The pedal: on or off (Space). Off, the last image stays
trial-contrast = Contrast
trial-contrast-help = A puff of contrast that the blood takes along (C)
trial-roadmap = Roadmap
trial-roadmap-help = Shows the lumen over the picture
trial-pulses = Pulses
trial-pulses-help = Pictures a second while the beam is on
# Angulations of the C-arm as they are abbreviated in a catheterisation laboratory; on small buttons.
trial-arm-ap = AP
trial-arm-lao-45 = LAO 45
trial-arm-lat = LAT
trial-arm-rao-30 = RAO 30
trial-arm-lao = LAO
trial-arm-rao = RAO
trial-arm-cran = CRAN
trial-arm-caud = CAUD
# Two spaces stand between the two angles.
trial-arm-angles = { $side } { $turned }°  { $tilt } { $tilted }°
# The same where it is not known how the patient lies.
trial-arm-turned = Turned { $turned }°  tilted { $tilted }°
trial-arm-preset-help = C-arm: { $angle } (key { $key })
trial-beam-on = { $rate } pulses/s, { $field } mm field
trial-beam-off = Last image hold (Space: on)

## The views

# What a screen reader calls the three pictures.
trial-view = Trial view
trial-fluoroscopy-view = Fluoroscopy view
trial-tip-view = Tip view
trial-view-title = Wire in the vessel
trial-tip-title = From the tip
# Buttons in the corners of pictures: very short.
trial-tip-hide = Hide
trial-tip-hide-help = Hide the tip view
trial-tip-show = Tip
trial-tip-show-help = Show the tip view
trial-large = Large
trial-large-back = Back
trial-large-name = Large fluoroscopy
trial-large-back-name = Fluoroscopy beside the others
trial-large-help = Fluoroscopy as the large picture with the others over it, and back (F)
trial-finding-way = Finding the way: { $percent } %
trial-none-on-problem = No trial is on: the panel says why.
trial-no-device = There is no graphics device to draw with.
trial-not-drawn = The trial cannot be drawn: { $why }.
trial-surface-not-drawn = The surface cannot be drawn: { $why }.
trial-wire-not-drawn = The wire cannot be drawn: { $why }.
trial-fluoroscopy-not-drawn = The fluoroscopy cannot be drawn: { $why }.
# Beside rings around places in the view.
trial-too-thin-ring = Too thin for the wire
trial-no-way-ring = No way
trial-missed-fork-ring = Missed fork
trial-pinched = Pinched
# A legend of two lines: the ways of the tip on the level and on the surface before its reduction.
trial-tip-here = Tip, this level
trial-tip-unreduced = Tip, unreduced

## The comparison with the unreduced surface

trial-compare = Compare with the unreduced surface
trial-compare-help = Replays the same input on the surface before its reduction
trial-comparing = Comparing
trial-comparing-percent = Comparing: { $percent } %
trial-cancel = Cancel
trial-cancel-comparison = Cancel comparison
trial-cancel-comparison-help = Compare no more; the trial goes on
trial-smallest = Smallest lumen
trial-smallest-was = { $after } mm, was { $before } mm
trial-smallest-help = Diameter where the route is narrowest, after and before the reduction
trial-pinched-places = { $count ->
    [one] { $count } place
   *[other] { $count } places
}
trial-pinched-help = Ringed in the view
trial-largest-deviation = Largest deviation
trial-largest-deviation-help = Between the two tips at the same time
trial-noise = Noise
trial-noise-help = Between the tips on the unreduced surface and on the same with its triangles in another order: what is less than this says nothing of the reduction
trial-deviation = Deviation
trial-deviation-plot = Deviation of the tip over insertion
trial-deviation-plot-help = Deviation of the tip in mm over insertion in cm; grey: noise

## The tables of the paper

trial-tables-aorta = Table III: the autopilot in the aorta.
trial-tables-coronary = Table IV: the autopilot in aorta and coronary arteries.
trial-tables-other = The autopilot in this surface.
# Stands behind one of the three above.
trial-tables-brackets = The paper's figures are in brackets.
# Beside a bar, for a screen reader.
trial-tables-progress = Tables
trial-tables-cancel = Cancel tables
trial-tables-again = Run again
trial-tables-copy = Copy
trial-tables-copy-help = As text, a tab between columns
trial-tables-failed = { $rate } %: { $why }
trial-tables-yes = yes
trial-tables-no = no
# Two numbers in one cell.
trial-tables-two = { $first }, { $mean }
# Heads of narrow columns.
trial-column-rate = Rate
trial-column-rate-help = The part of the triangles that was removed
trial-column-triangles = Triangles
trial-column-triangles-help = What was left
trial-column-initial-fps = Initial fps
trial-column-initial-fps-help = Frames a second in the first simulated second (the paper's)
trial-column-average-fps = Average fps
trial-column-average-fps-help = Mean over the five stations (the paper's)
trial-column-worst-fps = Worst fps
trial-column-worst-fps-help = The slowest station
trial-column-simulation = Simulation, ms
trial-column-simulation-help = To compute 1/60 s: in the first second, and the mean at the stations
trial-column-drawing = Drawing, ms
trial-column-drawing-help = To draw one frame of 1280x800
trial-column-steps = Steps/s
trial-column-steps-help = Steps of 2 ms that this machine computes in a second
trial-column-success = Success
trial-column-success-help = Whether the tip arrived (the paper's)
trial-column-peak-force = Peak force, N
trial-column-peak-force-help = The largest wall force at one place, in the steps that are balanced
trial-column-mean-force = Mean force, N
trial-column-mean-force-help = The sum of the wall forces, mean over the balanced steps
trial-column-unbalanced = Unbalanced, %
trial-column-unbalanced-help = Steps whose forces were not in balance; the forces are those of the others
trial-column-time = Time, s
trial-column-time-help = Simulated time to the target

# The sweep below the tables.
trial-sweep = { $seeds } seeds a rate
trial-sweep-help = What reduction does to the wire: the autopilot by many seeds at each rate, and the same input on the unreduced surface
trial-sweep-what = Median and largest of the seeds.
# Beside the plot, in the colours of its curves.
trial-sweep-largest = deviation, largest
trial-sweep-median = median
trial-sweep-noise = noise, largest
trial-sweep-plot = Deviation of the tip from the unreduced surface by reduction
trial-sweep-arrived = { $arrived } of { $seeds }
trial-column-arrive = Arrive
trial-column-arrive-help = Seeds by which the wire reached its target
trial-column-deviation = Deviation, mm
trial-column-deviation-help = Between the tip here and on the unreduced surface by the same input
trial-column-noise = Noise, mm
