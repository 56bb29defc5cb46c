### Scans und Masken: ihr Feld und ihre Ansichten, was an ihren Dateien falsch sein kann und was der Browser zu Dateien sagt.

## Das Feld

scan-title = Scan
scan-what = Die Oberfläche entsteht, wo Werte die Schwelle erreichen, oder aus einem Label; dann wird sie geglättet und reduziert.
scan-name = Scan
scan-format = Format
scan-voxels = Voxel
scan-voxels-help = Spalten, Zeilen und Schichten
scan-spacing = Abstand
scan-spacing-help = Zwischen Spalten, Zeilen und Schichten
scan-values = Werte
scan-values-range = { $low } bis { $high }{ $unit }
scan-volume = Volumen
scan-volume-help = Welches der Volumen in den Dateien gezeigt wird; ein anderes wird neu gelesen
scan-volume-offer = { $slices ->
    [one] { $what } ({ $slices } Schicht)
   *[other] { $what } ({ $slices } Schichten)
}
scan-volume-series = Serie { $number }
scan-threshold = Schwelle
scan-threshold-help = Was diesen Wert und mehr hat, ist das Gefäß; kontrastierte Gefäße im CT haben 150 bis 500 HU.
scan-histogram = Histogramm mit der Schwelle
scan-vessel = Gefäß
scan-vessel-help = Welches Label der Maske das Gefäß ist
scan-vessel-label = Label des Gefäßes
scan-label = Label { $label }
scan-label-named = Label { $label }: { $name }
scan-all-labels = Alle Labels
scan-seed = Startpunkt
scan-seed-help = Nur was mit diesem Voxel zusammenhängt, wird zur Oberfläche
scan-seed-remove = Entfernen
scan-seed-click = Klick auf das Gefäß in der Schicht: Nur was damit zusammenhängt, wird zur Oberfläche.
scan-half-way = Die Schwelle liegt in der Mitte zwischen dem Gefäß ({ $vessel }{ $unit }) und seiner Umgebung ({ $around }{ $unit }).
scan-method = Oberfläche durch
scan-method-help = Surface Nets glättet die Stufen innerhalb jedes Voxels, was dünne Gefäße ihrem Kaliber am nächsten bringt; Marching Cubes lässt sie, damit das Glätten sie entfernt
scan-surface-nets = Surface Nets
scan-marching-cubes = Marching Cubes
scan-shifts = Bei einer um 10 % niedrigeren Schwelle läge die Wand { $lower } mm weiter außen, bei einer um 10 % höheren { $higher } mm.
scan-box = Ausschnitt
scan-box-help = Nur diese Voxel werden betrachtet: Was außerhalb liegt, etwa Knochen, wird weggelassen
scan-columns = Spalten
scan-rows = Zeilen
scan-slices = Schichten
scan-box-ends = Erste und letzte, ab 0
scan-last-of = Letzte der { $axis }
scan-first-of = Erste der { $axis }
scan-whole = Ganzer Scan
scan-across = Quer zu
scan-across-help = Wie die gezeigte Schicht liegt
scan-slice = Schicht
scan-preview = Vorschau
scan-preview-help = Die Oberfläche in verringerter Auflösung
scan-triangles = { $count ->
    [one] { $count } Dreieck
   *[other] { $count } Dreiecke
}
scan-preview-coarse = Die Vorschau hat ein Voxel für je { $block }, sobald etwas davon innen liegt: Dünne Gefäße sehen weiter aus, als sie sind.
scan-cancel = Abbrechen
scan-cancel-help = Esc
scan-make = Oberfläche bilden
scan-make-help = In voller Auflösung, und öffnen
scan-close = Scan schließen

## Was gerade getan wird

scan-fetching = Der Teil von Lumen, der Scans liest, wird noch geladen
scan-part-missing = Nicht geöffnet: Der Teil von Lumen, der Dateien liest, konnte noch nicht geladen werden. Versuchen Sie es gleich noch einmal
scan-reading = Scan wird gelesen
scan-surveying = Werte zählen
scan-making = Oberfläche bilden
scan-progress = Fortschritt des Scans
scan-engine-stopped = Die Berechnung des Scans ist abgestürzt ({ $reason }): den Scan noch einmal öffnen.

