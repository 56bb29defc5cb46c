### The panel beside the views: the steps of the method with their settings, and the result in numbers. It is 296 points
### wide: a name on the left shares its row with a value or a list on the right.

## Controls

# Beside a field that holds a number.
panel-type = Ziehen, oder klicken und eingeben
# For assistive tools: the field beside the slider $name.
panel-value = { $name }: Wert
# On the button that sets a value back; $unit begins with a space, where there is one.
panel-back-to = Zurück auf { $value }{ $unit }
# For assistive tools: $name is "pass band".
panel-reset = { $name } zurücksetzen

# On a button: goes to a place in the view, or marks places there.
panel-show = Zeigen
# On a button: sets what was found.
panel-go-there = Übernehmen
# The head of what is folded up in a step.
panel-advanced = Erweitert
panel-advanced-help = Was selten anders einzustellen ist
# For assistive tools: $step is "Smooth" or "Reduce".
panel-advanced-of = Erweitert: { $step }

## Step 1: the surface

panel-surface = Oberfläche
panel-surface-does = Das größte zusammenhängende Stück bleibt.
panel-surface-none = Eine Oberfläche öffnen oder eine Datei hierher ziehen.
# Beside the name of step 1 while it is folded: keep it short.
panel-surface-to-mend = Reparatur nötig
panel-in-file = Dreiecke in Datei
panel-in-file-help = Wie die Datei sie enthält, Polygone zerlegt
panel-kept = Behalten
panel-triangle-count = { $count ->
    [one] { $count } Dreieck
   *[other] { $count } Dreiecke
}
panel-left-out = Weggelassen
panel-left-out-help = Stücke, die mit dem behaltenen keinen Eckpunkt gemeinsam haben
# $count triangles.
panel-left-out-count = { $pieces ->
    [one] { $count } in { $pieces } Stück
   *[other] { $count } in { $pieces } Stücken
}
panel-show-left-out = Weggelassenes zeigen
panel-show-left-out-help = Ein Klick auf ein Stück in der Ansicht behält dieses; mit Umschalt oder Strg kommt es dazu oder fällt weg
panel-unit = Einheit der Datei
panel-unit-help = Was eine Länge von 1 in der Datei bedeutet
# For assistive tools: the list of units.
panel-unit-list = Einheit
panel-all-pieces = Alle Stücke
# In place of a list of them: from 2 to 16.
panel-pieces = { $count } Stücke
panel-piece-add = Behält auch dieses Stück oder nicht mehr
# For assistive tools: $piece is "1,234 triangles, 56.7 mm".
panel-piece-keep = Das Stück von { $piece } behalten
# A piece in a list.
panel-piece = { $count ->
    [one] { $count } Dreieck, { $size } mm
   *[other] { $count } Dreiecke, { $size } mm
}
# For assistive tools: the list of pieces.
panel-piece-list = Stück

## Step 1: the axes of the file

panel-axes = Achsen der Datei
panel-axes-help = Wohin die Koordinaten wachsen: nach links, hinten, oben (LPS, wie in DICOM) oder nach rechts, vorn, oben (RAS)
panel-axes-unknown = Unbekannt
# Before the choice of axes in the menu of files, and for assistive tools the list in the panel.
panel-axes-list = Achsen
panel-axes-written-help = Wohin die Koordinaten gespeicherter Oberflächen wachsen; Dateien, die einen Platz dafür haben, geben es an, wie 3D Slicer es schreibt
panel-axes-unknown-help = Die Datei gibt nicht an, wohin ihre Achsen zeigen: in Schritt 1 wählen, dann lassen sie sich drehen
# On a narrow button beside LPS and RAS: saved surfaces keep their axes.
panel-axes-kept = Belassen
panel-axes-save-kept = Achsen beim Speichern belassen
# $axes is LPS or RAS.
panel-axes-save = In { $axes } speichern

## Step 1: the arrays of the file

