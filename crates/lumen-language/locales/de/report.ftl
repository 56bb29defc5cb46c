### Berichte: was auf der Seite für die Akten steht (PDF und Webseite).

report-title = Gefäßoberfläche
report-not-clinical = Nicht für klinische Entscheidungen.
report-page = Seite { $page } von { $count }
report-date = Datum
report-case = Fall
report-comment = Bemerkung

## Überschriften

report-file = Datei
report-settings = Einstellungen
report-numbers = Zahlen
report-by-hand = Von Hand gemessen
report-solver = Für einen Löser fertig gemacht: Wand, Ein- und Auslässe
report-stretches = Enger und weiter als beiderseits davon
report-view-reduced = Reduziert: { $count ->
    [one] ein Dreieck
   *[other] { $count } Dreiecke
}
report-view-before = Vorher: { $count ->
    [one] ein Dreieck
   *[other] { $count } Dreiecke
}
report-view-less = Weniger reduziert: { $count ->
    [one] ein Dreieck
   *[other] { $count } Dreiecke
} von { $all }
report-view-help = Ziehen dreht, Rad oder zwei Finger vergrößern, Umschalt und Ziehen verschiebt, Doppelklick zeigt das Ganze; oder Pfeiltasten, + und -, 0.
report-view-save = Als GLB speichern

## Die Datei

report-fingerprint = Prüfsumme (SHA-256)
report-no-fingerprint = keine: nicht aus einer Datei
report-format = Format
report-format-in = { $format }, in { $unit }
report-opened = Geöffnet
report-counts = { $triangles ->
    [one] { $triangles } Dreieck
   *[other] { $triangles } Dreiecke
} in { $pieces ->
    [one] einem Stück
   *[other] { $pieces } Stücken
}
report-size = Größe
report-size-mm = { $x } × { $y } × { $z } mm
report-axes = Achsen
report-axes-unknown = unbekannt
report-threshold = Schwelle
report-threshold-moves = { $value }; um 10 % niedriger läge die Wand { $lower } mm weiter außen, um 10 % höher { $higher } mm

## Einstellungen

report-keep = Behalten
report-keep-largest = das größte Stück
report-keep-piece = Stück { $number }
report-keep-pieces = Stücke { $numbers }
report-keep-all = alle Stücke
report-mending = Reparatur
report-no-mending = keine
report-lumen-taken = Lumen einer Wand genommen
report-welded = bis { $value } mm verschweißt
report-split = Flächen getrennt
report-filled = Löcher bis { $value } mm gefüllt
report-smoothing = Glättung
report-no-smoothing = keine
report-filter = Durchlassband { $band }, { $count ->
    [one] 1 Iteration
   *[other] { $count } Iterationen
}, { $window }
report-preset = { $preset }: { $filter }
report-no-crossings = ohne Schnitte
report-volume-held = Volumen erhalten
report-reduction = Reduktion
report-target-reduction = { $percent } % der Dreiecke
report-target-auto = { $percent } % der Dreiecke, automatisch gewählt
report-target-auto-safe = { $percent } % der Dreiecke, automatisch gewählt: so weit wie sicher
report-target-auto-kept = { $percent } % der Dreiecke, automatisch gewählt: so weit Gefäße erhalten sind, wo sie gemessen sind
report-target-auto-pinched = { $percent } % der Dreiecke, automatisch gewählt: so weit kein Gefäß eingeschnürt ist
report-target-triangles = { $count ->
    [one] auf { $count } Dreieck
   *[other] auf { $count } Dreiecke
}
report-target-deviation = innerhalb von { $most } mm
report-method = Verfahren
report-allowed = Zulässige Kaliberänderung

## Zahlen

report-triangles = Dreiecke
report-triangles-of = { $left } von { $all }
report-from-smoothed = Abweichung (geglättet)
report-from-opened = Abweichung (geöffnet)
report-distance = im Mittel { $mean } mm, höchstens { $most } mm
report-volume-change = Volumenänderung
report-area-change = Flächenänderung
report-half-gain = Halbe Verstärkung
report-crossing = Selbstschnitte
report-caps = Ein- und Auslässe
report-smallest-lumen = Engstes Lumen
report-measured = Gefäße gemessen
report-output-fingerprint = Oberflächen-Prüfsumme

## Spalten und Zellen

report-calibre = Kaliber
report-radius = Radius wie geöffnet, mm
report-diameter = Durchmesser
report-by-area = Fläche
report-diameter-mm = Durchmesser, mm
# Wo entlang des Gefäßes die Referenz gemessen ist.
report-reference-at = Referenz bei, mm
report-at-mm = Bei, mm
report-diameter-of = { $diameter } von { $reference }
report-measure = Messung
report-found = Wert
report-made-on = Gemessen an
report-middle = Mitte, mm
report-area = Fläche, mm²
report-end-radius = Radius, mm
report-normal = Normale, nach außen
report-point = ({ $x }; { $y }; { $z })
report-at = Bei ({ $x }; { $y }; { $z }) mm.

## Kurven

report-response = Was die Glättung von einer Welle lässt
report-wave-length = Länge einer Welle, mm
report-eigenvalue = Eigenwert
report-left = Rest
report-left-curve = Rest
report-pass-band = Durchlassband
report-change = Änderung, %
report-change-allowed = zulässig: ±{ $percent } %

## Warum es kein Bild gibt

report-error-size = ein Bild von { $width } × { $height } Pixeln kam mit { $bytes } Byte
report-error-png = das Bild lässt sich nicht schreiben: { $why }

report-sweep = Führungsdraht je nach Reduktion: { $file }
report-sweep-rate = Reduktion, %
report-sweep-tip = Spitze neben dem Weg ohne Reduktion, mm
report-sweep-deviation = größte
report-sweep-median = Median
report-sweep-noise = Rauschen
report-sweep-arrived = Kommen an, %
report-sweep-force = Größte Wandkraft, mN
