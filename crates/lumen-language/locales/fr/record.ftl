### Ce qui sort de l'application pour le dossier : rapports, images et rotations.

## Entrées du menu d'enregistrement

record-report = Rapport...
record-report-help = Une page pour le dossier : verdict, valeurs, réglages, vaisseaux, images et courbes
record-picture = Image (PNG)
record-pixels = { $count } pixels...
record-pixels-help = Le plus long côté de l'image
record-clear = Fond transparent
record-clear-help = Rien derrière la surface, pour la poser sur autre chose
record-turntable = Rotation (APNG)...
record-turntable-help = La surface fait un tour, en image animée ; les couleurs sont celles de la vue
record-video = Rotation en vidéo (WebM)...
record-video-help = Un tour de la surface, pour des diapositives ; il est enregistré pendant qu'il passe, en 4 s environ
record-no-video = Le navigateur n'a pas pu enregistrer la vidéo.

## Un graphique en fichier

record-plot = Enregistrer le graphique : { $title }
record-plot-help = En fichier, pour des diapositives ou un article
record-plot-svg = En image vectorielle (SVG)...
record-plot-svg-help = Nette à toute taille ; les mots restent du texte
record-plot-png = En image (PNG)...
record-plot-png-help = 1920 pixels de large
record-figure = Image...
record-figure-help = Le tout en une image pour des diapositives ou un article (PNG), 2400 pixels de large
record-figure-title = Lissage et réduction comparés

## La feuille du rapport

record-said-kept = Cas et remarque ne figurent que dans le rapport. Lumen les oublie dès qu'une autre surface est ouverte.
record-report-pdf = Enregistrer en PDF...
record-report-pdf-help = À imprimer
record-report-html = Enregistrer en page web...
record-report-html-help = La même chose en un fichier pour navigateur, qui n'a besoin de rien d'autre
record-report-surface = Enregistrer comme page web avec la surface…
record-report-surface-help = La même page ; la surface peut y être tournée, sur tout appareil, sans Lumen
record-name-file = Nom du fichier au rapport
record-name-file-help = Sinon, le rapport ne porte que l'empreinte du fichier : un nom peut être celui d'un patient

## Ce qui est en cours de dessin

record-drawing-report = Rapport
record-drawing-picture = Image
record-drawing-turntable = Rotation
record-drawing-film = Réduction animée

## Ce qu'il en est advenu

record-nothing = Il n'y a encore rien à enregistrer.
record-cancelled = Annulé.
record-cannot-draw = Dessin impossible : { $why }.
record-not-drawn = Le dessin n'a pas abouti : { $why }.
record-device-gone = Le dessin n'a pas abouti : le périphérique graphique a disparu.
record-error-too-large = ce périphérique graphique dessine des images d'au plus { $limit } pixels dans chaque sens
