### What goes wrong, and what is told of a file: sentences that stand in a message, in the list of findings, or behind the
### name of a file. "Array" is a list of numbers on the vertices or triangles of a surface, as VTK has it.

## Files that are not opened

errors-file-empty = The file is empty.
errors-file-unknown = "{ $name }" is not a surface that Lumen knows: it opens { $formats } and { $last } files.
errors-vtk-kind = This is VTK data of another kind ({ $kind }), and Lumen opens surfaces: extract its surface and save that.
errors-vtk-index = This VTK file ({ $kind }) only names others that hold the data: open one of those.
errors-image-volume = This is no surface but an image volume ({ $format }) that is broken or of a kind that Lumen does not read: segment it and save the surface.
errors-compressed = This is a compressed file ({ $format }): unpack it and open the surface inside.
# $what is what is counted, such as "triangles" or "bytes", in the plural.
errors-cut-short = The { $format } file is cut short: it announces { $announced } { $what } and holds { $found }.
# $problem is one of the messages under "What is wrong in a file".
errors-broken-line = The { $format } file is broken at line { $line }: { $problem }.
errors-broken = The { $format } file is broken: { $problem }.
errors-face-refers = Face { $face } of the { $format } file refers to vertex { $index }, but the file has { $vertices } vertices.
errors-coordinate = Vertex { $vertex } of the file has the coordinate { $value }, which is not a place in a body.
errors-gltf-elsewhere = The glTF file keeps its data in another file ({ $uri }): save it as one GLB file and open that.
# In place of the name of that other file.
errors-gltf-unnamed = which it does not name
# $feature is one of the messages under "What is not read".
errors-unsupported = The { $format } file uses { $feature }, which Lumen does not read.
errors-too-large = The surface is too large: it has { $corners } vertices or corners, and Lumen can take { $limit }.
errors-no-triangles = The { $format } file holds no triangles ({ $vertices } vertices and nothing between them to show).
# $found is errors-lines-points.
errors-no-surface = The { $format } file holds no surface, only { $found }: Lumen does not open centrelines.
# $what is one of the messages under "What a file would unfold to".
errors-unfolds = The { $format } file would unfold to { $what }, more than a file of { $file } bytes can honestly hold.
errors-all-degenerate = None of the { $triangles } triangles of the { $format } file has an area: each repeats one of its vertices.

## Parts of a file that are counted, in the plural

errors-bytes = bytes
errors-header-bytes = bytes of header
errors-vertices = vertices
errors-faces = faces
errors-triangles = triangles
errors-strips = triangle strips
errors-rows = rows of { $name }
errors-points = points
errors-cells = cells
errors-cell-types = types of cells

## What a file holds instead of a surface. $number is $count, written.

errors-lines = { $count ->
    [one] { $number } line
   *[other] { $number } lines
}
errors-so-many-points = { $count ->
    [one] { $number } point
   *[other] { $number } points
}
errors-lines-points = { $lines } and { $points }
# The kind of VTK's data, in errors-vtk-kind.
errors-vtk-solids = a grid of solid cells
errors-vtk-no-kind = file of no type

## What a file would unfold to

errors-so-many-bytes = { $bytes } bytes
errors-too-many-bytes = more bytes than there can be
errors-parts = { $parts } parts
errors-vertices-triangles = { $vertices } vertices and { $triangles } triangles

## What is not read

errors-version = version { $version }
errors-compressor = the compressor { $name }
errors-lzma = LZMA with a dictionary of { $bytes } bytes
errors-gltf-whole-positions = positions of 32-bit whole numbers
errors-gltf-sparse = sparse accessors

## What is wrong in a file: behind a colon, before a full stop. Words of the file stand in quotes already.

errors-no-number = { $word } stands where a number should
errors-no-coordinate = { $word } stands where a coordinate should
errors-no-vertex = { $word } stands where a vertex number should
errors-no-count = { $word } is no count
errors-no-type = { $word } is no type of number
errors-no-text = it should be a text and is not
# $problem is another of these messages.
errors-at-byte = { $problem } at byte { $byte }

errors-stl-no-facet = it is a text without a single "facet"
errors-stl-ends = the file ends in the middle of a triangle

errors-obj-vertex = a vertex needs three coordinates

errors-ply-begin = it does not begin with the word "ply"
errors-ply-end = its header has no "end_header"
errors-ply-encoding = the encoding { $word } is not known
errors-ply-no-encoding = its header does not say which encoding it has
errors-ply-property-first = a property stands before any element
errors-ply-property = a property needs a type and a name
errors-ply-no-xyz = its vertices have no x, y and z
errors-ply-list = a list has the length { $length }

