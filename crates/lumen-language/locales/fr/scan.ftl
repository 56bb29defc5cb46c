### Scans et masques : leur panneau et leurs vues, ce qui peut manquer à leurs fichiers et ce que le navigateur dit des fichiers.

## Le panneau

scan-title = Scan
scan-what = La surface est créée là où les valeurs atteignent le seuil, ou à partir d'une étiquette ; elle est ensuite lissée et réduite.
scan-name = Scan
scan-format = Format
scan-voxels = Voxels
scan-voxels-help = Colonnes, lignes et coupes
scan-spacing = Pas
scan-spacing-help = Entre les colonnes, les lignes et les coupes
scan-values = Valeurs
scan-values-range = { $low } à { $high }{ $unit }
scan-volume = Volume
scan-volume-help = Lequel des volumes des fichiers est montré ; un autre est lu à nouveau
scan-volume-offer = { $slices ->
    [one] { $what } ({ $slices } coupe)
   *[other] { $what } ({ $slices } coupes)
}
scan-volume-series = série { $number }
scan-threshold = Seuil
scan-threshold-help = Ce qui a cette valeur ou plus est le vaisseau ; les vaisseaux opacifiés au scanner ont de 150 à 500 HU.
scan-histogram = Histogramme, avec le seuil
scan-vessel = Vaisseau
scan-vessel-help = Quelle étiquette du masque est le vaisseau
scan-vessel-label = Étiquette du vaisseau
scan-label = Étiquette { $label }
scan-label-named = Étiquette { $label } : { $name }
scan-all-labels = Toutes
scan-seed = Point de départ
scan-seed-help = Seul ce qui est relié à ce voxel devient la surface
scan-seed-remove = Retirer
scan-seed-click = Cliquer sur le vaisseau dans la coupe : seul ce qui y est relié devient la surface.
scan-half-way = Le seuil est à mi-chemin entre le vaisseau ({ $vessel }{ $unit }) et ce qui l'entoure ({ $around }{ $unit }).
scan-method = Surface par
scan-method-help = Les surface nets lissent les marches dans chaque voxel, ce qui laisse les vaisseaux fins au plus près de leur calibre ; les marching cubes les gardent, et le lissage les enlève
scan-surface-nets = Surface nets
scan-marching-cubes = Marching cubes
scan-shifts = Avec un seuil plus bas de 10 %, la paroi serait { $lower } mm plus à l'extérieur ; avec un seuil plus haut de 10 %, { $higher } mm.
scan-box = Cadre
scan-box-help = Seuls ces voxels sont examinés : ce qui est en dehors, comme les os, est omis
scan-columns = Colonnes
scan-rows = Lignes
scan-slices = Coupes
scan-box-ends = La première et la dernière, à partir de 0
scan-last-of = Dernière des { $axis }
scan-first-of = Première des { $axis }
scan-whole = Tout le scan
scan-across = Selon
scan-across-help = Dans quel sens se trouve la coupe affichée
scan-slice = Coupe
scan-preview = Aperçu
scan-preview-help = La surface à résolution réduite
scan-triangles = { $count ->
    [one] { $count } triangle
   *[other] { $count } triangles
}
scan-preview-coarse = L'aperçu a un voxel pour { $block }, dès que l'un d'eux est à l'intérieur : les vaisseaux fins paraissent plus larges qu'ils ne sont.
scan-cancel = Annuler
scan-cancel-help = Échap
scan-make = Créer la surface
scan-make-help = À pleine résolution, et l'ouvrir
scan-close = Fermer le scan

## Ce qui est en cours

scan-fetching = La partie de Lumen qui lit les scans est encore en cours de chargement
scan-part-missing = Pas ouvert : la partie de Lumen qui lit les fichiers n'a pas encore pu être téléchargée. Réessayez dans un instant
scan-reading = Lecture du scan
scan-surveying = Comptage des valeurs
scan-making = Création de la surface
scan-progress = Avancement du scan
scan-engine-stopped = Le calcul du scan s'est arrêté ({ $reason }) : ouvrir à nouveau le scan.

## Les vues d'un scan

scan-preview-view = Aperçu de la surface
scan-preview-made = L'aperçu est en cours de création
scan-preview-not-drawn = L'aperçu ne peut pas être dessiné : { $why }.
scan-no-device = Il n'y a pas de périphérique graphique pour dessiner.
scan-slice-view = Coupe du scan
scan-slice-number = Coupe { $number }

## Coupes derrière la surface

