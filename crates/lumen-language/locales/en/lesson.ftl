### Lessons, their card and the glossary.

## The card of a lesson

# Stands over a step: the lesson's title, and which of its steps this is.
lesson-place = { $title }, { $step } of { $count }
lesson-close = Close lesson
lesson-close-help = Leave the lesson (Esc)
lesson-next = Next
lesson-next-help = Sets the app for the next step
lesson-back = Back
lesson-back-help = Sets it for the step before
lesson-again = Set again
lesson-again-help = Sets the app as this step has it
lesson-copy-link = Copy link
lesson-copy-link-help = Opens this step for whoever follows it
# $what is what stands behind "look:" in a step of a lesson, of the lessons below or of a teacher's.
lesson-look = Look at { $what }
# Below it, while numbers are still to come.
lesson-measuring = Being measured: the numbers follow.
lesson-show-answer = Show the answer
lesson-show-answer-help = Say your own first
# Told as a lesson is closed.
lesson-given-back = Settings and colours are as they were before the lesson. Undo brings its settings back.
lesson-given-back-surface = { $name } is open again, with the settings from before the lesson.

## What is wrong with a lesson that a teacher wrote

# $names are those of links; they are the same in all languages.
lesson-no-such = There is no lesson of that name; there are { $names }.
lesson-not-first = This is no lesson: its first line has to be "{ $first }".
lesson-not-text = This is no lesson: it is no text, or too long.
lesson-no-step = The lesson has no step.
lesson-unknown-key = Line { $line } of the lesson is not understood: "{ $key }".
lesson-wrong-value = Line { $line } of the lesson: "{ $value }" is no value for "{ $key }".
lesson-half-question = A step of the lesson has a question without an answer, or an answer without a question: "{ $step }".
lesson-settings-twice = Line { $line } of the lesson: It says "{ $name }" twice.
lesson-settings-unknown = Line { $line } of the lesson: It says "{ $name }", which means nothing here.
lesson-settings-value = Line { $line } of the lesson: It cannot be read: "{ $value }" is no value for "{ $key }".
lesson-settings-range = Line { $line } of the lesson: It cannot be used: { $error }.
lesson-settings-long = Line { $line } of the lesson: the settings are too long.

## The lessons

# Of each lesson its title, as the menu has it, and its file: what a teacher could write (docs/teaching.md). What stands before a
# colon, the first line, and the values of sample, settings, view, show and trial are the same in all languages. A line that begins
# with two more spaces goes on with the line above; none of these may begin with a dot, a star or a bracket.

lesson-stair-steps = Stair-steps
lesson-stair-steps-text =
    lumen lesson 1
    title: Stair-steps

    step: What a scan leaves
    text: A scan is a grid of boxes. A segmentation says of each box whether it is vessel, and marching cubes puts a surface
      around those that are. So the wall comes in terraces, as high as a slice is thick.
    sample: aorta
    settings: iterations=0 reduction=0
    view: anterior
    show: raking
    look: the terraces across the aorta, and how they turn along the branches that lie flat.
    ask: Is a terrace a property of the vessel, or of the scan?
    answer: Of the scan. Turn the patient and the terraces lie otherwise; the vessel is the same.

    step: With the filter
    text: The windowed-sinc filter takes away what is shorter than the form of the vessel and leaves what is longer. No triangle
      goes; vertices move.
    settings: reduction=0
    view: anterior
    show: split
    look: the line in the left view: drag it. Left of it the surface as opened, right of it smoothed.
    ask: How far has a vertex moved, compared with the size of a voxel?
    answer: On most of the wall less than half a voxel: a terrace ends no farther than that from where the wall was. Colour by
      deviation, from the surface as opened, shows it.

    step: Why a simulation minds
    text: A guidewire feels each terrace as an edge. Friction is asked for where there is none in the patient, and a contact search
      has many times the triangles that the form needs.
    settings: reduction=90
    view: anterior
    show: split
    look: the wireframe: one triangle in ten is left, and the form is there.

