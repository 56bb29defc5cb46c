### Mesures à la main : les outils, le plan de coupe et la liste des mesures.

## Le panneau

measure-title = Mesurer
measure-close = Fermer
measure-back = Retour
measure-close-help = M, Échap
measure-no-surface = Il n'y a pas encore de surface.
measure-choose = Choisir un outil, puis cliquer sur la surface dans l'une des vues.
# Where a finger points.
measure-choose-touch = Choisir un outil, puis toucher la surface dans une vue.
measure-hint = { $hint }. Entrée : le milieu de la vue ; Échap : terminé.

## Les outils

measure-ruler = Règle
measure-ruler-help = Distance en ligne droite entre deux points de la surface, en mm
measure-diameter = Diamètre
measure-diameter-help = La plus grande boule intérieure qui touche la paroi en un point : son diamètre en mm
measure-section = Section
measure-section-help = Perpendiculaire à la ligne centrale à côté d'un point : aire en mm², largeurs minimale et maximale et diamètre du cercle de même aire en mm
measure-angle = Angle
measure-angle-help = Au deuxième de trois points, en degrés
measure-fork = Fourche
measure-fork-help = Entre deux branches de la bifurcation la plus proche, là où chacune est un vaisseau distinct, en degrés

## Ce que fait le prochain clic

measure-click-first = Cliquer sur le premier point de la surface
measure-click-end = Cliquer sur l'autre extrémité
measure-click-vertex = Cliquer sur le sommet de l'angle
measure-click-last = Cliquer sur le dernier point
measure-point-wall = Pointer la paroi pour voir son diamètre ; cliquer pour le garder
measure-click-vessel = Cliquer sur un vaisseau
measure-click-branch = Cliquer sur une branche à côté d'une bifurcation
# The same by a finger.
measure-tap-first = Toucher le premier point de la surface
measure-tap-end = Toucher l'autre extrémité
measure-tap-vertex = Toucher le sommet de l'angle
measure-tap-last = Toucher le dernier point
measure-tap-wall = Toucher la paroi pour mesurer son diamètre
measure-tap-vessel = Toucher un vaisseau
measure-tap-branch = Toucher une branche à côté d'une bifurcation

## Pourquoi rien n'a été mesuré

measure-same-places = Deux des points sont identiques.
measure-no-ball = Aucune paroi ne fait face à ce point : aucune boule ne tient entre les deux.
measure-no-section = Pas de section : { $why }.
measure-no-angle = Pas d'angle : { $why }.
measure-not-yet = Les lignes centrales sont encore en cours de recherche : réessayer dans un instant.
measure-no-centreline = Il n'y a pas de ligne centrale : { $why }.

## Le plan de coupe

measure-clip = Plan de coupe
measure-clip-help = Masque ce qui se trouve d'un côté d'un plan, dans les deux vues ; faire glisser sa poignée ou le curseur
measure-square-to = Perpendiculaire
measure-square-to-help = À un axe, à la direction du regard ou à la ligne centrale d'un vaisseau, le long de laquelle il se déplace
measure-lost-centreline = Cette ligne centrale n'existe plus.
measure-position = Position
measure-position-help = Le long de l'axe ou de la ligne centrale, en mm
measure-flip = Inverser
measure-flip-help = Masquer l'autre côté
measure-clip-handle = Poignée du plan de coupe
measure-across-axis = À travers { $axis }
measure-facing = Face à la vue
measure-centreline = Ligne centrale
measure-along = Le long de { $vessel }

## La liste

measure-none = Aucune mesure
measure-measures = Mesures
measure-in-views = Dans les vues
measure-in-views-help = Dessiner les mesures sur les deux vues
measure-kept = Elles sont gardées avec la surface tant qu'elle est ouverte, par l'annulation, dans un fichier de réglages et dans le rapport.
measure-name-help = Son nom : cliquer pour le modifier
measure-name-of = Nom de la mesure { $number }
measure-show = Voir
measure-show-help = La caméra s'y rend
measure-show-named = Voir { $name }
measure-delete = Supprimer
measure-delete-named = Supprimer { $name }

## Dans les vues

measure-mark = { $name } : { $value }
