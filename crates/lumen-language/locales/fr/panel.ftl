### The panel beside the views: the steps of the method with their settings, and the result in numbers. It is 296 points
### wide: a name on the left shares its row with a value or a list on the right.

## Controls

# Beside a field that holds a number.
panel-type = Glisser, ou cliquer et saisir
# For assistive tools: the field beside the slider $name.
panel-value = { $name } : valeur
# On the button that sets a value back; $unit begins with a space, where there is one.
panel-back-to = Revenir à { $value }{ $unit }
# For assistive tools: $name is "pass band".
panel-reset = Réinitialiser : { $name }

# On a button: goes to a place in the view, or marks places there.
panel-show = Voir
# On a button: sets what was found.
panel-go-there = Appliquer
# The head of what is folded up in a step.
panel-advanced = Avancé
panel-advanced-help = Ce qu'il faut rarement régler autrement
# For assistive tools: $step is "Smooth" or "Reduce".
panel-advanced-of = Avancé : { $step }

## Step 1: the surface

panel-surface = Surface
panel-surface-does = Le plus grand morceau d'un seul tenant est gardé.
panel-surface-none = Ouvrir une surface, ou déposer un fichier ici.
# Beside the name of step 1 while it is folded: keep it short.
panel-surface-to-mend = à réparer
panel-in-file = Triangles du fichier
panel-in-file-help = Tels que le fichier les contient, polygones découpés
panel-kept = Gardés
panel-triangle-count = { $count ->
    [one] { $count } triangle
   *[other] { $count } triangles
}
panel-left-out = Omis
panel-left-out-help = Morceaux qui n'ont aucun sommet commun avec celui qui est gardé
# $count triangles.
panel-left-out-count = { $pieces ->
    [one] { $count } en { $pieces } morceau
   *[other] { $count } en { $pieces } morceaux
}
panel-show-left-out = Montrer ce qui est omis
panel-show-left-out-help = Cliquer sur un morceau dans la vue pour garder celui-là ; avec Maj ou Ctrl pour l'ajouter ou l'enlever
panel-unit = Unité du fichier
panel-unit-help = Ce que signifie une longueur de 1 dans le fichier
# For assistive tools: the list of units.
panel-unit-list = Unité
panel-all-pieces = Tous les morceaux
# In place of a list of them: from 2 to 16.
panel-pieces = { $count } morceaux
panel-piece-add = Garde aussi ce morceau, ou plus
# For assistive tools: $piece is "1,234 triangles, 56.7 mm".
panel-piece-keep = Garder le morceau de { $piece }
# A piece in a list.
panel-piece = { $count ->
    [one] { $count } triangle, { $size } mm
   *[other] { $count } triangles, { $size } mm
}
# For assistive tools: the list of pieces.
panel-piece-list = Morceau

## Step 1: the axes of the file

panel-axes = Axes du fichier
panel-axes-help = Vers où croissent les coordonnées : gauche, postérieur, supérieur (LPS, comme dans DICOM) ou droite, antérieur, supérieur (RAS)
panel-axes-unknown = Inconnus
# Before the choice of axes in the menu of files, and for assistive tools the list in the panel.
panel-axes-list = Axes
panel-axes-written-help = Vers où croissent les coordonnées des surfaces enregistrées ; les fichiers qui ont une place pour cela l'indiquent, comme 3D Slicer l'écrit
panel-axes-unknown-help = Le fichier n'indique pas l'orientation de ses axes : la choisir à l'étape 1, ils pourront ensuite être tournés
# On a narrow button beside LPS and RAS: saved surfaces keep their axes.
panel-axes-kept = Inchangés
panel-axes-save-kept = Enregistrer sans changer les axes
# $axes is LPS or RAS.
panel-axes-save = Enregistrer en { $axes }

## Step 1: the arrays of the file

