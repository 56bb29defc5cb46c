### Haptische Geräte, Gamepads und der Ton der Kraft: der Teil des Versuchs unter seinen Einstellungen, und was von einem Gerät
### gemeldet wird. Namen von Geräten, ihren Achsen und Reports sind in allen Sprachen gleich.

## Welches Gerät den Draht hält

# Steht vor der Liste der Geräte.
devices-device = Gerät
devices-device-help = Womit der Draht gehalten wird, neben Tasten und Feldern
devices-look-again = Neu suchen
devices-look-again-help = Listet die Geräte auf, die jetzt angeschlossen sind
# In der Liste der Geräte: keines davon.
devices-none = Keines
# In der Liste der Geräte: das, das keine Hardware braucht.
# In der Liste der Geräte: Feeder heißt das offene Gerät, das man bauen kann.
devices-serial-feeder = Feeder, seriell
# Ein Gerät ohne Namen; $numbers sind die seines Herstellers und seine eigene.
devices-unnamed = Gerät { $numbers }
# In der Liste der Geräte, im Browser: fragt nach einem.
devices-pair = Gerät koppeln...
devices-pair-serial = Seriell koppeln...
devices-not-paired = Der Browser hat nicht nach einem Gerät gefragt: bitte noch einmal koppeln.
devices-no-hid = Dieser Browser erreicht keine Geräte: Chrome und Edge können es, auf einem Computer. Gamepads gehen überall.
devices-only-serial = Dieser Browser erreicht nur den offenen Feeder, seriell: Andere Geräte brauchen Chrome oder Edge, auf einem Computer.
devices-again = Ein Gerät hält den Draht wieder.
devices-again-unarmed = Ein Gerät hält den Draht wieder; seine Kraft ist nicht freigegeben.

## Die zwei Regler, die die Hand am virtuellen Gerät sind

devices-hand-at = Hand bei
devices-hand-at-help = Wohin die Hand am virtuellen Gerät dessen Schieber bringen will
devices-turned-to = Gedreht
devices-turned-to-help = Wohin die Hand am virtuellen Gerät dessen Knopf drehen will

## Achsen: welche vorschiebt, welche dreht

devices-axis-help = Wo die Achse zwischen ihren Enden steht, und ihre Zahl
devices-push = Das Gerät nach vorn schieben, wie um den Draht vorzuschieben.
devices-turn = Es nach rechts drehen, wie um den Draht zu drehen.
# Den Draht vorschieben, und ihn um seine Achse drehen: je ein Feld und eine Zeile.
devices-feed = Vorschub
devices-roll = Drehung
devices-mapped-help = Welche Achse, was ihr Weg bewegt und welche Richtung vorn ist
devices-inverted = Invers
# Eine Einheit hinter einer Zahl: mm je Zählschritt des Geräts.
devices-per-count = { $unit }/Tick
# Von Bildschirmlesern gesprochen; $what ist Vorschub oder Drehung.
devices-mapped-far = { $what }: wie weit
devices-mapped-axis = { $what }: Achse
devices-learn = Anlernen
devices-learn-help = Findet heraus, welche Achse geschoben und welche gedreht wird
devices-forget = Vergessen
devices-forget-help = Diese Achsen sind für Geräte dieser Art gemerkt, nach Hersteller, Produkt und Deskriptor: vergisst sie und kehrt zu denen zurück, mit denen die meisten Geräte bedient werden
devices-no-force = Keine Kraft über diese Achsen.

## Die Felder auf dem Bildschirm; die Wörter an ihren Enden so kurz wie möglich

devices-feed-pad = Feld Vorschub
devices-feed-out = rück
devices-feed-in = vor
devices-feed-pad-help = Nach rechts ziehen schiebt vor, nach links zieht zurück (W, S)
devices-roll-pad = Feld Drehung
devices-roll-left = li.
devices-roll-right = re.
devices-roll-pad-help = Zur Seite ziehen dreht den Draht (A, D)

## Die Kraft eines Geräts