errors-gltf-no-json = it has no JSON part
errors-gltf-json = its JSON is wrong or incomplete at line { $line }, column { $column }
errors-gltf-no-scene = its scene is missing
errors-gltf-no-node = node { $node } is missing
errors-gltf-node-twice = node { $node } hangs from two others, or from itself
errors-gltf-no-mesh = mesh { $mesh } is missing
errors-gltf-mode = a mesh has a drawing mode that does not exist
errors-gltf-base64 = its base64 data are damaged
errors-gltf-no-accessor = accessor { $accessor } is missing
errors-gltf-accessor-type = accessor { $accessor } has a type that does not exist
errors-gltf-accessor-shape = accessor { $accessor } is not of the shape that its use asks for
errors-gltf-accessor-empty = accessor { $accessor } has no data
errors-gltf-accessor-beyond = accessor { $accessor } lies beyond the end of the data
errors-gltf-accessor-overlap = accessor { $accessor } has items that overlap
errors-gltf-indices = its vertex numbers are not whole numbers without sign

errors-vtk-xml = its XML is wrong or incomplete there
errors-vtk-no-file = it has no element "VTKFile"
errors-vtk-no-arrays = "{ $element }" has no arrays
errors-vtk-no-points = a piece has no points
errors-vtk-fractions = its cells are numbered with fractions
errors-vtk-beyond = an array lies beyond the end of the file
errors-vtk-underscore = its appended data do not begin with an underscore
errors-vtk-no-place = an array does not say where its data are
errors-vtk-array-end = an array goes on beyond the end of its data, or these are damaged
errors-vtk-block = a compressed block is damaged
errors-vtk-cell = cell { $cell } has the length { $length }
errors-vtk-third-line = neither "ASCII" nor "BINARY" stands in its third line
errors-vtk-no-part = { $word } is no part of a surface
errors-vtk-no-types = its cells have no types
# $name is OFFSETS or CONNECTIVITY, as the file has it.
errors-vtk-cells-lack = { $name } of its cells are missing
errors-vtk-ends-count = it ends where a count should stand
errors-vtk-ends-type = it ends where a type should stand
errors-vtk-field-type = a field has values of a type that is not known

## What is told of a file that was opened. $number is $count, written.

errors-stl-trailing = { $bytes } bytes after the last triangle left out.
errors-stl-open = The file may be cut short: its last solid has no end.
errors-ply-trailing = { $bytes } bytes after the last element left out.
errors-ply-unannounced = Numbers that the file's header does not announce were left out.
errors-ply-more-numbers = Numbers after the last element were left out.
errors-vtk-solids-left-out = { $cells } solid or curved cells left out: Lumen shows surfaces.
errors-fanned = { $count ->
    [one] { $number } polygon could not be cut into triangles without folding, having no area or crossing itself.
   *[other] { $number } polygons could not be cut into triangles without folding, having no area or crossing itself.
}
errors-degenerate = { $count ->
    [one] { $number } triangle with a repeated vertex dropped.
   *[other] { $number } triangles with a repeated vertex dropped.
}
errors-duplicate = { $count ->
    [one] { $number } triangle present twice; kept.
   *[other] { $number } triangles present twice; kept.
}
errors-short-faces = { $count ->
    [one] { $number } face of fewer than three corners left out.
   *[other] { $number } faces of fewer than three corners left out.
}
errors-lines-left-out = { $count ->
    [one] { $number } line left out: Lumen shows surfaces.
   *[other] { $number } lines left out: Lumen shows surfaces.
}
errors-points-left-out = { $count ->
    [one] { $number } point left out: Lumen shows surfaces.
   *[other] { $number } points left out: Lumen shows surfaces.
}
errors-reoriented = { $count ->
    [one] { $number } triangle turned over to agree with the neighbours.
   *[other] { $number } triangles turned over to agree with the neighbours.
}
errors-turned = { $count ->
    [one] { $number } piece found inside out and turned.
   *[other] { $number } pieces found inside out and turned.
}
errors-non-manifold = { $count ->
    [one] { $number } edge where more than two triangles meet; left as in the file.
   *[other] { $number } edges where more than two triangles meet; left as in the file.
}
errors-no-inside = The surface has no inside and outside (its triangles cannot be made to agree).
errors-moved = The surface lies far from the origin of its coordinates: it was moved by ({ $x }, { $y }, { $z }) mm to keep its detail, and is saved there.
errors-size = The surface is { $across } mm across, which is unusual for vessels: check its unit of length.
# $units is such as "cm (12.0 mm)", or errors-size-or.
errors-size-units = The surface is { $across } mm across, which is unusual for vessels: its numbers may be in { $units }.
errors-calibre-units = Its vessels are { $wide } mm wide on average, which is unusual: the numbers of the file may be in { $units }.
# $first and $next are such as "cm (12.0 mm)".
errors-size-or = { $first } or in { $next }