## Die Ansichten eines Scans

scan-preview-view = Vorschau der Oberfläche
scan-preview-made = Die Vorschau wird berechnet
scan-preview-not-drawn = Die Vorschau kann nicht gezeichnet werden: { $why }.
scan-no-device = Es gibt kein Grafikgerät, mit dem gezeichnet werden könnte.
scan-slice-view = Schicht des Scans
scan-slice-number = Schicht { $number }

## Schichten hinter der Oberfläche

scan-slices-title = Schichten des Scans
scan-across-columns = Quer zu Spalten
scan-across-rows = Quer zu Zeilen
scan-across-slices = Quer zu Schichten
scan-sagittal = Sagittal
scan-coronal = Koronal
scan-axial = Axial
scan-plane-help = Diese Ebene des Scans hinter der Oberfläche zeigen; die Tasten 1 bis 6 sehen sie von vorn
scan-slice-place = { $slice } von { $count }, { $mm } mm
scan-slice-place-help = Welche Schicht, und wie weit sie von der ersten entfernt ist
scan-plane-slider-help = Bewegt die Ebene durch den Scan
scan-plane-slice = Schicht: { $plane }
scan-outline = Umriss der Oberfläche
scan-outline-help = Wo die Ebene die gezeigte Oberfläche schneidet; er sollte am Rand des Gefäßes verlaufen
scan-keep = Scan für Schichten behalten ({ $mb } MB)
scan-keep-help = Der Scan bleibt mit dem Programmteil, der ihn gelesen hat, im Speicher, damit seine Schichten hinter der Oberfläche gezeigt werden können

## Das Fenster der Werte

scan-window = Fenster
scan-window-help = Die Werte, die schwarz und weiß sind
scan-window-name = Fenster der Werte
scan-window-vessels = Gefäße
scan-window-soft = Weichteile
scan-window-bone = Knochen
scan-window-most = Die meisten
scan-window-all = Alle Werte
scan-window-own = Eigenes
scan-level-width = Mitte, Breite
scan-level-width-help = Der Wert in der Mitte zwischen Schwarz und Weiß, und wie weit diese auseinanderliegen
scan-width = Breite des Fensters
scan-level = Mitte des Fensters

## Voreinstellungen der Schwelle

scan-preset-little = für Gefäße mit wenig Kontrastmittel
scan-preset-arteries = für Arterien
scan-preset-aorta = für die Aorta und die Koronararterien
scan-preset = { $value } { $name }
scan-presets = { $first }, { $second }, { $third }

## Warum es keine Oberfläche, Vorschau oder Schicht gibt

scan-none-open = Es ist noch kein Scan offen.
scan-no-slice = Diese Schicht gibt es nicht.
scan-nothing-chosen = Dies ist ein Scan mit Werten von { $low } bis { $high }: Bitte angeben, bei welcher Schwelle seine Oberfläche gebildet werden soll (kontrastierte Gefäße im CT: { $presets }).
scan-outside-range = Bei der Schwelle { $threshold } liegt keine Oberfläche: Die Werte reichen von { $low } bis { $high }.
scan-seed-outside = Der Startpunkt liegt nicht im Gefäß: Sein Wert { $value } ist nicht gewählt.
scan-seed-nowhere = Der Startpunkt liegt nicht im Scan oder nicht im Quader.
scan-seed-no-edge = Um den Startpunkt wurde kein Rand eines Gefäßes gefunden: Bitte die Schwelle einstellen.
scan-no-label = Das Label { $label } gibt es im Volumen nicht; { $known }.
scan-known-range = es ist ein Scan mit Werten von { $low } bis { $high }
scan-known-labels = es hat { $labels }
scan-outside-box = Der Ausschnitt enthält nichts vom Volumen, das { $size } Voxel hat.
scan-slice-too-large = Eine Schicht hat { $points } Voxel, von denen { $limit } bearbeitet werden können: einen Ausschnitt um die Gefäße setzen.
scan-all-one-side = Es gibt keine Oberfläche: Das ganze Volumen liegt auf einer Seite.
scan-one-side = Im Ausschnitt gibt es keine Oberfläche: Alles liegt auf einer Seite.
scan-too-many-triangles = Die Oberfläche hat mehr als { $limit } Dreiecke, die meisten davon Rauschen oder Knochen: die Schwelle anheben oder einen Ausschnitt um die Gefäße setzen.

