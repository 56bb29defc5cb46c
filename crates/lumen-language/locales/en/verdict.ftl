### The verdict on a result above the views, what helps, and what the panel, the command line and reports repeat of it.

## The strip above the views

# Beside "Being measured...".
verdict-follows = Calibre and shape follow.
# Beside "Being measured..." while a level is shown that a finer one may follow.
verdict-auto-follows = How far is safe is being found: the reduction may still go back.
# Beside "Not measured".
verdict-stopped = It was cancelled, or the computation has stopped: change a setting to go on.
# $text is what is said of the surface, a sentence: that it is a sample.
verdict-sample = Sample: { $text }
# Buttons: keep them short. This one opens a list of findings with what helps.
verdict-what-to-do = What to do
# Shows the pieces that are left out, which can be chosen in the view.
verdict-choose-pieces = Choose pieces
verdict-choose-pieces-help = Shows what is left out; a click on a piece keeps that one, with Shift or Ctrl besides the others
# Opens the list of the findings. The list has two parts, each with a title.
verdict-findings = Details
verdict-list-grave = To look at
verdict-list-notes = Notes
verdict-notes = { $count ->
    [one] { $count } note
   *[other] { $count } notes
}
verdict-show-vessels = Show vessels
verdict-show-vessels-help = What became of each, and where (V)
# Where too little is measured: opens the vessels with what is not measured.
verdict-show-unmeasured = Show unmeasured
verdict-show-unmeasured-help = Opens the vessels and goes to what is not measured; the surface shows it in grey. A green verdict needs at least { $percent } % of the length away from forks measured, and half of the vessels.
verdict-enough = Safe is said where at least { $percent } % of the length away from forks is measured, and half of the vessels.
verdict-remedy-help = Would help; can be undone
# Goes to the place of a finding.
verdict-show-place = Show me
verdict-show-place-help = Goes to where it is
