### Lektionen, ihre Karte und das Glossar.

## Die Karte einer Lektion

# Steht über einem Schritt: der Titel der Lektion, und der wievielte ihrer Schritte dies ist.
lesson-place = { $title }, { $step } von { $count }
lesson-close = Lektion schließen
lesson-close-help = Die Lektion verlassen (Esc)
lesson-next = Weiter
lesson-next-help = Stellt die App für den nächsten Schritt ein
lesson-back = Zurück
lesson-back-help = Stellt sie für den Schritt davor ein
lesson-again = Neu setzen
lesson-again-help = Stellt die App ein, wie dieser Schritt sie hat
lesson-copy-link = Link kopieren
lesson-copy-link-help = Öffnet diesen Schritt für alle, die ihm folgen
# $what ist, was in einem Schritt hinter „look:“ steht, in den Lektionen unten oder in der einer Lehrkraft.
lesson-look = Im Blick: { $what }
# Darunter, solange Zahlen noch ausstehen.
lesson-measuring = Wird gemessen: die Zahlen folgen.
lesson-show-answer = Antwort zeigen
lesson-show-answer-help = Zuerst selbst antworten
# Told as a lesson is closed.
lesson-given-back = Einstellungen und Farben sind wie vor der Lektion. Rückgängig holt ihre Einstellungen zurück.
lesson-given-back-surface = { $name } ist wieder offen, mit den Einstellungen von vor der Lektion.

## Was an einer Lektion falsch ist, die eine Lehrkraft geschrieben hat

# $names sind die in Links; sie sind in allen Sprachen gleich.
lesson-no-such = Es gibt keine Lektion dieses Namens; es gibt { $names }.
lesson-not-first = Das ist keine Lektion: Ihre erste Zeile muss „{ $first }“ sein.
lesson-not-text = Das ist keine Lektion: Es ist kein Text, oder er ist zu lang.
lesson-no-step = Die Lektion hat keinen Schritt.
lesson-unknown-key = Zeile { $line } der Lektion ist nicht verständlich: „{ $key }“.
lesson-wrong-value = Zeile { $line } der Lektion: „{ $value }“ ist kein Wert für „{ $key }“.
lesson-half-question = Ein Schritt der Lektion hat eine Frage ohne Antwort oder eine Antwort ohne Frage: „{ $step }“.
lesson-settings-twice = Zeile { $line } der Lektion: „{ $name }“ steht zweimal da.
lesson-settings-unknown = Zeile { $line } der Lektion: „{ $name }“ bedeutet hier nichts.
lesson-settings-value = Zeile { $line } der Lektion: „{ $value }“ ist kein Wert für „{ $key }“.
lesson-settings-range = Zeile { $line } der Lektion ist nicht zu verwenden: { $error }.
lesson-settings-long = Zeile { $line } der Lektion: die Einstellungen sind zu lang.

## Die Lektionen

# Von jeder Lektion ihr Titel, wie das Menü ihn hat, und ihre Datei: was eine Lehrkraft schreiben könnte (docs/teaching.md). Was vor
# einem Doppelpunkt steht, die erste Zeile und die Werte von sample, settings, view, show und trial sind in allen Sprachen gleich.
# Eine Zeile, die mit zwei Leerzeichen mehr beginnt, setzt die darüber fort; keine davon darf mit einem Punkt, einem Stern oder
# einer Klammer beginnen.

