### Les barres, menus et feuilles de la fenêtre ; phrases sur l'ouverture, l'enregistrement, le partage et ce qui revient ; le bureau.

## Ce qu'est Lumen

about-not-clinical = Pas pour des décisions cliniques
app-about-purpose = Rend la surface d'un vaisseau sanguin, issue d'un scanner ou d'une IRM, assez légère pour la simulation : garde le plus grand morceau, le lisse et le réduit.
app-about-privacy = Tout se passe sur cet appareil. Aucun fichier, ni aucune partie d'un fichier, n'est envoyé où que ce soit.
app-about-method = La méthode est celle de « Mesh Optimization of Vessel Surface Model for Computer-Aided Simulation of Percutaneous Coronary Intervention ». Lissage : Taubin, Zhang et Golub (1996). Décimation : Schroeder, Zarge et Lorensen (1992) ; Garland et Heckbert (1997). Maillages progressifs : Hoppe (1996).
app-about-licence = Licence : MIT ou Apache-2.0, au choix.
app-about-letters = Police : Ubuntu Light derivative Lumen, (c) Canonical Ltd, Ubuntu Font Licence 1.0.

## The bar above

app-open = Ouvrir...
app-open-help = Une surface ou des réglages (Ctrl+O) ; ou déposer un fichier
app-open-in = Unité
app-open-units = Unité des nombres du fichier
app-open-in-help = Ouvrir un fichier dont les nombres sont dans une autre unité que le mm (glTF : m)
app-sample = Exemple
app-save = Enregistrer
# On a phone: menus of what can be saved.
app-save-surface = Surface
app-save-vessels = Vaisseaux
app-save-record = Pour le dossier
app-undo = Annuler
app-undo-help = Annuler (Ctrl+Z)
app-redo = Rétablir
app-redo-help = Rétablir (Ctrl+Maj+Z)
app-split = Partagé
app-split-help = À l'ouverture et à présent, en une seule image ; faire glisser la ligne entre les deux (R)
app-before = Avant
app-before-help = Maintenir pour voir la surface à l'ouverture (ou maintenir B)
app-prepare = Préparer
app-prepare-help = Les étapes de la méthode : garder le plus grand morceau, lisser, réduire
app-compare = Comparer
app-compare-help = Plusieurs réglages côte à côte (C)
app-trial = Essai
app-trial-help = Diriger un guide dans le niveau affiché
app-vessels = Vaisseaux
app-vessels-help = Les vaisseaux, et ce que le lissage et la réduction ont fait du calibre de chacun (V)
app-measure = Mesurer
app-measure-help = Longueurs, diamètres, sections et angles, et un plan qui coupe la surface (M)
app-view = Vue
app-view-help = D'où l'on regarde la surface, et ce qui en est montré
app-learn = Leçons
app-about = À propos
app-about-help = Ce qu'est Lumen, et sur quoi reposent ses nombres
app-help = Aide
app-help-help = Touches et gestes (F1)
app-theme = Thème
app-theme-help = Clair ou sombre (T)
app-menu = Menu
app-menu-help = Plus
app-show-before = Montrer avant
app-split-view = Vue partagée

## The menu "Save"

app-save-lengths = Longueurs en { $unit }
app-save-levels = GLB à niveaux...
app-save-levels-help = Le niveau et de plus grossiers, avec la moitié, le quart, etc. de ses triangles, pour les logiciels qui connaissent MSFT_lod de glTF
app-save-all-lengths = Longueurs en mm ; en m pour glTF
app-save-settings = Réglages...
app-save-settings-help = Pour qui a le même fichier, et pour lumen optimise --settings ; s'ouvre comme une surface
app-copy-link = Copier le lien
app-copy-link-help = Les réglages, la vue et les premiers chiffres de l'empreinte du fichier, et rien de la surface
app-whole = Ouvrir dans Lumen
app-whole-help = La même surface et les mêmes réglages dans leur propre fenêtre, avec tout le reste
app-keep-surface = Garder les surfaces ouvertes sur cet appareil
app-keep-surface-help = Le fichier ouvert, pour le prochain démarrage, dans ce navigateur ; sinon seulement son nom, les réglages et la vue
app-forget = Oublier ce qui est gardé ici
app-forget-help = Réglages, noms et surfaces gardés dans ce navigateur

## The menu "View"

