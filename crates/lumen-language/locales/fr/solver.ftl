### L'étape qui prépare un niveau pour un solveur d'écoulement ou de structure.

solver-title = Pour un solveur
solver-does = Coupe, prolonge et ferme les extrémités du niveau et régularise ses triangles, pour les solveurs d'écoulement et de structure.
solver-work = Préparation de la surface pour un solveur

## Ce qui est fait

solver-wrap = Envelopper de façon étanche
solver-wrap-help = À sa place une surface fermée proche de celle-ci : les triangles croisés, doubles ou intérieurs et les fentes plus étroites que la tolérance disparaissent
solver-wrap-mm = Tolérance
solver-uncross = Défaire les croisements
solver-uncross-help = Les triangles qui en traversent d'autres sont écartés, ou découpés puis refermés
solver-clip = Couper les extrémités
solver-clip-help = Perpendiculairement à la ligne centrale
solver-clip-none = telles quelles
solver-clip-round = là où c'est rond
solver-clip-distance = à une distance
solver-clip-by = Distance de l'extrémité
solver-extend = Prolonger les extrémités
solver-extend-help = Un tube droit qui part le long de la paroi et devient un cercle de même aire
solver-extend-by = Longueur des prolongements
solver-radii-help = En rayons du vaisseau à son extrémité
solver-radii = { " " }rayons
solver-cap = Fermer les extrémités
solver-cap-help = Avec une partie propre à chaque extrémité
solver-cap-none = laisser ouvertes
solver-cap-planar = à plat, régulier
solver-cap-fan = à plat, en éventail
solver-cap-smooth = en dôme
solver-remesh = Refaire les triangles
solver-remesh-help = Des triangles presque équilatéraux, aussi grands que le calibre le demande
solver-around = Arêtes autour d'un vaisseau
solver-least = Arête la plus courte
solver-largest = Arête la plus longue
solver-bound = Borner l'écart
solver-bound-help = Des triangles plus petits là où la surface se courbe
solver-bound-mm = Écart le plus grand
solver-prepare = Préparer
solver-prepare-help = À partir du niveau affiché, qui reste tel quel
solver-show-level = Afficher le niveau
solver-show-made = Afficher le résultat

## Où des extrémités sont coupées une à une

solver-show-cuts = Afficher les coupes
solver-show-cuts-help = Où chaque extrémité est coupée, et ce qui disparaît ; une coupe s'y déplace
solver-cuts-help = Ce qui est coupé est en couleur. Faites glisser un anneau le long de son vaisseau, ou tapez sa distance à l'extrémité.
solver-cut-end = Extrémité { $number }
solver-cut-distance = Distance de la coupe à l'extrémité { $number }
solver-cut-not = L'extrémité { $number } n'est pas coupée : { $why }.
solver-cuts-reset = Toutes les extrémités pareilles

## Ce qu'il en est

solver-triangles = { $count ->
    [one] un triangle
   *[other] { $count } triangles
}
solver-failed = Le niveau ne peut pas être préparé : { $why }.
solver-older = Fait d'un autre niveau, ou avec d'autres réglages que maintenant.
solver-ready = Rien trouvé qui arrête un mailleur de volume.
solver-not-ready = Un mailleur de volume ne la prendra pas :
solver-crossed = Triangles qui se croisent : { $before } avant, { $after } restants.
solver-result-triangles = Triangles
solver-quality = Qualité moyenne
solver-quality-help = 4√3 fois l'aire sur la somme des carrés des côtés : 1 pour des triangles équilatéraux
solver-below = Sous 30°
solver-below-help = Triangles ayant un angle plus petit
solver-deviation = Écart
solver-deviation-help = La plus grande distance entre la surface avant et après la réfection des triangles
solver-go = Y aller
solver-go-to = Y aller : { $what }
solver-name = Nom
solver-name-of = Nom de { $name }
solver-id = Id
solver-area = mm²
solver-radius = r, mm
solver-names = Les noms se modifient ; les fichiers les portent.
solver-save = Enregistrer pour un solveur

## Ce qui gêne un mailleur de volume

check-empty = La surface n'a aucun triangle.
check-broken = { $count ->
    [one] Un sommet ou triangle a des nombres non finis ou hors limites.
   *[other] { $count } sommets ou triangles ont des nombres non finis ou hors limites.
}
check-open-rims = { $count ->
    [one] La surface est ouverte à un bord.
   *[other] La surface est ouverte à { $count } bords.
}
check-shared-edges = { $count ->
    [one] Une arête a plus de deux triangles.
   *[other] { $count } arêtes ont plus de deux triangles.
}
check-duplicates = { $count ->
    [one] Un triangle est présent deux fois.
   *[other] { $count } triangles sont présents plusieurs fois.
}
check-degenerate = { $count ->
    [one] Un triangle n'a pas d'aire.
   *[other] { $count } triangles n'ont pas d'aire.
}
check-crossing = { $count ->
    [one] Un triangle en traverse ou en touche un autre.
   *[other] { $count } triangles en traversent ou en touchent d'autres.
}
check-folds = { $count ->
    [one] La surface est repliée sur elle-même le long d'une arête.
   *[other] La surface est repliée sur elle-même le long de { $count } arêtes.
}
check-coincident = { $count ->
    [one] Un sommet est à la place d'un autre sans lui être joint.
   *[other] { $count } sommets sont à la place d'autres sans leur être joints.
}
check-windings = { $count ->
    [one] Les triangles d'une arête regardent de côtés différents.
   *[other] Les triangles de { $count } arêtes regardent de côtés différents.
}
check-inside-out = { $count ->
    [one] Une pièce fermée regarde vers l'intérieur.
   *[other] { $count } pièces fermées regardent vers l'intérieur.
}
check-slivers = { $count ->
    [one] Un triangle a un angle de moins de 1 degré : { $least_degrees } degré.
   *[other] { $count } triangles ont un angle de moins de 1 degré ; le plus petit mesure { $least_degrees } degré.
}
check-pieces = { $count ->
    [one] La surface est d'une pièce.
   *[other] La surface est en { $count } pièces.
}

