### Der Schritt, der eine Stufe für einen Strömungs- oder Strukturlöser fertig macht.

solver-title = Für einen Löser
solver-does = Schneidet, verlängert und schließt die Enden der Stufe und macht ihre Dreiecke gleichmäßig, für Strömungs- und Strukturlöser.
solver-work = Die Oberfläche wird für einen Löser fertig gemacht

## Was getan wird

solver-wrap = Wasserdicht umhüllen
solver-wrap-help = Stattdessen eine geschlossene Oberfläche nahe an dieser: sich durchdringende, doppelte und innere Dreiecke und Spalten, die schmaler als die Toleranz sind, fallen weg
solver-wrap-mm = Toleranz
solver-uncross = Durchdringungen auflösen
solver-uncross-help = Dreiecke, die in andere ragen, werden auseinandergeschoben oder ausgeschnitten und neu geschlossen
solver-clip = Enden schneiden
solver-clip-help = Senkrecht zur Zentrallinie
solver-clip-none = wie sie sind
solver-clip-round = wo rund
solver-clip-distance = in einem Abstand
solver-clip-by = Abstand vom Ende
solver-extend = Enden verlängern
solver-extend-help = Ein gerades Rohr, das entlang der Wand abgeht und zu einem Kreis gleicher Fläche wird
solver-extend-by = Länge der Verlängerungen
solver-radii-help = In Radien des Gefäßes an seinem Ende
solver-radii = { " " }Radien
solver-cap = Enden schließen
solver-cap-help = Mit einem eigenen Teil für jedes Ende
solver-cap-none = offen lassen
solver-cap-planar = eben, gleichmäßig
solver-cap-fan = eben, als Fächer
solver-cap-smooth = als Kuppel
solver-remesh = Dreiecke neu bilden
solver-remesh-help = Fast gleichseitige Dreiecke, so groß, wie es zum Kaliber passt
solver-around = Kanten um ein Gefäß
solver-least = Kürzeste Kante
solver-largest = Längste Kante
solver-bound = Abweichung begrenzen
solver-bound-help = Kleinere Dreiecke, wo sich die Oberfläche krümmt
solver-bound-mm = Größte Abweichung
solver-prepare = Fertig machen
solver-prepare-help = Aus der gezeigten Stufe; sie selbst bleibt, wie sie ist
solver-show-level = Stufe zeigen
solver-show-made = Ergebnis zeigen

## Wo einzelne Enden geschnitten werden

solver-show-cuts = Schnitte zeigen
solver-show-cuts-help = Wo jedes Ende geschnitten wird und was wegfällt; dort lässt sich ein Schnitt verschieben
solver-cuts-help = Was abgeschnitten wird, ist farbig. Ziehen Sie einen Ring entlang seines Gefäßes, oder geben Sie seinen Abstand vom Ende ein.
solver-cut-end = Ende { $number }
solver-cut-distance = Abstand des Schnitts von Ende { $number }
solver-cut-not = Ende { $number } wird nicht geschnitten: { $why }.
solver-cuts-reset = Alle Enden gleich

## Was daraus wurde

solver-triangles = { $count ->
    [one] ein Dreieck
   *[other] { $count } Dreiecke
}
solver-failed = Die Stufe kann nicht fertig gemacht werden: { $why }.
solver-older = Aus einer anderen Stufe oder mit anderen Einstellungen als jetzt gemacht.
solver-ready = Nichts gefunden, was einen Volumenvernetzer aufhält.
solver-not-ready = Ein Volumenvernetzer nimmt sie so nicht:
solver-crossed = Sich durchdringende Dreiecke: { $before } vorher, { $after } übrig.
solver-result-triangles = Dreiecke
solver-quality = Mittlere Güte
solver-quality-help = 4√3 mal Fläche durch die Summe der quadrierten Seiten: 1 für gleichseitige Dreiecke
solver-below = Unter 30°
solver-below-help = Dreiecke mit einem kleineren Winkel
solver-deviation = Abweichung
solver-deviation-help = Der größte Abstand zwischen der Oberfläche vor und nach der Neubildung der Dreiecke
solver-go = Dorthin
solver-go-to = Dorthin: { $what }
solver-name = Name
solver-name-of = Name von { $name }
solver-id = Id
solver-area = mm²
solver-radius = r, mm
solver-names = Namen können geändert werden; Dateien enthalten sie.
solver-save = Für einen Löser speichern

