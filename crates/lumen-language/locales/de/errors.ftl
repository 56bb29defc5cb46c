### Was schiefgeht und was zu einer Datei gesagt wird: Sätze in einer Meldung, in der Liste der Befunde oder hinter dem Namen
### einer Datei. Ein „Feld“ ist eine Liste von Zahlen zu den Eckpunkten oder Dreiecken einer Oberfläche, wie bei VTK.

## Dateien, die nicht geöffnet werden

errors-file-empty = Die Datei ist leer.
errors-file-unknown = „{ $name }“ ist keine Oberfläche, die Lumen kennt: Es öffnet Dateien in { $formats } und { $last }.
errors-vtk-kind = Dies sind VTK-Daten anderer Art ({ $kind }), Lumen öffnet aber Oberflächen: die Oberfläche extrahieren und diese speichern.
errors-vtk-index = Diese VTK-Datei ({ $kind }) nennt nur andere, die die Daten enthalten: eine von diesen öffnen.
errors-image-volume = Dies ist keine Oberfläche, sondern ein Bildvolumen ({ $format }), das beschädigt ist oder von einer Art, die Lumen nicht liest: segmentieren und die Oberfläche speichern.
errors-compressed = Dies ist eine komprimierte Datei ({ $format }): entpacken und die Oberfläche darin öffnen.
errors-cut-short = Die Datei ({ $format }) ist abgeschnitten: Angekündigt sind { $announced } { $what }, vorhanden { $found }.
errors-broken-line = Die Datei ({ $format }) ist in Zeile { $line } fehlerhaft – { $problem }.
errors-broken = Die Datei ({ $format }) ist fehlerhaft – { $problem }.
errors-face-refers = Fläche { $face } der Datei ({ $format }) verweist auf Eckpunkt { $index }, die Datei hat aber { $vertices } Eckpunkte.
errors-coordinate = Eckpunkt { $vertex } der Datei hat die Koordinate { $value }, die kein Ort in einem Körper ist.
errors-gltf-elsewhere = Die glTF-Datei hat ihre Daten in einer anderen Datei ({ $uri }): als eine einzige GLB-Datei speichern und diese öffnen.
errors-gltf-unnamed = die sie nicht nennt
errors-unsupported = Die Datei ({ $format }) verwendet etwas, das Lumen nicht liest: { $feature }.
errors-too-large = Die Oberfläche ist zu groß: Sie hat { $corners } Eckpunkte oder Ecken, Lumen kann höchstens { $limit } aufnehmen.
errors-no-triangles = Die Datei ({ $format }) enthält keine Dreiecke ({ $vertices } Eckpunkte und nichts dazwischen, das zu zeigen wäre).
errors-no-surface = Die Datei ({ $format }) enthält keine Oberfläche, nur { $lines } und { $points }: Lumen öffnet keine Zentrallinien.
errors-unfolds = Entpackt enthielte die Datei ({ $format }) { $what }, mehr als eine Datei von { $file } Byte glaubhaft enthalten kann.
errors-all-degenerate = Keines der { $triangles } Dreiecke der Datei ({ $format }) hat eine Fläche: Jedes wiederholt einen seiner Eckpunkte.

## Gezählte Teile einer Datei, in der Mehrzahl

errors-bytes = Byte
errors-header-bytes = Byte des Kopfes
errors-vertices = Eckpunkte
errors-faces = Flächen
errors-triangles = Dreiecke
errors-strips = Dreiecksstreifen
errors-rows = Zeilen von { $name }
errors-points = Punkte
errors-cells = Zellen
errors-cell-types = Zelltypen

## Was eine Datei statt einer Oberfläche enthält. $number ist $count, ausgeschrieben.

errors-lines = { $count ->
    [one] { $count } Linie
   *[other] { $count } Linien
}
errors-so-many-points = { $count ->
    [one] { $count } Punkt
   *[other] { $count } Punkte
}
errors-vtk-solids = Gitter aus Volumenzellen
errors-vtk-no-kind = Datei ohne Typ

## Was eine Datei entpackt enthielte

