### What goes wrong, and what is told of a file: sentences that stand in a message, in the list of findings, or behind the
### name of a file. "Array" is a list of numbers on the vertices or triangles of a surface, as VTK has it.

## Files that are not written, or not in full

errors-not-carried = The arrays of the file are not with it, because they are not carried to this level: save it again.
# Why a file is not written: behind its name and a colon.
errors-no-result = there is no result yet
errors-not-measured = the vessels are still being measured

## Settings that no stage can work with: behind a colon, too

errors-pass-band = the pass band must lie between 0.001 and 2, not { $value }
errors-iterations = the number of iterations must lie between 0 and 200, not { $value }
errors-feature-angle = the feature angle must lie between 0 and 180 degrees, not { $value }
errors-tolerance = the tolerance must lie between 0 and 100 %, not { $value } %
errors-reduction = the reduction rate must lie between 0 and 99.9 %, not { $value } %
errors-deviation = the largest deviation must lie between 0.001 and 1000 mm, not { $value } mm
errors-weld = the tolerance of a weld must lie between 0.000001 and 100 mm, not { $value } mm
errors-fill = the size of holes to fill must lie between 0.001 and 1000 mm, not { $value } mm
errors-no-component = there is no component { $wanted }: the surface has { $number }