## Was ein Volumenvernetzer beanstandet

check-empty = Die Oberfläche hat kein Dreieck.
check-broken = { $count ->
    [one] Ein Punkt oder Dreieck hat Zahlen, die nicht endlich oder außerhalb des Bereichs sind.
   *[other] { $count } Punkte oder Dreiecke haben Zahlen, die nicht endlich oder außerhalb des Bereichs sind.
}
check-open-rims = { $count ->
    [one] Die Oberfläche ist an einem Rand offen.
   *[other] Die Oberfläche ist an { $count } Rändern offen.
}
check-shared-edges = { $count ->
    [one] Eine Kante hat mehr als zwei Dreiecke.
   *[other] { $count } Kanten haben mehr als zwei Dreiecke.
}
check-duplicates = { $count ->
    [one] Ein Dreieck ist doppelt vorhanden.
   *[other] { $count } Dreiecke sind mehrfach vorhanden.
}
check-degenerate = { $count ->
    [one] Ein Dreieck hat keine Fläche.
   *[other] { $count } Dreiecke haben keine Fläche.
}
check-crossing = { $count ->
    [one] Ein Dreieck ragt in ein anderes oder berührt es.
   *[other] { $count } Dreiecke ragen in andere oder berühren sie.
}
check-folds = { $count ->
    [one] Die Oberfläche ist an einer Kante auf sich selbst gefaltet.
   *[other] Die Oberfläche ist an { $count } Kanten auf sich selbst gefaltet.
}
check-coincident = { $count ->
    [one] Ein Punkt liegt an der Stelle eines anderen und ist nicht mit ihm verbunden.
   *[other] { $count } Punkte liegen an der Stelle anderer und sind nicht mit ihnen verbunden.
}
check-windings = { $count ->
    [one] Die Dreiecke an einer Kante zeigen nach verschiedenen Seiten.
   *[other] Die Dreiecke an { $count } Kanten zeigen nach verschiedenen Seiten.
}
check-inside-out = { $count ->
    [one] Ein geschlossenes Stück zeigt nach innen.
   *[other] { $count } geschlossene Stücke zeigen nach innen.
}
check-slivers = { $count ->
    [one] Ein Dreieck hat einen Winkel unter 1 Grad: { $least_degrees } Grad.
   *[other] { $count } Dreiecke haben einen Winkel unter 1 Grad; der kleinste misst { $least_degrees } Grad.
}
check-pieces = { $count ->
    [one] Die Oberfläche ist ein Stück.
   *[other] Die Oberfläche besteht aus { $count } Stücken.
}

## Was anders getan wurde als gewünscht