panel-colour = Färben nach
panel-colour-help = Was die Datei über ihre Eckpunkte und Dreiecke angibt, in der schattierten Ansicht
panel-colour-none = Nichts
# An array of a file: its $name in the file, and $kind the type of its numbers, such as uint8. $on is "vertices" or "triangles".
panel-array-identifiers = { $on ->
    [vertices] { $name }: Labels auf Eckpunkten, { $kind }
   *[triangles] { $name }: Labels auf Dreiecken, { $kind }
}
panel-array-labels = { $on ->
    [vertices] { $name }: { $count ->
        [one] { $count } Label auf Eckpunkten
       *[other] { $count } Labels auf Eckpunkten
    }, { $kind }
   *[triangles] { $name }: { $count ->
        [one] { $count } Label auf Dreiecken
       *[other] { $count } Labels auf Dreiecken
    }, { $kind }
}
panel-array-scalar = { $on ->
    [vertices] { $name }: Skalar auf Eckpunkten, { $kind }
   *[triangles] { $name }: Skalar auf Dreiecken, { $kind }
}
panel-array-components = { $on ->
    [vertices] { $name }: { $count } Komponenten auf Eckpunkten, { $kind }
   *[triangles] { $name }: { $count } Komponenten auf Dreiecken, { $kind }
}
# $array is one of the messages above.
panel-array-range = { $array }, { $least } bis { $most }
# Below the labels that the legend of an array names.
panel-labels-more = { $count ->
    [one] und { $count } weiteres
   *[other] und { $count } weitere
}

## Step 1: mending

panel-mending = Reparatur
panel-faults-sought = Die Datei wird durchsucht...
panel-faults-none = Nichts gefunden, was zu reparieren wäre.
panel-holes = Löcher
panel-holes-help = Öffnungen der Wand, in denen kein Gefäß endet
panel-holes-count = { $count }, bis { $size } mm
# Edges of more than two triangles.
panel-edges = Mehrfachkanten
panel-edges-help = Kanten mit mehr als zwei Dreiecken: Dort ist die Oberfläche keine Mannigfaltigkeit
panel-points = Berührpunkte
panel-points-help = Eckpunkte, in denen sich Teile der Oberfläche punktförmig berühren: Dort ist sie keine Mannigfaltigkeit
panel-ends = Offene Enden
panel-ends-help = Wo Gefäße enden: Sie bleiben offen
# On a button: goes to the next place.
panel-fault-next = Weiter
panel-fault-show-help = Markiert sie in der Ansicht und geht von einem zum nächsten
# For assistive tools: $faults is "holes", "crowded edges", ...
panel-fault-next-of = Weiter: { $faults }
panel-fault-show = Zeigen: { $faults }
panel-wall = Zweiseitige Wand
panel-wall-help = Die Oberfläche ist eine Wand mit zwei Seiten, einer äußeren und einer inneren: Das Blut ist in der inneren
panel-wall-thickness = { $thickness } mm dick
panel-dropped = Entfernte Dreiecke
panel-dropped-help = Dreiecke mit einem doppelten Eckpunkt; beim Lesen behoben
panel-double = Doppelte Dreiecke
panel-double-help = Dreiecke über denselben drei Eckpunkten wie ein anderes
panel-turned = Gewendete Dreiecke
panel-turned-help = Beim Lesen gewendet, damit sie zu den Nachbarn passen
panel-turned-pieces = Gewendete Stücke
panel-turned-pieces-help = Stücke, deren Innenseite außen lag; beim Lesen gewendet
# What is said of a place that the view goes to.
panel-edge-place = Mehrfachkante
panel-point-place = Berührpunkt
panel-hole-place = Loch von { $size } mm
panel-end-place = Offenes Ende von { $size } mm
# Ticked, and followed by a field with a length.
panel-fill = Löcher füllen bis
panel-fill-help = Schließt Löcher in Wänden, die höchstens so groß sind; Gefäßenden bleiben offen
panel-weld = Kanten schweißen bis
panel-weld-help = Verbindet offene Kanten, die sich fast treffen. Nichts fällt zusammen: Wo Dreiecke ebenso klein sind, gilt ein kleinerer Wert
panel-split = Mehrfachkanten trennen
panel-split-help = Trennt Flächen, die sich eine Kante teilen oder in einem Punkt berühren, und entfernt doppelte Dreiecke
panel-lumen = Lumen nehmen
panel-lumen-help = Bei einer Wand mit zwei Seiten: behält die innere, an den Rändern abgeschnitten, als Grenze des Blutes
# What was mended, in a list with commas.
panel-mended-welded = { $count ->
    [one] { $count } Eckpunkt verschweißt
   *[other] { $count } Eckpunkte verschweißt
}
panel-mended-edges = { $count ->
    [one] { $count } Kante getrennt
   *[other] { $count } Kanten getrennt
}
panel-mended-vertices = { $count ->
    [one] { $count } Eckpunkt getrennt
   *[other] { $count } Eckpunkte getrennt
}
panel-mended-double = { $count ->
    [one] { $count } doppeltes Dreieck weggelassen
   *[other] { $count } doppelte Dreiecke weggelassen
}
panel-mended-holes = { $count ->
    [one] { $count } Loch gefüllt
   *[other] { $count } Löcher gefüllt
}
panel-mended-wall = { $count ->
    [one] { $count } Dreieck der Wand weggelassen
   *[other] { $count } Dreiecke der Wand weggelassen
}

