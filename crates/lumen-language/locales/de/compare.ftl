### Der Vergleich: bis zu sechs Einstellungen einer Oberfläche nebeneinander, und die Abbildungen davon.

## Anordnung der Bilder

compare-shaded = Schattiert
compare-shaded-help = Die Oberflächen
compare-wireframe = Drahtgitter
compare-wireframe-help = Ihre Kanten
compare-both = Beides
compare-both-help = Kanten auf der Oberfläche
compare-stacked = Gestapelt
compare-stacked-help = Die Oberfläche über ihren Kanten

## Die Leiste über dem Raster

compare-add = Aktuelle dazu
compare-add-short = Dazu
compare-add-long = Aktuelle Einstellungen hinzufügen
compare-add-help = Auch die aktuellen Einstellungen vergleichen
compare-full = Höchstens sechs werden verglichen: erst eine entfernen
compare-there-already = Die aktuellen Einstellungen werden schon verglichen
compare-figure-6 = Abb. 6
compare-figure-6-help = Die sechs Glättungen aus Abbildung 6 der Veröffentlichung
compare-figure-7 = Abb. 7
compare-figure-7-help = Die drei Reduktionsraten aus Abbildung 7 der Veröffentlichung
compare-show-as = Darstellung
compare-first = Erste
compare-first-help = Gedrückt halten, um in jeder Zelle die ersten Einstellungen zu sehen, und loslassen: Was sich bewegt, ist der Unterschied (oder X halten)
compare-difference = Unterschied zu A
compare-difference-help = Färbt, wie weit jede Oberfläche von A, der ersten, entfernt ist, in mm
compare-most = Größter Unterschied
compare-most-help = Geht dorthin, wo eine Oberfläche am weitesten von A entfernt ist; Ausschnitt einige Gefäßdurchmesser hoch
compare-whole = Ganzes Gefäß
compare-whole-help = Die ganze Oberfläche (F)
# A menu with what a phone has no room for.
compare-more = Mehr
compare-more-help = Wie die Bilder stehen, der Unterschied, ein Bild für eine Datei
compare-done = Fertig
compare-done-help = Zurück zu den zwei Ansichten (C)

## Was verglichen wird

compare-heading = Einstellungen im Vergleich
compare-heading-smoothing = Mehr und weniger Glättung
compare-heading-triangles = Immer weniger Dreiecke
compare-paper-figure-6 = Abbildung 6 der Veröffentlichung
compare-paper-figure-7 = Abbildung 7 der Veröffentlichung
compare-paper-rates = Raten aus Abbildung 7 der Veröffentlichung, geglättet wie eingestellt
compare-nothing = Noch wird nichts verglichen: die aktuellen Einstellungen hinzufügen oder die einer Abbildung der Veröffentlichung nehmen.
compare-slow = mehr als { $count } Dreiecke je Zelle: Das Drehen kann stocken

## Farben des Unterschieds

compare-distance-coming = Der Abstand von A wird gemessen.
compare-distance-unknown = Der Abstand von A ist nicht bekannt.
compare-distance-from = Abstand von A, lokales Mittel: 0 mm
compare-distance-to = { $most } mm und mehr

## Eine Zelle

compare-reference = A: die Referenz
compare-from-a = Von A: im Mittel { $mean } mm, höchstens { $most } mm
compare-no-area = Keine Fläche zu messen
compare-first-settings = Die ersten Einstellungen
compare-waiting = Wartet auf die Berechnung
compare-try-again = Noch einmal
compare-remove = { $title } entfernen
compare-remove-help = Nicht mehr vergleichen
compare-not-drawn = Die Oberfläche kann nicht gezeichnet werden: { $why }.
compare-no-device = Es gibt kein Grafikgerät, mit dem gezeichnet werden könnte.

## Eine Einstellung in Worten

compare-not-smoothed = nicht geglättet
compare-pass-band = Durchlassband { $value }
compare-iterations = { $value ->
    [one] 1 Iteration
   *[other] { $value } Iterationen
}
compare-window = { $value }-Fenster
compare-boundary = Regel { $value } an offenen Enden
compare-volume-preserved = Volumen erhalten
compare-suits = zur Oberfläche passend
compare-adapted = dem Kaliber angepasst
compare-no-crossing = ohne Schnitte
compare-caps-held = Deckel gehalten
compare-method = Verfahren { $value }
compare-feature-angle = Kantenwinkel { $value }°
compare-thin-spared = dünne Gefäße geschont
compare-labels-kept = Labelgrenzen gehalten
compare-not-reduced = nicht reduziert
compare-auto = automatische Reduktion
compare-reduction = Reduktion { $percent } %
compare-triangles-wanted = { $count ->
    [one] 1 Dreieck gewünscht
   *[other] { $count } Dreiecke gewünscht
}
compare-deviation-up-to = Abweichung bis { $most } mm

## Die Zahlen einer Zelle

compare-triangles = Dreiecke
compare-triangles-help = Nach der Reduktion
compare-removed = Entfernt
compare-removed-help = Der Teil der behaltenen Dreiecke, der weggefallen ist
compare-volume = Volumen
compare-volume-help = Änderung gegenüber den behaltenen Stücken wie geöffnet, offene Enden verschlossen
compare-deviation = Abweichung
compare-deviation-unit = Mittel / Max., mm
compare-from-smoothed = Von geglättet
compare-from-smoothed-help = Abweichung von der geglätteten Oberfläche in mm, Mittel und Maximum, in beiden Richtungen gemessen
compare-from-original = Vom Original
compare-from-original-help = Abweichung von den behaltenen Stücken wie geöffnet in mm, Mittel und Maximum, in beiden Richtungen gemessen

## Unter einer Abbildung

compare-figure-legend = Abweichung: Abstand zweier Oberflächen, in beiden Richtungen an je { $samples } Stellen gemessen; geglättet: die Oberfläche vor der Reduktion, Original: vor der Glättung. Volumen: Änderung gegenüber dem Original, offene Enden verschlossen.

## Warum keine Abbildung gezeichnet werden kann

compare-error-device = es gibt kein Grafikgerät zum Zeichnen, auch nicht in Software: Ein Treiber für Vulkan oder OpenGL fehlt, etwa mesa-vulkan-drivers von Debian
compare-error-too-large = das Bild hätte { $width } × { $height } Pixel; dieses Grafikgerät zeichnet höchstens { $limit } je Richtung