errors-so-many-bytes = { $bytes } Byte
errors-too-many-bytes = mehr Byte, als es geben kann
errors-parts = { $parts } Teile
errors-vertices-triangles = { $vertices } Eckpunkte und { $triangles } Dreiecke

## Was nicht gelesen wird

errors-version = Version { $version }
errors-compressor = das Kompressionsverfahren { $name }
errors-lzma = LZMA mit einem Wörterbuch von { $bytes } Byte
errors-gltf-whole-positions = Positionen aus ganzen 32-Bit-Zahlen
errors-extension = { $name }

## Was in einer Datei falsch ist: hinter einem Gedankenstrich, vor einem Punkt. Wörter der Datei stehen schon in Anführungszeichen.

errors-no-number = { $word } steht, wo eine Zahl stehen sollte
errors-no-coordinate = { $word } steht, wo eine Koordinate stehen sollte
errors-no-vertex = { $word } steht, wo die Nummer eines Eckpunkts stehen sollte
errors-no-count = { $word } ist keine Anzahl
errors-no-type = { $word } ist kein Zahlentyp
errors-no-text = sie sollte ein Text sein, ist aber keiner
errors-at-byte = { $problem } (bei Byte { $byte })

errors-stl-no-facet = sie ist ein Text ohne ein einziges „facet“
errors-stl-ends = die Datei endet mitten in einem Dreieck

errors-obj-vertex = ein Eckpunkt braucht drei Koordinaten

errors-ply-begin = sie beginnt nicht mit dem Wort „ply“
errors-ply-end = in ihrem Kopf fehlt „end_header“
errors-ply-encoding = die Kodierung { $word } ist nicht bekannt
errors-ply-no-encoding = ihr Kopf nennt keine Kodierung
errors-ply-property-first = eine Eigenschaft steht vor dem ersten Element
errors-ply-property = eine Eigenschaft braucht einen Typ und einen Namen
errors-ply-no-xyz = ihren Eckpunkten fehlen x, y und z
errors-ply-list = eine Liste hat die Länge { $length }

errors-gltf-no-json = ihr fehlt der JSON-Teil
errors-gltf-json = ihr JSON ist falsch oder unvollständig, in Zeile { $line }, Spalte { $column }
errors-gltf-no-scene = ihre Szene fehlt
errors-gltf-no-node = Knoten { $node } fehlt
errors-gltf-node-twice = Knoten { $node } hängt an zwei anderen oder an sich selbst
errors-gltf-no-mesh = Netz { $mesh } fehlt
errors-gltf-mode = ein Netz hat einen Zeichenmodus, den es nicht gibt
errors-gltf-base64 = ihre Base64-Daten sind beschädigt
errors-gltf-no-accessor = Accessor { $accessor } fehlt
errors-gltf-accessor-type = Accessor { $accessor } hat einen Typ, den es nicht gibt
errors-gltf-accessor-shape = Accessor { $accessor } hat nicht die Form, die seine Verwendung verlangt
errors-gltf-accessor-empty = Accessor { $accessor } hat keine Daten
errors-gltf-accessor-beyond = Accessor { $accessor } liegt hinter dem Ende der Daten
errors-gltf-accessor-overlap = Accessor { $accessor } hat Einträge, die sich überschneiden
errors-gltf-packed = ihre gepackte Ansicht { $view } ist beschädigt oder von einer Art, die nicht gelesen wird
errors-gltf-skin = Skin { $skin } passt nicht zur Szene oder zu dem Netz, das er bewegt
errors-gltf-indices = die Nummern ihrer Eckpunkte sind keine ganzen Zahlen ohne Vorzeichen