lesson-stair-steps = Treppenstufen
lesson-stair-steps-text =
    lumen lesson 1
    title: Treppenstufen

    step: Was ein Scan hinterlässt
    text: Ein Scan ist ein Raster aus Kästchen. Eine Segmentierung sagt von jedem Kästchen, ob es Gefäß ist, und Marching Cubes legt
      eine Oberfläche um jene, die es sind. So besteht die Wand aus Terrassen, so hoch, wie eine Schicht dick ist.
    sample: aorta
    settings: iterations=0 reduction=0
    view: anterior
    show: raking
    look: die Terrassen quer über die Aorta, und wie sie sich an den Ästen drehen, die flach liegen.
    ask: Ist eine Terrasse eine Eigenschaft des Gefäßes oder des Scans?
    answer: Des Scans. Drehen Sie den Patienten, und die Terrassen liegen anders; das Gefäß ist dasselbe.

    step: Mit dem Filter
    text: Der Windowed-Sinc-Filter nimmt weg, was kürzer ist als die Form des Gefäßes, und lässt, was länger ist. Kein Dreieck geht
      verloren; Eckpunkte bewegen sich.
    settings: reduction=0
    view: anterior
    show: split
    look: die Linie in der linken Ansicht; ziehen Sie daran. Links davon die Oberfläche wie geöffnet, rechts davon geglättet.
    ask: Wie weit hat sich ein Eckpunkt bewegt, verglichen mit der Größe eines Voxels?
    answer: Auf dem größten Teil der Wand weniger als ein halbes Voxel: Weiter entfernt von der wahren Wand endet dort keine Terrasse.
      Farbe nach Abweichung zeigt es, mit dem Haken bei „Vom Original“.

    step: Warum es eine Simulation stört
    text: Ein Führungsdraht spürt jede Terrasse als Kante. Reibung wird verlangt, wo beim Patienten keine ist, und die
      Kontaktsuche hat ein Vielfaches der Dreiecke zu prüfen, die die Form braucht.
    settings: reduction=90
    view: anterior
    show: split
    look: das Drahtgitter; eines von zehn Dreiecken ist übrig, und die Form ist da.

lesson-nets = Zwei Wege von einer Maske
lesson-nets-text =
    lumen lesson 1
    title: Zwei Wege von einer Maske

    step: Marching Cubes
    text: Eine Maske sagt von jedem Voxel, ob es Gefäß ist. Marching Cubes legt jeden Eckpunkt auf halbem Weg zwischen ein Voxel, das
      es ist, und eines, das es nicht ist. So hat die Wand die Stufen der Voxel.
    sample: aorta
    settings: iterations=0 reduction=0
    view: anterior
    show: raking
    look: die Stufen; noch ist nichts geglättet.

    step: Surface Nets
    text: Dieselbe Maske durch Surface Nets. Jede Zelle zwischen ungleichen Voxeln hat einen Eckpunkt, der sich zu seinen Nachbarn hin
      und wieder zurück bewegt und seine Zelle nie verlässt. Die Oberfläche ist weniger rau, noch vor jedem Filter.
    sample: aorta-nets
    settings: iterations=0 reduction=0
    view: anterior
    show: raking
    look: dieselben Stellen wie zuvor.
    ask: Solches Glätten zieht eine Wand nach innen. Sind die Gefäße davon enger?
    answer: Nein. Auf jeden Schritt zu den Nachbarn hin folgt einer zurück, und das Volumen weicht um weniger als 1 % von dem durch
      Marching Cubes ab.

    step: Beide mit dem Filter
    text: Der Filter glättet die eine wie die andere Oberfläche. Hier ist jede Arterie, die von der Aorta abgeht, auf beiden Wegen
      gleich weit, auf 1 % ihres mittleren Radius genau.
    sample: aorta-nets
    settings: reduction=0
    view: anterior
    show: split
    look: die Linie in der linken Ansicht; links davon Surface Nets, wie sie sind, rechts davon mit dem Filter.
    ask: Warum beginnt Lumen mit Surface Nets, wenn eine Maske geöffnet wird?
    answer: Wegen dünner Gefäße. Der Filter schont sie, und so bleibt von ihnen fast das, womit er beginnt.