## Warum ein Volumen keinen Ort hat

scan-no-place = Das Volumen lässt sich nicht im Patienten platzieren: { $why }.
scan-no-points = { $size } Punkte ergeben kein Volumen
scan-no-spacing = einen Abstand von { $spacing } mm zwischen seinen Punkten hat kein Scan
scan-no-directions = die Richtungen seiner Achsen spannen keinen Raum auf
scan-no-origin = sein Ursprung ist kein Ort in einem Körper
scan-points = Das Volumen hat { $points } Punkte und dafür { $samples } Zahlen.

## Warum eine Datei nicht geöffnet wurde

scan-no-volume = „{ $name }“ ist kein Volumen, das Lumen kennt: Es öffnet Dateien in NIfTI, NRRD, MetaImage und VTI und Serien in DICOM.
scan-no-scan = Die Datei ({ $format }) lässt sich nicht als Scan öffnen: { $problem }.
scan-data-elsewhere = Der Kopf in { $format } hat seine Zahlen in der Datei „{ $name }“: beide zusammen öffnen.
scan-dicom-mixed = { $places ->
    [one] An einem Ort liegen mehrere Schichten, und nichts in den Dateien sagt, zu welchem Volumen jede gehört: die Dateien eines Volumens allein öffnen.
   *[other] An { $places } Orten liegen je mehrere Schichten, und nichts in den Dateien sagt, zu welchem Volumen jede gehört: die Dateien eines Volumens allein öffnen.
}
scan-no-such-volume = { $count ->
    [one] Es gibt kein Volumen { $number }: Die Dateien enthalten eines.
   *[other] Es gibt kein Volumen { $number }: Die Dateien enthalten { $count }.
}
scan-too-large = Das Volumen ist zu groß: Seine Zahlen brauchen { $bytes } Byte, und Lumen kann { $limit } aufnehmen.
scan-volume-memory = Für die { $bytes } Byte des Volumens reicht der Speicher nicht.
scan-no-memory = Der Speicher reicht hier nicht, um { $mb } MB zu lesen.
scan-file-gone = Die Datei ist nicht mehr da.
scan-unreadable = { $path } ist nicht lesbar

## Was an einer Datei auffällt

scan-silent = Die { $format }-Datei sagt nicht, wie der Patient liegt: Die Achsen sind unbekannt.
scan-silent-format = { $format } sagt nicht, wie der Patient liegt: Die Achsen sind unbekannt.
scan-unknown-unit = Die Längeneinheit der { $format }-Datei, { $unit }, ist nicht bekannt: Sie wird als mm genommen.
scan-nifti-no-matrix = Die Matrix (sform) der NIfTI-Datei ist nicht brauchbar: Ihre Richtungen spannen keinen Raum auf. Stattdessen wird das Quaternion (qform) verwendet.
scan-nifti-no-place = Die Matrix (sform) der NIfTI-Datei ist nicht brauchbar: Ihre Richtungen spannen keinen Raum auf. Ein brauchbares Quaternion (qform) gibt es nicht, und stattdessen werden die Abstände verwendet.
scan-nifti-spacings = Die NIfTI-Datei widerspricht sich: Nach ihrer Matrix (sform) sind Voxel { $matrix } mm voneinander entfernt, nach ihren Abständen { $stated } mm. Die Matrix wird genommen.

## Was an einer Datei falsch ist

