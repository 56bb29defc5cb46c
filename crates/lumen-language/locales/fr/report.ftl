### Rapports : ce qui figure sur la page pour le dossier (PDF et page web).

report-title = Surface vasculaire
report-not-clinical = Pas pour des décisions cliniques.
report-page = Page { $page } sur { $count }
report-date = Date
report-case = Cas
report-comment = Remarque

## Titres

report-file = Fichier
report-settings = Réglages
report-numbers = Valeurs
report-by-hand = Mesuré à la main
report-solver = Prêt pour un solveur : paroi, entrées et sorties
report-stretches = Plus étroit ou plus large que de part et d'autre
report-view-reduced = Réduite : { $count ->
    [one] { $count } triangle
   *[other] { $count } triangles
}
report-view-before = Avant : { $count ->
    [one] { $count } triangle
   *[other] { $count } triangles
}
report-view-less = Moins réduite : { $count ->
    [one] { $count } triangle
   *[other] { $count } triangles
} sur { $all }
report-view-help = Glisser tourne, la molette ou deux doigts agrandissent, Maj et glisser déplacent, un double-clic montre le tout ; ou les flèches, + et -, 0.
report-view-save = Enregistrer en GLB

## Le fichier

report-fingerprint = Empreinte (SHA-256)
report-no-fingerprint = aucune : ne vient pas d'un fichier
report-format = Format
report-format-in = { $format }, en { $unit }
report-opened = Ouvert
report-counts = { $triangles ->
    [one] { $triangles } triangle
   *[other] { $triangles } triangles
} en { $pieces ->
    [one] { $pieces } morceau
   *[other] { $pieces } morceaux
}
report-size = Taille
report-size-mm = { $x } × { $y } × { $z } mm
report-axes = Axes
report-axes-unknown = inconnus
report-threshold = Seuil
report-threshold-moves = { $value } ; plus bas de 10 %, la paroi serait { $lower } mm plus à l'extérieur ; plus haut de 10 %, { $higher } mm

## Réglages

report-keep = Gardé
report-keep-largest = le plus grand morceau
report-keep-piece = morceau { $number }
report-keep-pieces = morceaux { $numbers }
report-keep-all = tous les morceaux
report-mending = Réparation
report-no-mending = aucune
report-lumen-taken = lumière d'une paroi prise
report-welded = soudé à { $value } mm
report-split = feuillets séparés
report-filled = trous jusqu'à { $value } mm comblés
report-smoothing = Lissage
report-no-smoothing = aucun
report-filter = bande passante { $band }, { $count ->
    [one] { $count } itération
   *[other] { $count } itérations
}, { $window }
report-preset = { $preset } : { $filter }
report-no-crossings = sans croisement
report-volume-held = volume préservé
report-reduction = Réduction
report-target-reduction = { $percent } % des triangles
report-target-auto = { $percent } % des triangles, choix automatique
report-target-auto-safe = { $percent } % des triangles, choix automatique : le taux sûr
report-target-auto-kept = { $percent } % des triangles, choix automatique : tant que les vaisseaux sont gardés là où ils sont mesurés
report-target-auto-pinched = { $percent } % des triangles, choix automatique : tant qu'aucun vaisseau n'est pincé
report-target-triangles = { $count ->
    [one] à { $count } triangle
   *[other] à { $count } triangles
}
report-target-deviation = à { $most } mm près
report-method = Méthode
report-allowed = Tolérance du calibre

## Nombres

report-triangles = Triangles
report-triangles-of = { $left } sur { $all }
report-from-smoothed = Écart au lissé
report-from-opened = Écart à l'ouvert
report-distance = { $mean } mm en moyenne, { $most } mm au plus
report-volume-change = Variation du volume
report-area-change = Variation de l'aire
report-half-gain = Demi-gain du lissage
report-crossing = Auto-intersections
report-caps = Entrées et sorties
report-smallest-lumen = Lumière minimale
report-measured = Vaisseaux mesurés
report-output-fingerprint = Empreinte de surface

## Colonnes et cellules

report-calibre = Calibre
report-radius = Rayon à l'ouverture, mm
report-diameter = Diamètre
report-by-area = En aire
report-diameter-mm = Diamètre, mm
# Où, le long du vaisseau, la référence est mesurée.
report-reference-at = Référence à, mm
report-at-mm = À, mm
report-diameter-of = { $diameter } sur { $reference }
report-measure = Mesure
report-found = Valeur
report-made-on = Mesuré sur
report-middle = Milieu, mm
report-area = Aire, mm²
report-end-radius = Rayon, mm
report-normal = Normale, vers l'extérieur
report-point = ({ $x } ; { $y } ; { $z })
report-at = À ({ $x } ; { $y } ; { $z }) mm.

## Courbes

report-response = Ce que le lissage laisse d'une onde
report-wave-length = Longueur d'onde, mm
report-eigenvalue = Valeur propre
report-left = Reste
report-left-curve = reste
report-pass-band = bande passante
report-change = Variation, %
report-change-allowed = toléré : ±{ $percent } %

## Pourquoi il n'y a pas d'image

report-error-size = une image de { $width } × { $height } pixels est arrivée avec { $bytes } octets
report-error-png = l'image ne peut pas être écrite : { $why }

report-sweep = Guide selon la réduction : { $file }
report-sweep-rate = Réduction, %
report-sweep-tip = Pointe hors du trajet sans réduction, mm
report-sweep-deviation = maximum
report-sweep-median = médiane
report-sweep-noise = bruit
report-sweep-arrived = Arrivent, %
report-sweep-force = Force maximale sur la paroi, mN