lesson-pass-band = Durchlassband
lesson-pass-band-text =
    lumen lesson 1
    title: Durchlassband

    step: Alles geht durch
    text: Eine Oberfläche lässt sich in Wellen zerlegen, wie ein Ton. Jede hat einen Eigenwert k des Laplace-Operators der Oberfläche:
      klein für lange Wellen, bis 2 für die kürzeste. Was unter dem Durchlassband liegt, bleibt. Bei 2 ist das alles.
    sample: aorta
    settings: pass-band=2 reduction=0 adapt=no guard=no
    view: anterior
    show: response
    look: die Filterantwort in Schritt 2 der Seitenleiste, eine gerade Linie bei 100 %.

    step: Nur was lang ist
    text: Bei 0,1 gehen die kürzesten Wellen verloren. Der Satz unter Stärke sagt, bis zu welcher Länge in Millimetern
      von einer Welle die Hälfte übrig ist.
    settings: pass-band=0.1 reduction=0 adapt=no guard=no
    view: anterior
    show: split
    look: die Terrassen. Was ist bei diesem Durchlassband von ihnen übrig?
    ask: Was geschieht bei 0,01: Geht weniger durch oder mehr?
    answer: Weniger. Das Durchlassband ist der größte Eigenwert, der durchgeht; ein kleineres lässt nur längere Wellen.

    step: Die Wahl der Veröffentlichung
    text: Bei 0,01 mit 100 Iterationen sind die Terrassen auf dieser Oberfläche fort, und die Kaliber bleiben bis auf etwa 3 %. Die
      Zahl hat keine Einheit: Auf einem feineren Netz bedeutet dasselbe 0,01 kürzere Wellen.
    settings: pass-band=0.01 reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: die Länge im Satz, neben dem Umfang des dünnsten Gefäßes (gepunktet in der Filterantwort).

    step: Zu weit
    text: Bei 0,001 verschwinden Wellen, die so lang sind wie der Weg um ein Gefäß: Die Nierenarterien werden zugezogen, die
      Beckenarterien verlieren die Hälfte ihres Kalibers. Das ist kein Rauschen mehr: Es ist das Gefäß.
    settings: pass-band=0.001 iterations=200 reduction=0 adapt=no guard=no
    view: anterior
    show: calibre
    look: die Farben der Äste 4 und 5, der Nierenarterien, und 1 und 7, der Beckenarterien. Die Skala zeigt Prozent ihres
      Radius.

lesson-windows = Iterationen und Fenster
lesson-windows-text =
    lumen lesson 1
    title: Iterationen und Fenster

    step: Ein Filter mit wenigen Termen
    text: Ein idealer Filter ließe alles unter dem Durchlassband durch und nichts darüber. Ein Polynom kann keinen solchen Sprung haben.
      Die Iterationen sind sein Grad: Mit 10 ist der Abfall breit, und Wellen weit über dem Durchlassband bleiben.
    sample: aorta
    settings: pass-band=0.1 iterations=10 reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: die Filterantwort in Schritt 2 der Seitenleiste. Wie breit ist der Abfall von 100 % auf nichts?
    ask: Was ändern mehr Iterationen: wie weit geglättet wird oder wie scharf?
    answer: Wie scharf Wellen unterschieden werden. Das Durchlassband sagt, wo; der Grad sagt, wie steil.

    step: Mehr Terme
    text: Mit 100 ist der Abfall steil und liegt dicht über dem Durchlassband.
    settings: pass-band=0.1 iterations=100 reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: der Punkt bei der halben Verstärkung, der sich zur gestrichelten Linie bewegt hat. Schieben Sie die Terme in der
      Filterantwort von 0 an weiter: So setzt sich die Reihe zu ihr zusammen.

    step: Das Fenster
    text: Nach so vielen Termen abgeschnitten, würde die Reihe wellig: Manche Wellen würden wachsen. Ein Fenster lässt die Terme
      auslaufen. Hamming, das der Veröffentlichung, fällt steil und ist wenig wellig; Nuttall ist am wenigsten wellig und fällt am
      wenigsten steil.
    settings: pass-band=0.1 iterations=30 window=nuttall reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: die Kurve, während Sie in Schritt 2 unter Erweitert ein Fenster nach dem anderen wählen.
    ask: Welches der vier hat beim selben Grad den steilsten Abfall?
    answer: Hamming, dann Hanning. Blackman und Nuttall sind weniger wellig und fallen weniger steil.

