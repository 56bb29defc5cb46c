### Messen von Hand: die Werkzeuge, die Schnittebene und die Liste der Messungen.

## Das Feld

measure-title = Messen
measure-close = Schließen
measure-back = Zurück
measure-close-help = M, Esc
measure-no-surface = Es gibt noch keine Oberfläche.
measure-choose = Ein Werkzeug wählen, dann in einer der Ansichten auf die Oberfläche klicken.
# Where a finger points.
measure-choose-touch = Ein Werkzeug wählen, dann in einer Ansicht auf die Oberfläche tippen.
measure-hint = { $hint }. Eingabetaste: Mitte der Ansicht; Esc: fertig.

## Die Werkzeuge

measure-ruler = Strecke
measure-ruler-help = Gerader Abstand zweier Stellen der Oberfläche in mm
measure-diameter = Durchmesser
measure-diameter-help = Größte Kugel im Inneren, die die Wand an einer Stelle berührt: ihr Durchmesser in mm
measure-section = Schnitt
measure-section-help = Senkrecht zur Zentrallinie neben einer Stelle: Fläche in mm², kleinste und größte Breite und Durchmesser des flächengleichen Kreises in mm
measure-angle = Winkel
measure-angle-help = An der zweiten von drei Stellen, in Grad
measure-fork = Gabel
measure-fork-help = Zwischen zwei Ästen der nächsten Gabelung, wo jeder schon ein eigenes Gefäß ist, in Grad

## Was der nächste Klick tut

measure-click-first = Erste Stelle auf der Oberfläche anklicken
measure-click-end = Das andere Ende anklicken
measure-click-vertex = Scheitel des Winkels anklicken
measure-click-last = Letzte Stelle anklicken
measure-point-wall = Auf die Wand zeigen, um den Durchmesser zu sehen; klicken, um ihn zu behalten
measure-click-vessel = Ein Gefäß anklicken
measure-click-branch = Einen Ast neben einer Gabelung anklicken
# The same by a finger.
measure-tap-first = Auf die erste Stelle der Oberfläche tippen
measure-tap-end = Auf das andere Ende tippen
measure-tap-vertex = Auf den Scheitel des Winkels tippen
measure-tap-last = Auf die letzte Stelle tippen
measure-tap-wall = Auf die Wand tippen, um ihren Durchmesser zu messen
measure-tap-vessel = Auf ein Gefäß tippen
measure-tap-branch = Auf einen Ast neben einer Gabelung tippen

## Warum nichts gemessen wurde

measure-same-places = Zwei der Stellen sind dieselbe.
measure-no-ball = Dieser Stelle liegt keine Wand gegenüber, daher passt keine Kugel dazwischen.
measure-no-section = Kein Querschnitt: { $why }.
measure-no-angle = Kein Winkel: { $why }.
measure-not-yet = Die Zentrallinien werden noch gesucht: gleich noch einmal versuchen.
measure-no-centreline = Es gibt keine Zentrallinie: { $why }.

## Die Schnittebene

measure-clip = Schnittebene
measure-clip-help = Lässt in beiden Ansichten weg, was auf einer Seite einer Ebene liegt; ihren Griff oder den Regler ziehen
measure-square-to = Senkrecht zu
measure-square-to-help = Eine Achse, die Blickrichtung oder die Zentrallinie eines Gefäßes, entlang derer sie sich bewegt
measure-lost-centreline = Diese Zentrallinie gibt es nicht mehr.
measure-position = Position
measure-position-help = Entlang der Achse oder der Zentrallinie, in mm
measure-flip = Umkehren
measure-flip-help = Die andere Seite weglassen
measure-clip-handle = Griff der Schnittebene
measure-across-axis = Quer zu { $axis }
measure-facing = Zum Betrachter
measure-centreline = Zentrallinie
measure-along = Entlang { $vessel }

## Die Liste

measure-none = Keine Messungen
measure-measures = Messungen
measure-in-views = In Ansichten
measure-in-views-help = Die Messungen in beide Ansichten einzeichnen
measure-kept = Sie bleiben bei der Oberfläche, solange diese offen ist, beim Rückgängigmachen, in einer Einstellungsdatei und im Bericht.
measure-name-help = Der Name: zum Ändern anklicken
measure-name-of = Name der Messung { $number }
measure-show = Zeigen
measure-show-help = Die Kamera geht dorthin
measure-show-named = { $name } zeigen
measure-delete = Löschen
measure-delete-named = { $name } löschen

## In den Ansichten

measure-mark = { $name }: { $value }
