### Die Leisten, Menüs und Blätter des Fensters; Sätze über Öffnen, Speichern, Weitergeben und was wiederkommt; der Desktop.

## Was Lumen ist

about-not-clinical = Nicht für klinische Entscheidungen
app-about-purpose = Macht die Oberfläche eines Blutgefäßes aus einem CT- oder MR-Scan leicht genug für Simulationen: behält das größte Stück, glättet und reduziert es.
app-about-privacy = Alles geschieht auf diesem Gerät. Keine Datei und kein Teil einer Datei wird irgendwohin gesendet.
app-about-method = Das Verfahren ist das aus „Mesh Optimization of Vessel Surface Model for Computer-Aided Simulation of Percutaneous Coronary Intervention“. Glättung: Taubin, Zhang und Golub (1996). Dezimierung: Schroeder, Zarge und Lorensen (1992); Garland und Heckbert (1997). Progressive Netze: Hoppe (1996).
app-about-licence = Lizenz: MIT oder Apache-2.0, nach Wahl.
app-about-letters = Schrift: Ubuntu Light derivative Lumen, (c) Canonical Ltd, Ubuntu Font Licence 1.0.

## The bar above

app-open = Öffnen...
app-open-help = Eine Oberfläche oder Einstellungen (Strg+O); oder eine Datei hierher ziehen
app-open-in = Einheit
app-open-units = Einheit der Zahlen in der Datei
app-open-in-help = Eine Datei öffnen, deren Zahlen in einer anderen Einheit als mm sind (glTF: m)
app-sample = Beispiel
app-save = Speichern
# On a phone: menus of what can be saved.
app-save-surface = Oberfläche
app-save-vessels = Gefäße
app-save-record = Für die Akte
app-undo = Rückgängig
app-undo-help = Rückgängig (Strg+Z)
app-redo = Wiederholen
app-redo-help = Wiederholen (Strg+Umschalt+Z)
app-split = Geteilt
app-split-help = Wie geöffnet und wie jetzt in einem Bild; die Linie dazwischen lässt sich ziehen (R)
app-before = Vorher
app-before-help = Gedrückt halten, um die Oberfläche wie geöffnet zu sehen (oder B halten)
app-prepare = Vorbereiten
app-prepare-help = Die Schritte des Verfahrens: größtes Stück behalten, glätten, reduzieren
app-compare = Vergleich
app-compare-help = Mehrere Einstellungen nebeneinander (C)
app-trial = Versuch
app-trial-help = Einen Führungsdraht durch die gezeigte Stufe steuern
app-vessels = Gefäße
app-vessels-help = Die Gefäße, und was Glättung und Reduktion aus dem Kaliber jedes einzelnen gemacht haben (V)
app-measure = Messen
app-measure-help = Längen, Durchmesser, Querschnitte und Winkel, und eine Ebene, die die Oberfläche aufschneidet (M)
app-view = Ansicht
app-view-help = Von wo die Oberfläche betrachtet wird, und was von ihr zu sehen ist
app-learn = Lernen
app-about = Info
app-about-help = Was Lumen ist, und worauf seine Zahlen beruhen
app-help = Hilfe
app-help-help = Tasten und Gesten (F1)
app-theme = Farbschema
app-theme-help = Hell oder dunkel (T)
app-menu = Menü
app-menu-help = Mehr
app-show-before = Vorher zeigen
app-split-view = Geteilte Ansicht

## The menu "Save"

app-save-lengths = Längen in { $unit }
app-save-levels = GLB mit Stufen...
app-save-levels-help = Die Stufe und gröbere, mit der Hälfte, einem Viertel und so weiter ihrer Dreiecke, für Betrachter, die MSFT_lod von glTF kennen
app-save-all-lengths = Längen in mm; bei glTF in m
app-save-settings = Einstellungen...
app-save-settings-help = Für alle, die dieselbe Datei haben, und für lumen optimise --settings; wird wie eine Oberfläche geöffnet
app-copy-link = Link kopieren
app-copy-link-help = Die Einstellungen, der Blick und die ersten Ziffern der Prüfsumme der Datei, und nichts von der Oberfläche
app-whole = In Lumen öffnen
app-whole-help = Dieselbe Oberfläche mit denselben Einstellungen in einem eigenen Fenster, mit allem Übrigen
app-keep-surface = Geöffnete Oberflächen auf diesem Gerät behalten
app-keep-surface-help = Die geöffnete Datei, für den nächsten Start, in diesem Browser; sonst nur ihr Name, die Einstellungen und die Ansicht
app-forget = Hier Behaltenes vergessen
app-forget-help = Einstellungen, Namen und Oberflächen, die in diesem Browser behalten werden