lesson-shrinkage = Schrumpfung
lesson-shrinkage-text =
    lumen lesson 1
    title: Schrumpfung

    step: Warum nicht einfach mitteln
    text: Jeden Eckpunkt auf das Mittel seiner Nachbarn zu setzen glättet auch, und jeder Durchgang nimmt von allen Wellen ein wenig
      weg, auch von den längsten: Ein Rohr wird dünner und am Ende ein Faden. Der Windowed-Sinc-Filter lässt die langen Wellen ganz.
    sample: aorta
    settings: reduction=0 adapt=no guard=no
    view: anterior
    show: response
    look: das Volumen im Ergebnis am Fuß der Seitenleiste; in der Filterantwort, mit dem Haken bei „Laplace daneben“, was das Mitteln
      vom dünnsten Gefäß übrig ließe.
    ask: Kann ein Filter, der lange Wellen ganz lässt, ein Gefäß trotzdem dünner machen?
    answer: Ja, wo das Gefäß selbst eine kurze Welle ist: Der Weg um es herum ist seine Wellenlänge.

    step: Ein dünnes Gefäß ist eine kurze Welle
    text: Mit einem schmaleren Durchlassband fallen die Wellen um die Nierenarterien, 19 mm lang, in das, was weggenommen wird. Diese
      verlieren Kaliber; die Aorta, deren Wellen dreimal so lang sind, behält es.
    settings: pass-band=0.006 iterations=200 reduction=0 adapt=no guard=no
    view: anterior
    show: calibre
    look: welche Äste zuerst ihre Farbe ändern.

    step: Das Volumen zurückgeben
    text: „Volumen erhalten“ schiebt die Eckpunkte entlang ihrer Normalen wieder nach außen, bis das Volumen ist, was es war, auf 0,01 %.
    settings: pass-band=0.006 iterations=200 preserve-volume=yes reduction=0 adapt=no guard=no
    view: anterior
    show: calibre
    ask: Bedeutet das richtige Volumen überall das richtige Kaliber?
    answer: Nein. Das Volumen ist eine Zahl für alle Gefäße; die Tabelle unter Gefäße hat jedes einzelne.

    step: Jedes Gefäß für sich
    text: „Dem Kaliber anpassen“ gibt jedem Eckpunkt ein eigenes Durchlassband, so breit, dass die Wellen um sein Gefäß durchgehen.
    settings: reduction=0
    view: anterior
    show: calibre vessels
    look: das Urteil über den Ansichten, und die Änderung jedes Astes in der Tabelle.

lesson-decimation = Was die Dezimierung bewahrt
lesson-decimation-text =
    lumen lesson 1
    title: Was die Dezimierung bewahrt

    step: Ein Kollaps
    text: Die Dezimierung nimmt einen Eckpunkt nach dem anderen, den billigsten zuerst. Der Eckpunkt geht zu einem Nachbarn, die Dreiecke
      an dieser Kante verschwinden, die anderen um ihn strecken sich über das Loch.
    sample: aorta
    settings: reduction=90
    show: flat collapses
    look: der Ring, also der Eckpunkt, der als nächster geht, das Loch um ihn und die Dreiecke, die es füllen werden. Gehen Sie
      Schritte zurück und vor.

    step: Wer gehen darf
    text: Schroeder hat fünf Klassen. Einfache Eckpunkte liegen in der Wand. Randpunkte gehen an ihrem offenen Ende entlang, Eckpunkte auf
      einer Formkante an dieser Kante entlang, sodass Ränder und Falten bleiben. Komplexe bleiben.
    settings: reduction=90 feature-angle=60
    view: anterior
    show: classes lines
    look: die Anzahlen neben den Farben, und die Ränder der offenen Enden.
    ask: Glatte Gefäße haben kaum Formkanten. Wo sind die Eckpunkte, die nicht einfach sind?
    answer: An den offenen Enden: Es sind Randpunkte.

    step: Was es kostet
    text: Jeder Schritt hat einen Fehler in Millimetern, und jede Reduktionsrate ist zugleich da. So lässt sich die ganze Kurve zeichnen.
    settings: reduction=98
    view: anterior
    show: deviation error
    look: „Fehler über Dreiecken“ in Schritt 3 der Seitenleiste; klicken Sie entlang der Kurve.
    ask: Von 50 % bis 90 % gehen vier von fünf Dreiecken. Wächst der Fehler auf das Fünffache?
    answer: Auf glatten Gefäßen etwa so: Der Fehler wächst mit dem Quadrat der Seite eines Dreiecks, und dieses verhält sich wie eins
      durch ihre Anzahl.

    step: Was sich nie ändert
    text: Kein offenes Ende wird geschlossen, keine zwei Gefäße werden verbunden, und kein Dreieck schneidet danach ein anderes. Ein
      Kaliber kann sich ändern: Ab 99,7 % ist ein Gefäß eingeschnürt, und das Urteil sagt, wo. Wo nichts mehr gehen darf, endet der
      Lauf.
    settings: reduction=99.9
    view: anterior
    show: flat
    look: jedes offene Ende ist noch da, mit drei oder mehr Kanten; und die Stelle, die eingeschnürt ist.

