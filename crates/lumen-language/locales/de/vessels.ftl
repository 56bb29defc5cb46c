### Die Gefäße: was Glättung und Reduktion aus dem Kaliber jedes einzelnen gemacht haben, in der App und in Berichten.

vessels-branch = Ast { $number }

## Was gespeichert werden kann

vessels-save-vtp = Zentrallinien (VTP)...
vessels-save-vtp-help = Für die Oberfläche wie geöffnet, mit dem Radius der einbeschriebenen Kugel; Felder benannt wie bei vmtk
vessels-save-csv = Zentrallinien (CSV)...
vessels-save-csv-help = Für die Oberfläche wie geöffnet, eine Zeile je Stelle
vessels-save-calibre = Kaliber (CSV)...
vessels-save-calibre-help = Fläche und Radius wie geöffnet, geglättet und reduziert, eine Zeile je Stelle

## Der Kopf der Gefäße unter den Ansichten

vessels-heading = Gefäße
vessels-coming = Die Gefäße werden gemessen...
vessels-newer = Neuere Zahlen sind unterwegs.
vessels-allowed = Zulässige Änderung
vessels-allowed-help = Des Radius jedes Gefäßes gegenüber der Oberfläche wie geöffnet
vessels-colour = Oberfläche färben
vessels-colour-help = Wie viel weiter oder enger jedes Gefäß ist als beim Öffnen
vessels-copy = Kopieren
vessels-copy-help = Die Tabelle als Text, mit Tabulatoren zwischen den Spalten
vessels-save = CSV sichern
vessels-save-help = Fläche und Radius an jeder Stelle jedes Gefäßes
vessels-back = Zurück
vessels-close = Schließen

## Die Tabelle

vessels-column-vessel = Gefäß
vessels-column-vessel-help = Klicken zeigt den Radius entlang des Gefäßes und geht dorthin, wo es sich am meisten ändert
vessels-column-verdict = Urteil
vessels-column-verdict-help = Ob es nach der Reduktion sein Kaliber behält, im Rahmen der zulässigen Änderung
vessels-column-measured = Gemessen
vessels-column-measured-help = Der Teil seiner Länge, auf dem es gemessen ist: Anderswo sagt das Urteil nichts
vessels-column-reduced = Reduziert
vessels-column-reduced-help = Die größte Änderung seines Radius nach der Reduktion, gegenüber der Oberfläche wie geöffnet
vessels-column-smoothed = Geglättet
vessels-column-smoothed-help = Die größte Änderung seines Radius nach der Glättung, gegenüber der Oberfläche wie geöffnet
vessels-column-safe = Sicher bis
vessels-column-safe-help = Die Reduktion, bis zu der es nachweislich sein Kaliber behält
vessels-column-radius-help = Des flächengleichen Kreises, wie geöffnet: Mittelwert sowie kleinster bis größter Wert
vessels-column-uneven = Ungleich
vessels-column-uneven-help = Wo sein Durchmesser, wie geöffnet, am deutlichsten enger oder weiter ist als beiderseits davon, um mindestens ein Viertel; über welche Länge
vessels-column-length = Länge, mm
vessels-column-length-help = Entlang der Zentrallinie
vessels-column-tortuosity = Tortuosität
vessels-column-tortuosity-help = Länge geteilt durch den Abstand der Enden
vessels-verdict-kept = erhalten
vessels-verdict-changed = verändert
vessels-verdict-not-measured = nicht gemessen
vessels-spread = { $mean } ({ $least } bis { $largest })
vessels-narrower = { $percent } % enger
vessels-wider = { $percent } % weiter
vessels-narrower-over = { $percent } % enger über { $length } mm, bei { $at } mm
vessels-wider-over = { $percent } % weiter über { $length } mm, bei { $at } mm
vessels-uneven-both = { $narrower }; { $wider }
# Der Durchmesser, die Referenz, und an welchen Stellen entlang des Gefäßes sie gemessen ist.
vessels-reference-between = { $diameter } statt { $reference } mm, nach den Durchmessern bei { $from } und { $to } mm
vessels-reference-at = { $diameter } statt { $reference } mm, nach dem Durchmesser bei { $at } mm
vessels-reference = { $diameter } statt { $reference } mm
vessels-table = { $name }, zulässige Änderung { $tolerance } %
# Folgt darauf nach einem Komma.
vessels-table-measured = gemessen über { $coverage }

## Warum ein Gefäß nirgends gemessen ist

vessels-too-thin = Es ist weniger als zwei Kanten weit: zu grob für eine Aussage.
vessels-not-closed = Seine Querschnitte schließen sich nicht.
vessels-ambiguous = Seine Wand ist dort gefaltet: Ein Querschnitt hat mehr als einen Umriss, und welcher es ist, ändert sich mit der Oberfläche.
vessels-at-forks = Es ist zu kurz: Es liegt ganz an Gabelungen oder Enden.
vessels-at-ends = Es ist zu kurz: Es liegt ganz an Enden oder Gabelungen.

## Der Radius entlang eines Gefäßes

