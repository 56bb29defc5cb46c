### What leaves the app for the record: reports, pictures and turntables.

## Entries of the menu of what can be saved

record-report = Report...
record-report-help = A page for the record: verdict, numbers, settings, vessels, pictures and curves
record-picture = Picture (PNG)
# The longer side of a picture: 960 pixels...
record-pixels = { $count } pixels...
record-pixels-help = The longer side of the picture
record-clear = Transparent background
record-clear-help = Nothing behind the surface, to lay it over something else
record-turntable = Turntable (APNG)...
record-turntable-help = The surface turning once, as a picture that moves; the colours are those of the view
record-video = Turntable as video (WebM)...
record-video-help = One turn of the surface, for slides; it is recorded as it plays, in some 4 s
record-no-video = The browser could not record the video.

## A plot as a file

record-plot = Save plot: { $title }
record-plot-help = As a file for slides and papers
record-plot-svg = As vector graphic (SVG)...
record-plot-svg-help = Sharp at any size; its words stay words
record-plot-png = As picture (PNG)...
record-plot-png-help = 1920 pixels wide
record-figure = Picture...
record-figure-help = All of them as one picture for slides and papers (PNG), 2400 pixels wide
record-figure-title = Smoothing and reduction compared

## The sheet of the report

record-said-kept = Case and comment stand in the report alone. Lumen forgets them when another surface is opened.
record-report-pdf = Save as PDF...
record-report-pdf-help = To print
record-report-html = Save as web page...
record-report-html-help = The same in one file for a browser, which needs nothing else
record-report-surface = Save as web page with the surface...
record-report-surface-help = The same page; the surface can be turned in it, on any device, without Lumen
record-name-file = Name the file in reports
record-name-file-help = Otherwise a report has the file's fingerprint alone: names may be those of patients

## What is being drawn, before the part of it that is done, in percent: one word

record-drawing-report = Report
record-drawing-picture = Picture
record-drawing-turntable = Turntable
record-drawing-film = Reduction, moving

## What came of it

record-nothing = There is nothing to save yet.
record-cancelled = Cancelled.
record-cannot-draw = It cannot be drawn: { $why }.
record-not-drawn = It was not drawn: { $why }.
record-device-gone = It was not drawn: the device went away.
# Said after a colon; a full stop follows.
record-error-too-large = this graphics device draws pictures of at most { $limit } pixels each way
