### Das Urteil über ein Ergebnis über den Ansichten, was hilft, und was Seitenleiste, Befehlszeile und Berichte davon wiederholen.

## Der Streifen über den Ansichten

verdict-safe = Für Simulationen geeignet
verdict-kept = Erhalten, wo gemessen
verdict-none-measured = Kein Gefäß gemessen
# Eine Überschrift, und wie viel gemessen ist: "82 % der Länge, 28 von 33 Gefäßen".
verdict-covered = { $head }: { $coverage }
verdict-not-measured = Nicht gemessen
verdict-coming = Wird gemessen...
verdict-to-look-at = { $count ->
    [one] Ein Punkt zu prüfen
   *[other] { $count } Punkte zu prüfen
}
verdict-follows = Kaliber und Form folgen.
# Beside "Being measured..." while a level is shown that a finer one may follow.
verdict-auto-follows = Es wird bestimmt, wie weit es sicher ist: die Reduktion geht vielleicht noch zurück.
verdict-stopped = Es wurde abgebrochen, oder die Berechnung ist abgestürzt: zum Fortfahren eine Einstellung ändern.
# $text is what is said of the surface, a sentence: that it is a sample.
verdict-sample = Beispiel: { $text }
verdict-what-to-do = Abhilfe
verdict-findings = Einzelheiten
verdict-list-grave = Zu prüfen
verdict-list-notes = Hinweise
verdict-notes = { $count ->
    [one] { $count } Hinweis
   *[other] { $count } Hinweise
}
verdict-show-vessels = Gefäße zeigen
verdict-show-vessels-help = Was aus jedem wurde, und wo (V)
verdict-show-unmeasured = Ungemessenes
verdict-show-unmeasured-help = Öffnet die Gefäße und geht dorthin, wo nicht gemessen ist; die Oberfläche ist dort grau. Ein grünes Urteil braucht mindestens { $percent } % gemessene Länge abseits der Gabelungen und die Hälfte der Gefäße.
verdict-enough = Sicher heißt es, wo mindestens { $percent } % der Länge abseits der Gabelungen gemessen sind und die Hälfte der Gefäße.
verdict-remedy-help = Würde helfen; kann rückgängig gemacht werden
verdict-show-place = Zeigen
verdict-show-place-help = Geht dorthin, wo es ist

## Was helfen würde: auf Schaltflächen

verdict-reduce-to = Auf { $percent } % reduzieren
verdict-read-in = In { $unit } lesen
verdict-take-lumen = Lumen nehmen
verdict-all-pieces = Alle Stücke
# Shows the pieces that are left out, which can be chosen in the view.
verdict-choose-pieces = Stücke wählen
verdict-choose-pieces-help = Zeigt, was weggelassen ist; ein Klick auf ein Stück behält dieses, mit Umschalt oder Strg neben den anderen
verdict-fill = Füllen
verdict-split = Trennen
verdict-no-crossings = Ohne Schnitte
verdict-hold-caps = Deckel halten

## Befunde zur Datei

verdict-wall = Die Oberfläche ist eine Wand mit zwei Seiten, { $thickness } mm dick.
verdict-holes = { $count ->
    [one] Die Wand hat ein Loch von { $diameter } mm.
   *[other] Die Wand hat { $count } Löcher, das größte von { $diameter } mm.
}
verdict-crowded = { $count ->
    [one] An { $count } Kante oder Punkt treffen sich Oberflächen, die getrennt sein sollten.
   *[other] An { $count } Kanten und Punkten treffen sich Oberflächen, die getrennt sein sollten.
}
# $percent of the area, in so many other pieces.
verdict-left-out = { $pieces ->
    [one] { $percent } % der Oberfläche sind weggelassen: ein anderes Stück.
   *[other] { $percent } % der Oberfläche sind weggelassen: { $pieces } andere Stücke.
}

## Befunde zu eingeschnürten Gefäßen

verdict-pinched-first = Ein Gefäß von { $before } mm ist eingeschnürt, erstmals bei { $percent } %.
verdict-lost-first = Ein Gefäß von { $before } mm ist verloren, erstmals bei { $percent } %.
verdict-pinched-at-first = Ein Gefäß von { $before } mm ist bei ({ $x }; { $y }; { $z }) eingeschnürt, erstmals bei { $percent } %
verdict-lost-at-first = Ein Gefäß von { $before } mm ist bei ({ $x }; { $y }; { $z }) verloren, erstmals bei { $percent } %
verdict-pinched-to = Ein Gefäß von { $before } mm ist bei ({ $x }; { $y }; { $z }) auf { $after } mm eingeschnürt.
verdict-lost-at = Ein Gefäß von { $before } mm ist bei ({ $x }; { $y }; { $z }) verloren.
verdict-worst-of = { $sentence } Es ist die schlimmste von { $count } Stellen.

## Befunde zu Glättung, Volumen und Dreiecken

