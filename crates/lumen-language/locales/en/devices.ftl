### Haptic devices, gamepads and the sound of the force: the part of a trial's panel below its setup, and what is told of a
### device. Names of devices, of their axes and of their reports are the same in all languages.

## Which device holds the wire

# Stands before the list of devices.
devices-device = Device
devices-device-help = What the wire is held by, beside keys and pads
devices-look-again = Look again
devices-look-again-help = Lists the devices that are plugged in now
# In the list of devices: none of them.
devices-none = None
# In the list of devices: the one that needs no hardware.
# In the list of devices: a feeder is the open device that can be built.
devices-serial-feeder = Feeder by serial
# A device without a name; $numbers are those of its vendor and its own.
devices-unnamed = Device { $numbers }
# In the list of devices, in the browser: asks for one.
devices-pair = Pair a device...
devices-pair-serial = Pair by serial...
devices-not-paired = The browser did not ask for a device: choose to pair one once more.
devices-no-hid = This browser reaches no devices: Chrome and Edge do, on a computer. Gamepads work everywhere.
devices-only-serial = This browser reaches the open feeder alone, by serial: other devices take Chrome or Edge, on a computer.
devices-again = A device holds the wire again.
devices-again-unarmed = A device holds the wire again; its force is not armed.

## The two sliders that are the hand on the virtual device

devices-hand-at = Hand at
devices-hand-at-help = Where the hand on the virtual device wants its slide
devices-turned-to = Turned to
devices-turned-to-help = Where the hand on the virtual device wants its knob

## Axes: which feeds the wire, which rolls it

devices-axis-help = Where the axis is between its ends, and its number
devices-push = Push the device forward, as if to feed the wire.
devices-turn = Turn it to the right, as if to roll the wire.
# To push the wire on, and to turn it about its axis: a pad each, and a row each.
devices-feed = Feed
devices-roll = Roll
devices-mapped-help = Which axis, what its way moves, and which way is forward
devices-inverted = Inverted
# A unit behind a number: mm for each count of the device's numbers.
devices-per-count = { $unit }/count
# Spoken by screen readers; $what is Feed or Roll.
devices-mapped-far = { $what }: how far
devices-mapped-axis = { $what }: axis
devices-learn = Learn axes
devices-learn-help = Finds out which axis you push and which you turn
devices-forget = Forget axes
devices-forget-help = These axes are remembered for devices of this kind, by vendor, product and descriptor: forgets them, and goes back to what most devices are held by
devices-no-force = No force by these axes.

## The pads on the screen; the words at their ends are as short as can be

devices-feed-pad = Feed pad
devices-feed-out = out
devices-feed-in = in
devices-feed-pad-help = Drag to the right to feed, to the left to withdraw (W, S)
devices-roll-pad = Roll pad
devices-roll-left = left
devices-roll-right = right
devices-roll-pad-help = Drag aside to roll the wire (A, D)

## The force of a device

devices-felt-as = Felt as
devices-felt-as-help = The part of the device's most force that 1 N along the wire is felt as
devices-torque-as = Torque as
devices-torque-as-help = The part of the device's most force that 1 N mm about the wire is felt as
devices-stop-force = Stop force
devices-stop-force-help = The device lets go at once (Esc)
devices-ask-arm-force = Arm force...
devices-ask-arm-force-help = Says what will move, then lets it
# Read before a motor moves for the first time: each word counts.
devices-force-warning = The device will push back by itself, with up to 40 % of its force. Hold it loosely, and keep hair, cables and cups away. Esc, the stop button, or leaving this window ends it.
devices-arm-force = Arm force
devices-not-now = Not now
devices-felt = Felt
devices-felt-help = What the hand holds at the guide
devices-latency = Latency
devices-latency-help = From input report to output report: half, 95 % and 99 % are not longer
devices-save-latency = Save latency
devices-save-latency-help = Saves these times, the device's name and Lumen's version as a small table, and nothing else
devices-ended-hidden = The force was ended as the window was left.
devices-ended-unplugged = The force was ended as the device was unplugged.
devices-ended-no-number = The force was ended: the trial gave no number for it.
devices-ended-refused = The force was ended: the device takes no more reports.

## A gamepad that shakes

devices-stop-rumble = Stop rumble
devices-stop-rumble-help = The gamepad is still at once (Esc)
devices-ask-arm-rumble = Arm rumble...
devices-ask-arm-rumble-help = Says when the gamepad will shake, then lets it
devices-rumble-warning = The gamepad will shake the harder the more force the hand holds at the guide, with up to 40 % of its strength. Esc, the stop button, or leaving this window ends it.
devices-arm-rumble = Arm rumble
devices-arm-rumble-help = From now on the gamepad shakes
devices-leave-still = Leave it still
devices-leave-still-help = The gamepad does not shake

## A sound in place of a force

devices-sound = Sound of the force
devices-sound-help = A tone that is the higher and the louder the more force the hand holds at the guide, up to 0.1 N or 1 N mm
devices-no-sound = The force cannot be heard here: the desktop program plays it on Linux by pw-play, paplay or aplay, a browser by Web Audio.

## Why a device is not served, in the browser

devices-no-serial-in-worker = This browser opens no serial ports in a Worker.
devices-no-timer = The browser gives no timer.
devices-not-there = The device is no longer there; plug it in again to go on.
devices-no-axis = The device has no axis that could feed or roll the wire.
devices-not-opened = The device could not be opened: another program holds it, or this user may not use it (on Linux it takes a udev rule, see docs/haptics.md).
devices-no-answer = The port is open, but what is there does not answer as the open feeder does.

## What cannot be done in a trial; the app adds a capital letter and a full stop

devices-no-trial = no trial is on
devices-log-not-written = the log cannot be written: { $error }
devices-log-other-surface = the log is of another surface, or of another level: open that first
devices-log-other-route = the log has another entry or target than the route of { $length } mm that is shown: start a trial with those first
