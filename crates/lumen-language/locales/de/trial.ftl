### The guidewire trial: a virtual wire is fed through the vessel, by hand or by an autopilot. Its part of the panel, its
### three views, the tables of the paper, and what the engine says of a trial.

## The panel

trial-title = Versuch
trial-title-help = Steuert einen Führungsdraht durch die gezeigte Stufe.
trial-adapt = Glättung dem Kaliber anpassen und starten
trial-adapt-help = Glättet dünne Gefäße weniger, sodass sie so weit bleiben, wie sie sind; „Rückgängig“ nimmt es zurück
trial-start = Versuch starten
trial-tables = Tabellen III und IV
trial-tables-help = Der Versuch der Veröffentlichung bei mehreren Reduktionsraten
trial-restart-to-try = Neu starten, um Draht und Startwert zu versuchen, wie sie jetzt eingestellt sind.
trial-preparing = Der Versuch wird vorbereitet
trial-finding = Lumen und Weg werden gesucht...
trial-at-entry = Der Draht ist an der Einführstelle.
trial-none-on = Es läuft kein Versuch.
trial-awaits = Die Glättung wird angepasst: Der Versuch beginnt, sobald die neue Stufe da ist.

## Buttons. Letters in brackets are keys

trial-restart = Neustart
trial-restart-help = Von der Einführstelle aus (R)
trial-autopilot = Autopilot
trial-autopilot-help = Steuert von selbst; eine Hand am Draht übernimmt wieder (G)
trial-pause = Pause
trial-pause-help = Hält den Versuch an (P)
trial-slow = Zeitlupe
trial-slow-help = Mit einem Viertel der Geschwindigkeit (M)
trial-step-back = 1 s zurück
trial-step-back-help = Eine Sekunde zurück und anhalten (Z)
trial-close = Schließen
trial-close-help = Zurück zur Oberfläche (Esc)
trial-save-log = Protokoll speichern
trial-save-log-help = Messwerte als CSV und eine Zusammenfassung als JSON
trial-open-log = Protokoll öffnen...
trial-open-log-help = Spielt ein gespeichertes Protokoll (CSV) auf dieser Stufe nach

## What could not be done

trial-no-surface = Es gibt noch keine Oberfläche, durch die ein Draht gesteuert werden könnte.
trial-computation-stopped = Die Berechnung ist abgestürzt.
trial-stopped = Der Versuch ist abgestürzt ({ $reason }). Die Oberfläche ist noch offen; bitte neu starten.
trial-cancelled = Abgebrochen.

## How the trial stands, in one sentence

trial-success = Erfolg: Die Spitze kam nach { $time } s an; größte Wandkraft { $force }.
trial-success-exchanged = Erfolg: Die Spitze kam nach { $time } s mit dem Draht { $wire } an (zuvor gescheitert: { $failed }); größte Wandkraft { $force }.
trial-failed = Gescheitert nach { $time } s: { $why }
trial-failed-exchanged = Gescheitert nach { $time } s mit dem Draht { $wire } (zuvor gescheitert: { $failed }): { $why }
trial-arrived = Erfolg: Die Spitze ist am Ziel.
trial-timed-out = Gescheitert: Die Zeit ist um.
trial-gave-up = Gescheitert: Der Autopilot gab auf.
trial-input-over = Die aufgezeichnete Eingabe ist zu Ende.
trial-paused = Pause.
trial-looped = Der Draht hat sich umgeschlagen: zurückziehen.
trial-wrong-branch = Falscher Ast: zurückziehen und drehen.
trial-behind = Der Rechner kommt nicht nach: Der Versuch läuft langsamer als in Echtzeit.
trial-steers = Autopilot: { $doing }.
trial-doing-following = folgt der Route
trial-doing-again = versucht es gedreht erneut
trial-doing-withdrawing = zieht zurück
trial-doing-exchanging = zieht den Draht heraus, um einen anderen zu nehmen
trial-doing-looking-ahead = schaut voraus, Versuch { $attempt } von { $attempts }
trial-feed-first = Den Draht zum Ziel vorschieben (W, S) und drehen (A, D) oder den Autopiloten steuern lassen: Von da an läuft die Zeit.
trial-feed = Den Draht zum Ziel vorschieben (W, S) und drehen (A, D) oder den Autopiloten steuern lassen.
# The same where a finger points: by the pads under the thumbs.
trial-feed-first-touch = Den Draht mit den Flächen unten zum Ziel vorschieben und drehen oder den Autopiloten steuern lassen: Von da an läuft die Zeit.
trial-feed-touch = Den Draht mit den Flächen unten zum Ziel vorschieben und drehen oder den Autopiloten steuern lassen.