scan-slices-title = Coupes du scan
scan-across-columns = Selon les colonnes
scan-across-rows = Selon les lignes
scan-across-slices = Selon les coupes
scan-sagittal = Sagittal
scan-coronal = Coronal
scan-axial = Axial
scan-plane-help = Afficher ce plan du scan derrière la surface ; les touches 1 à 6 le montrent de face
scan-slice-place = { $slice } sur { $count }, { $mm } mm
scan-slice-place-help = Quelle coupe, et à quelle distance de la première
scan-plane-slider-help = Déplace le plan à travers le scan
scan-plane-slice = Coupe : { $plane }
scan-outline = Contour de la surface
scan-outline-help = Là où le plan coupe la surface affichée ; il devrait suivre le bord du vaisseau
scan-keep = Garder le scan pour les coupes ({ $mb } Mo)
scan-keep-help = Le scan reste en mémoire, avec ce qui l'a lu, pour que ses coupes puissent être affichées derrière la surface

## La fenêtre des valeurs

scan-window = Fenêtre
scan-window-help = Les valeurs qui sont noires et blanches
scan-window-name = Fenêtre des valeurs
scan-window-vessels = Vaisseaux
scan-window-soft = Tissus mous
scan-window-bone = Os
scan-window-most = La plupart
scan-window-all = Toutes
scan-window-own = Autre
scan-level-width = Centre, largeur
scan-level-width-help = La valeur à mi-chemin entre le noir et le blanc, et l'écart entre ceux-ci
scan-width = Largeur de la fenêtre
scan-level = Centre de la fenêtre

## Préréglages du seuil

scan-preset-little = pour des vaisseaux peu opacifiés
scan-preset-arteries = pour les artères
scan-preset-aorta = pour l'aorte et les artères coronaires
scan-preset = { $value } { $name }
scan-presets = { $first }, { $second }, { $third }

## Pourquoi il n'y a pas de surface, d'aperçu ou de coupe

scan-none-open = Aucun scan n'est encore ouvert.
scan-no-slice = Cette coupe n'existe pas.
scan-nothing-chosen = C'est un scan aux valeurs de { $low } à { $high } : indiquer à quel seuil sa surface doit être créée (vaisseaux opacifiés au scanner : { $presets }).
scan-outside-range = Aucune surface ne se trouve au seuil { $threshold } : les valeurs vont de { $low } à { $high }.
scan-seed-outside = Le point de départ n'est pas dans le vaisseau : sa valeur { $value } n'est pas choisie.
scan-seed-nowhere = Le point de départ n'est pas dans le scan ou pas dans la boîte.
scan-seed-no-edge = Aucun bord de vaisseau n'a été trouvé autour du point de départ : régler le seuil.
scan-no-label = Il n'y a pas d'étiquette { $label } dans le volume ; { $known }.
scan-known-range = c'est un scan aux valeurs de { $low } à { $high }
scan-known-labels = il a { $labels }
scan-outside-box = Le cadre ne contient rien du volume, qui a { $size } voxels.
scan-slice-too-large = Une coupe a { $points } voxels, dont { $limit } peuvent être traités : placer un cadre autour des vaisseaux.
scan-all-one-side = Il n'y a pas de surface : tout le volume se trouve du même côté.
scan-one-side = Il n'y a pas de surface dans le cadre : tout se trouve du même côté.
scan-too-many-triangles = La surface a plus de { $limit } triangles, pour la plupart du bruit ou des os : relever le seuil ou placer un cadre autour des vaisseaux.

## Pourquoi un volume n'a pas de place

scan-no-place = Le volume ne peut pas être placé dans le patient : { $why }.
scan-no-points = { $size } points ne font pas un volume
scan-no-spacing = aucun scan n'a une distance de { $spacing } mm entre ses points
scan-no-directions = les directions de ses axes n'engendrent pas l'espace
scan-no-origin = son origine n'est pas un endroit dans un corps
scan-points = Le volume a { $points } points et { $samples } nombres pour ceux-ci.

## Pourquoi un fichier n'a pas été ouvert

scan-no-volume = « { $name } » n'est pas un volume que Lumen connaît : il ouvre les fichiers NIfTI, NRRD, MetaImage et VTI et les séries DICOM.
scan-no-scan = Le fichier { $format } ne peut pas être ouvert comme scan : { $problem }.
scan-data-elsewhere = L'en-tête { $format } garde ses nombres dans le fichier « { $name } » : ouvrir les deux ensemble.
scan-dicom-mixed = { $places ->
    [one] Plusieurs coupes se trouvent à une même place, et rien dans les fichiers ne dit à quel volume chacune appartient : ouvrez les fichiers d'un seul volume.
   *[other] Plusieurs coupes se trouvent à chacune de { $places } places, et rien dans les fichiers ne dit à quel volume chacune appartient : ouvrez les fichiers d'un seul volume.
}
scan-no-such-volume = { $count ->
    [one] Il n'y a pas de volume { $number } : les fichiers n'en contiennent qu'un.
   *[other] Il n'y a pas de volume { $number } : les fichiers en contiennent { $count }.
}
scan-too-large = Le volume est trop grand : ses nombres prennent { $bytes } octets, et Lumen peut en prendre { $limit }.
scan-volume-memory = Il n'y a pas assez de mémoire pour les { $bytes } octets du volume.
scan-no-memory = Il n'y a pas assez de mémoire ici pour lire { $mb } Mo.
scan-file-gone = Le fichier n'est plus là.
scan-unreadable = { $path } est illisible