scan-packed = sie kündigt { $needed } Byte an, mehr als ihre { $bytes } komprimierten Byte enthalten können: Sie ist abgeschnitten oder beschädigt
scan-packed-damaged = ihre komprimierten Daten sind abgeschnitten oder beschädigt
scan-header-endless = ihr Kopf endet nicht mit einer leeren Zeile
scan-header-lacks = in ihrem Kopf fehlt „{ $key }“
scan-header-none = ihr Kopf ist keiner
scan-not-numbers = „{ $key }“ besteht nicht aus { $count } Zahlen
scan-no-data-file = ihr Kopf sagt nicht, wo die Zahlen stehen ({ $key })
scan-many-labels = ihre Ebenen enthalten mehr als { $most } Labels, die meisten, die eine Karte haben kann
scan-axes = sie hat { $axes } Achsen
scan-dicom-header = eine Datei endet in ihrem Kopf
scan-dicom-damaged = die Elemente einer Datei sind beschädigt
scan-dicom-cut-short = eine Datei endet in einem ihrer Elemente
scan-dicom-pixels = eine Schicht hat weniger Pixel als Zeilen mal Spalten
scan-dicom-jpeg = das JPEG-Bild einer Schicht ist beschädigt oder von einer Art, die nicht gelesen wird
scan-dicom-jpeg-size = das JPEG-Bild einer Schicht hat nicht die Größe, die die Datei nennt
scan-dicom-no-directions = sie sagt nicht, wie ihre Schichten liegen
scan-dicom-no-spacing = sie sagt nicht, wie weit ihre Pixel auseinanderliegen
scan-dicom-no-places = sie sagt nicht, wo ihre Schichten liegen
scan-dicom-no-slice = keine ihrer Dateien enthält eine Schicht in Graustufen
scan-dicom-colours = ihre Bilder sind farbig, und eine Oberfläche braucht Graustufen
scan-dicom-single = sie enthält eine einzige Schicht, und eine Oberfläche braucht zwei oder mehr
scan-vti-wrong = „{ $name }“ ist falsch
scan-vti-no-element = das Element „{ $name }“ fehlt
scan-vti-no-points = sie sagt nicht, wie viele Punkte es gibt
scan-vti-no-array = sie hat kein Feld mit einer Zahl je Punkt oder Zelle

## Was nicht gelesen wird: ein Hauptwort im Akkusativ, hinter „verwendet“

scan-dimensions = eine andere Zahl von Dimensionen als drei
scan-more-dimensions = mehr als drei Dimensionen
scan-number-type = Zahlen vom Typ { $kind }
scan-file-a-slice = eine Datei je Schicht
scan-encoding = die Kodierung { $name }
scan-numbers-a-voxel = mehrere Zahlen je Voxel
scan-dicom-jpeg-bits = JPEG-Bilder mit { $bits } Bit
scan-dicom-table = eine Tabelle der Werte (Modality LUT)
scan-dicom-jpeg-2000 = JPEG-2000-Kompression
scan-dicom-compression = eine unbekannte Kompression
scan-dicom-bits = { $bits } Bit je Pixel
scan-vti-pieces = mehrere Stücke

## Was zu einer DICOM-Serie gesagt wird

scan-dicom-unreadable = { $count ->
    [one] Eine Schicht kann nicht gelesen werden und wird weggelassen. { $why }
   *[other] { $count } Schichten können nicht gelesen werden und werden weggelassen. { $why }
}
scan-dicom-same-place = { $count ->
    [one] Eine Schicht ist zweimal da, am selben Ort und mit denselben Pixeln: Eine davon wird genommen.
   *[other] { $count } Schichten sind zweimal da, am selben Ort und mit denselben Pixeln: Je eine davon wird genommen.
}
scan-volumes = Die Dateien enthalten { $count } Volumen einer Serie, unterschieden nach: { $by }; jedes mit seiner Zahl von Schichten: { $list }. Volumen { $taken } ist geöffnet.
scan-dicom-series = { $others ->
    [one] Die Dateien enthalten { $count } Serien. Das Volumen mit den meisten Schichten ({ $taken }) ist geöffnet. Weggelassene Schichten der anderen Serie: { $slices }.
   *[other] Die Dateien enthalten { $count } Serien. Das Volumen mit den meisten Schichten ({ $taken }) ist geöffnet. Weggelassene Schichten von { $others } anderen Serien: { $slices }.
}
scan-dicom-mixed-left-out = { $count ->
    [one] Ein Volumen wird weggelassen: Mehrere seiner Schichten liegen am selben Ort, und nichts in den Dateien sagt, zu welchem Volumen jede gehört.
   *[other] { $count } Volumen werden weggelassen: Mehrere ihrer Schichten liegen am selben Ort, und nichts in den Dateien sagt, zu welchem Volumen jede gehört.
}
scan-dicom-no-slices = { $count ->
    [one] Eine Datei enthält keine Schicht in Graustufen und wird weggelassen.
   *[other] { $count } Dateien enthalten keine Schicht in Graustufen und werden weggelassen.
}
scan-dicom-gap = Die Schichten haben keinen gleichmäßigen Abstand: meist { $usual } mm, aber { $there } mm zwischen den Schichten { $below } und { $above }; einige fehlen vielleicht, und die Oberfläche ist dort gestreckt.
scan-dicom-squeeze = Die Schichten haben keinen gleichmäßigen Abstand: meist { $usual } mm, aber { $there } mm zwischen den Schichten { $below } und { $above }; die Oberfläche ist dort gestaucht.