## Gauges and numbers. The names are short: the number stands beside them

trial-more-numbers = Weitere Zahlen
trial-wall-force = Wandkraft
trial-wall-force-help = Die größte Normalkraft an einer Stelle der Wand; der Balken wächst mit der bisher größten
trial-push-force = Schubkraft
trial-push-force-help = Was es braucht, um den Draht an der Schleuse zu halten: negativ, wenn er zurückgehalten wird. Der Balken zeigt den Betrag
trial-insertion = Einführung
trial-insertion-help = Länge des Drahts außerhalb der Schleuse; der Balken endet mit der Route zum Ziel
trial-bar-up-to = { $what }, bis { $most }
trial-to-target = Zum Ziel
trial-to-target-help = Abstand der Spitze vom Querschnitt am Ziel
trial-elapsed = Zeit
trial-elapsed-help = Simulierte Zeit
trial-beam-time-help = Zeit, in der die Strahlung an war
trial-contacts = Kontakte
trial-contacts-sum = { $count }, zusammen { $force }
trial-contacts-help = Stellen, an denen der Draht an der Wand liegt, und die Summe ihrer Kräfte
trial-tip-force = Kraft an der Spitze
trial-tip-force-help = Auf die Wand, bis 5 mm von der Spitze
trial-torque = Moment
trial-torque-help = Das Drehmoment um die Achse des Drahts an der Schleuse
trial-branch = Ast
trial-branch-on = { $branch }, auf der Route
trial-branch-off = { $branch }, neben der Route
trial-branch-help = Der Ast des Gefäßbaums, in dem die Spitze ist
trial-steps = Schritte
trial-steps-rate = { $rate } je Sekunde
trial-steps-help = Was dieser Rechner leistet; 500 je Sekunde reichen für Echtzeit
trial-unbalanced = Ohne Gleichgewicht
trial-unbalanced-help = Wo etwas schnappt, werden Schritte gebremst, oder die Schleuse wartet, sodass ihre Kräfte nicht im Gleichgewicht sind: Gezeigt werden die Kräfte des letzten Schritts, der es war
trial-unbalanced-unsettled = { $share } %, jetzt unausgeglichen
trial-unbalanced-braked = { $share } %, jetzt gebremst
trial-unbalanced-waiting = { $share } %, jetzt wartend
trial-unbalanced-held = { $share } %, jetzt gehalten
trial-fed = Vorschub
trial-fed-of = { $fed } von { $wanted } mm/s
trial-fed-help = Was im letzten Schritt vorgeschoben wurde, von dem, was verlangt war

## The wire

trial-wire = Draht
trial-wire-help = Woraus der Draht besteht: einer, der zur Route passt, wenn kein anderer gewählt ist; die Zahlen stehen eingeklappt darunter
trial-proposed = Vorschlag
trial-wire-floppy = 0,014" weich
trial-wire-workhorse = 0,014" Workhorse
trial-wire-stiff = 0,014" steif
trial-wire-workhorse-j = 0,014" J-Spitze
trial-wire-035-j = 0,035" J-Spitze
trial-wire-035-stiff-j = 0,035" steif, J
trial-wire-035-curve = 0,035" mit Katheterkurve
trial-wire-035-angled = 0,035" gewinkelt, lange Biegung
trial-wire-035-angled-20 = 0,035" gewinkelt, Spitze 20 mm
trial-wire-numbers = Spitze, Steifigkeit, Reibung
trial-tip-angle = Spitzenwinkel
trial-tip-angle-help = Der Winkel, um den die Spitze gebogen ist, bevor sie in das Gefäß kommt
trial-tip-length = Spitzenlänge
trial-tip-length-help = Länge der gebogenen Spitze, von ihrem Ende an
trial-tip-stiffness = Steifigkeit Spitze
trial-tip-stiffness-help = Biegesteifigkeit EI an der Spitze
trial-shaft-stiffness = Steifigkeit Schaft
trial-shaft-stiffness-help = Biegesteifigkeit EI des Schafts
trial-friction = Reibung
trial-friction-help = Reibungszahl, während der Draht an der Wand haftet; während er gleitet, behält er seinen Anteil davon