## Arrays that are left out

# $why is one of the messages below.
errors-array-left-out = The array { $name } is left out: { $why }.
errors-arrays-more = { $count ->
    [one] { $number } more array is left out.
   *[other] { $number } more arrays are left out.
}
errors-array-parts = its parts do not go together
errors-array-beyond = only the first { $most } arrays of a file are read
errors-array-not-everywhere = not every part of the file has it
errors-array-damaged = its data are damaged or elsewhere
errors-array-matrices = it holds matrices
errors-array-other-length = it has another length than the surface
errors-array-memory = it would take more memory than a file of this size is given
errors-array-cut-short = it is cut short
errors-array-no-number = it holds what is no number
errors-array-text = it holds text
errors-array-type = its numbers are of a type that is not read
errors-array-too-many = its data are damaged, or too many for a file of this size
errors-array-of-type = it holds values of the type { $kind }
errors-array-not-understood = it and what follows are not understood

## Files that are not written, or not in full

errors-nothing-to-save = There is no surface to save.
errors-triangle-refers = Triangle { $triangle } refers to vertex { $index }, but there are { $vertices } vertices.
errors-not-finite = Vertex { $vertex } has a position or a normal that is not a finite number.
errors-normal-count = There are { $normals } normals for { $vertices } vertices.
errors-array-length = The array "{ $name }" has { $tuples } tuples for { $rows } vertices or triangles.
errors-format-too-large = The surface is too large for a { $format } file: it would take { $bytes } bytes.
# $names are the names of $count arrays.
errors-no-place-arrays = { $count ->
    [one] { $format } has no place for arrays: { $names } is left out.
   *[other] { $format } has no place for arrays: { $names } are left out.
}
errors-no-place-triangles = { $count ->
    [one] { $format } has no place for arrays of triangles: { $names } is left out.
   *[other] { $format } has no place for arrays of triangles: { $names } are left out.
}
errors-no-place-colour = { $count ->
    [one] { $format } has no place for arrays other than one colour: { $names } is left out.
   *[other] { $format } has no place for arrays other than one colour: { $names } are left out.
}
errors-no-place-such = { $count ->
    [one] { $format } has no place for such arrays: { $names } is left out.
   *[other] { $format } has no place for such arrays: { $names } are left out.
}
errors-not-carried = The arrays of the file are not with it, because they are not carried to this level: save it again.
# Why a file is not written: behind its name and a colon.
errors-no-result = there is no result yet
errors-not-measured = the vessels are still being measured

## Units and axes

errors-unknown-unit = "{ $word }" is not a unit of length that Lumen knows: mm, cm or m.
# $from and $to are LPS, RAS or errors-axes-unknown.
errors-axes = Which way the axes of the surface point is not known, so it cannot be turned from { $from } to { $to }.
errors-axes-unknown = unknown axes

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

## What mending left

errors-weld-limited = At { $vertices } vertices on open edges less than { $mm } mm was welded: their triangles are as small.
errors-wall-not-parted = The lumen was not taken: the sides of the wall cannot be told apart.
errors-no-wall = The surface is no wall with two sides: it is taken as it is.
errors-holes-left = { $count ->
    [one] { $number } hole within the limit could not be filled without crossing the surface.
   *[other] { $number } holes within the limit could not be filled without crossing the surface.
}

## Messages between the parts of Lumen

errors-message = the message is not understood: { $error }
errors-message-buffer = buffer { $index } of the message has { $bytes } bytes, not a multiple of { $element }
errors-message-memory = there is no memory left for its { $bytes } bytes
errors-message-text = buffer { $index } of the message is no text

## Samples that cannot be made

errors-sample-range = { $asked } triangles are outside the range of { $least } to { $most }
errors-sample-grid = no grid gives { $asked } triangles to within 1 %; the nearest gives { $nearest }
errors-cancelled = cancelled