errors-vtk-xml = ihr XML ist dort falsch oder unvollständig
errors-vtk-no-file = ihr fehlt das Element „VTKFile“
errors-vtk-no-arrays = „{ $element }“ hat keine Felder
errors-vtk-no-points = ein Stück hat keine Punkte
errors-vtk-fractions = ihre Zellen sind mit Brüchen nummeriert
errors-vtk-beyond = ein Feld liegt hinter dem Ende der Datei
errors-vtk-underscore = ihre angehängten Daten beginnen nicht mit einem Unterstrich
errors-vtk-no-place = ein Feld nennt nicht, wo seine Daten sind
errors-vtk-array-end = ein Feld geht über das Ende seiner Daten hinaus, oder diese sind beschädigt
errors-vtk-block = ein komprimierter Block ist beschädigt
errors-vtk-cell = Zelle { $cell } hat die Länge { $length }
errors-vtk-third-line = in ihrer dritten Zeile steht weder „ASCII“ noch „BINARY“
errors-vtk-no-part = { $word } ist kein Teil einer Oberfläche
errors-vtk-no-types = ihre Zellen haben keine Typen
errors-vtk-cells-lack = { $name } ihrer Zellen fehlt
errors-vtk-ends-count = sie endet, wo eine Anzahl stehen sollte
errors-vtk-ends-type = sie endet, wo ein Typ stehen sollte
errors-vtk-field-type = ein Abschnitt „FIELD“ hat Werte eines unbekannten Typs

## Was zu einer geöffneten Datei gesagt wird. $number ist $count, ausgeschrieben.

errors-stl-trailing = { $bytes } Byte nach dem letzten Dreieck weggelassen.
errors-stl-count = Die Zahl der Dreiecke, die die Datei ankündigt ({ $announced }), passt nicht zu ihrer Länge: { $found } gelesen.
errors-stl-fewer = Die Zahl der Dreiecke, die die Datei ankündigt ({ $announced }), passt nicht zu ihrer Länge: { $found } gelesen. Die Datei ist vielleicht abgeschnitten.
errors-stl-open = Die Datei ist vielleicht abgeschnitten: Ihr letzter Körper hat kein Ende.
errors-ply-trailing = { $bytes } Byte nach dem letzten Element weggelassen.
errors-ply-unannounced = Zahlen, die der Kopf der Datei nicht ankündigt, wurden weggelassen.
errors-ply-more-numbers = Zahlen nach dem letzten Element wurden weggelassen.
errors-vtk-solids-left-out = { $cells } Volumen- oder gekrümmte Zellen weggelassen: Lumen zeigt Oberflächen.
errors-vtk-curved = { $count ->
    [one] { $count } gekrümmte Fläche als eben gelesen: Nur ihre Ecken werden behalten.
   *[other] { $count } gekrümmte Flächen als eben gelesen: Nur ihre Ecken werden behalten.
}
errors-gltf-instances = Kopien von Netzen (EXT_mesh_gpu_instancing) weggelassen: Jedes wird einmal gelesen.
errors-gltf-morphs = Morph-Ziele weggelassen: Netze werden in ihrer Grundform gelesen.
errors-fanned = { $count ->
    [one] { $count } Vieleck konnte nicht ohne Falten in Dreiecke zerlegt werden, da es keine Fläche hat oder sich selbst schneidet.
   *[other] { $count } Vielecke konnten nicht ohne Falten in Dreiecke zerlegt werden, da sie keine Fläche haben oder sich selbst schneiden.
}
errors-degenerate = { $count ->
    [one] { $count } Dreieck mit wiederholtem Eckpunkt verworfen.
   *[other] { $count } Dreiecke mit wiederholtem Eckpunkt verworfen.
}
errors-duplicate = { $count ->
    [one] { $count } Dreieck doppelt vorhanden; behalten.
   *[other] { $count } Dreiecke doppelt vorhanden; behalten.
}
errors-short-faces = { $count ->
    [one] { $count } Fläche mit weniger als drei Ecken weggelassen.
   *[other] { $count } Flächen mit weniger als drei Ecken weggelassen.
}
errors-lines-left-out = { $count ->
    [one] { $count } Linie weggelassen: Lumen zeigt Oberflächen.
   *[other] { $count } Linien weggelassen: Lumen zeigt Oberflächen.
}
errors-points-left-out = { $count ->
    [one] { $count } Punkt weggelassen: Lumen zeigt Oberflächen.
   *[other] { $count } Punkte weggelassen: Lumen zeigt Oberflächen.
}
errors-reoriented = { $count ->
    [one] { $count } Dreieck umgedreht, damit es zu seinen Nachbarn passt.
   *[other] { $count } Dreiecke umgedreht, damit sie zu ihren Nachbarn passen.
}
errors-turned = { $count ->
    [one] { $count } Stück mit der Innenseite nach außen gefunden und gewendet.
   *[other] { $count } Stücke mit der Innenseite nach außen gefunden und gewendet.
}
errors-non-manifold = { $count ->
    [one] { $count } Kante, an der sich mehr als zwei Dreiecke treffen; wie in der Datei belassen.
   *[other] { $count } Kanten, an denen sich mehr als zwei Dreiecke treffen; wie in der Datei belassen.
}
errors-no-inside = Die Oberfläche hat kein Innen und Außen (ihre Dreiecke lassen sich nicht einheitlich ausrichten).
errors-moved = Die Oberfläche liegt weit vom Ursprung ihrer Koordinaten: Sie wurde um ({ $x }; { $y }; { $z }) mm verschoben, damit keine Details verloren gehen, und wird dort gespeichert.
errors-unit-by-size = Die Zahlen der Datei wurden nach der Größe der Oberfläche in { $unit } gelesen.
errors-size = Die Oberfläche misst von Ecke zu Ecke { $across } mm, was für Gefäße ungewöhnlich ist: bitte die Längeneinheit prüfen.
errors-size-units = Die Oberfläche misst von Ecke zu Ecke { $across } mm, was für Gefäße ungewöhnlich ist: Ihre Zahlen sind vielleicht in { $units } angegeben.
errors-size-small = Die Oberfläche misst von Ecke zu Ecke { $across } mm: ein Stück kleiner Gefäße, oder ihre Zahlen sind in { $units } angegeben.
errors-calibre-units = Ihre Gefäße sind im Mittel { $wide } mm weit, was ungewöhnlich ist: Die Zahlen der Datei sind vielleicht in { $units } angegeben.
errors-size-or = { $first } oder in { $next }
errors-size-in = { $unit } ({ $length } mm)

