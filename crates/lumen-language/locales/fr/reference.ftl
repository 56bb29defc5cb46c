### La surface ouverte à côté d'un autre fichier, quel qu'en soit l'auteur.

## Où cela commence : une entrée d'un menu, un bouton à côté d'un avis

reference-open = Comparer à un fichier...
reference-open-help = Un autre fichier comme référence : la distance de la surface, et le calibre de chaque vaisseau sur les deux
reference-back = Retour à { $name }
reference-back-help = La comparaison à ce fichier
reference-take-next = Comparer à celui-ci
reference-take-next-help = Prend le fichier suivant comme référence pour celui-ci

## Ce qui est comparé, et comment : dans le panneau

reference-heading = Deux surfaces
reference-close-help = Retour aux deux vues (Échap)
reference-reference = Référence
reference-reference-help = Ce à quoi la surface est comparée ; un autre fichier peut être déposé ici
reference-other = Autre...
reference-other-help = Comparer à un autre fichier
reference-unit = Unité :
reference-unit-help = Des nombres dans le fichier de la référence
reference-surface = Surface :
reference-surface-help = Ce qui est jugé
reference-opened = comme ouverte
reference-level = réduite
# The name of the surface in the report.
reference-level-of = { $name }, réduite
reference-mended = { $name }, réparée
reference-move = La déplacer :
reference-move-help = Si la surface est d'abord amenée sur la référence
reference-still = non
reference-still-help = Les deux là où leurs fichiers les ont
reference-axes = axes
reference-axes-help = Tournée lorsqu'un fichier est en LPS et l'autre en RAS
reference-rigid = au mieux
reference-rigid-help = Tournée et décalée pour coïncider au mieux
reference-work = Comparaison à la référence

## Ce qui en est résulté

reference-coming = Les deux sont en cours de comparaison...
reference-no-level = Il n'y a pas encore de surface réduite.
reference-again = Comparer à nouveau
reference-failed = Elles ne peuvent pas être comparées : { $why }.
reference-moved = Déplacée de { $mm } mm en moyenne, tournée de { $degrees }°.
reference-fit = Après l'ajustement, les quatre cinquièmes les plus proches de la surface sont à { $mm } mm (RMS), { $before } mm avant.
reference-apart = Elles sont à { $mm } mm l'une de l'autre en moyenne.
reference-bring-together = Les rapprocher
reference-axes-differ = L'une est en LPS, l'autre en RAS : la gauche et la droite ne sont pas du même côté.
reference-turn = La tourner
# Of the reference's file; $note is a sentence.
reference-note = Référence : { $note }
reference-column-reference = Référence
reference-column-surface = Surface
reference-triangles = Triangles
reference-area = Aire
reference-volume = Volume
reference-mean = Distance, moyenne
reference-rms = Distance, RMS
reference-p95 = Distance, 95 %
reference-distance-help = Entre les deux, mesurée dans les deux sens sur des échantillons de chacune
reference-signed-help = Dehors et dedans dans des couleurs propres, ou seulement la distance
reference-farthest-reference = Plus loin, référence
reference-farthest-surface = Plus loin, surface
reference-farthest-help = La distance de son point le plus éloigné à l'autre : aucun point n'est à plus de { $most } mm, avec certitude
reference-go = Y aller
reference-go-long = Y aller : { $what }
reference-no-vessels = Calibre : { $why }.
reference-changed = { $all ->
    [one] Le vaisseau a changé de plus de { $tolerance } %.
   *[other] { $changed } vaisseaux sur { $all } ont changé de plus de { $tolerance } %.
}
reference-kept = Conservé à { $tolerance } % près là où c'est mesuré.
reference-not-measured = Aucun vaisseau ne peut être mesuré.
reference-measured = Mesuré : { $percent } % de la longueur.
reference-column-vessel = Vaisseau
reference-column-vessel-help = Numéroté comme sur la référence
reference-column-radius-help = Rayon moyen en mm, du cercle de même aire
reference-column-change = Écart
reference-column-change-help = Le plus grand changement du rayon par rapport à la référence
reference-column-verdict = Calibre
reference-save-numbers = Enregistrer JSON
reference-save-numbers-help = Tous les nombres, comme lumen compare les écrit
reference-save-stations = Enregistrer CSV
reference-save-stations-help = Aire et rayon sur les deux en chaque point de chaque vaisseau

## Over the pictures

reference-distance-title = Distance à l'autre
reference-legend = Distance
reference-legend-sides = surface dehors rouge, dedans bleu

## Pourquoi deux surfaces ne peuvent pas être comparées : dit après deux points, un point suit

reference-axes-unknown = l'orientation des axes n'est dite que par un des fichiers au plus
reference-no-area = une des surfaces n'a pas d'aire : il n'y a rien à comparer
