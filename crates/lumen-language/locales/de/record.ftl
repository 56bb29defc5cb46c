### Was die App für die Akten schreibt: Berichte, Bilder und Drehungen.

## Einträge im Menü zum Speichern

record-report = Bericht...
record-report-help = Eine Seite für die Akten: Urteil, Zahlen, Einstellungen, Gefäße, Bilder und Kurven
record-picture = Bild (PNG)
record-pixels = { $count } Pixel...
record-pixels-help = Die längere Seite des Bildes
record-clear = Hintergrund transparent
record-clear-help = Nichts hinter der Oberfläche, um sie über anderes zu legen
record-turntable = Drehung (APNG)...
record-turntable-help = Die Oberfläche dreht sich einmal, als bewegtes Bild; die Farben sind die der Ansicht
record-video = Drehung als Video (WebM)...
record-video-help = Eine Umdrehung der Oberfläche, für Folien; sie wird aufgenommen, während sie läuft, in etwa 4 s
record-no-video = Der Browser konnte das Video nicht aufnehmen.

## Ein Diagramm als Datei

record-plot = Diagramm speichern: { $title }
record-plot-help = Als Datei für Folien und Veröffentlichungen
record-plot-svg = Als Vektorgrafik (SVG)...
record-plot-svg-help = Scharf in jeder Größe; Wörter bleiben Text
record-plot-png = Als Bild (PNG)...
record-plot-png-help = 1920 Pixel breit
record-figure = Bild...
record-figure-help = Alle zusammen als ein Bild für Folien und Veröffentlichungen (PNG), 2400 Pixel breit
record-figure-title = Glättung und Reduktion im Vergleich

## Das Blatt des Berichts

record-said-kept = Fall und Bemerkung stehen nur im Bericht. Lumen vergisst sie, sobald eine andere Oberfläche geöffnet wird.
record-report-pdf = Als PDF speichern...
record-report-pdf-help = Zum Drucken
record-report-html = Als Webseite speichern...
record-report-html-help = Dasselbe in einer Datei für den Browser, die sonst nichts braucht
record-report-surface = Als Webseite mit der Oberfläche speichern …
record-report-surface-help = Dieselbe Seite; die Oberfläche lässt sich darin drehen, auf jedem Gerät, ohne Lumen
record-name-file = Dateiname im Bericht
record-name-file-help = Sonst steht im Bericht nur die Prüfsumme der Datei: Namen können die von Patienten sein

## Was gezeichnet wird

record-drawing-report = Bericht
record-drawing-picture = Bild
record-drawing-turntable = Drehung
record-drawing-film = Reduktion, bewegt

## Was daraus wurde

record-nothing = Es gibt noch nichts zu speichern.
record-cancelled = Abgebrochen.
record-cannot-draw = Es lässt sich nicht zeichnen: { $why }.
record-not-drawn = Es wurde nicht gezeichnet: { $why }.
record-device-gone = Es wurde nicht gezeichnet: Das Grafikgerät ist weggefallen.
record-error-too-large = dieses Grafikgerät zeichnet Bilder von höchstens { $limit } Pixeln je Richtung