## The menu "View"

app-fit = Einpassen
app-flat = Flache Dreiecke
app-flat-help = Jedes Dreieck mit seiner eigenen Normalen
app-raking = Streiflicht
app-raking-help = Von der Seite, fast entlang der Wand: Treppenstufen und Dellen treten hervor (K)
app-occlusion = Umgebungsverdeckung
app-occlusion-help = Dunkler, wo Wände nah beieinander stehen, wie in Falten und Gabelungen; nicht, wenn Farben gezeigt werden
app-see-through = Durchsichtiges Drahtgitter
app-see-through-help = Zeigt verdeckte Linien schwach
app-split-lines = Auch Drahtgitter geteilt
app-split-lines-help = Solange die Ansicht geteilt ist: links der Linie auch die Kanten wie geöffnet, rechts davon wie jetzt
app-colour-deviation = Farbe nach Abweichung
app-colour-deviation-help = Mittlerer Abstand zwischen dieser und der geglätteten Oberfläche um jeden Eckpunkt, in beiden Richtungen, in mm
app-colour-calibre = Farbe nach Kaliberänderung
app-colour-calibre-help = Wie viel weiter oder enger jedes Gefäß ist als beim Öffnen, in Prozent seines Radius
app-colour-classes = Farbe nach Eckpunktklasse
app-colour-classes-help = Wofür die Dezimierung jeden Eckpunkt hält: einfach, komplex, Rand, innere Kante oder Ecke (Schroeder 1992)
app-feature-lines = Formkanten, offene Enden
app-feature-lines-help = Kanten, die schärfer sind als der Kantenwinkel, wie die Dezimierung sie fand, und der Rand
app-present = Präsentieren
app-present-help = Für einen Beamer: größere Schrift, gedrückte Tasten werden gezeigt, von der Seitenleiste bleiben die Regler (P)
app-language = Sprache
app-language-system = Wie das System

## The menu "Learn"

app-lesson-help = Eine Lektion in wenigen Schritten; sie stellt die App ein
app-open-lesson = Lektion öffnen...
app-open-lesson-help = Eine Datei mit der Endung .lesson; sie kann auch hierher gezogen werden
app-collapses = Kollapse, einzeln
app-collapses-help = Was die Dezimierung als Nächstes nimmt, wohin es geht und was es kostet; ein Klick fragt, warum ein Eckpunkt bleiben muss
app-playback = Reduktion abspielen
app-playback-help = Von allen Dreiecken bis 99,9 % weniger und zurück, immer wieder
app-glossary = Glossar
app-glossary-help = Die Begriffe des Verfahrens, je in einem Satz

## The bar below

app-progress = Fortschritt
app-cancel = Abbrechen
app-cancel-help = Esc
app-triangles = { $count ->
    [one] { $count } Dreieck
   *[other] { $count } Dreiecke
}

## The views on a phone, and the handle of its panel

app-tab-shaded = Schattiert
app-tab-shaded-help = Die schattierte Ansicht; auch ein Wischen über den Streifen führt dorthin
app-tab-wireframe = Drahtgitter
app-tab-wireframe-help = Die Ansicht als Drahtgitter
app-panel-low = Höhe der Leiste: niedrig
app-panel-half = Höhe der Leiste: halb
app-panel-full = Höhe der Leiste: voll
# Name of a panel's edge, which is dragged to resize it; for assistive tools.
app-panel-edge = Größe der Leiste
# On the handle of a panel that is folded away.
app-panel-folded = Regler
app-panel-help = Nach oben oder unten ziehen; Tippen oder eine Pfeiltaste führt zur nächsten Höhe