panel-colour = Couleur selon
panel-colour-help = Ce que le fichier dit de ses sommets et triangles, dans la vue ombrée
panel-colour-none = Rien
# An array of a file: its $name in the file, and $kind the type of its numbers, such as uint8. $on is "vertices" or "triangles".
panel-array-identifiers = { $on ->
    [vertices] { $name } : étiquettes sur sommets, { $kind }
   *[triangles] { $name } : étiquettes sur triangles, { $kind }
}
panel-array-labels = { $on ->
    [vertices] { $name } : { $count ->
        [one] { $count } étiquette sur sommets
       *[other] { $count } étiquettes sur sommets
    }, { $kind }
   *[triangles] { $name } : { $count ->
        [one] { $count } étiquette sur triangles
       *[other] { $count } étiquettes sur triangles
    }, { $kind }
}
panel-array-scalar = { $on ->
    [vertices] { $name } : scalaire sur sommets, { $kind }
   *[triangles] { $name } : scalaire sur triangles, { $kind }
}
panel-array-components = { $on ->
    [vertices] { $name } : { $count } composantes sur sommets, { $kind }
   *[triangles] { $name } : { $count } composantes sur triangles, { $kind }
}
# $array is one of the messages above.
panel-array-range = { $array }, de { $least } à { $most }
# Below the labels that the legend of an array names.
panel-labels-more = et { $count } de plus

## Step 1: mending

panel-mending = Réparation
panel-faults-sought = Le fichier est examiné...
panel-faults-none = Rien à réparer n'a été trouvé.
panel-holes = Trous
panel-holes-help = Ouvertures de la paroi où aucun vaisseau ne se termine
panel-holes-count = { $count }, jusqu'à { $size } mm
# Edges of more than two triangles.
panel-edges = Arêtes multiples
panel-edges-help = Arêtes de plus de deux triangles : la surface n'y est pas une variété
panel-points = Points de contact
panel-points-help = Sommets où des parties de la surface se touchent en un point : elle n'y est pas une variété
panel-ends = Extrémités ouvertes
panel-ends-help = Où des vaisseaux se terminent : elles restent ouvertes
# On a button: goes to the next place.
panel-fault-next = Suivant
panel-fault-show-help = Les marque dans la vue et va de l'un à l'autre
# For assistive tools: $faults is "holes", "crowded edges", ...
panel-fault-next-of = Suivant : { $faults }
panel-fault-show = Voir : { $faults }
panel-wall = Paroi à deux faces
panel-wall-help = La surface est une paroi à deux faces, l'une externe et l'autre interne : le sang est dans l'interne
panel-wall-thickness = { $thickness } mm d'épaisseur
panel-dropped = Triangles supprimés
panel-dropped-help = Triangles à sommet répété ; réparés à la lecture
panel-double = Triangles doubles
panel-double-help = Triangles sur les trois mêmes sommets qu'un autre
panel-turned = Triangles retournés
panel-turned-help = Retournés à la lecture pour s'accorder avec leurs voisins
panel-turned-pieces = Morceaux retournés
panel-turned-pieces-help = Morceaux dont l'intérieur était dehors ; retournés à la lecture du fichier
# What is said of a place that the view goes to.
panel-edge-place = Arête multiple
panel-point-place = Point de contact
panel-hole-place = Trou de { $size } mm
panel-end-place = Extrémité ouverte de { $size } mm
# Ticked, and followed by a field with a length.
panel-fill = Combler trous jusqu'à
panel-fill-help = Ferme les trous des parois larges d'autant au plus ; les extrémités des vaisseaux restent ouvertes
panel-weld = Souder les arêtes à
panel-weld-help = Joint les arêtes libres qui se touchent presque. Rien ne s'effondre : là où les triangles sont aussi petits, la tolérance est réduite
panel-split = Séparer les arêtes multiples
panel-split-help = Sépare les feuillets qui partagent une arête ou se touchent en un point, et supprime les triangles doubles
panel-lumen = Prendre la lumière
panel-lumen-help = D'une paroi à deux faces : garde l'interne, coupée aux bords, comme limite du sang
# What was mended, in a list with commas.
panel-mended-welded = { $count ->
    [one] { $count } sommet soudé
   *[other] { $count } sommets soudés
}
panel-mended-edges = { $count ->
    [one] { $count } arête séparée
   *[other] { $count } arêtes séparées
}
panel-mended-vertices = { $count ->
    [one] { $count } sommet séparé
   *[other] { $count } sommets séparés
}
panel-mended-double = { $count ->
    [one] { $count } triangle double omis
   *[other] { $count } triangles doubles omis
}
panel-mended-holes = { $count ->
    [one] { $count } trou comblé
   *[other] { $count } trous comblés
}
panel-mended-wall = { $count ->
    [one] { $count } triangle de la paroi omis
   *[other] { $count } triangles de la paroi omis
}