solver-note-left-out = { $others ->
    [one] Ein kleineres Stück ist weggelassen.
   *[other] { $others } kleinere Stücke sind weggelassen.
}
solver-note-lumen = Die Oberfläche ist eine { $thickness_mm } mm dicke Wand: ihre Innenseite ist genommen.
solver-note-not-cut = Das Ende bei ({ $at }) ist nicht geschnitten: { $why }.
solver-note-not-cut-many = { $count } Enden sind nicht geschnitten: { $why }. Sie liegen bei { $places }.
solver-note-no-end = Bei ({ $at }) endet kein Gefäß: dort wird nichts geschnitten.
solver-note-no-ends = Kein Ende zum Verlängern oder Schließen gefunden: zuerst die Enden schneiden.
solver-note-filled = { $count ->
    [one] Ein Loch in der Wand ist gefüllt.
   *[other] { $count } Löcher in der Wand sind gefüllt.
}
solver-note-wall = Die Öffnung bei ({ $at }) ist als Teil der Wand geschlossen: { $why }.
solver-note-wall-many = { $count } Öffnungen sind als Teil der Wand geschlossen: { $why }. Sie liegen bei { $places }.
solver-note-shorter = Die Verlängerung von { $name } ist nur { $mm } mm lang: weiter draußen träfe sie auf etwas.
solver-note-shorter-many = { $count } Verlängerungen sind nur { $least_mm } bis { $most_mm } mm lang, weiter draußen träfen sie auf etwas: { $names }.
solver-note-not-extended = { $name } ist nicht verlängert: { $why }.
solver-note-not-extended-many = { $count } Enden sind nicht verlängert: { $why }. Es sind { $names }.
solver-note-wrapped = Die Oberfläche ist umhüllt, höchstens { $deviation_mm } mm entfernt.
solver-note-wrap-lumen = Die Oberfläche ist eine { $thickness_mm } mm dicke Wand: umhüllt ist ihr Lumen.
solver-note-wrap-wall = Die Oberfläche ist eine { $thickness_mm } mm dicke Wand, deren Seiten sich nicht unterscheiden lassen: umhüllt ist die Wand, nicht ihr Lumen.
solver-note-wrap-hollow = Die Hülle reicht bei { $at } ins Gefäß: die Wand hat Spalten, die breiter als die Toleranz sind, und umhüllt ist die Wand. Versuchen Sie eine größere Toleranz.

## Warum

solver-why-fork = eine Gabelung ist zu nah: { $room_mm } mm sind frei
solver-why-forks = eine Gabelung ist zu nah: höchstens { $most_mm } mm sind frei
solver-why-not-round = das Gefäß ist dort nirgends rund
solver-why-no-section = die Oberfläche hat dort keinen geschlossenen Querschnitt
solver-why-open = der Querschnitt läuft in eine Öffnung
solver-why-coarse = die Dreiecke sind dort zu groß
solver-why-around = was dahinter liegt, führt außen herum auf die andere Seite
solver-why-other-end = ein anderes Ende würde abgeschnitten
solver-why-most = { $percent } % der Oberfläche würden abgeschnitten
solver-why-folded = sein Umriss ist gefaltet
solver-why-crossed = sein Umriss kreuzt sich selbst
solver-why-not-flat = sie liegt in keiner Ebene
solver-why-long = das ist zu lang für so kleine Dreiecke wie dort
solver-why-no-room = es ist kein Platz dafür
solver-why-fine = seine Kanten sind zu kurz für seine Fläche
solver-why-unsound = die Oberfläche ist dort nicht in Ordnung
solver-why-sac = es ist ein Sack, weiter als sein Hals
solver-why-spicule = es ist ein Stachel einer rauen Wand und kein Gefäß
solver-error-empty = die Oberfläche hat keine Dreiecke
solver-error-unsound = Zahlen der Oberfläche sind nicht endlich oder außerhalb des Bereichs
solver-error-tree = kein Ende zu finden: { $why }
solver-error-wall = sie ist eine { $thickness_mm } mm dicke Wand, deren Innenseite von ihrer Außenseite nicht zu unterscheiden ist
solver-error-cap = { $name } kann nicht geschlossen werden: { $why }
solver-error-mend = Kanten haben mehr als zwei Dreiecke, oder Dreiecke zeigen in entgegengesetzte Richtungen: die Oberfläche zuerst reparieren
solver-error-sizes = die gewünschten Längen ergeben keinen Sinn
solver-error-many = so kurze Kanten ergeben etwa { $about } Dreiecke, und höchstens { $most } werden gebildet
solver-error-wrap = eine Hülle innerhalb von { $tolerance_mm } mm würde zu groß: versuchen Sie { $least_mm } mm
solver-error-wrap-coarse = eine Hülle innerhalb von { $tolerance_mm } mm hätte nichts mehr von der Form der Oberfläche: versuchen Sie höchstens { $most_mm } mm