## Step 2: smoothing

panel-smooth = Glätten
panel-smooth-does = Entfernt die Treppenstufen des Scans.
panel-strength = Stärke
panel-strength-help = Zur Oberfläche passend: wie veröffentlicht, aber nirgends so stark, dass ein Gefäß sein Kaliber verliert oder Dreiecke sich schneiden. Wie veröffentlicht: Durchlassband 0,01, 100 Iterationen, überall gleich.
# Settings of one's own, in the list of the strength.
panel-strength-own = Eigene
panel-pass-band = Durchlassband
panel-pass-band-help = Was der Filter durchlässt: 0,001 lässt nur die grobe Form stehen, 2 lässt alles stehen. Ohne Einheit.
panel-iterations = Iterationen
panel-iterations-help = Grad des Filters: je höher, desto schärfer. 0 schaltet die Glättung aus.
# The window function of the filter.
panel-window = Fenster
panel-window-help = Fensterfunktion des Filters. Hamming ist die der Veröffentlichung; Nuttall hat die geringste Welligkeit.
panel-adapt = Dem Kaliber anpassen
panel-adapt-help = Glättet dünne Gefäße weniger, damit jedes sein Kaliber behält. Das Durchlassband ist das der weiten.
panel-guard = Ohne Schnitte
panel-guard-help = Glättet weniger, wo Dreiecke sonst durch andere gezogen würden: an Falten und zwischen Gefäßen.
panel-hold-caps = Deckel halten
panel-hold-caps-help = Ebene Enden geschlossener Gefäße bleiben eben und behalten ihre Flächen: Ein- und Auslässe einer Strömung.
panel-volume-held = Volumen erhalten
panel-volume-held-help = Gibt dort zurück, was die Glättung abträgt: offene Enden verschlossen, auf 0,01 % genau.
panel-smoothed-less = { $count ->
    [one] An { $count } Eckpunkt weniger geglättet: ohne Schnitte.
   *[other] An { $count } Eckpunkten weniger geglättet: ohne Schnitte.
}
panel-smoothed-less-help = Geht dorthin, wo am wenigsten geglättet ist
# What is said of the place that the view goes to.
panel-smoothed-less-place = Weniger geglättet

## Step 2: the settings that have a name

panel-preset-auto = Zur Oberfläche passend
panel-preset-paper = Wie veröffentlicht
panel-preset-none = Keine

## Step 2: the response of the filter