## Where it enters and should go

trial-entry = Zugang
trial-entry-help = Wo der Draht aus der Schleuse oder dem Führungskatheter kommt
trial-target = Ziel
trial-target-help = Wohin er soll
trial-direction = Richtung
trial-direction-help = Von welchem Ende der Draht kommt
trial-swap = Tauschen
trial-swap-help = Am Ziel hinein und von dort zur Einführstelle
trial-swap-refused = Am Ziel kann kein Draht eingeführt werden
trial-pick = Wählen
trial-pick-entry = Einführstelle wählen
trial-pick-target = Ziel wählen
trial-pick-help = Danach auf das Gefäß klicken
trial-click-entry = Auf das Gefäß klicken, wo der Draht hineinkommt.
trial-click-target = Auf das Gefäß klicken, wohin er soll.
trial-click-entry-touch = Auf das Gefäß tippen, wo der Draht hineinkommt.
trial-click-target-touch = Auf das Gefäß tippen, wohin er soll.
trial-seed = Startwert
trial-seed-help = Variiert Einführstelle, Drehung und Reibung ein wenig; 0 variiert nichts. Wirkt nach einem Neustart
trial-own = aus dem Beispiel
trial-entry-wide = { $branch }, { $width } mm
trial-entry-ostium = Ostium von { $branch }, { $width } mm
trial-target-room = { $branch }, so weit der Platz reicht
trial-target-open = { $branch }, offenes Ende
trial-target-closed = { $branch }, geschlossenes Ende
trial-target-away = { $name }, { $width } mm, { $away } mm entfernt

## The fluoroscope

trial-fluoroscopy = Durchleuchtung
trial-pedal-help = Das Pedal: an oder aus (Leertaste). Aus bleibt das letzte Bild stehen
trial-contrast = Kontrast
trial-contrast-help = Ein Bolus Kontrastmittel, den das Blut mitnimmt (C)
trial-roadmap = Roadmap
trial-roadmap-help = Zeigt das Lumen über dem Bild
trial-pulses = Pulse
trial-pulses-help = Bilder je Sekunde, solange die Strahlung an ist
trial-arm-ap = AP
trial-arm-lao-45 = LAO 45
trial-arm-lat = LAT
trial-arm-rao-30 = RAO 30
trial-arm-lao = LAO
trial-arm-rao = RAO
trial-arm-cran = CRAN
trial-arm-caud = CAUD
trial-arm-angles = { $side } { $turned }°  { $tilt } { $tilted }°
trial-arm-turned = Gedreht { $turned }°  gekippt { $tilted }°
trial-arm-preset-help = C-Bogen: { $angle } (Taste { $key })
trial-beam-on = { $rate } Pulse/s, Feld { $field } mm
trial-beam-off = Letztes Bild (Leertaste: an)

## The views

trial-view = Ansicht des Versuchs
trial-fluoroscopy-view = Ansicht der Durchleuchtung
trial-tip-view = Ansicht aus der Spitze
trial-view-title = Draht im Gefäß
trial-tip-title = Aus der Spitze
trial-tip-hide = Aus
trial-tip-hide-help = Die Ansicht aus der Spitze ausblenden
trial-tip-show = Spitze
trial-tip-show-help = Die Ansicht aus der Spitze zeigen
trial-large = Groß
trial-large-back = Klein
trial-large-name = Durchleuchtung groß
trial-large-back-name = Durchleuchtung neben den anderen
trial-large-help = Die Durchleuchtung als großes Bild mit den anderen darüber, und zurück (F)
trial-finding-way = Der Weg wird gesucht: { $percent } %
trial-none-on-problem = Es läuft kein Versuch: Die Seitenleiste sagt, warum.
trial-no-device = Es gibt kein Grafikgerät, mit dem gezeichnet werden könnte.
trial-not-drawn = Der Versuch kann nicht gezeichnet werden: { $why }.
trial-surface-not-drawn = Die Oberfläche kann nicht gezeichnet werden: { $why }.
trial-wire-not-drawn = Der Draht kann nicht gezeichnet werden: { $why }.
trial-fluoroscopy-not-drawn = Die Durchleuchtung kann nicht gezeichnet werden: { $why }.
trial-too-thin-ring = Zu dünn für den Draht
trial-no-way-ring = Kein Weg
trial-missed-fork-ring = Verfehlte Gabelung
trial-pinched = Eingeschnürt
trial-tip-here = Spitze, diese Stufe
trial-tip-unreduced = Spitze, unreduziert