## Over the sample, until a file is opened

# Followed by a button with the next message; they read as one sentence.
app-invite-drop = Ein Gefäß hier ablegen oder
app-invite-open = eines öffnen
# On the button where a finger points, which drops nothing.
app-invite-open-alone = Ein Gefäß öffnen
app-invite-open-help = Eine Datei wählen: nichts verlässt dieses Gerät
# For assistive tools, and its tooltip.
app-invite-close = Einladung schließen
app-invite-close-help = Das Beispiel bleibt offen

## The sheet of keys

app-keys = Tasten und Gesten
app-close = Schließen
app-touch-one = Ein Finger
app-touch-two = Zwei Finger
app-touch-two-does = Verschieben; auf- und zuziehen zum Zoomen
app-touch-double = Doppeltippen
# Above the keys, where what stands before is for fingers.
app-keys-keyboard = Mit Maus und Tastatur
app-key-drag = Ziehen
app-key-drag-does = Drehen
app-key-move = Umschalt oder rechte Taste + Ziehen, zwei Finger
app-key-move-does = Verschieben
app-key-zoom = Mausrad, zwei Finger spreizen
app-key-zoom-does = Zum Zeiger hin zoomen
app-key-arrows = Pfeile, + und -
app-key-arrows-does = Drehen und zoomen
app-key-fit = F, Doppelklick
app-key-fit-does = In die Ansicht einpassen
app-key-sides = 1 bis 6
app-key-sides-does = Anterior, posterior, links, rechts, superior, inferior
app-key-before = B oder Leertaste, gehalten
app-key-before-does = Die Oberfläche wie geöffnet
app-key-split = R
app-key-split-does = Wie geöffnet und wie jetzt in einem Bild; die Linie dazwischen ziehen
app-key-left-out = L
app-key-left-out-does = Weggelassenes zeigen; ein Klick auf ein Stück behält dieses
app-key-deviation = D
app-key-deviation-does = Farbe nach Abweichung
app-key-raking = K
app-key-raking-does = Licht von der Seite, das Treppenstufen zeigt
app-key-vessels = V
app-key-vessels-does = Die Gefäße und was aus ihrem Kaliber wurde
app-key-measure = M
app-key-measure-does = Messen und die Oberfläche aufschneiden; die Eingabetaste misst in der Mitte der Ansicht
app-key-compare = C
app-key-compare-does = Mehrere Einstellungen vergleichen; die Eingabetaste übernimmt die ausgewählte
app-key-compare-first = X, gehalten
app-key-compare-first-does = Im Vergleich: die ersten Einstellungen in jeder Zelle
app-key-present = P
app-key-present-does = Präsentieren: größere Schrift, Tasten sichtbar, keine Seitenleiste
app-key-open = Strg+O
app-key-open-does = Öffnen
app-key-save = Strg+S
app-key-save-does = Als STL speichern
app-key-undo = Strg+Z
app-key-undo-does = Rückgängig
app-key-redo = Strg+Umschalt+Z, Strg+Y
app-key-redo-does = Wiederholen
app-key-escape = Esc
app-key-escape-does = Oberstes schließen, abbrechen, den Vergleich verlassen
app-key-theme = T
app-key-theme-does = Hell oder dunkel
app-key-tab = Tab
app-key-tab-does = Nächstes Bedienelement; Pfeile, Bild auf, Bild ab, Pos1 und Ende bewegen einen Regler
app-key-sheet = F1
app-key-sheet-does = Diese Liste

## The same while a trial is shown