# $k is the eigenvalue, $length a length with its unit.
panel-half-gain = Halbe Verstärkung bei k = { $k }: Wellen von { $length }; kürzere werden weggeglättet.
panel-half-gain-adapted = Halbe Verstärkung bei k = { $k }: Wellen von { $length }; kürzere verschwinden, in dünnen Gefäßen weniger.
panel-half-gain-bare = Halbe Verstärkung bei k = { $k }.
panel-half-gain-none = Nichts wird weggeglättet: Alles wird durchgelassen.
panel-response = Filterantwort
panel-response-help = Wie viel von einer Welle auf der Oberfläche bleibt, nach ihrer Länge
panel-response-length = Länge einer Welle, mm
panel-response-eigenvalue = Eigenwert k
# Beside lines and points of the picture.
panel-response-thinnest = dünnstes gemessenes: { $length }
panel-response-pass-band = Durchlassband
panel-response-half = halb
# Beside the pointer, in two lines.
panel-response-at =
    { $length }: { $percent } % bleiben
    k = { $k }
panel-response-at-bare =
    { $percent } % bleiben
    k = { $k }
panel-wave = Welle
panel-wave-help = Ihre Länge auf der Oberfläche; hier oder auf der Kurve ziehen
# $wave is a length with its unit, or "k = 0.0234".
panel-wave-left = Von einer Welle von { $wave } bleiben { $percent } %.
panel-wave-left-thinnest = Um das dünnste gemessene Gefäß, { $length }: { $percent } %.
panel-wave-left-thinnest-adapted = Um das dünnste gemessene Gefäß, { $length }: { $percent } %, durch die Anpassung mehr.
panel-windows = Fenster im Vergleich
panel-windows-help = Die drei anderen bei gleichem Durchlassband und gleichen Iterationen
panel-windows-drawn = Dünn: die anderen in der Reihenfolge der Liste, gestrichelt, gepunktet, lang gestrichelt.
panel-laplacian = Laplace daneben
panel-laplacian-help = Was bliebe, wenn jeder Eckpunkt so oft, wie es Iterationen gibt, zum Mittel seiner Nachbarn rückte
panel-laplacian-seen = Auch im Bild
panel-laplacian-seen-help = In der geteilten Ansicht links, was ebenso viele Laplace-Durchgänge aus der Oberfläche machen: Dünne Gefäße schrumpfen
panel-laplacian-left = { $passes ->
    [one] Rot: { $passes } Laplace-Durchgang, λ = { $factor }: { $percent } % der Welle bleiben.
   *[other] Rot: { $passes } Laplace-Durchgänge, λ = { $factor }: { $percent } % der Welle bleiben.
}
# Diameters with their unit: as it is, after Laplacian smoothing, after windowed-sinc smoothing.
panel-laplacian-thinnest = Das dünnste Gefäß, { $whole }, schrumpft auf { $laplacian }; mit Windowed Sinc auf { $sinc }.
panel-laplacian-thinnest-adapted = Das dünnste Gefäß, { $whole }, schrumpft auf { $laplacian }; mit Windowed Sinc auf { $sinc } (durch die Anpassung mehr).
# The terms of the Chebyshev series.
panel-terms = Terme
panel-terms-help = Die Tschebyscheff-Reihe bis zu diesem Term, als dünne Kurve; der letzte ist der der Iterationen
panel-terms-drawn = Dünne Linie: Terme 0 bis { $last } von { $iterations }, bis zu { $percent } % neben der ganzen Reihe.

## Step 3: the reduction

