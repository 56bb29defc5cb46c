### La comparaison : jusqu'à six réglages d'une surface côte à côte, et les figures que l'on en tire.

## Disposition des images

compare-shaded = Ombré
compare-shaded-help = Les surfaces
compare-wireframe = Fil de fer
compare-wireframe-help = Leurs arêtes
compare-both = Les deux
compare-both-help = Les arêtes sur la surface
compare-stacked = Superposé
compare-stacked-help = La surface au-dessus de ses arêtes

## La barre au-dessus de la grille

compare-add = Ajouter l'actuel
compare-add-short = Ajouter
compare-add-long = Ajouter les réglages actuels
compare-add-help = Comparer aussi les réglages actuels
compare-full = Six comparaisons au plus : en retirer une d'abord
compare-there-already = Les réglages actuels sont déjà comparés
compare-figure-6 = Figure 6
compare-figure-6-help = Les six lissages de la figure 6 de l'article
compare-figure-7 = Figure 7
compare-figure-7-help = Les trois taux de réduction de la figure 7 de l'article
compare-show-as = Affichage
compare-first = Premier
compare-first-help = Maintenir pour voir les premiers réglages dans chaque case, puis relâcher : ce qui bouge est la différence (ou maintenir X)
compare-difference = Différence avec A
compare-difference-help = Colore la distance de chaque surface à A, la première, en mm
compare-most = Plus grande différence
compare-most-help = Va là où une surface est le plus loin de A, sur quelques diamètres de vaisseau
compare-whole = Vaisseau entier
compare-whole-help = Toute la surface (F)
# A menu with what a phone has no room for.
compare-more = Plus
compare-more-help = La disposition des images, la différence, une image pour un fichier
compare-done = Terminé
compare-done-help = Retour aux deux vues (C)

## Ce qui est comparé

compare-heading = Réglages côte à côte
compare-heading-smoothing = Plus ou moins de lissage
compare-heading-triangles = De moins en moins de triangles
compare-paper-figure-6 = Figure 6 de l'article
compare-paper-figure-7 = Figure 7 de l'article
compare-paper-rates = Taux de la figure 7 de l'article, lissage comme réglé
compare-nothing = Rien n'est encore comparé : ajouter les réglages actuels ou prendre ceux d'une figure de l'article.
compare-slow = plus de { $count } triangles par case : la rotation peut être lente

## Couleurs de la différence

compare-distance-coming = La distance à A est en cours de mesure.
compare-distance-unknown = La distance à A n'est pas connue.
compare-distance-from = Distance à A, moyenne locale : 0 mm
compare-distance-to = { $most } mm et plus

## Une case

compare-reference = A : la référence
compare-from-a = De A : moyenne { $mean } mm, au plus { $most } mm
compare-no-area = Aucune aire à mesurer
compare-first-settings = Les premiers réglages
compare-waiting = En attente du calcul
compare-try-again = Réessayer
compare-remove = Retirer { $title }
compare-remove-help = Ne plus comparer
compare-not-drawn = La surface ne peut pas être dessinée : { $why }.
compare-no-device = Il n'y a pas de périphérique graphique pour dessiner.

## Un réglage en mots

compare-not-smoothed = non lissé
compare-pass-band = bande passante { $value }
compare-iterations = { $value ->
    [one] { $value } itération
   *[other] { $value } itérations
}
compare-window = fenêtre de { $value }
compare-boundary = règle { $value } aux extrémités ouvertes
compare-volume-preserved = volume préservé
compare-suits = adapté à la surface
compare-adapted = adapté au calibre
compare-no-crossing = sans croisement
compare-caps-held = bouchons gardés
compare-method = méthode { $value }
compare-feature-angle = angle d'arête { $value }°
compare-thin-spared = vaisseaux fins ménagés
compare-labels-kept = limites des étiquettes gardées
compare-not-reduced = non réduit
compare-auto = réduction automatique
compare-reduction = réduction { $percent } %
compare-triangles-wanted = { $count ->
    [one] { $count } triangle voulu
   *[other] { $count } triangles voulus
}
compare-deviation-up-to = écart jusqu'à { $most } mm

## Les nombres d'une case

compare-triangles = Triangles
compare-triangles-help = Après la réduction
compare-removed = Enlevés
compare-removed-help = La part des triangles gardés qui a disparu
compare-volume = Volume
compare-volume-help = Variation par rapport aux morceaux gardés, à l'ouverture, extrémités ouvertes bouchées
compare-deviation = Écart
compare-deviation-unit = moy. / max., mm
compare-from-smoothed = Du lissé
compare-from-smoothed-help = Écart à la surface lissée en mm, moyenne et maximum, mesuré dans les deux sens
compare-from-original = De l'original
compare-from-original-help = Écart aux morceaux gardés, à l'ouverture, en mm, moyenne et maximum, mesuré dans les deux sens

## Sous une figure

compare-figure-legend = Écart : distance entre deux surfaces, mesurée dans les deux sens sur { $samples } points de chacune ; lissé : la surface avant la réduction, original : avant le lissage. Volume : variation par rapport à l'original, extrémités ouvertes bouchées.

## Pourquoi une figure ne peut pas être dessinée

compare-error-device = il n'y a pas de périphérique graphique pour dessiner, même logiciel : un pilote Vulkan ou OpenGL manque, comme mesa-vulkan-drivers de Debian
compare-error-too-large = l'image ferait { $width } × { $height } pixels ; ce périphérique graphique en dessine au plus { $limit } dans chaque sens