devices-felt-as = Kraft
devices-felt-as-help = Mit welchem Teil seiner größten Kraft das Gerät 1 N längs des Drahts spüren lässt
devices-torque-as = Moment
devices-torque-as-help = Mit welchem Teil seiner größten Kraft das Gerät 1 N mm um den Draht spüren lässt
devices-stop-force = Kraft beenden
devices-stop-force-help = Das Gerät lässt sofort los (Esc)
devices-ask-arm-force = Kraft freigeben...
devices-ask-arm-force-help = Sagt zuerst, was sich bewegen wird, und gibt es dann frei
# Wird gelesen, bevor sich zum ersten Mal ein Motor bewegt: jedes Wort zählt.
devices-force-warning = Das Gerät wird von selbst zurückdrücken, mit bis zu 40 % seiner Kraft. Halten Sie es locker, und halten Sie Haare, Kabel und Tassen fern. Esc, der Knopf zum Beenden oder das Verlassen dieses Fensters beendet es.
devices-arm-force = Kraft freigeben
devices-not-now = Nicht jetzt
devices-felt = Gespürt
devices-felt-help = Was die Hand an der Schleuse hält
devices-latency = Latenz
devices-latency-help = Vom Eingabe- bis zum Ausgabereport: die Hälfte, 95 % und 99 % dauern nicht länger
devices-save-latency = Latenz speichern
devices-save-latency-help = Speichert diese Zeiten, den Namen des Geräts und die Version von Lumen als kleine Tabelle, und sonst nichts
devices-ended-hidden = Die Kraft wurde beendet, als das Fenster verlassen wurde.
devices-ended-unplugged = Die Kraft wurde beendet, als das Gerät abgezogen wurde.
devices-ended-no-number = Die Kraft wurde beendet: Der Versuch gab keine Zahl dafür.
devices-ended-refused = Die Kraft wurde beendet: Das Gerät nimmt keine Reports mehr an.

## Ein Gamepad, das vibriert

devices-stop-rumble = Vibration aus
devices-stop-rumble-help = Das Gamepad ist sofort still (Esc)
devices-ask-arm-rumble = Vibration an...
devices-ask-arm-rumble-help = Sagt zuerst, wann das Gamepad vibrieren wird, und gibt es dann frei
devices-rumble-warning = Das Gamepad wird umso stärker vibrieren, je mehr Kraft die Hand an der Schleuse hält, mit bis zu 40 % seiner Stärke. Esc, der Knopf zum Beenden oder das Verlassen dieses Fensters beendet es.
devices-arm-rumble = Vibration an
devices-arm-rumble-help = Von jetzt an vibriert das Gamepad
devices-leave-still = Still lassen
devices-leave-still-help = Das Gamepad vibriert nicht

## Ein Ton statt einer Kraft

devices-sound = Ton der Kraft
devices-sound-help = Ein Ton, der umso höher und lauter ist, je mehr Kraft die Hand an der Schleuse hält, bis 0,1 N oder 1 N mm
devices-no-sound = Die Kraft ist hier nicht zu hören: Das Desktop-Programm spielt sie unter Linux mit pw-play, paplay oder aplay, ein Browser mit Web Audio.

## Warum ein Gerät nicht bedient wird, im Browser

devices-no-serial-in-worker = Dieser Browser öffnet keine seriellen Anschlüsse in einem Worker.
devices-no-timer = Der Browser gibt keinen Zeitgeber her.
devices-not-there = Das Gerät ist nicht mehr da; zum Fortfahren wieder anschließen.
devices-no-axis = Das Gerät hat keine Achse, die den Draht vorschieben oder drehen könnte.
devices-not-opened = Das Gerät konnte nicht geöffnet werden: Ein anderes Programm hält es, oder dieser Benutzer darf es nicht verwenden (unter Linux ist eine udev-Regel nötig, siehe docs/haptics.md).
devices-no-answer = Der Anschluss ist offen, aber was dort ist, antwortet nicht wie der offene Feeder.

## Dasselbe im Desktop-Programm; jedes steht für sich

devices-gone = das Gerät ist nicht mehr da
devices-report-refused = das Gerät nimmt Report { $id } nicht an: { $reason }
devices-descriptor-cut = der Report-Deskriptor endet innerhalb des Eintrags bei Byte { $at }
devices-descriptor-long = der Report-Deskriptor hat { $bytes } Byte, mehr als { $most }
devices-descriptor-many = das Gerät hat mehr als { $fields } Felder, oder Sammlungen, die tiefer als { $depth } liegen
devices-report-long = Report { $id } des Geräts ist länger als { $most } Byte
devices-report-id = ein Report des Geräts hat die Kennung { $id }, die nicht zwischen 1 und 255 liegt

## Was in einem Versuch nicht geht; die App setzt einen Großbuchstaben und einen Punkt

devices-no-trial = es läuft kein Versuch
devices-log-not-written = das Protokoll kann nicht geschrieben werden: { $error }
devices-log-other-surface = das Protokoll gehört zu einer anderen Oberfläche oder zu einer anderen Stufe: zuerst diese öffnen
devices-log-other-route = das Protokoll hat eine andere Einführstelle oder ein anderes Ziel als die gezeigte Route von { $length } mm: zuerst einen Versuch mit jenen starten