panel-reduce = Reduzieren
panel-reduce-does = Entfernt zuerst, was am wenigsten zählt; die Topologie bleibt.
panel-stop = Grenze
panel-stop-help = Was bestimmt, wie weit die Reduktion geht
panel-stop-deviation = Abweichung
panel-stop-rate = Rate oder Anzahl
panel-bound = Größte Abweichung
panel-bound-help = So wenige Dreiecke, wie überall und in beiden Richtungen so nah an der geglätteten Oberfläche bleiben können.
panel-next-coarser = Nächstgröbere Stufe
panel-next-coarser-help = Eine Abweichung, die in der Stufe mit einem Schritt mehr gefunden wurde
# There is no coarser level.
panel-next-coarser-none = keine
panel-reduction = Reduktion
panel-reduction-help = Der Teil der Dreiecke, der entfernt wird.
panel-back-to-auto = Zurück auf automatisch
# Behind the name of a rate that is set by itself, in brackets: keep it short.
panel-auto-short = auto
panel-auto = Automatisch: 90 % oder so weit wie sicher
# $percent is the rate that was come to: at most 90.
panel-auto-most = Automatisch: { $percent } %
panel-auto-safe = Automatisch: { $percent } %, so weit wie sicher
panel-auto-kept = Automatisch: { $percent } %, erhalten, wo gemessen
panel-auto-pinched = Automatisch: { $percent } %, keines eingeschnürt
panel-auto-deciding = Automatisch: es wird bestimmt, wie weit es sicher ist
panel-auto-help = Reduziert um 90 % oder so weit, wie jedes Gefäß sein Kaliber auf { $tolerance } % genau behält und keines eingeschnürt wird, je nachdem, was weniger ist. Der Regler setzt stattdessen eine Zahl.
# Followed by a rate: reduction up to it changes no vessel too much.
panel-safe = Sicher bis
panel-safe-help = Bis hier behält jedes messbare Gefäß sein Kaliber auf { $tolerance } % genau, keines wird eingeschnürt, und keine Dreiecke schneiden sich, die es nicht schon taten.
# $why is a part of a sentence.
panel-safe-refused = Hier gibt es keine solche Rate: { $why }.
panel-kept-to = Erhalten bis
panel-safe-rests = Bei { $percent } % gemessen über { $coverage }; das Urteil gilt der gezeigten Stufe.
panel-safe-rests-at = Um { $percent } % reduziert: über { $coverage }
panel-safe-changed = Äste, die schon die Glättung stärker ändert, zählen nicht: { $count }.
panel-safe-go-help = Setzt die Reduktion auf die Marke unter dem Regler
panel-wanted = Anzahl Dreiecke
panel-wanted-help = Dasselbe als Zahl; ziehen, oder klicken und eingeben
panel-method = Verfahren
panel-method-help = Schroeder ist das der Veröffentlichung: Es löscht Eckpunkte und verschiebt keinen. Quadric verschiebt sie: halbe mittlere Abweichung, bessere Form.
panel-feature-angle = Kantenwinkel
panel-feature-angle-help = Kanten, die schärfer sind als dieser Winkel, bleiben als Kanten erhalten.
panel-spare-thin = Dünne Gefäße schonen
panel-spare-thin-help = Ein Fehler zählt umso mehr, je dünner das Gefäß ist: Dünne behalten mehr Dreiecke, weite weniger.
panel-keep-labels = Labelgrenzen halten
panel-keep-labels-help = Kanten zwischen zwei Labels der Felder der Datei werden als Kanten gehalten: Eckpunkte bewegen sich nur auf ihnen

## Step 3: the error against the triangles

panel-error = Fehler über Dreiecken
panel-error-help = Was jede Rate auf dieser Oberfläche kostet, aus ihrem einen progressiven Netz
panel-error-mm = Fehler, mm
# Beside lines of the picture.
panel-error-now = jetzt
panel-error-safe = sicher
panel-error-kept = erhalten
panel-error-is = { $count ->
    [one] Fehler über Dreiecken: { $error } mm bei { $count } Dreieck
   *[other] Fehler über Dreiecken: { $error } mm bei { $count } Dreiecken
}
panel-error-schroeder = Fehler: der des Verfahrens, der seine Schritte ordnet. Quadratisches Mittel des Abstands von den Ebenen, für die ein Eckpunkt stand; an Kanten und offenen Enden mindestens der Abstand von deren Linie. Keine Schranke: Die Punkte sind gemessen.
panel-error-quadric = Fehler: der des Verfahrens, der seine Schritte ordnet. Quadratisches Mittel des Abstands des neuen Eckpunkts von den Ebenen, für die er steht. Keine Schranke: Die Punkte sind gemessen.
panel-error-other = Grau: { $method }, von derselben Oberfläche.
panel-error-other-none = { $method } steht daneben, sobald es einmal gewählt war: Es braucht einen eigenen Lauf.
# Beside the pointer, in three lines; $curve is what the curve is of.
panel-error-at =
    { $curve }
    { $error } mm bei { $count ->
        [one] { $count } Dreieck
       *[other] { $count } Dreiecken
    }
    Klicken, um dorthin zu gehen