lesson-wire = Was ein Draht spürt
lesson-wire-text =
    lumen lesson 1
    title: Was ein Draht spürt

    step: Der Weg hinein
    text: Ein Führungsdraht ist ein elastischer Stab. Er wird an der Leiste vorgeschoben, biegt sich, wo die Wand ihn ablenkt, und gleitet
      unter Reibung. Die Wand besteht aus genau den Dreiecken, die gezeigt werden.
    sample: aorta
    settings: reduction=90
    view: anterior
    show: vessels
    look: die Radien in der Tabelle; ein Draht von 0,89 mm Durchmesser muss seinen Weg hindurch finden.
    ask: Wird der Draht die Wand auf dem ganzen Weg berühren oder an wenigen Stellen?
    answer: An wenigen: Er ist steif und liegt außen an den Biegungen an.

    step: Der Autopilot
    text: Der Autopilot schiebt und dreht den Draht, wie eine Hand es täte. Schubkraft ist die Kraft an der Hand, längs des Drahts.
    settings: reduction=90
    trial: autopilot
    look: Wandkraft und Schubkraft in der Seitenleiste, und die Farbe der Wand, wo sie berührt wurde.

    step: Weniger Dreiecke
    text: Dasselbe mit einem von hundert Dreiecken. Jede Facette ist eine flache Stelle mit einer Kante zur nächsten.
    settings: reduction=99
    trial: autopilot
    look: die Balken; ihre Skala ist die des Schritts davor.
    ask: Ist die Kraft auf die Wand eine andere als zuvor?
    answer: Ein Lauf sagt das nicht: Schon eine andere Reihenfolge der Dreiecke ändert sie. „Mit der unreduzierten Oberfläche
      vergleichen“ misst den Unterschied gegen dieses Rauschen.

lesson-solver = Vom Scan zum Löser
lesson-solver-text =
    lumen lesson 1
    title: Vom Scan zum Löser

    step: Leicht, aber nicht gleichmäßig
    text: Die Stufe ist leicht und lässt jedem Gefäß sein Kaliber: genug für einen Draht. Ein Strömungslöser füllt das Gefäß mit
      Tetraedern, und die sind so gut wie die Dreiecke, auf denen sie stehen.
    sample: aorta
    settings: reduction=90
    view: anterior
    look: das Drahtgitter: lange, schmale Dreiecke entlang der Gefäße.

    step: Enden für eine Strömung
    text: Jedes Ende ist senkrecht zum Gefäß geschnitten, um 5 Radien verlängert, als Rohr, das zum Kreis wird, und durch ein ebenes
      Teil mit einem Namen geschlossen. Namen und Flächen stehen in Schritt 5 der Leiste.
    sample: aorta
    settings: reduction=90
    show: solver
    look: die farbigen Enden.
    ask: Warum werden Enden verlängert?
    answer: Die Strömung, die ein Löser an einem Ende bekommt, ist nicht die des Gefäßes. In der Verlängerung wird sie dazu.

    step: Dreiecke nach dem Kaliber
    text: Um jedes Gefäß gehen 12 Kanten, sodass ein dünnes kleine Dreiecke hat und ein weites große. Keines ist weit von
      gleichseitig entfernt.
    sample: aorta
    settings: reduction=90
    show: solver
    look: das Drahtgitter, wo eine Nierenarterie die Aorta verlässt.
    ask: Ein Vieleck mit 12 Kanten liegt in seinem Kreis. Wie viel der Fläche geht verloren?
    answer: 4,5 %. Lumen bringt Ein- und Auslässe auf die Fläche zurück, die sie hatten; von der Wand erhalten mehr Kanten mehr.

## Das Glossar

