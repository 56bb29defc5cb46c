### Ce qui échoue et ce qui est dit d'un fichier : des phrases dans un message, dans la liste des constats ou derrière le nom
### d'un fichier. Un « tableau » est une liste de nombres sur les sommets ou les triangles d'une surface, comme dans VTK.

## Fichiers qui ne sont pas ouverts

errors-file-empty = Le fichier est vide.
errors-file-unknown = « { $name } » n'est pas une surface que Lumen connaît : il ouvre les fichiers { $formats } et { $last }.
errors-vtk-kind = Ce sont des données VTK d'un autre type ({ $kind }), et Lumen ouvre des surfaces : extraire la surface et l'enregistrer.
errors-vtk-index = Ce fichier VTK ({ $kind }) ne fait que nommer ceux qui contiennent les données : ouvrir l'un d'eux.
errors-image-volume = Ce n'est pas une surface mais un volume d'images ({ $format }), endommagé ou d'un type que Lumen ne lit pas : le segmenter et enregistrer la surface.
errors-compressed = C'est un fichier compressé ({ $format }) : le décompresser et ouvrir la surface qu'il contient.
errors-cut-short = Le fichier { $format } est tronqué : il annonce { $announced } { $what } et en contient { $found }.
errors-broken-line = Le fichier { $format } est incorrect à la ligne { $line } : { $problem }.
errors-broken = Le fichier { $format } est incorrect : { $problem }.
errors-face-refers = La face { $face } du fichier { $format } renvoie au sommet { $index }, mais le fichier a { $vertices } sommets.
errors-coordinate = Le sommet { $vertex } du fichier a la coordonnée { $value }, qui n'est pas un endroit dans un corps.
errors-gltf-elsewhere = Le fichier glTF garde ses données dans un autre fichier ({ $uri }) : l'enregistrer en un seul fichier GLB et ouvrir celui-ci.
errors-gltf-unnamed = qu'il ne nomme pas
errors-unsupported = Le fichier { $format } utilise quelque chose que Lumen ne lit pas : { $feature }.
errors-too-large = La surface est trop grande : elle a { $corners } sommets ou coins, et Lumen en accepte { $limit }.
errors-no-triangles = Le fichier { $format } ne contient aucun triangle ({ $vertices } sommets et rien à montrer entre eux).
errors-no-surface = Le fichier { $format } ne contient pas de surface, seulement { $lines } et { $points } : Lumen n'ouvre pas de lignes centrales.
errors-unfolds = Décompressé, le fichier { $format } contiendrait { $what }, plus que ce qu'un fichier de { $file } octets peut vraisemblablement contenir.
errors-all-degenerate = Aucun des { $triangles } triangles du fichier { $format } n'a d'aire : chacun répète un de ses sommets.

## Parties d'un fichier qui sont comptées, au pluriel

errors-bytes = octets
errors-header-bytes = octets d'en-tête
errors-vertices = sommets
errors-faces = faces
errors-triangles = triangles
errors-strips = bandes de triangles
errors-rows = rangées de { $name }
errors-points = points
errors-cells = cellules
errors-cell-types = types de cellules

## Ce qu'un fichier contient au lieu d'une surface. $number est $count, écrit.

errors-lines = { $count ->
    [one] { $count } ligne
   *[other] { $count } lignes
}
errors-so-many-points = { $count ->
    [one] { $count } point
   *[other] { $count } points
}
errors-vtk-solids = grille de cellules volumiques
errors-vtk-no-kind = fichier sans type

## Ce qu'un fichier contiendrait, décompressé

errors-so-many-bytes = { $bytes } octets
errors-too-many-bytes = plus d'octets qu'il ne peut y en avoir
errors-parts = { $parts } parties
errors-vertices-triangles = { $vertices } sommets et { $triangles } triangles

## Ce qui n'est pas lu

errors-version = la version { $version }
errors-compressor = la compression { $name }
errors-lzma = LZMA avec un dictionnaire de { $bytes } octets
errors-gltf-whole-positions = des positions en nombres entiers de 32 bits
errors-extension = { $name }

## Ce qui est incorrect dans un fichier: derrière deux points, avant un point. Les mots du fichier sont déjà entre guillemets.