## The result

panel-result = Ergebnis
# Below the heading, as long as the surface that was opened has no level yet.
panel-result-follows = Wird berechnet...
panel-triangles = Dreiecke
panel-vertices = Eckpunkte
# After and before the reduction; also which of how many.
panel-of = { $count } von { $all }
panel-of-help = Nach und vor der Reduktion
panel-removed = Entfernt
panel-calibre = Kaliber
panel-calibre-help = Ob jedes messbare Gefäß sein Kaliber behält
panel-vessels = Gefäße
panel-vessels-help = Was aus jedem wurde, und wo
panel-deviation-mean = Abweichung, mittl.
panel-deviation-max = Abweichung, max.
panel-deviation-help = Abstand von der geglätteten Oberfläche, in beiden Richtungen gemessen
panel-volume = Volumen
panel-volume-help = Änderung gegenüber den behaltenen Stücken wie geöffnet, offene Enden verschlossen
panel-area = Fläche
panel-area-help = Änderung gegenüber den behaltenen Stücken wie geöffnet
panel-notes = Hinweise zur Datei

## The result: the shape

panel-shape = Form
# Of the level, and of the smoothed surface before.
panel-shape-was = { $now }, zuvor { $before }
panel-shape-narrowest = Engste Stelle bei ({ $x }; { $y }; { $z }) mm
panel-roughness = Rauheit
panel-roughness-help = Quadratisches Mittel des Winkels zwischen benachbarten Dreiecken; „zuvor“ ist die geglättete Oberfläche. Weniger Dreiecke knicken stärker.
# Triangles with a very small angle.
panel-slivers = Splitter
panel-slivers-help = Dreiecke mit einem Winkel unter 10 Grad, als Teil von allen
panel-self-intersecting = Selbstschnitte
panel-self-intersecting-help = Dreiecke, die andere schneiden
panel-caps = Ein- und Auslässe
panel-caps-help = Ebene Enden, und um wie viel sich ihre Flächen ändern
# How many, and the least and largest change in percent.
panel-caps-changed = { $count }, { $least } bis { $most } %
panel-smallest-lumen = Engstes Lumen
panel-smallest-lumen-help = Durchmesser der Gefäße an der engsten Stelle: der größten Kugel im Innern, die dort die Wand berührt

## The result: what each stage took

panel-times = Zeit je Schritt
panel-time-reading = Lesen
panel-time-mending = Reparatur
panel-time-connectivity = Zusammenhang
panel-time-smoothing = Glättung
panel-time-decimation = Dezimierung, alle Raten
panel-time-bound = Stufe suchen
panel-time-level = Stufe
panel-time-normals = Normalen
panel-time-deviation = Abweichung
panel-time-measures = Form und Lumen
panel-time-calibre = Kaliber

## The deviation, as colours