app-fit = Ajuster
app-flat = Triangles plats
app-flat-help = Chaque triangle avec sa propre normale
app-raking = Lumière rasante
app-raking-help = De côté, presque le long de la paroi : les marches d'escalier et les creux ressortent (K)
app-occlusion = Occlusion ambiante
app-occlusion-help = Plus sombre là où les parois sont proches, comme dans les plis et les bifurcations ; pas quand des couleurs sont affichées
app-see-through = Fil de fer transparent
app-see-through-help = Montre les lignes cachées, faiblement
app-split-lines = Fil de fer aussi partagé
app-split-lines-help = Tant que la vue est partagée : aussi les arêtes, à l'ouverture à gauche de la ligne et à présent à droite
app-colour-deviation = Couleur selon l'écart
app-colour-deviation-help = Distance moyenne entre cette surface et la surface lissée autour de chaque sommet, dans les deux sens, en mm
app-colour-calibre = Couleur selon le calibre
app-colour-calibre-help = De combien chaque vaisseau est plus large ou plus étroit qu'à l'ouverture, en pour cent de son rayon
app-colour-classes = Couleur par classe de sommet
app-colour-classes-help = Ce pour quoi la décimation prend chaque sommet : simple, complexe, bord, arête intérieure ou coin (Schroeder 1992)
app-feature-lines = Arêtes vives, extr. ouvertes
app-feature-lines-help = Les arêtes plus vives que l'angle d'arête, telles que la décimation les a trouvées, et le bord des extrémités ouvertes
app-present = Présenter
app-present-help = Pour un projecteur : texte plus grand, les touches pressées s'affichent, le panneau est masqué (P)
app-language = Langue
app-language-system = Comme le système

## The menu "Learn"

app-lesson-help = Une leçon en quelques étapes, qui règle l'application
app-open-lesson = Ouvrir une leçon...
app-open-lesson-help = Un fichier en .lesson ; on peut aussi le déposer ici
app-collapses = Contractions, une à une
app-collapses-help = Ce que la décimation prend ensuite, où cela va et ce que cela coûte ; un clic demande pourquoi un sommet doit rester
app-playback = Animer la réduction
app-playback-help = De tous les triangles à 99,9 % de moins et retour, sans fin
app-glossary = Glossaire
app-glossary-help = Les mots de la méthode, en une phrase chacun

## The bar below

app-progress = Progression
app-cancel = Annuler
app-cancel-help = Échap
app-triangles = { $count ->
    [one] { $count } triangle
   *[other] { $count } triangles
}

## The views on a phone, and the handle of its panel

app-tab-shaded = Ombré
app-tab-shaded-help = La vue ombrée ; un balayage le long de la bande y mène aussi
app-tab-wireframe = Fil de fer
app-tab-wireframe-help = La vue en fil de fer
app-panel-low = Hauteur du panneau : basse
app-panel-half = Hauteur du panneau : moyenne
app-panel-full = Hauteur du panneau : pleine
# Name of a panel's edge, which is dragged to resize it; for assistive tools.
app-panel-edge = Taille du panneau
# On the handle of a panel that is folded away.
app-panel-folded = Curseurs
app-panel-help = Le faire glisser vers le haut ou le bas ; un appui ou une touche fléchée passe à la hauteur suivante

## Over the sample, until a file is opened

# Followed by a button with the next message; they read as one sentence.
app-invite-drop = Déposer un vaisseau ici, ou
app-invite-open = en ouvrir un
# On the button where a finger points, which drops nothing.
app-invite-open-alone = Ouvrir un vaisseau
app-invite-open-help = Choisir un fichier : rien ne quitte cette machine
# For assistive tools, and its tooltip.
app-invite-close = Fermer l'invitation
app-invite-close-help = L'exemple reste ouvert

## The sheet of keys