errors-no-number = { $word } se trouve là où il faut un nombre
errors-no-coordinate = { $word } se trouve là où il faut une coordonnée
errors-no-vertex = { $word } se trouve là où il faut un numéro de sommet
errors-no-count = { $word } n'est pas un nombre d'éléments
errors-no-type = { $word } n'est pas un type de nombre
errors-no-text = il devrait être un texte et ne l'est pas
errors-at-byte = { $problem } (à l'octet { $byte })

errors-stl-no-facet = c'est un texte sans un seul « facet »
errors-stl-ends = le fichier se termine au milieu d'un triangle

errors-obj-vertex = un sommet a besoin de trois coordonnées

errors-ply-begin = il ne commence pas par le mot « ply »
errors-ply-end = son en-tête n'a pas de « end_header »
errors-ply-encoding = le codage { $word } n'est pas connu
errors-ply-no-encoding = son en-tête ne dit pas quel est son codage
errors-ply-property-first = une propriété précède tout élément
errors-ply-property = une propriété a besoin d'un type et d'un nom
errors-ply-no-xyz = ses sommets n'ont pas de x, y et z
errors-ply-list = une liste a la longueur { $length }

errors-gltf-no-json = il n'a pas de partie JSON
errors-gltf-json = son JSON est incorrect ou incomplet à la ligne { $line }, colonne { $column }
errors-gltf-no-scene = sa scène manque
errors-gltf-no-node = le nœud { $node } manque
errors-gltf-node-twice = le nœud { $node } dépend de deux autres ou de lui-même
errors-gltf-no-mesh = le maillage { $mesh } manque
errors-gltf-mode = un maillage a un mode de dessin qui n'existe pas
errors-gltf-base64 = ses données en base64 sont endommagées
errors-gltf-no-accessor = l'accesseur { $accessor } manque
errors-gltf-accessor-type = l'accesseur { $accessor } a un type qui n'existe pas
errors-gltf-accessor-shape = l'accesseur { $accessor } n'a pas la forme que son emploi demande
errors-gltf-accessor-empty = l'accesseur { $accessor } n'a pas de données
errors-gltf-accessor-beyond = l'accesseur { $accessor } se trouve au-delà de la fin des données
errors-gltf-accessor-overlap = l'accesseur { $accessor } a des éléments qui se chevauchent
errors-gltf-packed = sa vue compressée { $view } est endommagée, ou d'une sorte qui n'est pas lue
errors-gltf-skin = le skin { $skin } ne va pas avec la scène ou avec le maillage qu'il déplace
errors-gltf-indices = ses numéros de sommets ne sont pas des nombres entiers sans signe

errors-vtk-xml = son XML y est incorrect ou incomplet
errors-vtk-no-file = il n'a pas d'élément « VTKFile »
errors-vtk-no-arrays = « { $element } » n'a pas de tableaux
errors-vtk-no-points = un morceau n'a pas de points
errors-vtk-fractions = ses cellules sont numérotées par des fractions
errors-vtk-beyond = un tableau se trouve au-delà de la fin du fichier
errors-vtk-underscore = ses données ajoutées ne commencent pas par un tiret bas
errors-vtk-no-place = un tableau ne dit pas où sont ses données
errors-vtk-array-end = un tableau dépasse la fin de ses données, ou celles-ci sont endommagées
errors-vtk-block = un bloc compressé est endommagé
errors-vtk-cell = la cellule { $cell } a la longueur { $length }
errors-vtk-third-line = sa troisième ligne ne contient ni « ASCII » ni « BINARY »
errors-vtk-no-part = { $word } ne fait pas partie d'une surface
errors-vtk-no-types = ses cellules n'ont pas de types
errors-vtk-cells-lack = { $name } de ses cellules manque
errors-vtk-ends-count = il se termine là où il faut un nombre d'éléments
errors-vtk-ends-type = il se termine là où il faut un type
errors-vtk-field-type = un champ a des valeurs d'un type inconnu

## Ce qui est dit d'un fichier ouvert. $number est $count, écrit.

errors-stl-trailing = { $bytes } octets après le dernier triangle omis.
errors-stl-count = Le nombre de triangles que le fichier annonce ({ $announced }) ne va pas avec sa longueur : { $found } lus.
errors-stl-fewer = Le nombre de triangles que le fichier annonce ({ $announced }) ne va pas avec sa longueur : { $found } lus. Le fichier est peut-être tronqué.
errors-stl-open = Le fichier est peut-être tronqué : son dernier solide n'a pas de fin.
errors-ply-trailing = { $bytes } octets après le dernier élément omis.
errors-ply-unannounced = Des nombres que l'en-tête du fichier n'annonce pas ont été omis.
errors-ply-more-numbers = Des nombres après le dernier élément ont été omis.
errors-vtk-solids-left-out = { $cells } cellules volumiques ou courbes omises : Lumen montre des surfaces.
errors-vtk-curved = { $count ->
    [one] { $count } face courbe prise comme plane : seuls ses coins sont gardés.
   *[other] { $count } faces courbes prises comme planes : seuls leurs coins sont gardés.
}
errors-gltf-instances = Copies de maillages (EXT_mesh_gpu_instancing) omises : chacun est lu une fois.
errors-gltf-morphs = Cibles de morphing omises : les maillages sont lus dans leur forme de base.
errors-fanned = { $count ->
    [one] { $count } polygone n'a pas pu être découpé en triangles sans repli : il n'a pas d'aire ou se croise lui-même.
   *[other] { $count } polygones n'ont pas pu être découpés en triangles sans repli : ils n'ont pas d'aire ou se croisent eux-mêmes.
}
errors-degenerate = { $count ->
    [one] { $count } triangle à sommet répété supprimé.
   *[other] { $count } triangles à sommet répété supprimés.
}
errors-duplicate = { $count ->
    [one] { $count } triangle présent deux fois ; gardé.
   *[other] { $count } triangles présents deux fois ; gardés.
}
errors-short-faces = { $count ->
    [one] { $count } face de moins de trois coins omise.
   *[other] { $count } faces de moins de trois coins omises.
}
errors-lines-left-out = { $count ->
    [one] { $count } ligne omise : Lumen montre des surfaces.
   *[other] { $count } lignes omises : Lumen montre des surfaces.
}
errors-points-left-out = { $count ->
    [one] { $count } point omis : Lumen montre des surfaces.
   *[other] { $count } points omis : Lumen montre des surfaces.
}
errors-reoriented = { $count ->
    [one] { $count } triangle retourné pour s'accorder avec ses voisins.
   *[other] { $count } triangles retournés pour s'accorder avec leurs voisins.
}
errors-turned = { $count ->
    [one] { $count } morceau trouvé à l'envers et retourné.
   *[other] { $count } morceaux trouvés à l'envers et retournés.
}
errors-non-manifold = { $count ->
    [one] { $count } arête où plus de deux triangles se rejoignent ; laissée comme dans le fichier.
   *[other] { $count } arêtes où plus de deux triangles se rejoignent ; laissées comme dans le fichier.
}
errors-no-inside = La surface n'a ni intérieur ni extérieur (ses triangles ne peuvent pas être accordés).
errors-moved = La surface est loin de l'origine de ses coordonnées : elle a été déplacée de ({ $x } ; { $y } ; { $z }) mm pour garder ses détails, et y sera enregistrée.
errors-unit-by-size = Les nombres du fichier ont été lus en { $unit }, d'après la taille de la surface.
errors-size = La surface mesure { $across } mm d'un coin à l'autre, ce qui est inhabituel pour des vaisseaux : vérifier son unité de longueur.
errors-size-units = La surface mesure { $across } mm d'un coin à l'autre, ce qui est inhabituel pour des vaisseaux : ses nombres sont peut-être en { $units }.
errors-size-small = La surface mesure { $across } mm d'un coin à l'autre : un morceau de petits vaisseaux, ou ses nombres sont en { $units }.
errors-calibre-units = Ses vaisseaux ont { $wide } mm de large en moyenne, ce qui est inhabituel : les nombres du fichier sont peut-être en { $units }.
errors-size-or = { $first } ou en { $next }
errors-size-in = { $unit } ({ $length } mm)

## Tableaux qui sont omis

errors-array-left-out = Le tableau { $name } est omis : { $why }.
errors-arrays-more = { $count ->
    [one] { $count } autre tableau est omis.
   *[other] { $count } autres tableaux sont omis.
}
errors-array-parts = ses parties ne s'accordent pas
errors-array-beyond = seuls les { $most } premiers tableaux d'un fichier sont lus
errors-array-not-everywhere = il manque à une partie du fichier
errors-array-damaged = ses données sont endommagées ou ailleurs
errors-array-matrices = il contient des matrices
errors-array-other-length = il n'a pas la même longueur que la surface
errors-array-memory = il prendrait plus de mémoire qu'il n'en est donné à un fichier de cette taille
errors-array-cut-short = il est tronqué
errors-array-no-number = il contient autre chose que des nombres
errors-array-text = il contient du texte
errors-array-type = ses nombres sont d'un type qui n'est pas lu
errors-array-too-many = ses données sont endommagées, ou trop nombreuses pour un fichier de cette taille
errors-array-of-type = il contient des valeurs du type { $kind }
errors-array-not-understood = ni lui ni ce qui suit n'est compris

## Fichiers qui ne sont pas écrits, ou pas en entier

errors-nothing-to-save = Il n'y a pas de surface à enregistrer.
errors-triangle-refers = Le triangle { $triangle } renvoie au sommet { $index }, mais il y a { $vertices } sommets.
errors-not-finite = Le sommet { $vertex } a une position ou une normale qui n'est pas un nombre fini.
errors-normal-count = Il y a { $normals } normales pour { $vertices } sommets.
errors-array-length = Le tableau « { $name } » a { $tuples } tuples pour { $rows } sommets ou triangles.
errors-format-too-large = La surface est trop grande pour un fichier { $format } : il prendrait { $bytes } octets.
errors-no-place-arrays = { $count ->
    [one] { $format } n'a pas de place pour des tableaux : { $names } est omis.
   *[other] { $format } n'a pas de place pour des tableaux : { $names } sont omis.
}
errors-no-place-triangles = { $count ->
    [one] { $format } n'a pas de place pour des tableaux de triangles : { $names } est omis.
   *[other] { $format } n'a pas de place pour des tableaux de triangles : { $names } sont omis.
}
errors-no-place-colour = { $count ->
    [one] { $format } n'a pas de place pour d'autres tableaux qu'une couleur : { $names } est omis.
   *[other] { $format } n'a pas de place pour d'autres tableaux qu'une couleur : { $names } sont omis.
}
errors-no-place-such = { $count ->
    [one] { $format } n'a pas de place pour de tels tableaux : { $names } est omis.
   *[other] { $format } n'a pas de place pour de tels tableaux : { $names } sont omis.
}
errors-not-carried = Les tableaux du fichier manquent, car ils ne sont pas reportés à ce niveau : enregistrer encore une fois.
errors-no-result = il n'y a pas encore de résultat
errors-not-measured = les vaisseaux sont encore en cours de mesure

## Unités et axes

errors-unknown-unit = « { $word } » n'est pas une unité de longueur que Lumen connaît : mm, cm ou m.
errors-axes = On ne sait pas où pointent les axes de la surface ; elle ne peut donc pas être tournée ({ $from } vers { $to }).
errors-axes-lps = LPS
errors-axes-ras = RAS
errors-axes-unknown = axes inconnus

## Réglages avec lesquels aucune étape ne peut travailler: aussi derrière deux points

errors-pass-band = la bande passante doit être entre 0,001 et 2, pas { $value }
errors-iterations = le nombre d'itérations doit être entre 0 et 200, pas { $value }
errors-feature-angle = l'angle d'arête doit être entre 0 et 180 degrés, pas { $value }
errors-tolerance = la tolérance doit être entre 0 et 100 %, pas { $value } %
errors-reduction = le taux de réduction doit être entre 0 et 99,9 %, pas { $value } %
errors-deviation = l'écart maximal doit être entre 0,001 et 1000 mm, pas { $value } mm
errors-weld = la tolérance de soudure doit être entre 0,000001 et 100 mm, pas { $value } mm
errors-fill = la taille des trous à combler doit être entre 0,001 et 1000 mm, pas { $value } mm
errors-no-component = il n'y a pas de composante { $wanted } : la surface en a { $count }

## Ce que la réparation a laissé

errors-weld-limited = À { $vertices } sommets sur des arêtes libres, moins de { $mm } mm a été soudé : leurs triangles sont aussi petits.
errors-wall-not-parted = La lumière n'a pas été prise : les faces de la paroi ne se distinguent pas.
errors-no-wall = La surface n'est pas une paroi à deux faces : elle est prise telle quelle.
errors-holes-left = { $count ->
    [one] { $count } trou dans la limite n'a pas pu être comblé sans croiser la surface.
   *[other] { $count } trous dans la limite n'ont pas pu être comblés sans croiser la surface.
}

## Messages entre les parties de Lumen

errors-message = le message n'est pas compris : { $error }
errors-message-missing = le tampon { $index } du message manque
errors-message-buffer = le tampon { $index } du message a { $bytes } octets, ce qui n'est pas un multiple de { $element }
errors-message-memory = il n'y a plus de mémoire pour ses { $bytes } octets
errors-message-text = le tampon { $index } du message n'est pas un texte

## Exemples qui ne peuvent pas être créés

errors-sample-range = { $asked } triangles sont hors de l'intervalle de { $least } à { $most }
errors-sample-grid = aucune grille ne donne { $asked } triangles à 1 % près ; la plus proche en donne { $nearest }
errors-cancelled = annulé