lesson-nets = Two ways from a mask
lesson-nets-text =
    lumen lesson 1
    title: Two ways from a mask

    step: Marching cubes
    text: A mask says of each voxel whether it is vessel. Marching cubes puts every vertex half way between a voxel that is and one
      that is not. So the wall has the steps of the voxels.
    sample: aorta
    settings: iterations=0 reduction=0
    view: anterior
    show: raking
    look: the steps; nothing is smoothed yet.

    step: Surface nets
    text: The same mask by surface nets. Each cell between voxels that differ has a vertex, which relaxes towards its neighbours and
      back and never leaves its cell. The surface is less rough before any filter.
    sample: aorta-nets
    settings: iterations=0 reduction=0
    view: anterior
    show: raking
    look: the same places as before.
    ask: To relax draws a wall inwards. Are the vessels narrower for it?
    answer: No. Each step towards the neighbours is followed by one back, and the volume differs by less than 1 % from that of
      marching cubes.

    step: Both with the filter
    text: The filter smooths either surface. Here every artery that leaves the aorta is as wide either way, to within 1 % of its mean
      radius.
    sample: aorta-nets
    settings: reduction=0
    view: anterior
    show: split
    look: the line in the left view: left of it surface nets as they are, right of it with the filter.
    ask: Why does Lumen begin with surface nets where a mask is opened?
    answer: For thin vessels. The filter spares them, so what it begins with is nearly what is left of them.

lesson-pass-band = Pass band
lesson-pass-band-text =
    lumen lesson 1
    title: Pass band

    step: Everything passes
    text: A surface can be taken apart into waves, as a tone is. Each has an eigenvalue k of the surface's Laplacian: small for long
      waves, up to 2 for the shortest. What lies below the pass band stays. At 2 that is everything.
    sample: aorta
    settings: pass-band=2 reduction=0 adapt=no guard=no
    view: anterior
    show: response
    look: Response in step 2 of the panel: a straight line at 100 %.

    step: Only what is long
    text: At 0.1 the shortest waves go. The sentence below Strength says up to which length in millimetres half of a wave is left.
    settings: pass-band=0.1 reduction=0 adapt=no guard=no
    view: anterior
    show: split
    look: the terraces: what is left of them at this pass band?
    ask: What happens at 0.01: does less pass, or more?
    answer: Less. The pass band is the highest eigenvalue that passes; a smaller one leaves longer waves only.

    step: The paper's choice
    text: At 0.01 with 100 iterations terraces are gone on this surface, and calibres stay to about 3 %. The number has no unit: on a
      finer mesh the same 0.01 means shorter waves.
    settings: pass-band=0.01 reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: the length in the sentence, beside the circumference of the thinnest vessel (dotted in Response).

    step: Too far
    text: At 0.001 waves as long as the way around a vessel go: the renal arteries are drawn shut, the iliac arteries lose half of
      their calibre. That is no noise any more: it is the vessel.
    settings: pass-band=0.001 iterations=200 reduction=0 adapt=no guard=no
    view: anterior
    show: calibre
    look: the colours of branches 4 and 5, the renal arteries, and 1 and 7, the iliac arteries. The scale is in per cent of their
      radius.

lesson-windows = Iterations and windows
lesson-windows-text =
    lumen lesson 1
    title: Iterations and windows

    step: A filter of few terms
    text: An ideal filter would let everything below the pass band through and nothing above. A polynomial cannot have such a step.
      Iterations are its degree: with 10 the fall is wide, and waves far above the pass band stay.
    sample: aorta
    settings: pass-band=0.1 iterations=10 reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: Response in step 2 of the panel: how wide is the fall from 100 % to nothing?
    ask: What do more iterations change: how far the surface is smoothed, or how sharply?
    answer: How sharply waves are told apart. The pass band says where; the degree says how steep.

    step: More terms
    text: With 100 the fall is steep and lies close above the pass band.
    settings: pass-band=0.1 iterations=100 reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: the dot at half gain, which has moved towards the dashed line. Move Terms in Response from 0 on: how the series
      adds up to it.

    step: The window
    text: Cut off after so many terms, the series would ripple: some waves would grow. A window tapers the terms. Hamming, the
      paper's, falls steeply and ripples by little; Nuttall ripples least and falls least steeply.
    settings: pass-band=0.1 iterations=30 window=nuttall reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: the curve while you choose one Window after the other, under Advanced in step 2.
    ask: Which of the four has the steepest fall at the same degree?
    answer: Hamming, then Hanning. Blackman and Nuttall ripple less and fall less steeply.

