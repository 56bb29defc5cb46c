### Ce que disent les deux vues, les images et les contractions : titres, légendes, et ce qui s'affiche quand rien ne peut être dessiné.

## Les vues

views-shaded = Vue ombrée
views-wireframe = Vue en fil de fer
views-shaded-title = Ombré
views-wireframe-title = Fil de fer
views-as-opened = À l'ouverture
views-now = Actuel
views-laplacian = { $passes ->
    [one] { $passes } passe laplacienne
   *[other] { $passes } passes laplaciennes
}
views-divider = Séparation entre l'ouverture et l'état actuel
views-divider-other = Séparation entre « { $before } » et l'état actuel
views-divider-wireframe = Séparation dans le fil de fer
views-divider-wireframe-other = Séparation dans le fil de fer entre « { $before } » et l'état actuel
views-idle = au repos
views-rate = { $rate } i/s
views-pinched = Pincé : { $before } mm avant
views-lost = Perdu : { $before } mm avant
views-axes-unknown = Axes inconnus

## La légende

views-calibre = Variation de calibre
views-calibre-note = non mesuré
views-peak-force = Force maximale
views-legend-more = { $value } et plus
views-legend-less = { $value } et moins

## Quand quelque chose ne peut être dessiné

views-no-memory = La mémoire graphique est pleine : cette surface ne peut pas être dessinée ; elle reste ouverte et peut être réduite davantage ou enregistrée.
views-no-device = Aucun périphérique graphique n'est disponible pour dessiner.
views-failed = Les vues ne peuvent pas être dessinées : { $error }.
views-surface-failed = La surface ne peut pas être dessinée : { $error }.
views-slices-failed = Les coupes ne peuvent pas être dessinées : { $error }.
views-not-drawn = L'image n'a pas été dessinée : { $error }.
views-too-large = { $what ->
    [triangles] ses triangles demandent { $needed } Mo de mémoire graphique d'un seul bloc, et cette machine en donne { $limit } Mo ; la réduire davantage
    [edges] ses arêtes demandent { $needed } Mo de mémoire graphique d'un seul bloc, et cette machine en donne { $limit } Mo ; la réduire davantage
    [positions] ses positions demandent { $needed } Mo de mémoire graphique d'un seul bloc, et cette machine en donne { $limit } Mo
    [normals] ses normales demandent { $needed } Mo de mémoire graphique d'un seul bloc, et cette machine en donne { $limit } Mo
    [scalars] ses scalaires demandent { $needed } Mo de mémoire graphique d'un seul bloc, et cette machine en donne { $limit } Mo
   *[other] ses données demandent { $needed } Mo de mémoire graphique d'un seul bloc, et cette machine en donne { $limit } Mo
}
views-miscounted = { $what ->
    [normals] { $found } normales pour { $expected } nœuds
    [scalars] { $found } scalaires pour { $expected } nœuds
    [pixels] { $found } pixels au lieu de { $expected }
   *[other] { $found } valeurs pour { $expected } nœuds
}
views-no-node = nœud { $index } sur { $nodes }
views-picture-kept = le processeur graphique n'a pas remis l'image : { $error }
views-picture-lost = le processeur graphique a disparu avant la lecture de l'image

## Avant l'ouverture d'un grand fichier

views-large = { $name } compte environ { $count } triangles, pour lesquels quelque { $needed } Go de mémoire peuvent être nécessaires ; il y en a { $limit } ici. L'ouverture est tentée : en cas d'échec, ce qui était ouvert le reste. Le programme de bureau n'a pas cette limite.

## Côtés d'où une vue peut regarder

views-anterior = Antérieur
views-posterior = Postérieur
views-left = Gauche
views-right = Droite
views-superior = Supérieur
views-inferior = Inférieur
views-front = Avant
views-rear = Arrière
views-left-side = Côté gauche
views-right-side = Côté droit
views-top = Dessus
views-bottom = Dessous

## Ce que montre une vue, pour les outils d'assistance

# Avec leur préposition, derrière « vue ».
views-side-left = de la gauche
views-side-right = de la droite
views-side-front = de l'avant
views-side-back = de l'arrière
views-side-above = du dessus
views-side-below = du dessous
views-side-axis = de { $axis }
views-seen-laplacian = { $passes ->
    [one] { $name } après { $passes } passe laplacienne, vue { $side }
   *[other] { $name } après { $passes } passes laplaciennes, vue { $side }
}
views-seen-opened = { $count ->
    [one] { $name } à l'ouverture, vue { $side }, { $count } triangle
   *[other] { $name } à l'ouverture, vue { $side }, { $count } triangles
}
views-seen = { $name }, vue { $side }
views-seen-triangles = { $count ->
    [one] { $count } triangle
   *[other] { $count } triangles
}
views-seen-narrowest = { $diameter } mm au plus étroit
views-news = { $count ->
    [one] { $name }, { $count } triangle. { $verdict }
   *[other] { $name }, { $count } triangles. { $verdict }
}