app-trial-key-feed = W und S, auf und ab
app-trial-key-feed-does = Den Draht vorschieben und zurückziehen
app-trial-key-roll = A und D, links und rechts
app-trial-key-roll-does = Ihn nach links und rechts drehen
app-trial-key-faster = Umschalt dazu
app-trial-key-faster-does = Schneller
app-trial-key-gamepad = Gamepad (im Browser)
app-trial-key-gamepad-does = Linker Stick schiebt vor, rechter Stick dreht
app-trial-key-autopilot = G
app-trial-key-autopilot-does = Autopilot
app-trial-key-fluoroscopy = Leertaste
app-trial-key-fluoroscopy-does = Durchleuchtung ein oder aus
app-trial-key-enlarge = F
app-trial-key-enlarge-does = Durchleuchtung als großes Bild, und zurück
app-trial-key-contrast = C
app-trial-key-contrast-does = Ein Bolus Kontrastmittel
app-trial-key-arm = 1 bis 4
app-trial-key-arm-does = C-Bogen: AP, LAO 45, LAT, RAO 30
app-trial-key-turn-arm = In der Durchleuchtung ziehen
app-trial-key-turn-arm-does = Den C-Bogen drehen
app-trial-key-magnify = Mausrad, zwei Finger dort
app-trial-key-magnify-does = Vergrößern
app-trial-key-restart = R
app-trial-key-restart-does = Neustart
app-trial-key-pause = P
app-trial-key-pause-does = Pause
app-trial-key-back = Z
app-trial-key-back-does = Eine Sekunde zurück
app-trial-key-slow = M
app-trial-key-slow-does = Zeitlupe
app-trial-key-escape = Esc
app-trial-key-escape-does = Oberstes schließen, zuletzt den Versuch
app-trial-key-view = Ziehen, Mausrad in der Gefäßansicht
app-trial-key-view-does = Drehen, zoomen
app-trial-key-sheet = F1
app-trial-key-sheet-does = Diese Liste

## Opening

app-open-failed = { $name }: { $why }
app-open-failed-kept = { $name }: { $why } Was geöffnet war, ist es noch.
app-not-opened-again = Die Oberfläche konnte nicht wieder geöffnet werden.
app-opening-cancelled = Das Öffnen wurde abgebrochen.
app-opening-cancelled-kept = Das Öffnen wurde abgebrochen; was geöffnet war, ist es noch.
# $percent: less than 90.
app-told-again = { $text } ({ $count }-mal)
app-open-next = Nächste öffnen
app-open-next-help = Die nächste der Dateien öffnen, die zusammen kamen, an Stelle dieser
app-take-away = Schließen
app-take-away-help = Diese Meldung wegnehmen
app-others = { $rest ->
    [0] { $next } kam mit.
    [1] { $next } und eine weitere kamen mit.
   *[other] { $next } und { $rest } weitere kamen mit.
}
app-gone-back = Um { $percent } % reduziert: mehr wäre nicht sicher.
app-gone-back-kept = Um { $percent } % reduziert: mehr würde das Kaliber nicht erhalten, wo es gemessen ist.
app-gone-back-pinched = Um { $percent } % reduziert: mehr würde ein Gefäß einschnüren.
app-scan-cancelled = Abgebrochen; der Scan wurde nicht geöffnet.

## Work that ends before it is done

app-cancelled = Abgebrochen.
app-cancelled-result-stands = Abgebrochen; das letzte Ergebnis gilt.
app-computation-stopped = Die Berechnung ist abgestürzt.
app-engine-stopped = Die Berechnung ist abgestürzt ({ $reason }).
app-engine-keeps-stopping = Die Berechnung stürzt immer wieder ab ({ $reason }).
app-engine-try-again = Was gezeigt wird, ist noch da und kann gespeichert werden; für einen neuen Versuch eine Einstellung ändern oder eine Datei öffnen.
app-engine-memory = Das Desktop-Programm hat mehr Speicher.
app-engine-stopped-opening = { $name } konnte nicht geöffnet werden: Die Berechnung ist abgestürzt ({ $reason }).
app-engine-restarted = Die Berechnung ist abgestürzt ({ $reason }) und wurde neu gestartet.
app-nothing-lost = Nichts ging verloren.
app-thread-ended = ihr Thread ist beendet
app-reason-unknown = aus unbekanntem Grund
app-graphics-restarted = Die Grafik wurde unterbrochen und neu gestartet. Nichts ging verloren.

## Saving

