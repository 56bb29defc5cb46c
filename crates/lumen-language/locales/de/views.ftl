### Was die beiden Ansichten, die Bilder und die Kollapse sagen: Titel, Legenden und was dort steht, wo nichts gezeichnet werden kann.

## Die Ansichten

views-shaded = Schattierte Ansicht
views-wireframe = Drahtgitteransicht
views-shaded-title = Schattiert
views-wireframe-title = Drahtgitter
views-as-opened = Wie geöffnet
views-now = Jetzt
views-laplacian = { $passes ->
    [one] { $passes } Laplace-Durchgang
   *[other] { $passes } Laplace-Durchgänge
}
views-divider = Trennlinie zwischen „wie geöffnet“ und „jetzt“
views-divider-other = Trennlinie zwischen „{ $before }“ und „jetzt“
views-divider-wireframe = Trennlinie im Drahtgitter
views-divider-wireframe-other = Trennlinie im Drahtgitter zwischen „{ $before }“ und „jetzt“
views-idle = in Ruhe
views-rate = { $rate } fps
views-pinched = Eingeschnürt: vorher { $before } mm
views-lost = Verloren: vorher { $before } mm
views-axes-unknown = Achsen unbekannt

## Die Legende

views-calibre = Kaliberänderung
views-calibre-note = nicht gemessen
views-peak-force = Größte Kraft
views-legend-more = { $value } und mehr
views-legend-less = { $value } und weniger

## Wo etwas nicht gezeichnet werden kann

views-no-memory = Der Grafikspeicher ist voll, daher kann diese Oberfläche nicht gezeichnet werden; sie ist weiterhin geöffnet und kann weiter reduziert oder gespeichert werden.
views-no-device = Es gibt kein Grafikgerät, mit dem gezeichnet werden könnte.
views-failed = Die Ansichten können nicht gezeichnet werden: { $error }.
views-surface-failed = Die Oberfläche kann nicht gezeichnet werden: { $error }.
views-slices-failed = Die Schichten können nicht gezeichnet werden: { $error }.
views-not-drawn = Das Bild wurde nicht gezeichnet: { $error }.
views-too-large = { $what ->
    [triangles] ihre Dreiecke benötigen { $needed } MB Grafikspeicher am Stück, dieser Rechner gibt { $limit } MB; bitte weiter reduzieren
    [edges] ihre Kanten benötigen { $needed } MB Grafikspeicher am Stück, dieser Rechner gibt { $limit } MB; bitte weiter reduzieren
    [positions] ihre Positionen benötigen { $needed } MB Grafikspeicher am Stück, dieser Rechner gibt { $limit } MB
    [normals] ihre Normalen benötigen { $needed } MB Grafikspeicher am Stück, dieser Rechner gibt { $limit } MB
    [scalars] ihre Skalare benötigen { $needed } MB Grafikspeicher am Stück, dieser Rechner gibt { $limit } MB
   *[other] ihre Daten benötigen { $needed } MB Grafikspeicher am Stück, dieser Rechner gibt { $limit } MB
}
views-miscounted = { $what ->
    [normals] { $found } Normalen für { $expected } Knoten
    [scalars] { $found } Skalare für { $expected } Knoten
    [pixels] { $found } Bildpunkte statt { $expected }
   *[other] { $found } Werte für { $expected } Knoten
}
views-no-node = Knoten { $index } von { $nodes }
views-picture-kept = der Grafikprozessor hat das Bild nicht herausgegeben: { $error }
views-picture-lost = der Grafikprozessor ging verloren, bevor das Bild gelesen war

## Vor dem Öffnen einer großen Datei

views-large = { $name } hat etwa { $count } Dreiecke, wofür rund { $needed } GB Speicher nötig sein können; hier sind es { $limit }. Es wird versucht: Sollte es misslingen, bleibt offen, was offen war. Das Desktop-Programm hat diese Grenze nicht.

## Seiten, von denen eine Ansicht blicken kann

views-anterior = Anterior
views-posterior = Posterior
views-left = Links
views-right = Rechts
views-superior = Superior
views-inferior = Inferior
views-front = Vorn
views-rear = Hinten
views-left-side = Linke Seite
views-right-side = Rechte Seite
views-top = Oben
views-bottom = Unten

## Was eine Ansicht zeigt, für Hilfsmittel

# Folgen auf „von“.
views-side-left = links
views-side-right = rechts
views-side-front = vorn
views-side-back = hinten
views-side-above = oben
views-side-below = unten
views-side-axis = { $axis }
views-seen-laplacian = { $passes ->
    [one] { $name } nach { $passes } Laplace-Durchgang, von { $side }
   *[other] { $name } nach { $passes } Laplace-Durchgängen, von { $side }
}
views-seen-opened = { $count ->
    [one] { $name } wie geöffnet, von { $side }, { $count } Dreieck
   *[other] { $name } wie geöffnet, von { $side }, { $count } Dreiecke
}
views-seen = { $name } von { $side }
views-seen-triangles = { $count ->
    [one] { $count } Dreieck
   *[other] { $count } Dreiecke
}
views-seen-narrowest = engste Stelle { $diameter } mm
views-news = { $count ->
    [one] { $name }, { $count } Dreieck. { $verdict }
   *[other] { $name }, { $count } Dreiecke. { $verdict }
}