## Felder, die weggelassen werden

errors-array-left-out = Das Feld { $name } wird weggelassen: { $why }.
errors-arrays-more = { $count ->
    [one] { $count } weiteres Feld wird weggelassen.
   *[other] { $count } weitere Felder werden weggelassen.
}
errors-array-parts = Seine Teile passen nicht zusammen
errors-array-beyond = Gelesen werden nur die ersten { $most } Felder einer Datei
errors-array-not-everywhere = Nicht jeder Teil der Datei hat es
errors-array-damaged = Seine Daten sind beschädigt oder anderswo
errors-array-matrices = Es enthält Matrizen
errors-array-other-length = Es hat eine andere Länge als die Oberfläche
errors-array-memory = Es bräuchte mehr Speicher, als einer Datei dieser Größe gegeben wird
errors-array-cut-short = Es ist abgeschnitten
errors-array-no-number = Es enthält etwas, das keine Zahl ist
errors-array-text = Es enthält Text
errors-array-type = Seine Zahlen sind von einem Typ, der nicht gelesen wird
errors-array-too-many = Seine Daten sind beschädigt oder zu viele für eine Datei dieser Größe
errors-array-of-type = Es enthält Werte vom Typ { $kind }
errors-array-not-understood = Weder das Feld noch das, was darauf folgt, wird verstanden

## Dateien, die nicht oder nicht ganz geschrieben werden

errors-nothing-to-save = Es gibt keine Oberfläche zum Speichern.
errors-triangle-refers = Dreieck { $triangle } verweist auf Eckpunkt { $index }, es gibt aber { $vertices } Eckpunkte.
errors-not-finite = Eckpunkt { $vertex } hat eine Position oder eine Normale, die keine endliche Zahl ist.
errors-normal-count = Es gibt { $normals } Normalen für { $vertices } Eckpunkte.
errors-array-length = Das Feld „{ $name }“ hat { $tuples } Tupel für { $rows } Eckpunkte oder Dreiecke.
errors-format-too-large = Die Oberfläche ist zu groß für eine { $format }-Datei: Sie bräuchte { $bytes } Byte.
errors-no-place-arrays = { $count ->
    [one] { $format } hat keinen Platz für Felder: { $names } wird weggelassen.
   *[other] { $format } hat keinen Platz für Felder: { $names } werden weggelassen.
}
errors-no-place-triangles = { $count ->
    [one] { $format } hat keinen Platz für Felder von Dreiecken: { $names } wird weggelassen.
   *[other] { $format } hat keinen Platz für Felder von Dreiecken: { $names } werden weggelassen.
}
errors-no-place-colour = { $count ->
    [one] { $format } hat keinen Platz für Felder außer einer Farbe: { $names } wird weggelassen.
   *[other] { $format } hat keinen Platz für Felder außer einer Farbe: { $names } werden weggelassen.
}
errors-no-place-such = { $count ->
    [one] { $format } hat keinen Platz für solche Felder: { $names } wird weggelassen.
   *[other] { $format } hat keinen Platz für solche Felder: { $names } werden weggelassen.
}
errors-not-carried = Die Felder der Datei fehlen, weil sie nicht auf diese Stufe übertragen sind: bitte noch einmal speichern.
errors-no-result = Es gibt noch kein Ergebnis
errors-not-measured = Die Gefäße werden noch gemessen