app-nothing-to-save = Es gibt noch nichts zu speichern.
app-not-saved = { $name } wurde nicht gespeichert: { $why }
app-save-again = { $name } wurde nicht gespeichert: bitte noch einmal speichern.
app-saved = { $name } wurde gespeichert.
app-not-written = { $name } konnte nicht geschrieben werden: { $error }.
app-pair-saved = { $first } und { $second } wurden in { $folder } gespeichert.
app-pair-there-already = Nichts wurde gespeichert: { $name } ist schon da. Bitte einen anderen Namen wählen.
app-pair-not-written = Nichts wurde gespeichert: { $name } konnte nicht geschrieben werden: { $error }.

## Presenting

app-presenting = Präsentation: größere Schrift, Tasten werden gezeigt, von der Seitenleiste bleiben die Regler. P oder Esc beendet sie.

## Settings for others

app-settings-taken = Die Einstellungen aus { $name } gelten.
app-measures-of-other = Ihre Messungen gehören zu einer anderen Oberfläche und wurden weggelassen.
app-measures-too-early = Ihre Messungen wurden weggelassen: Datei noch einmal öffnen, sobald die Oberfläche in ihrer Einheit gelesen ist.
app-measures-shown = Ihre Messungen werden gezeigt.
app-measures-not-saved = Die Messungen sind nicht bei den Einstellungen: Diese Oberfläche hat keine Datei, an der sie zu erkennen wäre.
app-link-copied-file = Der Link wurde kopiert. Er enthält die Einstellungen und die ersten Ziffern der Prüfsumme der Datei, und nichts von der Oberfläche: Wer ihn öffnet, braucht dieselbe Datei.
app-link-copied-sample = Der Link wurde kopiert. Er enthält die Einstellungen und sagt, für welches Beispiel sie sind.
app-link-nothing = Es gibt noch nichts, worauf ein Link zeigen könnte.
app-link-fewer = Dieses Beispiel hat weniger Dreiecke als von sich aus: Kein Link führt darauf. Öffnen Sie die Seite ohne ?samples=.
app-step-link-copied = Der Link zu diesem Schritt wurde kopiert.
app-link-taken = Die Einstellungen des Links gelten.
app-link-same = Zu dieser Oberfläche gehört der Link: Es ist dasselbe zu sehen.
app-link-other-file = Das ist eine andere Datei als die, zu der der Link gehört: Ihr SHA-256 beginnt mit { $opened }, nicht mit { $wanted }. Die Einstellungen sind die des Links.
app-link-needs-file = Dieser Link gehört zu einer Datei, deren SHA-256 mit { $digits } beginnt; wird sie geöffnet, ist dasselbe zu sehen.

## Why a link or a file of settings was not taken

app-link-long = Der Link ist länger als jeder, den Lumen macht: Er hat { $bytes } Byte.
app-link-newer = Der Link stammt von einem neueren Lumen: Seine Version ist { $found }, und dieses Lumen liest { $known }.
app-link-missing = Der Link ist nicht vollständig: „{ $pair }“ fehlt.
app-link-twice = Im Link steht „{ $pair }“ zweimal.
app-link-unknown = Im Link steht „{ $pair }“, was hier nichts bedeutet.
app-link-value = Der Link ist nicht lesbar: „{ $value }“ ist kein Wert für „{ $key }“.
app-link-range = Der Link ist nicht verwendbar: { $why }.
app-settings-none = Das ist keine Datei mit Einstellungen von Lumen.
app-settings-newer = Diese Einstellungen stammen von einem neueren Lumen: Ihre Version ist { $found }, und dieses Lumen liest bis { $known }.
app-settings-field = Die Einstellungen sind nicht lesbar: { $why }.
app-settings-range = Die Einstellungen sind nicht verwendbar: { $why }.
app-measures-unsound = Die Messungen können nicht gezeigt werden: Es sind zu viele, oder eine ihrer Zahlen ist keine.

## What was measured, and on what