## Ce qui semble étrange dans un fichier

scan-silent = Le fichier { $format } ne dit pas comment le patient est orienté : les axes sont inconnus.
scan-silent-format = { $format } ne dit pas comment le patient est orienté : les axes sont inconnus.
scan-unknown-unit = L'unité de longueur du fichier { $format }, { $unit }, n'est pas connue : elle est prise pour des mm.
scan-nifti-no-matrix = La matrice (sform) du fichier NIfTI est inutilisable : ses directions n'engendrent pas l'espace. Le quaternion (qform) est utilisé à la place.
scan-nifti-no-place = La matrice (sform) du fichier NIfTI est inutilisable : ses directions n'engendrent pas l'espace. Il n'y a pas de quaternion (qform) utilisable, et les espacements sont utilisés à la place.
scan-nifti-spacings = Le fichier NIfTI se contredit : selon sa matrice (sform) les voxels sont à { $matrix } mm, selon ses espacements à { $stated } mm. La matrice est prise.

## Ce qui ne va pas dans un fichier

scan-packed = il annonce { $needed } octets, plus que ses { $bytes } octets compressés ne peuvent contenir : il est tronqué ou endommagé
scan-packed-damaged = ses données compressées sont tronquées ou endommagées
scan-header-endless = son en-tête ne se termine pas par une ligne vide
scan-header-lacks = son en-tête n'a pas de « { $key } »
scan-header-none = son en-tête n'en est pas un
scan-not-numbers = « { $key } » n'est pas fait de { $count } nombres
scan-no-data-file = son en-tête ne dit pas où sont les nombres ({ $key })
scan-many-labels = ses couches contiennent plus de { $most } étiquettes, le maximum d'une carte
scan-axes = il a { $axes } axes
scan-dicom-header = un fichier se termine dans son en-tête
scan-dicom-damaged = les éléments d'un fichier sont endommagés
scan-dicom-cut-short = un fichier se termine dans l'un de ses éléments
scan-dicom-pixels = une coupe a moins de pixels que lignes fois colonnes
scan-dicom-jpeg = l'image JPEG d'une coupe est endommagée, ou d'un genre qui n'est pas lu
scan-dicom-jpeg-size = l'image JPEG d'une coupe n'a pas la taille que le fichier indique
scan-dicom-no-directions = il ne dit pas comment ses coupes sont orientées
scan-dicom-no-spacing = il ne dit pas à quelle distance sont ses pixels
scan-dicom-no-places = il ne dit pas où sont ses coupes
scan-dicom-no-slice = aucun de ses fichiers ne contient une coupe en niveaux de gris
scan-dicom-colours = ses images sont en couleurs, et une surface demande des niveaux de gris
scan-dicom-single = il ne contient qu'une coupe, et une surface en demande deux ou plus
scan-vti-wrong = « { $name } » est faux
scan-vti-no-element = il n'a pas d'élément « { $name } »
scan-vti-no-points = il ne dit pas combien de points il y a
scan-vti-no-array = il n'a pas de tableau d'un nombre par point ou par cellule

## Ce qui n'est pas lu : derrière « utilise »

scan-dimensions = un nombre de dimensions autre que trois
scan-more-dimensions = plus de trois dimensions
scan-number-type = des nombres du type { $kind }
scan-file-a-slice = un fichier par coupe
scan-encoding = le codage { $name }
scan-numbers-a-voxel = plusieurs nombres par voxel
scan-dicom-jpeg-bits = des images JPEG de { $bits } bits
scan-dicom-table = une table de valeurs (modality LUT)
scan-dicom-jpeg-2000 = la compression JPEG 2000
scan-dicom-compression = une compression inconnue
scan-dicom-bits = { $bits } bits par pixel
scan-vti-pieces = plusieurs morceaux

## Ce qui est dit d'une série DICOM