app-keys = Touches et gestes
app-close = Fermer
app-touch-one = Un doigt
app-touch-two = Deux doigts
app-touch-two-does = Déplacer, pincer pour zoomer
app-touch-double = Double appui
# Above the keys, where what stands before is for fingers.
app-keys-keyboard = Avec souris et clavier
app-key-drag = Glisser
app-key-drag-does = Tourner
app-key-move = Maj ou bouton droit + glisser, deux doigts
app-key-move-does = Déplacer
app-key-zoom = Molette, pincer
app-key-zoom-does = Zoomer vers le pointeur
app-key-arrows = Flèches, + et -
app-key-arrows-does = Tourner et zoomer
app-key-fit = F, double clic
app-key-fit-does = Ajuster à la vue
app-key-sides = 1 à 6
app-key-sides-does = Antérieur, postérieur, gauche, droite, supérieur, inférieur
app-key-before = B ou Espace, maintenu
app-key-before-does = La surface à l'ouverture
app-key-split = R
app-key-split-does = À l'ouverture et à présent, en une seule image ; faire glisser la ligne
app-key-left-out = L
app-key-left-out-does = Montrer ce qui est omis ; cliquer sur un morceau pour le garder
app-key-deviation = D
app-key-deviation-does = Couleur selon l'écart
app-key-raking = K
app-key-raking-does = Lumière de côté, qui montre les marches d'escalier
app-key-vessels = V
app-key-vessels-does = Les vaisseaux et ce qu'est devenu leur calibre
app-key-measure = M
app-key-measure-does = Mesurer, et couper la surface ; Entrée mesure au milieu de la vue
app-key-compare = C
app-key-compare-does = Comparer plusieurs réglages ; Entrée prend ceux de la case choisie
app-key-compare-first = X, maintenu
app-key-compare-first-does = Dans la comparaison : les premiers réglages dans chaque case
app-key-present = P
app-key-present-does = Présenter : texte plus grand, touches affichées, sans panneau
app-key-open = Ctrl+O
app-key-open-does = Ouvrir
app-key-save = Ctrl+S
app-key-save-does = Enregistrer en STL
app-key-undo = Ctrl+Z
app-key-undo-does = Annuler
app-key-redo = Ctrl+Maj+Z, Ctrl+Y
app-key-redo-does = Rétablir
app-key-escape = Échap
app-key-escape-does = Fermer ce qui est au-dessus, annuler, quitter la comparaison
app-key-theme = T
app-key-theme-does = Clair ou sombre
app-key-tab = Tab
app-key-tab-does = Commande suivante ; flèches, Page préc., Page suiv., Début et Fin déplacent un curseur
app-key-sheet = F1
app-key-sheet-does = Cette liste

## The same while a trial is shown

app-trial-key-feed = W et S, haut et bas
app-trial-key-feed-does = Avancer et retirer le guide
app-trial-key-roll = A et D, gauche et droite
app-trial-key-roll-does = Le tourner à gauche et à droite
app-trial-key-faster = Maj avec celles-ci
app-trial-key-faster-does = Plus vite
app-trial-key-gamepad = Manette (dans un navigateur)
app-trial-key-gamepad-does = Le stick gauche avance, le droit tourne
app-trial-key-autopilot = G
app-trial-key-autopilot-does = Autopilote
app-trial-key-fluoroscopy = Espace
app-trial-key-fluoroscopy-does = Radioscopie : marche ou arrêt
app-trial-key-enlarge = F
app-trial-key-enlarge-does = La radioscopie en grande image, et retour
app-trial-key-contrast = C
app-trial-key-contrast-does = Un bolus de produit de contraste
app-trial-key-arm = 1 à 4
app-trial-key-arm-does = Arceau : face, OAG 45, profil, OAD 30
app-trial-key-turn-arm = Glisser dans la radioscopie
app-trial-key-turn-arm-does = Tourner l'arceau
app-trial-key-magnify = Molette, pincer à cet endroit
app-trial-key-magnify-does = Agrandir
app-trial-key-restart = R
app-trial-key-restart-does = Relancer
app-trial-key-pause = P
app-trial-key-pause-does = Pause
app-trial-key-back = Z
app-trial-key-back-does = Une seconde en arrière
app-trial-key-slow = M
app-trial-key-slow-does = Ralenti
app-trial-key-escape = Échap
app-trial-key-escape-does = Fermer ce qui est au-dessus, en dernier l'essai
app-trial-key-view = Glisser, molette dans la vue du vaisseau
app-trial-key-view-does = Tourner, zoomer
app-trial-key-sheet = F1
app-trial-key-sheet-does = Cette liste

## Opening

app-open-failed = { $name } : { $why }
app-open-failed-kept = { $name } : { $why } Ce qui était ouvert l'est toujours.
app-not-opened-again = La surface n'a pas pu être rouverte.
app-opening-cancelled = L'ouverture a été annulée.
app-opening-cancelled-kept = L'ouverture a été annulée ; ce qui était ouvert l'est toujours.
# $percent: less than 90.
app-told-again = { $text } ({ $count } fois)
app-open-next = Ouvrir le suivant
app-open-next-help = Ouvrir le suivant des fichiers arrivés ensemble, à la place de celui-ci
app-take-away = Fermer
app-take-away-help = Retirer ce message
app-others = { $rest ->
    [0] { $next } est arrivé avec lui.
    [1] { $next } et un autre sont arrivés avec lui.
   *[other] { $next } et { $rest } autres sont arrivés avec lui.
}
app-gone-back = Réduit de { $percent } % : davantage ne serait pas sûr.
app-gone-back-kept = Réduit de { $percent } % : davantage ne garderait pas le calibre là où il est mesuré.
app-gone-back-pinched = Réduit de { $percent } % : davantage pincerait un vaisseau.
app-scan-cancelled = Annulé ; le scan n'a pas été ouvert.