## The comparison with the unreduced surface

trial-compare = Mit der unreduzierten Oberfläche vergleichen
trial-compare-help = Spielt dieselbe Eingabe auf der Oberfläche vor ihrer Reduktion nach
trial-comparing = Vergleich
trial-comparing-percent = Vergleich: { $percent } %
trial-cancel = Abbrechen
trial-cancel-comparison = Vergleich abbrechen
trial-cancel-comparison-help = Nicht weiter vergleichen; der Versuch geht weiter
trial-smallest = Engstes Lumen
trial-smallest-was = { $after } mm, war { $before } mm
trial-smallest-help = Durchmesser, wo die Route am engsten ist, nach und vor der Reduktion
trial-pinched-places = { $count ->
    [one] { $count } Stelle
   *[other] { $count } Stellen
}
trial-pinched-help = In der Ansicht mit Ringen markiert
trial-largest-deviation = Größte Abweichung
trial-largest-deviation-help = Zwischen den beiden Spitzen zur selben Zeit
trial-noise = Rauschen
trial-noise-help = Zwischen den Spitzen auf der unreduzierten Oberfläche und auf derselben mit anderer Reihenfolge der Dreiecke: Was kleiner ist, sagt nichts über die Reduktion
trial-deviation = Abweichung
trial-deviation-plot = Abweichung der Spitze über der Einführung
trial-deviation-plot-help = Abweichung der Spitze in mm über der Einführung in cm; grau: Rauschen
trial-path = die Bahn der Spitze weicht um höchstens { $most } mm ab
trial-path-more = die Bahn der Spitze weicht um höchstens { $most } mm ab, während die unreduzierte Oberfläche mit anderer Reihenfolge der Dreiecke um bis zu { $noise } mm von sich selbst abweicht
trial-path-noise = die Bahn der Spitze weicht um höchstens { $most } mm ab, nicht mehr als das Rauschen, da die unreduzierte Oberfläche mit anderer Reihenfolge der Dreiecke um bis zu { $noise } mm von sich selbst abweicht
trial-verdict-chance-yes = Bei { $gone } % kommt dieser Draht an, doch ob er es tut, ist Zufall: Auf der unreduzierten Oberfläche kommt er bei { $arrives } von { $all } Reihenfolgen der Dreiecke an; { $path }.
trial-verdict-chance-no = Bei { $gone } % kommt dieser Draht nicht an, doch ob er es tut, ist Zufall: Auf der unreduzierten Oberfläche kommt er bei { $arrives } von { $all } Reihenfolgen der Dreiecke an; { $path }.
trial-verdict-both = Bei { $gone } % kommt dieser Draht an; { $path }.
trial-verdict-neither = Dieser Draht kommt bei dieser Eingabe auf keiner der beiden Oberflächen an; Reduktion { $gone } %: { $path }.
trial-verdict-reduced = Bei { $gone } % kommt dieser Draht an; bei derselben Eingabe auf der unreduzierten Oberfläche nicht, und { $path }.
trial-verdict-unreduced = Bei { $gone } % kommt dieser Draht nicht an, auf der unreduzierten Oberfläche aber schon; { $path }.

## The tables of the paper