lesson-shrinkage = Shrinkage
lesson-shrinkage-text =
    lumen lesson 1
    title: Shrinkage

    step: Why not just average
    text: Moving each vertex to the mean of its neighbours smooths too, and every pass takes a little off all waves, the longest as
      well: a tube becomes thinner and in the end a thread. The windowed-sinc filter leaves the long waves whole.
    sample: aorta
    settings: reduction=0 adapt=no guard=no
    view: anterior
    show: response
    look: Volume in the result at the foot of the panel; in Response, with Laplacian beside it ticked, what averaging would
      leave of the thinnest vessel.
    ask: Can a filter that leaves long waves whole still make a vessel thinner?
    answer: Yes, where the vessel itself is a short wave: the way around it is its wavelength.

    step: A thin vessel is a short wave
    text: With a narrower pass band the waves around the renal arteries, 19 mm long, fall into what is taken away. These lose
      calibre; the aorta, whose waves are three times as long, keeps it.
    settings: pass-band=0.006 iterations=200 reduction=0 adapt=no guard=no
    view: anterior
    show: calibre
    look: which branches change their colour first.

    step: Giving the volume back
    text: Preserve volume moves vertices out again along their normals until the volume is what it was, to 0.01 %.
    settings: pass-band=0.006 iterations=200 preserve-volume=yes reduction=0 adapt=no guard=no
    view: anterior
    show: calibre
    ask: Does the right volume mean the right calibre everywhere?
    answer: No. The volume is one number for all vessels; the table under Vessels has each.

    step: Each vessel its own
    text: Adapt to calibre gives each vertex a pass band of its own, so wide that the waves around its vessel pass.
    settings: reduction=0
    view: anterior
    show: calibre vessels
    look: the verdict above the views, and the change of each branch in the table.

lesson-decimation = What decimation keeps
lesson-decimation-text =
    lumen lesson 1
    title: What decimation keeps

    step: One collapse
    text: Decimation takes one vertex after the other, the cheapest first. The vertex goes to a neighbour, the triangles on that edge
      vanish, the others around it stretch over the hole.
    sample: aorta
    settings: reduction=90
    show: flat collapses
    look: the ring: the vertex that goes next, the hole around it and the triangles that will fill it. Step back and forward.

    step: Who may go
    text: Schroeder has five classes. Simple vertices lie within the wall. Boundary vertices go along their open end, vertices on a
      feature edge along that edge, so that rims and creases stay. Complex ones stay.
    settings: reduction=90 feature-angle=60
    view: anterior
    show: classes lines
    look: the counts beside the colours, and the rims of the open ends.
    ask: Smooth vessels have hardly any feature edges. Where are the vertices that are not simple?
    answer: At the open ends: they are boundary vertices.

    step: What it costs
    text: Each step has an error in millimetres, and every reduction rate is there at once. So the whole curve can be drawn.
    settings: reduction=98
    view: anterior
    show: deviation error
    look: Error against triangles in step 3 of the panel: click along the curve.
    ask: From 50 % to 90 % four of five triangles go. Does the error grow fivefold?
    answer: On smooth vessels about so: the error grows with the square of a triangle's side, and that is as one over their number.

    step: What never changes
    text: No open end is closed, no two vessels are joined, and no triangle is made to cross another. A calibre may change: from
      99.7 % on a vessel is pinched, and the verdict says where. Where nothing more may go, the run ends.
    settings: reduction=99.9
    view: anterior
    show: flat
    look: the rims: every open end is still there, with three edges or more; and at the place that is pinched.

lesson-wire = What a wire feels
lesson-wire-text =
    lumen lesson 1
    title: What a wire feels

    step: The way in
    text: A guidewire is an elastic rod. It is fed at the groin, bends where the wall turns it, and slides under friction. The wall is
      made of just the triangles that are shown.
    sample: aorta
    settings: reduction=90
    view: anterior
    show: vessels
    look: the radii in the table: a wire of 0.89 mm across has to find its way through them.
    ask: Will the wire touch the wall all the way, or in a few places?
    answer: In a few: it is stiff and lies against the outside of the bends.

    step: The autopilot
    text: The autopilot feeds and rolls the wire as a hand would. Push is the force at the hand, along the wire.
    settings: reduction=90
    trial: autopilot
    look: Wall force and Push force in the panel, and the colour of the wall where it was touched.

    step: Fewer triangles
    text: The same with one triangle in a hundred. Each facet is a flat place with an edge to the next.
    settings: reduction=99
    trial: autopilot
    look: the bars, whose scale is that of the step before.
    ask: Is the force on the wall another one than before?
    answer: One run does not tell: the order of the triangles alone changes it. Compare with the unreduced surface measures the
      difference against that noise.