app-measure-diameter = { $mm } mm Durchmesser
app-measure-section = { $area } mm², { $least } bis { $largest } mm breit, als Kreis { $round } mm
app-measured-opened = Wie geöffnet
app-measured-opened-vessel = Wie geöffnet, { $vessel }
app-measured-opened-fork = Wie geöffnet, { $vessel }, an einer Gabelung
app-measured-level = { $count ->
    [one] Bei { $count } Dreieck
   *[other] Bei { $count } Dreiecken
}
app-measured-level-vessel = { $count ->
    [one] Bei { $count } Dreieck, { $vessel }
   *[other] Bei { $count } Dreiecken, { $vessel }
}
app-measured-level-fork = { $count ->
    [one] Bei { $count } Dreieck, { $vessel }, an einer Gabelung
   *[other] Bei { $count } Dreiecken, { $vessel }, an einer Gabelung
}

## What comes back at the next start

app-file-back = { $name } ist wieder da, mit den Einstellungen und der Ansicht von zuletzt.
app-settings-back = Einstellungen und Ansicht sind wie zuletzt.
app-file-before = { $name } war zuvor geöffnet. Bitte wieder öffnen: Die Einstellungen sind wie zuletzt, und die Ansicht wird es sein.
app-file-before-given-up = { $name } war zuvor geöffnet. Das Programm endete zweimal, während die Datei geöffnet wurde; sie wird hier nicht mehr behalten. Bitte wieder öffnen: Die Einstellungen sind wie zuletzt, und die Ansicht wird es sein.
app-surfaces-kept = Jede Datei mit einer Oberfläche, die von nun an geöffnet wird, wird auf diesem Gerät für den nächsten Start behalten, anstelle der vorigen.
app-surfaces-kept-and-this = { $name } und jede danach geöffnete Datei mit einer Oberfläche wird auf diesem Gerät für den nächsten Start behalten, anstelle der vorigen.
app-surfaces-not-kept = Auf diesem Gerät wird keine Oberfläche mehr behalten.
app-forgotten = Alles, was auf diesem Gerät behalten wurde, ist vergessen: Einstellungen, Namen und Oberflächen. Nichts wird behalten, bis wieder eine Oberfläche geöffnet wird.

## The desktop

app-dialog-opened = Oberflächen, Scans, Protokolle und Einstellungen
app-dialog-all = Alle Dateien
app-no-file = Es wurde keine Datei gewählt.
app-not-read = { $name } konnte nicht gelesen werden: { $error }.
app-no-scans = Diese Fassung von Lumen wurde ohne Scans und Masken gebaut (Feature scans).
app-folder-empty = Im Ordner sind keine Dateien.
app-scan-not-found = { $name } ist nicht lesbar: { $error }.
app-scan-file-gone = Eine Datei des Scans ist nicht mehr da.
app-scan-file-not-read = Eine Datei des Scans ist nicht lesbar: { $error }.
app-graphics-keep-failing = Die Grafik fällt auf diesem Rechner immer wieder aus. Was geöffnet war, ist noch da.
app-try-again = Erneut versuchen
app-virtual-device = Virtuelles Gerät
app-devices-not-listed = das System listet seine Geräte nicht auf: { $error }
app-device-not-opened = { $name } kann nicht geöffnet werden: { $error } (unter Linux ist eine udev-Regel nötig, siehe docs/haptics.md)
app-haply-not-there = Haplys Dienst antwortet auf diesem Rechner nicht ({ $address }): bitte starten und das Gerät noch einmal wählen ({ $error })
app-haply-no-arm = Haplys Dienst hat keinen Inverse3: bitte anschließen und das Gerät noch einmal wählen

## Die Reduktion, von allen Dreiecken bis zu den wenigsten und zurück abgespielt

app-playback-play = Abspielen
app-playback-pause = Anhalten
app-playback-play-help = Von allen Dreiecken bis 99,9 % weniger und zurück; in jeder Sekunde um den gleichen Teil
app-playback-period = hin und zurück
app-playback-period-help = Wie lange das dauert, in Sekunden
app-playback-level = { $count ->
    [one] { $percent } %: { $count } Dreieck
   *[other] { $percent } %: { $count } Dreiecke
}
app-playback-save = Sichern (APNG)...
app-playback-save-help = Dasselbe als bewegtes Bild, von dort gesehen, von wo die Ansicht jetzt blickt
app-playback-close = Schließen
app-playback-close-help = Schließt es; die Reduktion von vorher kommt zurück
