### Les vaisseaux : ce que le lissage et la réduction ont fait du calibre de chacun, dans l'application et les rapports.

vessels-branch = branche { $number }

## Ce que l'on peut enregistrer

vessels-save-vtp = Lignes centrales (VTP)...
vessels-save-vtp-help = De la surface à l'ouverture, avec le rayon de la boule inscrite ; tableaux nommés comme ceux de vmtk
vessels-save-csv = Lignes centrales (CSV)...
vessels-save-csv-help = De la surface à l'ouverture, une ligne par point
vessels-save-calibre = Calibre (CSV)...
vessels-save-calibre-help = Aire et rayon à l'ouverture, après lissage et après réduction, une ligne par point

## L'en-tête des vaisseaux sous les vues

vessels-heading = Vaisseaux
vessels-coming = Mesure des vaisseaux en cours...
vessels-newer = De nouvelles valeurs arrivent.
vessels-allowed = Tolérance
vessels-allowed-help = Du rayon de chaque vaisseau, par rapport à la surface à l'ouverture
vessels-colour = Colorer la surface
vessels-colour-help = De combien chaque vaisseau est plus large ou plus étroit qu'à l'ouverture
vessels-copy = Copier
vessels-copy-help = Le tableau en texte, une tabulation entre les colonnes
vessels-save = Enreg. CSV
vessels-save-help = Aire et rayon en chaque point de chaque vaisseau
vessels-back = Retour
vessels-close = Fermer

## Le tableau

vessels-column-vessel = Vaisseau
vessels-column-vessel-help = Cliquer pour voir le rayon le long du vaisseau et aller là où il change le plus
vessels-column-verdict = Verdict
vessels-column-verdict-help = Indique s'il garde son calibre après réduction, dans la limite de la tolérance
vessels-column-measured = Mesuré
vessels-column-measured-help = La part de sa longueur où il est mesuré : ailleurs le verdict ne dit rien
vessels-column-reduced = Réduit
vessels-column-reduced-help = Le plus grand changement de son rayon, après réduction, par rapport à la surface à l'ouverture
vessels-column-smoothed = Lissé
vessels-column-smoothed-help = Le plus grand changement de son rayon, après lissage, par rapport à la surface à l'ouverture
vessels-column-safe = Sûr jusqu'à
vessels-column-safe-help = La réduction jusqu'à laquelle il a gardé son calibre
vessels-column-radius-help = Du cercle de même aire, à l'ouverture : moyenne, et du plus petit au plus grand
vessels-column-uneven = Inégal
vessels-column-uneven-help = Où son diamètre, à l'ouverture, est le plus nettement plus étroit ou plus large que de part et d'autre, d'un quart au moins ; sur quelle longueur
vessels-column-length = Long., mm
vessels-column-length-help = Le long de sa ligne centrale
vessels-column-tortuosity = Tortuosité
vessels-column-tortuosity-help = Longueur divisée par la distance des extrémités
vessels-verdict-kept = gardé
vessels-verdict-changed = changé
vessels-verdict-not-measured = non mesuré
vessels-spread = { $mean } ({ $least } à { $largest })
vessels-narrower = { $percent } % plus étroit
vessels-wider = { $percent } % plus large
vessels-narrower-over = { $percent } % plus étroit sur { $length } mm, à { $at } mm
vessels-wider-over = { $percent } % plus large sur { $length } mm, à { $at } mm
vessels-uneven-both = { $narrower } ; { $wider }
# Le diamètre, la référence, et les endroits le long du vaisseau où elle est mesurée.
vessels-reference-between = { $diameter } au lieu de { $reference } mm, d'après les diamètres à { $from } et { $to } mm
vessels-reference-at = { $diameter } au lieu de { $reference } mm, d'après le diamètre à { $at } mm
vessels-reference = { $diameter } au lieu de { $reference } mm
vessels-table = { $name }, tolérance { $tolerance } %
# Le suit après une virgule.
vessels-table-measured = mesuré sur { $coverage }

## Pourquoi un vaisseau n'est mesuré nulle part

vessels-too-thin = Sa largeur est de moins de deux arêtes : trop grossier pour conclure.
vessels-not-closed = Ses sections ne se ferment pas.
vessels-ambiguous = Sa paroi y est repliée : une section a plus d'un contour, et lequel est retenu change avec la surface.
vessels-at-forks = Il est trop court : tout entier à des bifurcations ou à des extrémités.
vessels-at-ends = Il est trop court : tout entier à des extrémités ou à des bifurcations.

## Le rayon le long d'un vaisseau