## Step 2: smoothing

panel-smooth = Lisser
panel-smooth-does = Enlève les marches d'escalier du scan.
panel-strength = Intensité
panel-strength-help = Adapté à la surface : comme l'article, mais nulle part au point qu'un vaisseau perde son calibre ou que des triangles se croisent. De l'article : bande passante 0,01, 100 itérations, partout les mêmes.
# Settings of one's own, in the list of the strength.
panel-strength-own = Autre
panel-pass-band = Bande passante
panel-pass-band-help = Ce qui passe le filtre : 0,001 ne laisse que la forme générale, 2 laisse tout. Sans unité.
panel-iterations = Itérations
panel-iterations-help = Degré du filtre : plus il est élevé, plus la coupure est nette. 0 désactive le lissage.
# The window function of the filter.
panel-window = Fenêtre
panel-window-help = Fonction de fenêtrage du filtre. Hamming est celle de l'article ; Nuttall ondule le moins.
panel-adapt = Adapter au calibre
panel-adapt-help = Lisse moins les vaisseaux fins, pour que chacun garde son calibre. La bande passante est celle des vaisseaux larges.
panel-guard = Sans croisement
panel-guard-help = Lisse moins où des triangles en traverseraient d'autres : aux plis, entre les vaisseaux.
panel-hold-caps = Garder les bouchons
panel-hold-caps-help = Les bouts plats des vaisseaux fermés restent plats et gardent leur surface : entrées et sorties d'un écoulement.
panel-volume-held = Préserver le volume
panel-volume-held-help = Rend ce que le lissage enlève, là où il l'enlève : extrémités ouvertes bouchées, à 0,01 % près.
panel-smoothed-less = { $count ->
    [one] Moins lissé à { $count } sommet : sans croisement.
   *[other] Moins lissé à { $count } sommets : sans croisement.
}
panel-smoothed-less-help = Va là où c'est le moins lissé
# What is said of the place that the view goes to.
panel-smoothed-less-place = Moins lissé

## Step 2: the settings that have a name

panel-preset-auto = Adapté à la surface
panel-preset-paper = De l'article
panel-preset-none = Aucun

## Step 2: the response of the filter

# $k is the eigenvalue, $length a length with its unit.
panel-half-gain = Demi-gain à k = { $k } : ondes de { $length } ; les plus courtes sont lissées.
panel-half-gain-adapted = Demi-gain à k = { $k } : ondes de { $length } ; les plus courtes disparaissent, moins dans les vaisseaux fins.
panel-half-gain-bare = Demi-gain à k = { $k }.
panel-half-gain-none = Rien n'est lissé : tout passe.
panel-response = Réponse
panel-response-help = Combien il reste d'une onde sur la surface, selon sa longueur
panel-response-length = Longueur d'onde, mm
panel-response-eigenvalue = Valeur propre k
# Beside lines and points of the picture.
panel-response-thinnest = le plus fin mesuré : { $length }
panel-response-pass-band = bande passante
panel-response-half = moitié
# Beside the pointer, in two lines.
panel-response-at =
    { $length } : il reste { $percent } %
    k = { $k }
panel-response-at-bare =
    il reste { $percent } %
    k = { $k }