## Work that ends before it is done

app-cancelled = Annulé.
app-cancelled-result-stands = Annulé ; le dernier résultat reste.
app-computation-stopped = Le calcul s'est arrêté.
app-engine-stopped = Le calcul s'est arrêté ({ $reason }).
app-engine-keeps-stopping = Le calcul s'arrête sans cesse ({ $reason }).
app-engine-try-again = Ce qui est affiché est toujours là et peut être enregistré ; changer un réglage ou ouvrir un fichier pour réessayer.
app-engine-memory = Le programme de bureau a plus de mémoire.
app-engine-stopped-opening = { $name } n'a pas pu être ouvert : le calcul s'est arrêté ({ $reason }).
app-engine-restarted = Le calcul s'est arrêté ({ $reason }) et a été relancé.
app-nothing-lost = Rien n'a été perdu.
app-thread-ended = son fil d'exécution est terminé
app-reason-unknown = pour une raison inconnue
app-graphics-restarted = L'affichage graphique a été interrompu et relancé. Rien n'a été perdu.

## Saving

app-nothing-to-save = Il n'y a encore rien à enregistrer.
app-not-saved = { $name } n'a pas été enregistré : { $why }
app-save-again = { $name } n'a pas été enregistré : l'enregistrer à nouveau.
app-saved = { $name } a été enregistré.
app-not-written = { $name } n'a pas pu être écrit : { $error }.
app-pair-saved = { $first } et { $second } ont été enregistrés dans { $folder }.
app-pair-there-already = Rien n'a été enregistré : { $name } existe déjà. Choisir un autre nom.
app-pair-not-written = Rien n'a été enregistré : { $name } n'a pas pu être écrit : { $error }.

## Presenting

app-presenting = Présentation : texte plus grand, touches affichées, du panneau seuls les curseurs. P ou Échap y met fin.

## Settings for others

app-settings-taken = Les réglages de { $name } sont en vigueur.
app-measures-of-other = Ses mesures appartiennent à une autre surface et ont été omises.
app-measures-too-early = Ses mesures ont été omises : l'ouvrir à nouveau une fois la surface lue dans son unité.
app-measures-shown = Ses mesures sont affichées.
app-measures-not-saved = Les mesures ne sont pas avec les réglages : cette surface n'a pas de fichier auquel la reconnaître.
app-link-copied-file = Le lien a été copié. Il contient les réglages et les premiers chiffres de l'empreinte du fichier, et rien de la surface : pour l'ouvrir, il faut le même fichier.
app-link-copied-sample = Le lien a été copié. Il contient les réglages et dit pour quel exemple ils sont.
app-link-nothing = Il n'y a encore rien vers quoi un lien pourrait mener.
app-link-fewer = Cet exemple a moins de triangles que de lui-même : aucun lien n'y mène. Ouvrez la page sans ?samples=.
app-step-link-copied = Le lien vers cette étape a été copié.
app-link-taken = Les réglages du lien sont en vigueur.
app-link-same = C'est bien ce à quoi le lien appartient : la même chose est affichée.
app-link-other-file = Ce fichier n'est pas celui du lien : son SHA-256 commence par { $opened }, et non par { $wanted }. Les réglages sont ceux du lien.
app-link-needs-file = Ce lien appartient à un fichier dont le SHA-256 commence par { $digits } ; l'ouvrir montrera la même chose.

## Why a link or a file of settings was not taken

app-link-long = Le lien est plus long que tous ceux que Lumen fait : il a { $bytes } octets.
app-link-newer = Le lien a été fait par un Lumen plus récent : sa version est { $found }, et ce Lumen lit { $known }.
app-link-missing = Le lien n'est pas complet : il ne dit pas « { $pair } ».
app-link-twice = Le lien dit deux fois « { $pair } ».
app-link-unknown = Le lien dit « { $pair } », ce qui ne signifie rien ici.
app-link-value = Le lien est illisible : « { $value } » n'est pas une valeur pour « { $key } ».
app-link-range = Le lien est inutilisable : { $why }.
app-settings-none = Ce n'est pas un fichier de réglages de Lumen.
app-settings-newer = Ces réglages ont été écrits par un Lumen plus récent : leur version est { $found }, et ce Lumen lit jusqu'à { $known }.
app-settings-field = Les réglages sont illisibles : { $why }.
app-settings-range = Les réglages sont inutilisables : { $why }.
app-measures-unsound = Les mesures ne peuvent pas être affichées : il y en a trop, ou l'un de leurs nombres n'en est pas un.