vessels-radius-head = Rayon le long de la { $name } :
# Au-dessus : une portion plus étroite ou plus large que de part et d'autre, et ce à quoi elle est comparée.
vessels-uneven = { $stretch } : { $reference }
# L'endroit le plus étroit, comparé à un autre que l'on a choisi.
vessels-refer = Référence choisie
vessels-refer-help = Compare l'endroit le plus étroit de cette branche à l'endroit choisi, d'après le diamètre du cercle de même aire : faire glisser la ligne dans le tracé
vessels-refer-at = Référence à
vessels-refer-at-help = Faire glisser, ou saisir un endroit le long de la branche
vessels-refer-reduced = Réduit : { $percent } %
vessels-refers-here = référence { $diameter } mm
vessels-reference-line = référence
vessels-radius-along = Rayon le long de la { $name }
vessels-as-opened = à l'ouverture
vessels-smoothed = lissé
vessels-reduced = réduit
vessels-dotted = pointillé : ±{ $percent } %
vessels-no-section = Aucune de ses sections ne peut être mesurée.
vessels-along = Le long du vaisseau, mm
vessels-radius = Rayon, mm
vessels-hover =
    { $surface }
    { $radius } mm à { $at } mm
    Cliquer pour y aller

## Ce qu'ils sont devenus

vessels-all-kept-short = gardés, à { $tolerance } %
# Là où trop peu est mesuré.
vessels-kept-short = gardés sur { $percent } %
vessels-some-changed-short = { $changed ->
    [one] { $changed } sur { $all } changé
   *[other] { $changed } sur { $all } changés
}
vessels-place = { $name } : { $percent } %
vessels-not-here = { $name } : non mesuré ici
vessels-none = Il n'y a pas de vaisseau à mesurer : { $why }.
vessels-sentences = { $first } { $rest }
vessels-none-measured = Aucun vaisseau ne peut être mesuré.
vessels-all-kept = { $count ->
    [one] Le vaisseau garde son calibre à { $tolerance } % près.
   *[other] Les { $count } vaisseaux gardent leur calibre à { $tolerance } % près.
}
vessels-kept-of = { $count ->
    [one] { $count } vaisseau sur { $all } a été mesuré : il garde son calibre à { $tolerance } % près.
   *[other] { $count } vaisseaux sur { $all } ont été mesurés : ils gardent leur calibre à { $tolerance } % près.
}
vessels-changed = { $changed ->
    [one] { $changed } vaisseau mesuré sur { $all } change de plus de { $tolerance } %.
   *[other] { $changed } vaisseaux mesurés sur { $all } changent de plus de { $tolerance } %.
}
vessels-changed-most = { $changed ->
    [one] { $changed } vaisseau mesuré sur { $all } change de plus de { $tolerance } %, surtout la { $name } : { $by } %.
   *[other] { $changed } vaisseaux mesurés sur { $all } changent de plus de { $tolerance } %, surtout la { $name } : { $by } %.
}
vessels-measured-over = Mesuré sur { $percent } % de la longueur ; pas sur { $parts }.
# Après un titre ou un deux-points.
vessels-coverage = { $percent } % de la longueur, { $measured } sur { $all ->
    [one] { $all } vaisseau
   *[other] { $all } vaisseaux
}
# Des parts de la longueur, énumérées après « pas sur ».
vessels-parts = { $first }, { $rest }
vessels-part-ends = { $percent } % aux extrémités
vessels-part-forks = { $percent } % aux bifurcations
vessels-part-thin = { $percent } % trop grossiers
vessels-part-unclear = { $percent } % sans contour fermé unique
vessels-by-smoothing = Le lissage seul en change déjà { $count } autant.
vessels-unknown = { $count ->
    [one] Un autre est trop court ou trop grossier pour être mesuré.
   *[other] { $count } autres sont trop courts ou trop grossiers pour être mesurés.
}
vessels-open-ends = { $count ->
    [one] Aucun vaisseau n'a été trouvé à une extrémité ouverte.
   *[other] Aucun vaisseau n'a été trouvé à { $count } extrémités ouvertes.
}

## Pourquoi il n'y a pas de vaisseau, ou rien de mesuré

vessels-error-no-triangles = la surface n'a pas de triangles
vessels-error-inside-out = la surface est retournée : ses triangles sont tournés vers l'intérieur du vaisseau
vessels-error-no-inside = { $triangles ->
    [one] la surface n'a pas d'intérieur : c'est un seul triangle
   *[other] la surface n'a pas d'intérieur : de ses { $triangles } triangles, aucun ne fait face à un autre
}
vessels-error-sheet = l'intérieur de la surface est une couche mince et non un vaisseau : il faut plus de { $balls } boules pour le remplir ; c'est peut-être la paroi d'un vaisseau, avec une face interne et une face externe
vessels-error-unit = le vaisseau le plus large fait { $diameter } mm : la surface n'est sans doute pas dans l'unité dans laquelle elle a été ouverte
vessels-error-no-centreline = il n'y a pas de ligne centrale à laquelle elle serait perpendiculaire
vessels-error-not-closed = la paroi n'y est pas fermée autour de la ligne centrale : la surface est ouverte ou repliée dans ce plan
vessels-error-no-fork = aucun vaisseau ne se divise : un angle peut être mesuré entre trois points
vessels-error-short = une branche de cette bifurcation est trop courte pour avoir sa propre direction