# Von jedem Eintrag das Wort, ein Doppelpunkt und ein Leerzeichen, und was es bedeutet. Gezeigt wird in der Ordnung des Alphabets.

lesson-word-boundary-loop = Randschleife: Der Rand eines offenen Endes: eine geschlossene Linie aus Kanten, die je ein Dreieck haben.
lesson-word-calibre = Kaliber: Die Weite eines Gefäßes, hier der Radius des Kreises, der die Fläche seines Querschnitts hat.
lesson-word-chebyshev-polynomials = Tschebyscheff-Polynome: Die Terme, deren Summe der Filter ist. Jeder kostet einen Durchgang über die Oberfläche.
lesson-word-complex-vertex = Komplexer Eckpunkt: Ein Eckpunkt, um den die Dreiecke keine Scheibe bilden, etwa wo drei Flächen zusammenkommen. Er bleibt.
lesson-word-corner = Ecke: Ein Eckpunkt, an dem eine Formkante endet oder mehr als zwei zusammenkommen.
lesson-word-decimation = Dezimierung: Das Wegnehmen von Eckpunkten, die billigsten zuerst, und das Schließen des Lochs, das jeder hinterlässt.
lesson-word-deviation = Abweichung: Der Abstand zwischen der reduzierten und der geglätteten Oberfläche, in beiden Richtungen gemessen, in mm.
lesson-word-eigenvalue-k = Eigenwert k: Was sagt, wie kurz eine Welle auf der Oberfläche ist: 0 für die längste, 2 für die kürzeste.
lesson-word-feature-edge = Formkante: Eine Kante, deren zwei Dreiecke in der Richtung um mehr als den Kantenwinkel voneinander abweichen.
lesson-word-flip = Umklappen: Ein Dreieck dreht seine andere Seite nach außen. Kein Kollaps darf das bewirken.
lesson-word-gain = Verstärkung: Der Teil einer Welle, den der Filter lässt: 100 % im Durchlassband, darüber fast nichts.
lesson-word-half-edge-collapse = Halbkantenkollaps: Ein Eckpunkt geht dorthin, wo ein Nachbar ist; die Dreiecke an ihrer Kante verschwinden.
lesson-word-interior-edge-vertex = Innerer Kantenpunkt: Ein Eckpunkt innerhalb der Oberfläche, an dem zwei Formkanten zusammenkommen.
lesson-word-level = Stufe: Eine der Oberflächen eines progressiven Netzes, mit einer Anzahl von Dreiecken.
lesson-word-link-condition = Link-Bedingung: Zwei Eckpunkte dürfen nur dann einer werden, wenn sie keine Nachbarn gemeinsam haben außer denen gegenüber ihrer Kante. Das bewahrt die Topologie.
lesson-word-marching-cubes = Marching Cubes: Das Verfahren, das eine Oberfläche um die Voxel einer Segmentierung legt.
lesson-word-pass-band = Durchlassband: Die Eigenwerte, die durch den Filter gehen: alle unter dieser Zahl.
lesson-word-progressive-mesh = Progressives Netz: Alle Stufen eines Laufs, aus denen jede Reduktionsrate ohne einen weiteren Lauf genommen wird.
lesson-word-quadric = Quadrik: Die Summe der quadrierten Abstände von einer Menge von Ebenen, als zehn Zahlen aufbewahrt.
lesson-word-reduction-rate = Reduktionsrate: Der Teil der Dreiecke, der entfernt wird, in Prozent.
lesson-word-simple-vertex = Einfacher Eckpunkt: Ein Eckpunkt innerhalb der Oberfläche und auf keiner Formkante.
lesson-word-surface-nets = Surface Nets: Das Verfahren, das jeder Zelle zwischen ungleichen Voxeln einen Eckpunkt gibt und ihn darin glättet.
lesson-word-topology = Topologie: Welche Stücke, Löcher und offenen Enden es gibt, was immer ihre Form ist.
lesson-word-wavelength = Wellenlänge: Die Länge einer Welle auf der Oberfläche, in mm. Der Weg um ein Gefäß ist eine.
lesson-word-window = Fenster: Gewichte, die die Terme des Filters auslaufen lassen, sodass er weniger wellig ist.