## Einheiten und Achsen

errors-unknown-unit = „{ $word }“ ist keine Längeneinheit, die Lumen kennt: mm, cm oder m.
errors-axes = Wohin die Achsen der Oberfläche zeigen, ist nicht bekannt; sie kann daher nicht von { $from } nach { $to } gedreht werden.
errors-axes-lps = LPS
errors-axes-ras = RAS
errors-axes-unknown = unbekannten Achsen

## Einstellungen, mit denen kein Schritt arbeiten kann: auch hinter einem Doppelpunkt

errors-pass-band = Das Durchlassband muss zwischen 0,001 und 2 liegen, nicht bei { $value }
errors-iterations = Die Anzahl der Iterationen muss zwischen 0 und 200 liegen, nicht bei { $value }
errors-feature-angle = Der Kantenwinkel muss zwischen 0 und 180 Grad liegen, nicht bei { $value }
errors-tolerance = Die Toleranz muss zwischen 0 und 100 % liegen, nicht bei { $value } %
errors-reduction = Die Reduktionsrate muss zwischen 0 und 99,9 % liegen, nicht bei { $value } %
errors-deviation = Die größte Abweichung muss zwischen 0,001 und 1000 mm liegen, nicht bei { $value } mm
errors-weld = Die Toleranz beim Verschweißen muss zwischen 0,000001 und 100 mm liegen, nicht bei { $value } mm
errors-fill = Die Größe zu füllender Löcher muss zwischen 0,001 und 1000 mm liegen, nicht bei { $value } mm
errors-no-component = Es gibt keine Komponente { $wanted }: Die Oberfläche hat { $count }

## Was nach der Reparatur blieb

errors-weld-limited = An { $vertices } Eckpunkten an offenen Kanten wurde weniger als { $mm } mm verschweißt: Ihre Dreiecke sind ebenso klein.
errors-wall-not-parted = Das Lumen wurde nicht genommen: Die Seiten der Wand lassen sich nicht unterscheiden.
errors-no-wall = Die Oberfläche ist keine Wand mit zwei Seiten: Sie wird genommen, wie sie ist.
errors-holes-left = { $count ->
    [one] { $count } Loch innerhalb der Grenze konnte nicht gefüllt werden, ohne die Oberfläche zu schneiden.
   *[other] { $count } Löcher innerhalb der Grenze konnten nicht gefüllt werden, ohne die Oberfläche zu schneiden.
}

## Nachrichten zwischen den Teilen von Lumen

errors-message = Die Nachricht wird nicht verstanden: { $error }
errors-message-missing = Puffer { $index } der Nachricht fehlt
errors-message-buffer = Puffer { $index } der Nachricht hat { $bytes } Byte, kein Vielfaches von { $element }
errors-message-memory = Für ihre { $bytes } Byte ist kein Speicher mehr da
errors-message-text = Puffer { $index } der Nachricht ist kein Text

## Beispiele, die nicht erzeugt werden können

errors-sample-range = { $asked } Dreiecke liegen außerhalb des Bereichs von { $least } bis { $most }
errors-sample-grid = Kein Gitter ergibt { $asked } Dreiecke auf 1 % genau; das nächste ergibt { $nearest }
errors-cancelled = Abgebrochen