lesson-solver = From scan to solver
lesson-solver-text =
    lumen lesson 1
    title: From scan to solver

    step: Light, but not even
    text: The level is light and keeps every vessel's calibre: enough for a wire. A flow solver fills the vessel with tetrahedra, and
      these are as good as the triangles that they stand on.
    sample: aorta
    settings: reduction=90
    view: anterior
    look: the wireframe: long, thin triangles along the vessels.

    step: Ends for a flow
    text: Each end is cut square to its vessel, extended by 5 radii as a tube that becomes a circle, and closed by a flat patch with a
      name. Names and areas stand in step 5 of the panel.
    sample: aorta
    settings: reduction=90
    show: solver
    look: the coloured ends.
    ask: Why are ends extended?
    answer: The flow that a solver is given at an end is not the one of the vessel. Along the extension it becomes so.

    step: Triangles by calibre
    text: Every vessel has 12 edges around it, so that a thin one has small triangles and a wide one large ones. None is far from
      equilateral.
    sample: aorta
    settings: reduction=90
    show: solver
    look: the wireframe where a renal artery leaves the aorta.
    ask: A polygon of 12 edges lies inside its circle. How much of the area is lost?
    answer: 4.5 %. Lumen brings inlets and outlets back to the area that they had; of the wall more edges keep more.

## The glossary

# Of each entry the word, a colon and a space, and what it means. The entries are shown in the order of the alphabet.

lesson-word-boundary-loop = Boundary loop: The rim of an open end: a closed line of edges that have one triangle each.
lesson-word-calibre = Calibre: The width of a vessel, here the radius of the circle that has the area of its cross-section.
lesson-word-chebyshev-polynomials = Chebyshev polynomials: The terms that the filter is a sum of. Each costs one pass over the surface.
lesson-word-complex-vertex = Complex vertex: A vertex around which the triangles form no disc, as where three sheets meet. It stays.
lesson-word-corner = Corner: A vertex where one feature edge ends or more than two meet.
lesson-word-decimation = Decimation: Taking away vertices, the cheapest first, and closing the hole that each leaves.
lesson-word-deviation = Deviation: The distance between the reduced and the smoothed surface, measured both ways, in mm.
lesson-word-eigenvalue-k = Eigenvalue k: What says how short a wave on the surface is: 0 for the longest, 2 for the shortest.
lesson-word-feature-edge = Feature edge: An edge whose two triangles differ in direction by more than the feature angle.
lesson-word-flip = Flip: A triangle that would turn its other side outwards. No collapse may make one.
lesson-word-gain = Gain: The part of a wave that the filter leaves: 100 % in the pass band, nearly nothing above.
lesson-word-half-edge-collapse = Half-edge collapse: A vertex goes to where a neighbour is; the triangles on their edge vanish.
lesson-word-interior-edge-vertex = Interior edge vertex: A vertex within the surface on which two feature edges meet.
lesson-word-level = Level: One of the surfaces of a progressive mesh, with a number of triangles.
lesson-word-link-condition = Link condition: Two vertices may become one only if they share no neighbours but those opposite their edge. It keeps the topology.
lesson-word-marching-cubes = Marching cubes: The method that puts a surface around the voxels of a segmentation.
lesson-word-pass-band = Pass band: The eigenvalues that pass the filter: all below this number.
lesson-word-progressive-mesh = Progressive mesh: All levels of one run, from which any reduction rate is taken without another run.
lesson-word-quadric = Quadric: The sum of squared distances from a set of planes, kept as ten numbers.
lesson-word-reduction-rate = Reduction rate: The part of the triangles that is removed, in per cent.
lesson-word-simple-vertex = Simple vertex: A vertex within the surface and on no feature edge.
lesson-word-surface-nets = Surface nets: The method that gives each cell between unlike voxels a vertex and lets it relax within that cell.
lesson-word-topology = Topology: Which pieces, holes and open ends there are, whatever their form.
lesson-word-wavelength = Wavelength: The length of a wave on the surface, in mm. The way around a vessel is one.
lesson-word-window = Window: Weights that taper the terms of the filter, so that it ripples less.