## What was measured, and on what

app-measure-diameter = { $mm } mm de diamètre
app-measure-section = { $area } mm², { $least } à { $largest } mm de large, cercle équivalent { $round } mm
app-measured-opened = À l'ouverture
app-measured-opened-vessel = À l'ouverture, { $vessel }
app-measured-opened-fork = À l'ouverture, { $vessel }, à une bifurcation
app-measured-level = { $count ->
    [one] Sur { $count } triangle
   *[other] Sur { $count } triangles
}
app-measured-level-vessel = { $count ->
    [one] Sur { $count } triangle, { $vessel }
   *[other] Sur { $count } triangles, { $vessel }
}
app-measured-level-fork = { $count ->
    [one] Sur { $count } triangle, { $vessel }, à une bifurcation
   *[other] Sur { $count } triangles, { $vessel }, à une bifurcation
}

## What comes back at the next start

app-file-back = { $name } est de retour, avec les réglages et la vue d'avant.
app-settings-back = Les réglages et la vue sont comme avant.
app-file-before = { $name } était ouvert auparavant. L'ouvrir à nouveau : les réglages sont comme avant, et la vue le sera.
app-file-before-given-up = { $name } était ouvert auparavant. Le programme s'est terminé deux fois pendant son ouverture ; il n'est donc plus gardé ici. L'ouvrir à nouveau : les réglages sont comme avant, et la vue le sera.
app-surfaces-kept = Chaque fichier de surface ouvert désormais est gardé sur cet appareil pour le prochain démarrage, à la place du précédent.
app-surfaces-kept-and-this = { $name }, puis chaque fichier de surface ouvert ensuite, est gardé sur cet appareil pour le prochain démarrage, à la place du précédent.
app-surfaces-not-kept = Plus aucune surface n'est gardée sur cet appareil.
app-forgotten = Tout ce qui était gardé sur cet appareil est oublié : réglages, noms et surfaces. Rien n'est gardé avant l'ouverture d'une autre surface.

## The desktop

app-dialog-opened = Surfaces, scans, journaux et réglages
app-dialog-all = Tous les fichiers
app-no-file = Aucun fichier n'a été choisi.
app-not-read = { $name } n'a pas pu être lu : { $error }.
app-no-scans = Cette version de Lumen a été construite sans scans ni masques (feature scans).
app-folder-empty = Il n'y a aucun fichier dans le dossier.
app-scan-not-found = { $name } est illisible : { $error }.
app-scan-file-gone = Un fichier du scan n'est plus là.
app-scan-file-not-read = Un fichier du scan est illisible : { $error }.
app-graphics-keep-failing = L'affichage graphique échoue sans cesse sur cette machine. Ce qui était ouvert est toujours là.
app-try-again = Réessayer
app-virtual-device = Appareil virtuel
app-devices-not-listed = le système ne donne pas la liste de ses appareils : { $error }
app-device-not-opened = { $name } ne peut pas être ouvert : { $error } (sous Linux, il faut une règle udev, voir docs/haptics.md)
app-haply-not-there = le service de Haply ne répond pas sur cet ordinateur ({ $address }) : le démarrer, puis choisir l'appareil à nouveau ({ $error })
app-haply-no-arm = le service de Haply n'a pas d'Inverse3 : le brancher, puis choisir l'appareil à nouveau

## La réduction, de tous les triangles au plus petit nombre et retour

app-playback-play = Lire
app-playback-pause = Pause
app-playback-play-help = De tous les triangles à 99,9 % de moins et retour ; la même part de moins à chaque seconde
app-playback-period = aller et retour
app-playback-period-help = Combien de temps cela prend, en secondes
app-playback-level = { $count ->
    [one] { $percent } % : { $count } triangle
   *[other] { $percent } % : { $count } triangles
}
app-playback-save = Enregistrer (APNG)...
app-playback-save-help = La même chose en image animée, vue d'où la vue regarde à présent
app-playback-close = Fermer
app-playback-close-help = Ferme ; la réduction d'avant revient