scan-dicom-unreadable = { $count ->
    [one] Une coupe ne peut pas être lue et est omise. { $why }
   *[other] { $count } coupes ne peuvent pas être lues et sont omises. { $why }
}
scan-dicom-same-place = { $count ->
    [one] Une coupe est présente deux fois, à la même place et avec les mêmes pixels : une seule est prise.
   *[other] { $count } coupes sont présentes deux fois, à la même place et avec les mêmes pixels : une seule de chaque est prise.
}
scan-volumes = Les fichiers contiennent { $count } volumes d'une même série, distingués par : { $by } ; chacun avec son nombre de coupes : { $list }. Le volume { $taken } est ouvert.
scan-dicom-series = { $others ->
    [one] Les fichiers contiennent { $count } séries. Le volume qui a le plus de coupes ({ $taken }) est ouvert. Coupes omises de l'autre série : { $slices }.
   *[other] Les fichiers contiennent { $count } séries. Le volume qui a le plus de coupes ({ $taken }) est ouvert. Coupes omises de { $others } autres séries : { $slices }.
}
scan-dicom-mixed-left-out = { $count ->
    [one] { $count } volume est omis : plusieurs de ses coupes sont à la même place, et rien dans les fichiers ne dit à quel volume chacune appartient.
   *[other] { $count } volumes sont omis : plusieurs de leurs coupes sont à la même place, et rien dans les fichiers ne dit à quel volume chacune appartient.
}
scan-dicom-no-slices = { $count ->
    [one] { $count } fichier ne contient pas de coupe en niveaux de gris et est omis.
   *[other] { $count } fichiers ne contiennent pas de coupe en niveaux de gris et sont omis.
}
scan-dicom-gap = Les coupes ne sont pas régulièrement espacées : le plus souvent { $usual } mm, mais { $there } mm entre les coupes { $below } et { $above } ; il en manque peut-être, et la surface y est étirée.
scan-dicom-squeeze = Les coupes ne sont pas régulièrement espacées : le plus souvent { $usual } mm, mais { $there } mm entre les coupes { $below } et { $above } ; la surface y est comprimée.

## Ce qui distingue les volumes d'une série : derrière deux-points, et devant sa valeur

scan-by-time = position temporelle
scan-by-heart-phase = phase cardiaque
scan-by-trigger = temps de déclenchement
scan-by-echo = écho
scan-by-b-value = valeur b
scan-by-image-type = type d'image
scan-by-stack = pile
scan-by-acquisition = numéro d'acquisition
scan-by-thickness = épaisseur de coupe
scan-by-kernel = noyau de convolution
scan-by-voltage = tension du tube
scan-by-reference-frame = repère
scan-by-moment = moment
scan-by-order = numéros des coupes
scan-by-place = positions des coupes
scan-by-several = plusieurs champs
scan-by-segment = segment
scan-by-layer = couche

## Le navigateur

scan-part-gone = Un fichier du scan n'a pas pu être lu ; il a peut-être été déplacé ou modifié depuis qu'il a été choisi.
scan-part-memory = Le navigateur n'a plus de mémoire pour lire le scan.
scan-folder-lost = Le navigateur n'a pas pu lire le dossier.
scan-folder-empty = Il n'y a pas de fichiers dans le dossier.
scan-file-large = { $name } fait { $gb } Go ; dans le navigateur, Lumen ouvre des surfaces jusqu'à { $limit } Go.
scan-file-lost = Le navigateur n'a pas pu lire { $name } ; le fichier a peut-être été déplacé ou modifié depuis qu'il a été choisi.
scan-file-memory = { $name } fait { $mb } Mo, pour lesquels ce navigateur n'a plus de mémoire.
scan-no-dialog = Le navigateur n'a pas ouvert de boîte de dialogue.
scan-saved = { $name } a été enregistré.
scan-both-saved = { $first } et { $second } ont été enregistrés.
scan-not-saved = { $name } n'a pas été enregistré : le navigateur n'a plus de mémoire pour { $mb } Mo.
scan-not-kept = { $name } n'est pas gardé : ce navigateur n'a pas de place pour { $mb } Mo.
scan-not-forgotten = Le navigateur n'a pas pu oublier la surface : effacer les données de cette page dans ses réglages.
scan-typed = Saisie

scan-not-fetched = son programme n'a pas pu être chargé : { $reason }
scan-not-handed-over = les fichiers n'ont pas pu être transmis : { $why }
scan-not-sent = une commande n'a pas pu être envoyée : { $why }
scan-not-understood = une réponse n'a pas pu être lue : { $why }
scan-no-worker = aucun Worker n'a pu être démarré : { $why }
scan-memory-ends = il n'y a plus de mémoire au-delà de ses { $gb } Go
scan-message-unread = Le message n'a pas pu être lu.
scan-script-unloaded = Le script du Worker n'a pas pu être chargé.
scan-browser-memory = le navigateur n'a plus de mémoire pour { $mb } Mo
scan-language-not-handed-over = la langue n'a pas pu être transmise : { $why }
scan-language-failed = Les mots de la langue { $name } n'ont pas pu être chargés : { $reason }. Rien ne change.