panel-wave = Onde
panel-wave-help = Sa longueur sur la surface ; glisser ici ou sur la courbe
# $wave is a length with its unit, or "k = 0.0234".
panel-wave-left = D'une onde de { $wave }, il reste { $percent } %.
panel-wave-left-thinnest = Autour du vaisseau mesuré le plus fin, { $length } : { $percent } %.
panel-wave-left-thinnest-adapted = Autour du vaisseau mesuré le plus fin, { $length } : { $percent } %, davantage grâce à l'adaptation.
panel-windows = Fenêtres côte à côte
panel-windows-help = Les trois autres, à même bande passante et mêmes itérations
panel-windows-drawn = Traits fins : les autres dans l'ordre de la liste, en tirets, en pointillé, en longs tirets.
panel-laplacian = Laplacien à côté
panel-laplacian-help = Ce qui resterait si chaque sommet allait à la moyenne de ses voisins, autant de fois qu'il y a d'itérations
panel-laplacian-seen = Aussi dans l'image
panel-laplacian-seen-help = Dans la vue partagée, à gauche, ce qu'autant de passes laplaciennes font de la surface : les vaisseaux fins rétrécissent
panel-laplacian-left = { $passes ->
    [one] Rouge : { $passes } passe laplacienne, λ = { $factor } : il reste { $percent } % de l'onde.
   *[other] Rouge : { $passes } passes laplaciennes, λ = { $factor } : il reste { $percent } % de l'onde.
}
# Diameters with their unit: as it is, after Laplacian smoothing, after windowed-sinc smoothing.
panel-laplacian-thinnest = Le vaisseau le plus fin, { $whole }, passe à { $laplacian } ; par sinus cardinal fenêtré à { $sinc }.
panel-laplacian-thinnest-adapted = Le vaisseau le plus fin, { $whole }, passe à { $laplacian } ; par sinus cardinal fenêtré à { $sinc } (davantage grâce à l'adaptation).
# The terms of the Chebyshev series.
panel-terms = Termes
panel-terms-help = La série de Tchebychev jusqu'à ce terme, en courbe fine ; le dernier est celui des itérations
panel-terms-drawn = Ligne fine : termes 0 à { $last } sur { $iterations }, jusqu'à { $percent } % d'écart à la série entière.

## Step 3: the reduction

panel-reduce = Réduire
panel-reduce-does = Enlève ce qui compte le moins ; la topologie reste.
panel-stop = Limite
panel-stop-help = Ce qui dit jusqu'où va la réduction
panel-stop-deviation = Écart
panel-stop-rate = Taux ou nombre
panel-bound = Écart maximal
panel-bound-help = Aussi peu de triangles que possible, à cette distance au plus de la surface lissée, partout et dans les deux sens.
panel-next-coarser = Niveau plus grossier
panel-next-coarser-help = Un écart trouvé dans le niveau plus grossier d'un pas
# There is no coarser level.
panel-next-coarser-none = aucun
panel-reduction = Réduction
panel-reduction-help = La part des triangles qui est enlevée.
panel-back-to-auto = Revenir à automatique
# Behind the name of a rate that is set by itself, in brackets: keep it short.
panel-auto-short = auto
panel-auto = Automatique : 90 %, ou le taux sûr
# $percent is the rate that was come to: at most 90.
panel-auto-most = Automatique : { $percent } %
panel-auto-safe = Automatique : { $percent } %, le taux sûr
panel-auto-kept = Automatique : { $percent } %, gardé où c'est mesuré
panel-auto-pinched = Automatique : { $percent } %, aucun pincé
panel-auto-deciding = Automatique : recherche du taux sûr
panel-auto-help = Réduit de 90 %, ou tant que chaque vaisseau garde son calibre à { $tolerance } % près et qu'aucun n'est pincé, selon ce qui est moindre. Le curseur fixe un nombre à la place.
# Followed by a rate: reduction up to it changes no vessel too much.
panel-safe = Sûr jusqu'à
panel-safe-help = Jusqu'ici, chaque vaisseau mesurable garde son calibre à { $tolerance } % près, aucun n'est pincé, et aucun triangle n'en croise d'autres sans l'avoir déjà fait.
# $why is a part of a sentence.
panel-safe-refused = Il n'y a pas de tel taux ici : { $why }.
panel-kept-to = Gardé jusqu'à
panel-safe-rests = Mesuré à { $percent } % sur { $coverage } ; le verdict porte sur le niveau montré.
panel-safe-rests-at = Réduit de { $percent } % : sur { $coverage }
panel-safe-changed = Les branches que le lissage lui-même change davantage ne comptent pas : { $count }.
panel-safe-go-help = Place la réduction à la marque sous le curseur
panel-wanted = Triangles voulus
panel-wanted-help = La même chose en nombre ; glisser, ou cliquer et saisir
panel-method = Méthode
panel-method-help = Schroeder est celle de l'article : elle supprime des sommets et n'en déplace aucun. Quadric les déplace : moitié moins d'écart moyen, meilleure forme.
panel-feature-angle = Angle d'arête
panel-feature-angle-help = Les arêtes plus vives que cet angle restent des arêtes.
panel-spare-thin = Ménager les vaisseaux fins
panel-spare-thin-help = Une erreur compte d'autant plus que le vaisseau est fin : les fins gardent plus de triangles, les larges moins.
panel-keep-labels = Garder les limites
panel-keep-labels-help = Les arêtes entre deux étiquettes des tableaux du fichier restent des arêtes : les sommets ne se déplacent que le long d'elles

## Step 3: the error against the triangles

panel-error = Erreur selon les triangles
panel-error-help = Ce que coûte chaque taux sur cette surface, d'après son unique maillage progressif
panel-error-mm = Erreur, mm
# Beside lines of the picture.
panel-error-now = ici
panel-error-safe = sûr
panel-error-kept = gardé
panel-error-is = { $count ->
    [one] Erreur selon les triangles : { $error } mm à { $count } triangle
   *[other] Erreur selon les triangles : { $error } mm à { $count } triangles
}
panel-error-schroeder = Erreur : celle de la méthode, qui ordonne ses pas. Moyenne quadratique de la distance aux plans que représentait un sommet ; sur les arêtes et extrémités ouvertes, au moins celle à leur ligne. Ce n'est pas une borne : les points sont mesurés.
panel-error-quadric = Erreur : celle de la méthode, qui ordonne ses pas. Moyenne quadratique de la distance du nouveau sommet aux plans qu'il représente. Ce n'est pas une borne : les points sont mesurés.
panel-error-other = Gris : { $method }, de la même surface.
panel-error-other-none = { $method } apparaît à côté une fois choisie : il faut un calcul à part.
# Beside the pointer, in three lines; $curve is what the curve is of.
panel-error-at =
    { $curve }
    { $error } mm à { $count ->
        [one] { $count } triangle
       *[other] { $count } triangles
    }
    Cliquer pour y aller

## The result

panel-result = Résultat
# Below the heading, as long as the surface that was opened has no level yet.
panel-result-follows = Calcul en cours...
panel-triangles = Triangles
panel-vertices = Sommets
# After and before the reduction; also which of how many.
panel-of = { $count } sur { $all }
panel-of-help = Après et avant la réduction
panel-removed = Enlevés
panel-calibre = Calibre
panel-calibre-help = Indique si chaque vaisseau mesurable garde son calibre
panel-vessels = Vaisseaux
panel-vessels-help = Ce que chacun est devenu, et où
panel-deviation-mean = Écart moyen
panel-deviation-max = Écart maximal
panel-deviation-help = Distance à la surface lissée, mesurée dans les deux sens
panel-volume = Volume
panel-volume-help = Variation par rapport aux morceaux gardés, à l'ouverture, extrémités ouvertes bouchées
panel-area = Aire
panel-area-help = Variation par rapport aux morceaux gardés, à l'ouverture
panel-notes = Notes sur le fichier

## The result: the shape

panel-shape = Forme
# Of the level, and of the smoothed surface before.
panel-shape-was = { $now }, avant { $before }
panel-shape-narrowest = Le plus étroit en ({ $x } ; { $y } ; { $z }) mm
panel-roughness = Rugosité
panel-roughness-help = Moyenne quadratique de l'angle entre triangles voisins ; « avant » est la surface lissée. Moins de triangles plient davantage.
# Triangles with a very small angle.
panel-slivers = Aplatis
panel-slivers-help = Triangles aplatis, avec un angle de moins de 10 degrés, en part du total
panel-self-intersecting = Auto-intersections
panel-self-intersecting-help = Triangles qui en traversent d'autres
panel-caps = Entrées et sorties
panel-caps-help = Bouts plats, et de combien leurs surfaces changent
# How many, and the least and largest change in percent.
panel-caps-changed = { $count }, { $least } à { $most } %
panel-smallest-lumen = Lumière minimale
panel-smallest-lumen-help = Diamètre des vaisseaux au plus étroit : de la plus grande boule intérieure qui touche la paroi

## The result: what each stage took

panel-times = Temps par étape
panel-time-reading = Lecture
panel-time-mending = Réparation
panel-time-connectivity = Connexité
panel-time-smoothing = Lissage
panel-time-decimation = Décimation, tous taux
panel-time-bound = Recherche du niveau
panel-time-level = Niveau
panel-time-normals = Normales
panel-time-deviation = Écart
panel-time-measures = Forme et lumière
panel-time-calibre = Calibre

## The deviation, as colours

panel-from-opened = Depuis l'original
panel-from-opened-help = La distance du niveau à la surface à l'ouverture, et non à la surface lissée
panel-signed = Intérieur, extérieur
panel-signed-help = Où le niveau est hors de cette surface, et où il est dedans
# Followed by four small buttons: 95 %, 0.1 mm, 0.25 mm, 0.5 mm.
panel-up-to = Max.
panel-up-to-help = L'écart qui a la dernière couleur
panel-up-to-percentile = 95 % : ce qui contient 95 % des points mesurés
# For assistive tools.
panel-up-to-value = Couleurs jusqu'à { $value }
# Above the legend in the view.
panel-legend-opened = Écart à l'original
panel-legend-smoothed = Écart, moyenne locale
# Below the legend.
panel-legend-sides = En bas : intérieur, en haut : extérieur
# Below the histogram.
panel-beyond = { $percent } % au-delà de { $deviation } mm
panel-largest-deviation = Écart maximal : { $deviation } mm
# $place is the message above.
panel-largest-deviation-go = { $place }. Cliquer pour y aller

## The vertex classes, as colours

# Above the legend in the view.
panel-class = Classe de sommet
# In the legend: a class and how many vertices there are of it.
panel-class-count = { $class } { $count }
# For assistive tools: the classes with how many there are of each, with commas.
panel-classes = Classes de sommets : { $classes }
panel-classes-help = Simple : sur aucune arête vive. Complexe : la surface n'y est pas un disque. Bord : à une extrémité ouverte. Arête intérieure : deux arêtes vives se rejoignent. Coin : une, ou plus de deux.

## What the computation does, in the status bar, before its percentage

panel-work-reading = Lecture
panel-work-comparing = Comparaison
panel-stage-mending = Réparation
panel-stage-connectivity = Recherche des morceaux
panel-stage-smoothing = Lissage
panel-stage-decimation = Réduction
panel-stage-bound = Recherche du niveau
panel-stage-level = Extraction du niveau
panel-stage-deviation = Mesure de l'écart
panel-stage-arrays = Transfert des tableaux
panel-stage-measures = Mesure de la forme
panel-stage-faults = Recherche de défauts
panel-stage-vessels = Recherche des vaisseaux
panel-stage-certificate = Mesure du calibre
panel-stage-safe = Recherche du taux sûr

## The samples, in the menu, and as the name of what is shown

panel-sample-aorta = Aorte abdominale
panel-sample-coronary = Artères coronaires
panel-sample-aorta-nets = Aorte abdominale par surface nets

## Les équations

panel-equations = Équations
panel-equations-of = Équations : { $step }
panel-equations-help = Les équations de l'article. Pointez un symbole en couleur : son curseur et son repère dans la réponse s'allument, et inversement.
panel-equation-1 = À quelle distance un sommet se trouve de la moyenne de ses voisins ; la somme de ses poids w est 1.
panel-equation-2 = La même chose pour tous les sommets à la fois, avec K = I − W.
panel-equation-3 = Le lissage : une fonction de K, appliquée aux coordonnées.
panel-equation-4 = La surface est une somme d'ondes e. De chacune reste la part f(k) ; sa valeur propre k est près de 0 pour les ondes longues, au plus 2 pour les plus courtes.
panel-equation-5 = La réponse : des polynômes de Tchebychev T jusqu'au degré N. θ représente la bande passante, un peu décalée pour qu'elle soit elle-même conservée.
panel-equation-6 = La fenêtre { $window } : sans ces poids, une série qui finit oscillerait.
panel-equation-7 = La réduction : la part des m triangles qui disparaît, en pour cent ; il en reste m'.
panel-tied-pass-band = Bande passante : { $value }
panel-tied-iterations = Itérations : { $count }
panel-tied-window = Fenêtre : { $window }
panel-tied-reduction = Réduction
panel-tied-wave = Valeur propre d'une onde ; le graphique marque celle que vous essayez
panel-tied-response = Réponse : la part d'une onde qui reste
