### Le verdict sur un résultat au-dessus des vues, ce qui aide, et ce que le panneau, la ligne de commande et les rapports en répètent.

## Le bandeau au-dessus des vues

verdict-safe = Apte à la simulation
verdict-kept = Gardé là où mesuré
verdict-none-measured = Aucun vaisseau mesuré
# Un titre, et la part mesurée : « 82 % de la longueur, 28 sur 33 vaisseaux ».
verdict-covered = { $head } : { $coverage }
verdict-not-measured = Non mesuré
verdict-coming = Mesure en cours...
verdict-to-look-at = { $count ->
    [one] { $count } point à vérifier
   *[other] { $count } points à vérifier
}
verdict-follows = Le calibre et la forme suivent.
# Beside "Being measured..." while a level is shown that a finer one may follow.
verdict-auto-follows = Recherche du taux sûr : la réduction peut encore reculer.
verdict-stopped = La mesure a été annulée, ou le calcul s'est arrêté : modifier un réglage pour continuer.
# $text is what is said of the surface, a sentence: that it is a sample.
verdict-sample = Exemple : { $text }
verdict-what-to-do = Que faire
verdict-findings = Détails
verdict-list-grave = À vérifier
verdict-list-notes = Remarques
verdict-notes = { $count ->
    [one] { $count } remarque
   *[other] { $count } remarques
}
verdict-show-vessels = Voir vaisseaux
verdict-show-vessels-help = Ce que chacun est devenu, et où (V)
verdict-show-unmeasured = Non mesuré
verdict-show-unmeasured-help = Ouvre les vaisseaux et va là où rien n'est mesuré ; la surface y est grise. Un verdict vert demande au moins { $percent } % de la longueur mesurée hors des bifurcations, et la moitié des vaisseaux.
verdict-enough = « Sûr » se dit là où au moins { $percent } % de la longueur hors des bifurcations est mesuré, et la moitié des vaisseaux.
verdict-remedy-help = Aiderait ; peut être annulé
verdict-show-place = Voir
verdict-show-place-help = Va à l'endroit en question

## Ce qui aiderait : sur des boutons

verdict-reduce-to = Réduire à { $percent } %
verdict-read-in = Lire en { $unit }
verdict-take-lumen = Prendre la lumière
verdict-all-pieces = Tous les morceaux
# Shows the pieces that are left out, which can be chosen in the view.
verdict-choose-pieces = Choisir des morceaux
verdict-choose-pieces-help = Montre ce qui est omis ; un clic sur un morceau garde celui-là, avec Maj ou Ctrl en plus des autres
verdict-fill = Combler
verdict-split = Séparer
verdict-no-crossings = Sans croisement
verdict-hold-caps = Garder les bouchons

## Constats sur le fichier

verdict-wall = La surface est une paroi à deux faces, épaisse de { $thickness } mm.
verdict-holes = { $count ->
    [one] La paroi a un trou de { $diameter } mm.
   *[other] La paroi a { $count } trous, le plus grand de { $diameter } mm.
}
verdict-crowded = { $count ->
    [one] En { $count } arête ou point se rejoignent des surfaces qui devraient être séparées.
   *[other] En { $count } arêtes et points se rejoignent des surfaces qui devraient être séparées.
}
# $percent of the area, in so many other pieces.
verdict-left-out = { $pieces ->
    [one] { $percent } % de la surface sont omis : un autre morceau.
   *[other] { $percent } % de la surface sont omis : { $pieces } autres morceaux.
}

## Constats sur les vaisseaux pincés

verdict-pinched-first = Un vaisseau de { $before } mm est pincé, dès { $percent } %.
verdict-lost-first = Un vaisseau de { $before } mm est perdu, dès { $percent } %.
verdict-pinched-at-first = Un vaisseau de { $before } mm est pincé en ({ $x } ; { $y } ; { $z }), dès { $percent } %
verdict-lost-at-first = Un vaisseau de { $before } mm est perdu en ({ $x } ; { $y } ; { $z }), dès { $percent } %
verdict-pinched-to = Un vaisseau de { $before } mm est pincé à { $after } mm en ({ $x } ; { $y } ; { $z }).
verdict-lost-at = Un vaisseau de { $before } mm est perdu en ({ $x } ; { $y } ; { $z }).
verdict-worst-of = { $sentence } C'est le pire de { $count } endroits.

## Constats sur le lissage, le volume et les triangles