vessels-radius-head = Radius entlang von { $name }:
# Darüber: ein Abschnitt, der enger oder weiter ist als zu beiden Seiten, und womit er verglichen ist.
vessels-uneven = { $stretch }: { $reference }
# Die engste Stelle neben einer anderen, die gewählt wurde.
vessels-refer = Eigene Referenz
vessels-refer-help = Vergleicht die engste Stelle dieses Astes mit der gewählten Stelle, nach dem Durchmesser des flächengleichen Kreises: die Linie im Bild ziehen
vessels-refer-at = Referenz bei
vessels-refer-at-help = Ziehen, oder eine Stelle entlang des Astes eingeben
vessels-refer-reduced = Reduziert: { $percent } %
vessels-refers-here = Referenz { $diameter } mm
vessels-reference-line = Referenz
vessels-radius-along = Radius entlang von { $name }
vessels-as-opened = wie geöffnet
vessels-smoothed = geglättet
vessels-reduced = reduziert
vessels-dotted = gepunktet: ±{ $percent } %
vessels-no-section = Keiner seiner Querschnitte lässt sich messen.
vessels-along = Entlang des Gefäßes, mm
vessels-radius = Radius, mm
vessels-hover =
    { $surface }
    { $radius } mm bei { $at } mm
    Klicken, um dorthin zu gehen

## Was aus ihnen wurde

vessels-all-kept-short = erhalten, auf { $tolerance } %
# Wo zu wenig gemessen ist.
vessels-kept-short = erhalten über { $percent } %
vessels-some-changed-short = { $changed } von { $all } verändert
vessels-place = { $name }: { $percent } %
vessels-not-here = { $name }: hier nicht gemessen
vessels-none = Es gibt keine messbaren Gefäße: { $why }.
vessels-sentences = { $first } { $rest }
vessels-none-measured = Kein Gefäß lässt sich messen.
vessels-all-kept = { $count ->
    [one] Das Gefäß behält sein Kaliber auf { $tolerance } % genau.
   *[other] Alle { $count } Gefäße behalten ihr Kaliber auf { $tolerance } % genau.
}
vessels-kept-of = { $count ->
    [one] { $count } von { $all } Gefäßen wurde gemessen: Es behält sein Kaliber auf { $tolerance } % genau.
   *[other] { $count } von { $all } Gefäßen wurden gemessen: Sie behalten ihr Kaliber auf { $tolerance } % genau.
}
vessels-changed = { $changed ->
    [one] { $changed } von { $all } gemessenen Gefäßen ändert sich um mehr als { $tolerance } %.
   *[other] { $changed } von { $all } gemessenen Gefäßen ändern sich um mehr als { $tolerance } %.
}
vessels-changed-most = { $changed ->
    [one] { $changed } von { $all } gemessenen Gefäßen ändert sich um mehr als { $tolerance } %, am meisten { $name }: { $by } %.
   *[other] { $changed } von { $all } gemessenen Gefäßen ändern sich um mehr als { $tolerance } %, am meisten { $name }: { $by } %.
}
vessels-measured-over = Gemessen über { $percent } % der Länge; nicht über { $parts }.
# Nach einer Überschrift oder einem Doppelpunkt.
vessels-coverage = { $percent } % der Länge, { $measured } von { $all ->
    [one] { $all } Gefäß
   *[other] { $all } Gefäßen
}
# Teile der Länge, aufgezählt nach "nicht über".
vessels-parts = { $first }, { $rest }
vessels-part-ends = { $percent } % an Enden
vessels-part-forks = { $percent } % an Gabelungen
vessels-part-thin = { $percent } % zu grob
vessels-part-unclear = { $percent } % ohne genau einen geschlossenen Umriss
vessels-by-smoothing = Schon die Glättung verändert { $count } davon so stark.
vessels-unknown = { $count ->
    [one] Eines ist zu kurz oder zu grob für eine Messung.
   *[other] { $count } sind zu kurz oder zu grob für eine Messung.
}
vessels-open-ends = { $count ->
    [one] An einem offenen Ende wurde kein Gefäß gefunden.
   *[other] An { $count } offenen Enden wurde kein Gefäß gefunden.
}

## Warum es keine Gefäße gibt oder nichts gemessen wurde

vessels-error-no-triangles = Die Oberfläche hat keine Dreiecke
vessels-error-inside-out = Die Oberfläche ist umgestülpt: Ihre Dreiecke zeigen in das Gefäß hinein
vessels-error-no-inside = { $triangles ->
    [one] Die Oberfläche hat kein Inneres: Sie ist ein einziges Dreieck
   *[other] Die Oberfläche hat kein Inneres: Von ihren { $triangles } Dreiecken liegt keines einem anderen gegenüber
}
vessels-error-sheet = Das Innere der Oberfläche ist eine dünne Schicht und kein Gefäß: Es braucht mehr als { $balls } Kugeln, um sie zu füllen; vielleicht ist sie die Wand eines Gefäßes, mit einer inneren und einer äußeren Seite
vessels-error-unit = Das weiteste Gefäß misst { $diameter } mm: Die Oberfläche ist wahrscheinlich nicht in der Einheit, in der sie geöffnet wurde
vessels-error-no-centreline = Es gibt keine Zentrallinie, zu der er senkrecht sein könnte
vessels-error-not-closed = Die Wand ist dort um die Zentrallinie nicht geschlossen: Die Oberfläche ist in dieser Ebene offen oder gefaltet
vessels-error-no-fork = Kein Gefäß teilt sich: Ein Winkel lässt sich zwischen drei Stellen messen
vessels-error-short = Ein Ast dieser Gabelung ist zu kurz für eine eigene Richtung