## Was die Volumen einer Serie unterscheidet: hinter einem Doppelpunkt, und vor seinem Wert

scan-by-time = zeitliche Position
scan-by-heart-phase = Herzphase
scan-by-trigger = Triggerzeit
scan-by-echo = Echo
scan-by-b-value = b-Wert
scan-by-image-type = Bildart
scan-by-stack = Stapel
scan-by-acquisition = Nummer der Aufnahme
scan-by-thickness = Schichtdicke
scan-by-kernel = Faltungskern
scan-by-voltage = Röhrenspannung
scan-by-reference-frame = Bezugssystem
scan-by-moment = Zeitpunkt
scan-by-order = Nummern der Schichten
scan-by-place = Lage der Schichten
scan-by-several = mehrere Felder
scan-by-segment = Segment
scan-by-layer = Ebene

## Der Browser

scan-part-gone = Eine Datei des Scans konnte nicht gelesen werden; vielleicht wurde sie seit der Auswahl verschoben oder geändert.
scan-part-memory = Der Browser hat keinen Speicher mehr, um den Scan zu lesen.
scan-folder-lost = Der Browser konnte den Ordner nicht lesen.
scan-folder-empty = In dem Ordner sind keine Dateien.
scan-file-large = { $name } hat { $gb } GB; im Browser öffnet Lumen Oberflächen bis { $limit } GB.
scan-file-lost = Der Browser konnte { $name } nicht lesen; vielleicht wurde die Datei seit der Auswahl verschoben oder geändert.
scan-file-memory = { $name } hat { $mb } MB, für die dieser Browser keinen Speicher mehr hat.
scan-no-dialog = Der Browser hat keinen Dateidialog geöffnet.
scan-saved = { $name } wurde gespeichert.
scan-both-saved = { $first } und { $second } wurden gespeichert.
scan-not-saved = { $name } wurde nicht gespeichert: Der Browser hat keinen Speicher mehr für { $mb } MB.
scan-not-kept = { $name } wird nicht behalten: Dieser Browser hat keinen Platz für { $mb } MB.
scan-not-forgotten = Der Browser konnte die Oberfläche nicht löschen: bitte die Daten dieser Seite in seinen Einstellungen löschen.
scan-typed = Eingabe

scan-not-fetched = sein Programm konnte nicht geladen werden: { $reason }
scan-not-handed-over = die Dateien konnten nicht übergeben werden: { $why }
scan-not-sent = ein Befehl konnte nicht gesendet werden: { $why }
scan-not-understood = eine Antwort konnte nicht gelesen werden: { $why }
scan-no-worker = es konnte kein Worker gestartet werden: { $why }
scan-memory-ends = über die belegten { $gb } GB hinaus ist kein Speicher mehr da
scan-message-unread = Die Nachricht konnte nicht gelesen werden.
scan-script-unloaded = Das Skript des Workers konnte nicht geladen werden.
scan-browser-memory = der Browser hat keinen Speicher mehr für { $mb } MB
scan-language-not-handed-over = die Sprache konnte nicht übergeben werden: { $why }
scan-language-failed = Die Wörter für { $name } konnten nicht geladen werden: { $reason }. Alles bleibt, wie es ist.