trial-tables-aorta = Tabelle III: der Autopilot in der Aorta.
trial-tables-coronary = Tabelle IV: der Autopilot in Aorta und Koronararterien.
trial-tables-other = Der Autopilot in dieser Oberfläche.
trial-tables-brackets = Die Zahlen der Veröffentlichung stehen in Klammern.
trial-tables-progress = Tabellen
trial-tables-cancel = Tabellen abbrechen
trial-tables-again = Wiederholen
trial-tables-copy = Kopieren
trial-tables-copy-help = Als Text, mit Tabulatoren zwischen den Spalten
trial-tables-failed = { $rate } %: { $why }
trial-tables-yes = ja
trial-tables-no = nein
trial-tables-two = { $first }; { $mean }
trial-column-rate = Rate
trial-column-rate-help = Der Anteil der Dreiecke, der entfernt wurde
trial-column-triangles = Dreiecke
trial-column-triangles-help = Was übrig blieb
trial-column-initial-fps = Bilder/s anfangs
trial-column-initial-fps-help = Bilder je Sekunde in der ersten simulierten Sekunde (Veröffentlichung)
trial-column-average-fps = Bilder/s Mittel
trial-column-average-fps-help = Mittel über die fünf Stationen (Veröffentlichung)
trial-column-worst-fps = Bilder/s min.
trial-column-worst-fps-help = Die langsamste Station
trial-column-simulation = Simulation, ms
trial-column-simulation-help = Um 1/60 s zu berechnen: in der ersten Sekunde und im Mittel an den Stationen
trial-column-drawing = Zeichnen, ms
trial-column-drawing-help = Um ein Bild von 1280 × 800 zu zeichnen
trial-column-steps = Schritte/s
trial-column-steps-help = Schritte von 2 ms, die dieser Rechner in einer Sekunde berechnet
trial-column-success = Erfolg
trial-column-success-help = Ob die Spitze ankam (Veröffentlichung)
trial-column-peak-force = Kraft max., N
trial-column-peak-force-help = Die größte Wandkraft an einer Stelle, in den Schritten im Gleichgewicht
trial-column-mean-force = Kraft Mittel, N
trial-column-mean-force-help = Die Summe der Wandkräfte, im Mittel über die Schritte im Gleichgewicht
trial-column-unbalanced = Ungleichgew., %
trial-column-unbalanced-help = Schritte, deren Kräfte nicht im Gleichgewicht waren; die Kräfte sind die der anderen
trial-column-time = Zeit, s
trial-column-time-help = Simulierte Zeit bis zum Ziel

## What came of a trial: clauses without a capital letter or a full stop

trial-end-running = noch nicht zu Ende: Die Spitze ist { $away } mm vom Ziel entfernt
trial-end-arrived = die Spitze kam nach { $time } s an
trial-end-timed-out = die Zeit des Autopiloten von { $limit } s war um, die Spitze noch { $away } mm vom Ziel entfernt
trial-end-over = die aufgezeichnete Eingabe war zu Ende, die Spitze noch { $away } mm vom Ziel entfernt
trial-end-gave-up = { $count ->
    [one] der Autopilot gab nach { $count } Rückzug auf, die Spitze noch { $away } mm vom Ziel entfernt
   *[other] der Autopilot gab nach { $count } Rückzügen auf, die Spitze noch { $away } mm vom Ziel entfernt
}
trial-end-missed = { $why }; { $missed }
trial-missed-fork = er verfehlte die Gabelung nach { $along } mm der Route und nahm { $into } statt { $instead }
trial-missed-route = er verfehlte die Gabelung nach { $along } mm der Route und nahm { $into }, statt der Route zu folgen
trial-another-branch = einen anderen Ast

## Why a trial cannot begin: clauses that a capital letter and a full stop are given to