## Sous les images d'un rapport

views-reduced = Lissée et réduite
views-triangles = Ses triangles
views-calibre-meaning = Variation de calibre, de { $from } % (sombre) à { $to } % (clair) ; gris : non mesuré
views-deviation-meaning = Écart, de { $from } mm (sombre) à { $to } mm (clair)

## Classes de sommets, d'après Schroeder

views-class-simple = Simple
views-class-complex = Complexe
views-class-boundary = Bord
views-class-interior-edge = Arête intérieure
views-class-corner = Coin

## Les contractions, une par une

views-back = Reculer
views-back-help = Annule la dernière contraction : un ou deux triangles de plus
views-on = Avancer
views-on-help = Effectue la contraction suivante : un ou deux triangles de moins
views-play = Lire
views-play-help = L'une après l'autre, lentement
views-follow = Aller à chacune
views-follow-help = La caméra va là où se trouve la suivante
views-close = Fermer
views-close-help = Plus de contractions (Échap)
views-next-vertex = { $before ->
    [one] Ensuite, { $number } sur { $all } : un sommet de la classe « { $class } » rejoint un voisin ; { $before } triangle devient { $after }.
   *[other] Ensuite, { $number } sur { $all } : un sommet de la classe « { $class } » rejoint un voisin ; { $before } triangles deviennent { $after }.
}
views-next-edge = { $before ->
    [one] Ensuite, { $number } sur { $all } : une arête devient un sommet à sa propre place ; { $before } triangle devient { $after }.
   *[other] Ensuite, { $number } sur { $all } : une arête devient un sommet à sa propre place ; { $before } triangles deviennent { $after }.
}
views-next-error = Son erreur est de { $cost } mm : la moyenne quadratique des distances aux plans qu'il représente. La plus grande jusqu'ici est de { $largest } mm.
views-next-error-line = Son erreur est de { $cost } mm : la moyenne quadratique des distances aux plans qu'il représente, ou sa distance à sa ligne si elle est plus grande. La plus grande jusqu'ici est de { $largest } mm.
views-last-level = C'est le dernier niveau : aucun sommet ne peut plus disparaître.
views-click-vertex = Cliquer sur un sommet dans une vue pour voir où il peut aller.
views-click-vertex-touch = Toucher un sommet dans une vue pour voir où il peut aller.

## Où un sommet peut aller : des phrases qui se suivent

views-vertex = Sommet de la classe « { $class } ».
views-stays-by-rule = Il reste, par règle : la surface n'y est pas un disque.
views-stays-crowded = Trop de triangles s'y rencontrent : il attend ses voisins.
views-goes-never = Dans ce calcul, il ne disparaît jamais.
views-goes-at = { $count ->
    [one] Dans ce calcul, il disparaît à { $count } triangle, pour { $cost } mm.
   *[other] Dans ce calcul, il disparaît à { $count } triangles, pour { $cost } mm.
}
views-ways = { $count ->
    [one] Chemin vers son voisin : { $ways }.
   *[other] Chemins vers ses { $count } voisins : { $ways }.
}
views-way-open = { $count ->
    [one] { $count } ouvert
   *[other] { $count } ouverts
}
views-way-eased = { $count ->
    [one] { $count } ouvert dès que la forme peut souffrir davantage
   *[other] { $count } ouverts dès que la forme peut souffrir davantage
}
views-way-off-line = { $count } hors de sa ligne
views-way-link = { $count } contre la condition de lien : la topologie changerait
views-way-flip = { $count ->
    [one] { $count } fermé : un triangle se retournerait
   *[other] { $count } fermés : un triangle se retournerait
}
views-way-sliver = { $count ->
    [one] { $count } fermé : un triangle s'aplatirait
   *[other] { $count } fermés : un triangle s'aplatirait
}
views-unseen = Les croisements ne sont pas examinés ici.
views-unseen-quadric = La forme et les croisements ne sont pas examinés ici : seul le calcul sait où il serait placé.
views-unseen-borders = Les limites entre étiquettes non plus.
