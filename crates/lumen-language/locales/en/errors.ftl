### What goes wrong, and what is told of a file: sentences that stand in a message, in the list of findings, or behind the
### name of a file. "Array" is a list of numbers on the vertices or triangles of a surface, as VTK has it.

## Files that are not written, or not in full

errors-not-carried = The arrays of the file are not with it, because they are not carried to this level: save it again.
# Why a file is not written: behind its name and a colon.
errors-no-result = there is no result yet
errors-not-measured = the vessels are still being measured