trial-place = ({ $x }; { $y }; { $z })
trial-entry-outside = die Einführstelle { $at } liegt außerhalb des Gefäßes, { $distance_mm } mm von dessen Wand
trial-target-outside = das Ziel { $at } liegt außerhalb des Gefäßes, { $distance_mm } mm von dessen Wand
trial-no-way = von der Einführstelle zum Ziel führt kein offener Weg: Das Lumen endet bei { $at }, { $gap_mm } mm vor dem des Ziels
trial-too-short = Einführstelle und Ziel sind { $length_mm } mm voneinander entfernt: zu nah für eine Route
trial-too-thin = das Lumen ist zu dünn für einen Draht von { $wire_mm } mm: Es ist { $lumen_mm } mm weit bei { $at }, nach { $arc_mm } mm der Route; weniger Glättung hält dünne Gefäße weiter
trial-no-entry = kein Gefäß dieser Oberfläche hat ein Ende, an dem ein Draht eingeführt werden könnte; bitte eine Einführstelle angeben
trial-no-target = kein Gefäß dieser Oberfläche ist weit genug von der Einführstelle entfernt, um Ziel zu sein; bitte ein Ziel angeben
trial-tight = der Draht passt an der Einführstelle nicht hinein: Die Wand ist { $distance_mm } mm entfernt, der Radius des Drahts ist { $radius_mm } mm
trial-no-direction = die Einführstelle hat keine Richtung
trial-load = eine Last von { $load } N auf jeden Millimeter des Drahts ist nicht möglich: Sie kann von 0 bis { $most } N reichen
trial-not-inside = die Einführstelle ist nicht im Gefäß
trial-wire-impossible = dieser Wert des Drahts ist nicht möglich: { $what } { $value }
trial-wire-diameter = Durchmesser
trial-wire-shaft-stiffness = Steifigkeit des Schafts
trial-wire-tip-stiffness = Steifigkeit der Spitze
trial-wire-torsion-ratio = Torsionsverhältnis
trial-wire-length = Länge
trial-wire-density = Dichte
trial-wire-tip-element = Element an der Spitze
trial-wire-shaft-element = Element des Schafts
trial-wire-soft-part = weicher Teil
trial-wire-taper = Verjüngung
trial-wire-bend = Biegung
trial-wire-bend-angle = Winkel der Biegung
trial-wire-straight-end = gerades Ende
trial-wire-static-friction = Haftreibung
trial-wire-kinetic-friction = Gleitreibung

## What a wire's tip does not reach

trial-reach-none = Von keinem Draht ist zu erwarten, dass er in den Ast an der Gabelung nach { $along } mm der Route gelangt; sie biegt um { $turn }° aus einem { $width } mm weiten Lumen ab: Dafür muss eine Spitze { $takes } mm zur Seite reichen, und diese reicht { $reach } mm.
trial-reach-another = Von diesem Draht ist nicht zu erwarten, dass er in den Ast an der Gabelung nach { $along } mm der Route gelangt; sie biegt um { $turn }° aus einem { $width } mm weiten Lumen ab: Dafür muss eine Spitze { $takes } mm zur Seite reichen, und diese reicht { $reach } mm. Die Spitze eines anderen Drahts reicht so weit.

## Why a log cannot be replayed: clauses as above

trial-log-none = dies ist kein Protokoll eines Lumen-Versuchs: Die erste Zeile ist nicht „# lumen trial log“
trial-log-schema = das Protokoll hat das Schema { $found }; diese Version liest die Schemata { $oldest } bis { $newest }
trial-log-setup = die Einstellungen im Protokoll sind nicht lesbar: { $why }
trial-log-no-setup = das Protokoll sagt nicht, welche Einstellungen galten
trial-log-line = Zeile { $line } des Protokolls ist nicht lesbar: { $what }
trial-log-steps = die Anzahl der Schritte ist keine Zahl
trial-log-step = der Schritt ist keine Zahl
trial-log-feed = der Vorschub ist keine Zahl
trial-log-roll = die Drehung ist keine Zahl
trial-log-wire = der Draht ist keiner von denen des Aufbaus
trial-log-order = der Schritt liegt nicht nach dem vorigen
trial-log-columns = die Spalten sind nicht die eines Protokolls

# The sweep below the tables.
trial-sweep = { $seeds } Versuche je Rate
trial-sweep-help = Was die Reduktion mit dem Draht macht: der Autopilot mit vielen Startwerten bei jeder Rate, und dieselbe Eingabe auf der unreduzierten Oberfläche
trial-sweep-what = Median und größter Wert der Versuche.
# Beside the plot, in the colours of its curves.
trial-sweep-largest = Abweichung, größte
trial-sweep-median = Median
trial-sweep-noise = Rauschen, größtes
trial-sweep-plot = Abweichung der Spitze von der unreduzierten Oberfläche je nach Reduktion
trial-sweep-arrived = { $arrived } von { $seeds }
trial-column-arrive = Kommen an
trial-column-arrive-help = Versuche, in denen der Draht sein Ziel erreichte
trial-column-deviation = Abweichung, mm
trial-column-deviation-help = Zwischen der Spitze hier und auf der unreduzierten Oberfläche bei derselben Eingabe
trial-column-noise = Rauschen, mm