verdict-all-but-shut = Un vaisseau est presque fermé en ({ $x } ; { $y } ; { $z }) : il en reste { $diameter } mm.
verdict-drawn-shut = Le lissage a fermé un vaisseau en ({ $x } ; { $y } ; { $z }) : il enlève les ondes de moins de { $wave } mm, le tour d'un vaisseau de { $around } mm. Une bande passante plus large garde ouverts les vaisseaux fins.
verdict-volume-changed = Le volume a changé de { $change } % : { $cause }.
verdict-volume-narrow = la bande passante est trop étroite pour des vaisseaux aussi fins
verdict-volume-few = si peu de triangles ne portent pas cette forme
verdict-volume-adapt = { $sentence } « Adapter au calibre » (--smoothing auto) le préserve.
verdict-volume-put-back = Le volume n'est pas préservé à 0,01 % près : des sommets ont été remis en place pour qu'aucun triangle n'en croise d'autres.
verdict-volume-none = Le volume n'a pas pu être préservé, car la surface n'en renferme aucun : elle est lissée comme sans cette contrainte.
verdict-volume-thin = Le volume n'a pas pu être préservé, car des vaisseaux aussi fins se déchireraient ou gonfleraient avec cette bande passante : la surface est lissée comme sans cette contrainte.
verdict-crossing = { $count ->
    [one] { $count } triangle en croise d'autres.
   *[other] { $count } triangles en croisent d'autres.
}
verdict-crossing-before = { $count ->
    [one] { $count } triangle en croise d'autres ; { $before } avant la réduction.
   *[other] { $count } triangles en croisent d'autres ; { $before } avant la réduction.
}
verdict-caps-rounded = { $count ->
    [one] Une entrée ou sortie n'est plus plate.
   *[other] { $count } entrées et sorties ne sont plus plates.
}
verdict-caps = { $count ->
    [one] La surface d'une entrée ou sortie change de { $percent } %.
   *[other] Les surfaces de { $count } entrées et sorties changent, une de { $percent } %.
}
verdict-narrower = À l'ouverture, la { $name } est plus étroite de { $percent } % que de part et d'autre, sur { $length } mm : { $reference }.
verdict-wider = À l'ouverture, la { $name } est plus large de { $percent } % que de part et d'autre, sur { $length } mm : { $reference }.
verdict-few-iterations = Trop peu d'itérations pour cette bande passante : il en faut davantage pour lisser.
verdict-not-smoothed = Rien n'est lissé : si la surface a les marches de son examen, elles sont encore là, et un guide s'y accroche.
verdict-shortfall-topology = Cette surface ne descend pas au-dessous de { $reached } triangles ({ $wanted } étaient demandés) : en retirer davantage fermerait une extrémité ouverte ou pincerait un vaisseau
verdict-shortfall-geometry = Cette surface ne descend pas au-dessous de { $reached } triangles ({ $wanted } étaient demandés) : en retirer davantage replierait la surface sur elle-même
verdict-shortfall-complex = Cette surface ne descend pas au-dessous de { $reached } triangles ({ $wanted } étaient demandés) : le reste se trouve sur des arêtes de plus de deux triangles, qui restent telles quelles

## Étiquettes près de l'anneau autour de l'endroit d'un constat

verdict-place-hole = Trou
verdict-place-here = Ici
verdict-place-narrowed = Pincé
verdict-place-narrower = { $percent } % plus étroit
verdict-place-wider = { $percent } % plus large
verdict-place-pinched = pincé
verdict-place-lost = perdu
verdict-place-shut = Fermé
verdict-place-rounded = plus plate
verdict-place-cap = surface { $percent } %

## Jusqu'où une réduction est sûre : des phrases sans point final

verdict-safe-past = Trop réduite pour que les vaisseaux mesurés gardent leur calibre : il reste { $triangles } triangles, et ils le gardent jusqu'à { $kept }, à { $rate } %. Essayez ce taux : un vaisseau peut être trop étroit pour le guide par la seule réduction.
verdict-safe-none-kept = le lissage lui-même change chaque vaisseau mesurable
verdict-safe-none-measured = aucun vaisseau n'est mesurable
verdict-safe-changed = À { $rate } %, la { $name } change de { $by } %, en ({ $x } ; { $y } ; { $z })
verdict-safe-unmeasured = À { $rate } %, la { $name } n'est plus mesurable
verdict-safe-uncovered = À { $rate } %, { $percent } % seulement de la longueur des vaisseaux sont mesurables

## Le filtre

verdict-half-gain = k = { $k } : ondes de { $length } mm
verdict-half-gain-alone = k = { $k }

## Des mots comme phrase

verdict-sentence = { $words }.
