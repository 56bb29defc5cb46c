### Die offene Oberfläche neben einer anderen Datei, wer immer sie gemacht hat.

## Wo es beginnt: ein Eintrag eines Menüs, ein Knopf neben einem Hinweis

reference-open = Mit Datei vergleichen...
reference-open-help = Eine andere Datei als Referenz: wie weit die Oberfläche von ihr entfernt ist, und das Kaliber jedes Gefäßes auf beiden
reference-back = Zurück zu { $name }
reference-back-help = Der Vergleich mit dieser Datei
reference-take-next = Damit vergleichen
reference-take-next-help = Nimmt die nächste der Dateien als Referenz für diese

## Was verglichen wird, und wie: im Panel

reference-heading = Zwei Oberflächen
reference-close-help = Zurück zu den beiden Ansichten (Esc)
reference-reference = Referenz
reference-reference-help = Womit die Oberfläche verglichen wird; eine andere Datei kann hier abgelegt werden
reference-other = Andere...
reference-other-help = Mit einer anderen Datei vergleichen
reference-unit = Einheit:
reference-unit-help = Der Zahlen in der Datei der Referenz
reference-surface = Oberfläche:
reference-surface-help = Was beurteilt wird
reference-opened = wie geöffnet
reference-level = reduziert
# The name of the surface in the report.
reference-level-of = { $name }, reduziert
reference-mended = { $name }, repariert
reference-move = Bewegen:
reference-move-help = Ob die Oberfläche zuerst auf die Referenz bewegt wird
reference-still = nicht
reference-still-help = Beide, wo ihre Dateien sie haben
reference-axes = Achsen
reference-axes-help = Gedreht, wo eine Datei in LPS ist und die andere in RAS
reference-rigid = bestes Passen
reference-rigid-help = Gedreht und verschoben, wie die beiden am besten passen
reference-work = Vergleich mit der Referenz

## Was dabei herauskam

reference-coming = Die beiden werden verglichen...
reference-no-level = Es gibt noch keine reduzierte Oberfläche.
reference-again = Noch einmal vergleichen
reference-failed = Sie können nicht verglichen werden: { $why }.
reference-moved = Im Mittel um { $mm } mm bewegt, um { $degrees }° gedreht.
reference-fit = Nach dem Einpassen sind die nächsten vier Fünftel der Oberfläche { $mm } mm entfernt (RMS), vorher { $before } mm.
reference-apart = Sie liegen im Mittel { $mm } mm auseinander.
reference-bring-together = Zusammenbringen
reference-axes-differ = Eine ist in LPS, die andere in RAS: links und rechts liegen nicht auf derselben Seite.
reference-turn = Drehen
# Of the reference's file; $note is a sentence.
reference-note = Referenz: { $note }
reference-column-reference = Referenz
reference-column-surface = Oberfläche
reference-triangles = Dreiecke
reference-area = Fläche
reference-volume = Volumen
reference-mean = Abstand, Mittel
reference-rms = Abstand, RMS
reference-p95 = Abstand, 95 %
reference-distance-help = Zwischen den beiden, in beide Richtungen über Stichproben von jeder gemessen
reference-signed-help = Außen und innen in eigenen Farben, oder nur wie weit
reference-farthest-reference = Fernster der Referenz
reference-farthest-surface = Fernster der Oberfläche
reference-farthest-help = Wie weit ihr fernster Punkt von der anderen entfernt ist: kein Punkt ist weiter als { $most } mm, mit Sicherheit
reference-go = Dorthin
reference-go-long = Dorthin: { $what }
reference-no-vessels = Kaliber: { $why }.
reference-changed = { $all ->
    [one] Das Gefäß hat sich um mehr als { $tolerance } % geändert.
   *[other] { $changed } von { $all } Gefäßen haben sich um mehr als { $tolerance } % geändert.
}
reference-kept = Wo gemessen, auf { $tolerance } % erhalten.
reference-not-measured = Kein Gefäß kann gemessen werden.
reference-measured = Gemessen: { $percent } % der Länge.
reference-column-vessel = Gefäß
reference-column-vessel-help = Wie auf der Referenz nummeriert
reference-column-radius-help = Mittlerer Radius in mm, des Kreises gleicher Fläche
reference-column-change = Änderung
reference-column-change-help = Die größte Änderung des Radius gegenüber der Referenz
reference-column-verdict = Kaliber
reference-save-numbers = JSON speichern
reference-save-numbers-help = Alle Zahlen, wie lumen compare sie schreibt
reference-save-stations = CSV speichern
reference-save-stations-help = Fläche und Radius auf beiden an jeder Stelle jedes Gefäßes

## Over the pictures

reference-distance-title = Abstand von der anderen
reference-legend = Abstand
reference-legend-sides = Oberfläche außen rot, innen blau

## Warum zwei Oberflächen nicht verglichen werden können: nach einem Doppelpunkt, ein Punkt folgt

reference-axes-unknown = wohin die Achsen zeigen, sagt höchstens eine der Dateien
reference-no-area = eine der Oberflächen hat keine Fläche: es gibt nichts zu vergleichen