verdict-all-but-shut = Ein Gefäß ist bei ({ $x }; { $y }; { $z }) fast verschlossen: { $diameter } mm sind davon übrig.
verdict-drawn-shut = Die Glättung hat ein Gefäß bei ({ $x }; { $y }; { $z }) zugezogen: Sie entfernt Wellen unter { $wave } mm, dem Umfang eines Gefäßes von { $around } mm. Ein breiteres Durchlassband hält dünne Gefäße offen.
verdict-volume-changed = Das Volumen hat sich um { $change } % geändert: { $cause }.
verdict-volume-narrow = Das Durchlassband ist zu schmal für so dünne Gefäße
verdict-volume-few = So wenige Dreiecke tragen diese Form nicht
verdict-volume-adapt = { $sentence } „Dem Kaliber anpassen“ (--smoothing auto) erhält es.
verdict-volume-put-back = Das Volumen ist nicht auf 0,01 % gehalten: Eckpunkte wurden zurückgesetzt, damit sich keine Dreiecke schneiden.
verdict-volume-none = Das Volumen konnte nicht gehalten werden, weil die Oberfläche keines einschließt: Sie ist wie ohne diese Vorgabe geglättet.
verdict-volume-thin = Das Volumen konnte nicht gehalten werden, weil so dünne Gefäße bei diesem Durchlassband reißen oder anschwellen würden: Die Oberfläche ist wie ohne diese Vorgabe geglättet.
verdict-crossing = { $count ->
    [one] { $count } Dreieck schneidet andere.
   *[other] { $count } Dreiecke schneiden andere.
}
verdict-crossing-before = { $count ->
    [one] { $count } Dreieck schneidet andere; vor der Reduktion waren es { $before }.
   *[other] { $count } Dreiecke schneiden andere; vor der Reduktion waren es { $before }.
}
verdict-caps-rounded = { $count ->
    [one] Ein Ein- oder Auslass ist nicht mehr eben.
   *[other] { $count } Ein- und Auslässe sind nicht mehr eben.
}
verdict-caps = { $count ->
    [one] Die Fläche eines Ein- oder Auslasses ändert sich um { $percent } %.
   *[other] Die Flächen von { $count } Ein- und Auslässen ändern sich, eine um { $percent } %.
}
verdict-narrower = Wie geöffnet ist { $name } über { $length } mm um { $percent } % enger als zu beiden Seiten: { $reference }.
verdict-wider = Wie geöffnet ist { $name } über { $length } mm um { $percent } % weiter als zu beiden Seiten: { $reference }.
verdict-few-iterations = Zu wenige Iterationen für dieses Durchlassband: Zum Glätten braucht es mehr.
verdict-not-smoothed = Nichts ist geglättet: Hat die Oberfläche die Stufen ihrer Aufnahme, sind sie noch da, und ein Draht bleibt an ihnen hängen.
verdict-shortfall-topology = Weiter als auf { $reached } Dreiecke lässt sich diese Oberfläche nicht reduzieren (gewünscht waren { $wanted }): Weiteres Entfernen würde ein offenes Ende schließen oder ein Gefäß einschnüren
verdict-shortfall-geometry = Weiter als auf { $reached } Dreiecke lässt sich diese Oberfläche nicht reduzieren (gewünscht waren { $wanted }): Weiteres Entfernen würde die Oberfläche auf sich selbst falten
verdict-shortfall-complex = Weiter als auf { $reached } Dreiecke lässt sich diese Oberfläche nicht reduzieren (gewünscht waren { $wanted }): Der Rest liegt an Kanten von mehr als zwei Dreiecken, die bleiben, wie sie sind

## Beschriftungen neben dem Ring um die Stelle eines Befunds

verdict-place-hole = Loch
verdict-place-here = Hier
verdict-place-narrowed = Eingeschnürt
verdict-place-narrower = { $percent } % enger
verdict-place-wider = { $percent } % weiter
verdict-place-pinched = eingeschnürt
verdict-place-lost = verloren
verdict-place-shut = Zugezogen
verdict-place-rounded = nicht mehr eben
verdict-place-cap = Fläche { $percent } %

## Wie weit eine Reduktion sicher ist: Sätze ohne Punkt

verdict-safe-past = Zu weit reduziert, als dass die gemessenen Gefäße ihr Kaliber behielten: { $triangles } Dreiecke sind übrig, sie behalten es bis { $kept }, bei { $rate } %. Versuchen Sie diese Rate: Ein Gefäß kann allein durch die Reduktion zu eng für den Draht sein.
verdict-safe-none-kept = Schon die Glättung ändert jedes messbare Gefäß
verdict-safe-none-measured = Kein Gefäß ist messbar
verdict-safe-changed = Bei { $rate } % ändert sich { $name } um { $by } %, bei ({ $x }; { $y }; { $z })
verdict-safe-unmeasured = Bei { $rate } % ist { $name } nicht mehr messbar
verdict-safe-uncovered = Bei { $rate } % sind nur noch { $percent } % der Länge der Gefäße messbar

## Der Filter

verdict-half-gain = k = { $k }: Wellen von { $length } mm
verdict-half-gain-alone = k = { $k }

## Wörter als Satz

verdict-sentence = { $words }.