## Unter den Bildern eines Berichts

views-reduced = Geglättet und reduziert
views-triangles = Ihre Dreiecke
views-calibre-meaning = Kaliberänderung, { $from } % (dunkel) bis { $to } % (hell); grau: nicht gemessen
views-deviation-meaning = Abweichung, { $from } mm (dunkel) bis { $to } mm (hell)

## Klassen der Eckpunkte nach Schroeder

views-class-simple = Einfach
views-class-complex = Komplex
views-class-boundary = Rand
views-class-interior-edge = Innere Kante
views-class-corner = Ecke

## Die Kollapse, einer nach dem anderen

views-back = Zurück
views-back-help = Nimmt den letzten Kollaps zurück: ein oder zwei Dreiecke mehr
views-on = Weiter
views-on-help = Führt den nächsten Kollaps aus: ein oder zwei Dreiecke weniger
views-play = Abspielen
views-play-help = Einer nach dem anderen, langsam
views-follow = Jeden zeigen
views-follow-help = Die Kamera geht dorthin, wo der nächste ist
views-close = Schließen
views-close-help = Keine Kollapse mehr (Esc)
views-next-vertex = { $before ->
    [one] Als Nächstes, { $number } von { $all }: Ein Eckpunkt der Klasse „{ $class }“ geht in einem Nachbarn auf; aus { $before } Dreieck werden { $after }.
   *[other] Als Nächstes, { $number } von { $all }: Ein Eckpunkt der Klasse „{ $class }“ geht in einem Nachbarn auf; aus { $before } Dreiecken werden { $after }.
}
views-next-edge = { $before ->
    [one] Als Nächstes, { $number } von { $all }: Eine Kante wird zu einem Eckpunkt an eigener Stelle; aus { $before } Dreieck werden { $after }.
   *[other] Als Nächstes, { $number } von { $all }: Eine Kante wird zu einem Eckpunkt an eigener Stelle; aus { $before } Dreiecken werden { $after }.
}
views-next-error = Der Fehler beträgt { $cost } mm: der quadratische Mittelwert der Abstände von den Ebenen, für die er steht. Der größte bisher ist { $largest } mm.
views-next-error-line = Der Fehler beträgt { $cost } mm: der quadratische Mittelwert der Abstände von den Ebenen, für die er steht, oder der Abstand von seiner Linie, wo dieser größer ist. Der größte bisher ist { $largest } mm.
views-last-level = Dies ist die letzte Stufe: Kein Eckpunkt darf mehr wegfallen.
views-click-vertex = In einer Ansicht auf einen Eckpunkt klicken, um zu sehen, wohin er gehen darf.
views-click-vertex-touch = In einer Ansicht auf einen Eckpunkt tippen, um zu sehen, wohin er gehen darf.

## Wohin ein Eckpunkt gehen darf: Sätze, die hintereinander stehen

views-vertex = Eckpunkt der Klasse „{ $class }“.
views-stays-by-rule = Er bleibt laut Regel: Die Oberfläche ist dort keine Scheibe.
views-stays-crowded = Dort treffen sich zu viele Dreiecke: Er wartet auf seine Nachbarn.
views-goes-never = In diesem Lauf fällt er nie weg.
views-goes-at = { $count ->
    [one] In diesem Lauf fällt er bei { $count } Dreieck weg, mit einem Fehler von { $cost } mm.
   *[other] In diesem Lauf fällt er bei { $count } Dreiecken weg, mit einem Fehler von { $cost } mm.
}
views-ways = { $count ->
    [one] Weg zu seinem einen Nachbarn: { $ways }.
   *[other] Wege zu seinen { $count } Nachbarn: { $ways }.
}
views-way-open = { $count } offen
views-way-eased = { $count } offen, sobald die Form mehr leiden darf
views-way-off-line = { $count } abseits seiner Linie
views-way-link = { $count } gegen die Link-Bedingung: Die Topologie würde sich ändern
views-way-flip = { $count } gesperrt: Ein Dreieck würde umklappen
views-way-sliver = { $count } gesperrt: Ein Dreieck würde zum Splitter
views-unseen = Selbstschnitte werden hier nicht betrachtet.
views-unseen-quadric = Form und Selbstschnitte werden hier nicht betrachtet: Wohin er gesetzt würde, weiß nur der Lauf.
views-unseen-borders = Labelgrenzen ebenso wenig.