panel-from-opened = Vom Original
panel-from-opened-help = Wie weit die Stufe von der Oberfläche abweicht, wie sie geöffnet wurde, nicht von der geglätteten
panel-signed = Innen und außen
panel-signed-help = Wo die Stufe außerhalb jener Oberfläche liegt, und wo innerhalb
# Followed by four small buttons: 95 %, 0.1 mm, 0.25 mm, 0.5 mm.
panel-up-to = Bis
panel-up-to-help = Die Abweichung, die die letzte Farbe hat
panel-up-to-percentile = 95 %: worunter 95 % der Messpunkte liegen
# For assistive tools.
panel-up-to-value = Farben bis { $value }
# Above the legend in the view.
panel-legend-opened = Abweichung vom Original
panel-legend-smoothed = Abweichung, lokales Mittel
# Below the legend.
panel-legend-sides = Unten: innen, oben: außen
# Below the histogram.
panel-beyond = { $percent } % über { $deviation } mm
panel-largest-deviation = Größte Abweichung: { $deviation } mm
# $place is the message above.
panel-largest-deviation-go = { $place }. Klicken, um dorthin zu gehen

## The vertex classes, as colours

# Above the legend in the view.
panel-class = Eckpunktklasse
# In the legend: a class and how many vertices there are of it.
panel-class-count = { $class } { $count }
# For assistive tools: the classes with how many there are of each, with commas.
panel-classes = Eckpunktklassen: { $classes }
panel-classes-help = Einfach: auf keiner Formkante. Komplex: Die Oberfläche ist dort keine Scheibe. Rand: an einem offenen Ende. Innere Kante: Zwei Formkanten treffen sich. Ecke: eine oder mehr als zwei.

## What the computation does, in the status bar, before its percentage

panel-work-reading = Lesen
panel-work-comparing = Vergleichen
panel-stage-mending = Reparieren
panel-stage-connectivity = Stücke suchen
panel-stage-smoothing = Glätten
panel-stage-decimation = Reduzieren
panel-stage-bound = Stufe suchen
panel-stage-level = Stufe erstellen
panel-stage-deviation = Abweichung messen
panel-stage-arrays = Felder übertragen
panel-stage-measures = Form und Lumen messen
panel-stage-faults = Fehler suchen
panel-stage-vessels = Gefäße suchen
panel-stage-certificate = Kaliber messen
panel-stage-safe = Sichere Rate suchen

## The samples, in the menu, and as the name of what is shown

panel-sample-aorta = Bauchaorta
panel-sample-coronary = Koronararterien
panel-sample-aorta-nets = Bauchaorta durch Surface Nets

## Die Gleichungen

panel-equations = Gleichungen
panel-equations-of = Gleichungen: { $step }
panel-equations-help = Die Gleichungen des Artikels. Zeigen Sie auf ein farbiges Zeichen: Sein Regler und seine Marke in der Filterantwort leuchten auf, und umgekehrt.
panel-equation-1 = Wie weit ein Eckpunkt vom Mittel seiner Nachbarn liegt; seine Gewichte w ergeben zusammen 1.
panel-equation-2 = Dasselbe für alle Eckpunkte zugleich, mit K = I − W.
panel-equation-3 = Glätten: eine Funktion von K, angewandt auf die Koordinaten.
panel-equation-4 = Die Oberfläche ist eine Summe von Wellen e. Von jeder bleibt der Anteil f(k); ihr Eigenwert k ist nahe 0 bei langen Wellen, höchstens 2 bei den kürzesten.
panel-equation-5 = Die Filterantwort: Tschebyschow-Polynome T bis zum Grad N. θ steht für das Durchlassband, ein wenig verschoben, damit es selbst ganz durchkommt.
panel-equation-6 = Das Fenster { $window }: Ohne diese Gewichte würde eine Reihe, die endet, schwingen.
panel-equation-7 = Die Reduktion: der Anteil der m Dreiecke, der wegfällt, in Prozent; m' bleiben.
panel-tied-pass-band = Durchlassband: { $value }
panel-tied-iterations = Iterationen: { $count }
panel-tied-window = Fenster: { $window }
panel-tied-reduction = Reduktion
panel-tied-wave = Eigenwert einer Welle; die Kurve zeigt die, die Sie ausprobieren
panel-tied-response = Filterantwort: der Anteil einer Welle, der bleibt