## Ce qui a été fait autrement que demandé

solver-note-left-out = { $others ->
    [one] Une pièce plus petite est laissée de côté.
   *[other] { $others } pièces plus petites sont laissées de côté.
}
solver-note-lumen = La surface est une paroi de { $thickness_mm } mm d'épaisseur : sa face intérieure est prise.
solver-note-not-cut = L'extrémité en ({ $at }) n'est pas coupée : { $why }.
solver-note-not-cut-many = { $count } extrémités ne sont pas coupées : { $why }. Elles sont en { $places }.
solver-note-no-end = Aucun vaisseau ne finit près de ({ $at }) : rien n'y est coupé.
solver-note-no-ends = Aucune extrémité à prolonger ou à fermer : coupez d'abord les extrémités.
solver-note-filled = { $count ->
    [one] Un trou de la paroi est rempli.
   *[other] { $count } trous de la paroi sont remplis.
}
solver-note-wall = L'ouverture en ({ $at }) est fermée comme partie de la paroi : { $why }.
solver-note-wall-many = { $count } ouvertures sont fermées comme parties de la paroi : { $why }. Elles sont en { $places }.
solver-note-shorter = Le prolongement de { $name } ne fait que { $mm } mm : plus loin, il rencontrerait quelque chose.
solver-note-shorter-many = { $count } prolongements ne font que { $least_mm } à { $most_mm } mm, plus loin ils rencontreraient quelque chose : { $names }.
solver-note-not-extended = { $name } n'est pas prolongé : { $why }.
solver-note-not-extended-many = { $count } extrémités ne sont pas prolongées : { $why }. Ce sont { $names }.
solver-note-wrapped = La surface est enveloppée, à { $deviation_mm } mm au plus.
solver-note-wrap-lumen = La surface est une paroi de { $thickness_mm } mm d'épaisseur : c'est sa lumière qui est enveloppée.
solver-note-wrap-wall = La surface est une paroi de { $thickness_mm } mm d'épaisseur dont les faces ne se distinguent pas : c'est la paroi qui est enveloppée, et non sa lumière.
solver-note-wrap-hollow = L'enveloppe entre dans le vaisseau en { $at } : la paroi a des fentes plus larges que la tolérance, et c'est elle qui est enveloppée. Essayez une tolérance plus grande.

## Pourquoi

solver-why-fork = une bifurcation est trop proche : { $room_mm } mm sont libres
solver-why-forks = une bifurcation est trop proche : { $most_mm } mm sont libres au plus
solver-why-not-round = le vaisseau n'y est rond nulle part
solver-why-no-section = la surface n'y a pas de section fermée
solver-why-open = la section donne dans une ouverture
solver-why-coarse = les triangles y sont trop grands
solver-why-around = ce qui est au-delà fait le tour vers l'autre côté
solver-why-other-end = une autre extrémité serait coupée
solver-why-most = { $percent } % de la surface seraient coupés
solver-why-folded = son contour est replié
solver-why-crossed = son contour se croise
solver-why-not-flat = elle n'est dans aucun plan
solver-why-long = c'est trop long pour d'aussi petits triangles
solver-why-no-room = il n'y a pas la place
solver-why-fine = ses arêtes sont trop courtes pour son aire
solver-why-unsound = la surface n'y est pas en ordre
solver-why-sac = c'est un sac, plus large que son collet
solver-why-spicule = c'est une pointe d'une paroi rugueuse et non un vaisseau
solver-error-empty = la surface n'a aucun triangle
solver-error-unsound = des nombres de la surface sont non finis ou hors limites
solver-error-tree = aucune extrémité trouvée : { $why }
solver-error-wall = c'est une paroi de { $thickness_mm } mm d'épaisseur, dont la face intérieure ne se distingue pas de l'extérieure
solver-error-cap = { $name } ne peut pas être fermé : { $why }
solver-error-mend = des arêtes ont plus de deux triangles, ou des triangles regardent à l'opposé : réparez d'abord la surface
solver-error-sizes = les longueurs demandées n'ont pas de sens
solver-error-many = des arêtes aussi courtes font environ { $about } triangles, et { $most } au plus sont faits
solver-error-wrap = une enveloppe à { $tolerance_mm } mm près serait trop grande : essayez { $least_mm } mm
solver-error-wrap-coarse = une enveloppe à { $tolerance_mm } mm près n'aurait plus rien de la forme de la surface : essayez { $most_mm } mm au plus
