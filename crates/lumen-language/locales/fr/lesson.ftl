### Leçons, leur carte et le glossaire.

## La carte d'une leçon

# Au-dessus d'une étape : le titre de la leçon, et laquelle de ses étapes c'est.
lesson-place = { $title }, { $step } sur { $count }
lesson-close = Fermer la leçon
lesson-close-help = Quitter la leçon (Échap)
lesson-next = Suivant
lesson-next-help = Règle l'application pour l'étape suivante
lesson-back = Retour
lesson-back-help = La règle pour l'étape d'avant
lesson-again = Remettre
lesson-again-help = Règle l'application comme cette étape l'a
lesson-copy-link = Copier le lien
lesson-copy-link-help = Ouvre cette étape pour qui le suit
# $what est ce qui suit « look: » dans une étape d'une leçon, de celles d'en bas ou de celle d'un enseignant.
lesson-look = À regarder : { $what }
# En dessous, tant que des nombres manquent encore.
lesson-measuring = Mesure en cours : les nombres suivent.
lesson-show-answer = Voir la réponse
lesson-show-answer-help = Donner d'abord la sienne
# Told as a lesson is closed.
lesson-given-back = Réglages et couleurs sont comme avant la leçon. Annuler rétablit ceux de la leçon.
lesson-given-back-surface = { $name } est de nouveau ouvert, avec les réglages d'avant la leçon.

## Ce qui ne va pas dans une leçon qu'un enseignant a écrite

# $names sont ceux des liens ; ils sont les mêmes dans toutes les langues.
lesson-no-such = Il n'y a pas de leçon de ce nom ; il y a { $names }.
lesson-not-first = Ce n'est pas une leçon : sa première ligne doit être « { $first } ».
lesson-not-text = Ce n'est pas une leçon : ce n'est pas un texte, ou il est trop long.
lesson-no-step = La leçon n'a pas d'étape.
lesson-unknown-key = La ligne { $line } de la leçon n'est pas comprise : « { $key } ».
lesson-wrong-value = Ligne { $line } de la leçon : « { $value } » n'est pas une valeur pour « { $key } ».
lesson-half-question = Une étape de la leçon a une question sans réponse, ou une réponse sans question : « { $step } ».
lesson-settings-twice = Ligne { $line } de la leçon : « { $name } » y est deux fois.
lesson-settings-unknown = Ligne { $line } de la leçon : « { $name } » ne veut rien dire ici.
lesson-settings-value = Ligne { $line } de la leçon : « { $value } » n'est pas une valeur pour « { $key } ».
lesson-settings-range = La ligne { $line } de la leçon ne peut pas servir : { $error }.
lesson-settings-long = Ligne { $line } de la leçon : les réglages sont trop longs.

## Les leçons

# De chaque leçon son titre, comme le menu l'a, et son fichier : ce qu'un enseignant pourrait écrire (docs/teaching.md). Ce qui est
# devant un deux-points, la première ligne et les valeurs de sample, settings, view, show et trial sont les mêmes dans toutes les
# langues. Une ligne qui commence par deux espaces de plus continue celle d'au-dessus ; aucune de celles-ci ne doit commencer par un
# point, une étoile ou un crochet.

lesson-stair-steps = Marches d'escalier
lesson-stair-steps-text =
    lumen lesson 1
    title: Marches d'escalier

    step: Ce qu'un scan laisse
    text: Un scan est une grille de boîtes. Une segmentation dit de chaque boîte si elle fait partie du vaisseau, et les marching
      cubes placent une surface autour de celles-là. La paroi est donc en terrasses, aussi hautes qu'une coupe est épaisse.
    sample: aorta
    settings: iterations=0 reduction=0
    view: anterior
    show: raking
    look: les terrasses en travers de l'aorte, et comme elles tournent le long des branches qui sont à plat.
    ask: Une terrasse est-elle une propriété du vaisseau ou du scan ?
    answer: Du scan. Tournez le patient, et les terrasses seront ailleurs ; le vaisseau est le même.

    step: Avec le filtre
    text: Le filtre en sinus cardinal fenêtré enlève ce qui est plus court que la forme du vaisseau et laisse ce qui est plus long.
      Aucun triangle ne disparaît ; les sommets bougent.
    settings: reduction=0
    view: anterior
    show: split
    look: la ligne dans la vue de gauche ; tirez-la. À sa gauche, la surface à l'ouverture ; à sa droite, lissée.
    ask: De combien un sommet a-t-il bougé, par rapport à la taille d'un voxel ?
    answer: Sur la plus grande part de la paroi moins d'un demi-voxel : aucune terrasse ne s'y arrête plus loin de la vraie paroi.
      Couleur selon l'écart le montre, avec « Depuis l'original » coché.

    step: Pourquoi cela gêne une simulation
    text: Un guide sent chaque terrasse comme une arête. Un frottement est demandé là où le patient n'en a pas, et la recherche de
      contacts porte sur bien plus de triangles que la forme n'en demande.
    settings: reduction=90
    view: anterior
    show: split
    look: le fil de fer ; il reste un triangle sur dix, et la forme est là.

lesson-nets = Deux chemins depuis un masque
lesson-nets-text =
    lumen lesson 1
    title: Deux chemins depuis un masque

    step: Marching cubes
    text: Un masque dit de chaque voxel s'il fait partie du vaisseau. Les marching cubes placent chaque sommet à mi-chemin entre un voxel
      qui en fait partie et un autre qui n'en fait pas partie. La paroi a donc les marches des voxels.
    sample: aorta
    settings: iterations=0 reduction=0
    view: anterior
    show: raking
    look: les marches ; rien n'est encore lissé.

    step: Surface nets
    text: Le même masque par surface nets. Chaque cellule entre des voxels différents a un sommet, qui va vers ses voisins et en revient
      sans jamais quitter sa cellule. La surface est moins rugueuse avant tout filtre.
    sample: aorta-nets
    settings: iterations=0 reduction=0
    view: anterior
    show: raking
    look: les mêmes endroits qu'avant.
    ask: Un tel lissage tire une paroi vers l'intérieur. Les vaisseaux en sont-ils plus étroits ?
    answer: Non. Chaque pas vers les voisins est suivi d'un pas en arrière, et le volume diffère de moins de 1 % de celui des marching
      cubes.

    step: Les deux avec le filtre
    text: Le filtre lisse l'une et l'autre surface. Ici, chaque artère qui part de l'aorte est aussi large par les deux chemins, à
      1 % près de son rayon moyen.
    sample: aorta-nets
    settings: reduction=0
    view: anterior
    show: split
    look: la ligne dans la vue de gauche ; à sa gauche les surface nets telles quelles, à sa droite avec le filtre.
    ask: Pourquoi Lumen commence-t-il par les surface nets quand un masque est ouvert ?
    answer: Pour les vaisseaux fins. Le filtre les épargne, et il en reste presque ce par quoi il commence.

lesson-pass-band = Bande passante
lesson-pass-band-text =
    lumen lesson 1
    title: Bande passante

    step: Tout passe
    text: Une surface peut se décomposer en ondes, comme un son. Chacune a une valeur propre k du laplacien de la surface : petite
      pour les ondes longues, jusqu'à 2 pour la plus courte. Ce qui est sous la bande passante reste. À 2, c'est tout.
    sample: aorta
    settings: pass-band=2 reduction=0 adapt=no guard=no
    view: anterior
    show: response
    look: la réponse à l'étape 2 du panneau, une droite à 100 %.

    step: Seulement ce qui est long
    text: À 0,1 les ondes les plus courtes disparaissent. La phrase sous Intensité dit jusqu'à quelle longueur en millimètres il reste la
      moitié d'une onde.
    settings: pass-band=0.1 reduction=0 adapt=no guard=no
    view: anterior
    show: split
    look: les terrasses. Qu'en reste-t-il à cette bande passante ?
    ask: Que se passe-t-il à 0,01 : en passe-t-il moins, ou plus ?
    answer: Moins. La bande passante est la plus grande valeur propre qui passe ; une plus petite ne laisse que des ondes plus longues.

    step: Le choix de l'article
    text: À 0,01 avec 100 itérations les terrasses ont disparu sur cette surface, et les calibres restent à environ 3 % près. Le nombre
      n'a pas d'unité : sur un maillage plus fin le même 0,01 correspond à des ondes plus courtes.
    settings: pass-band=0.01 reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: la longueur dans la phrase, à côté du tour du vaisseau le plus fin (en pointillé dans la réponse).

    step: Trop loin
    text: À 0,001 des ondes aussi longues que le tour d'un vaisseau disparaissent : les artères rénales se referment, les artères
      iliaques perdent la moitié de leur calibre. Ce n'est plus du bruit : c'est le vaisseau.
    settings: pass-band=0.001 iterations=200 reduction=0 adapt=no guard=no
    view: anterior
    show: calibre
    look: les couleurs des branches 4 et 5, les artères rénales, et 1 et 7, les artères iliaques. L'échelle est en pour cent de
      leur rayon.

lesson-windows = Itérations et fenêtres
lesson-windows-text =
    lumen lesson 1
    title: Itérations et fenêtres

    step: Un filtre à peu de termes
    text: Un filtre idéal laisserait passer tout ce qui est sous la bande passante et rien au-dessus. Un polynôme ne peut pas faire un
      tel saut. Les itérations sont son degré : avec 10 la chute est large, et des ondes bien au-dessus de la bande restent.
    sample: aorta
    settings: pass-band=0.1 iterations=10 reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: la réponse à l'étape 2 du panneau. Quelle est la largeur de la chute de 100 % à rien ?
    ask: Que changent plus d'itérations : jusqu'où la surface est lissée, ou avec quelle netteté ?
    answer: La netteté avec laquelle les ondes sont séparées. La bande passante dit où ; le degré dit avec quelle pente.

    step: Plus de termes
    text: Avec 100 la chute est raide et tout près au-dessus de la bande passante.
    settings: pass-band=0.1 iterations=100 reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: le point au demi-gain, qui s'est rapproché de la ligne en tirets. Faites avancer les termes dans la réponse à partir de 0 :
      c'est ainsi que la série s'additionne.

    step: La fenêtre
    text: Coupée après tant de termes, la série ondulerait : certaines ondes grandiraient. Une fenêtre atténue les termes. Hamming, celle
      de l'article, tombe vite et ondule peu ; Nuttall ondule le moins et tombe le moins vite.
    settings: pass-band=0.1 iterations=30 window=nuttall reduction=0 adapt=no guard=no
    view: anterior
    show: split response
    look: la courbe pendant que vous choisissez une fenêtre après l'autre, sous Avancé à l'étape 2.
    ask: Laquelle des quatre a la chute la plus raide au même degré ?
    answer: Hamming, puis Hanning. Blackman et Nuttall ondulent moins et tombent moins vite.

lesson-shrinkage = Rétrécissement
lesson-shrinkage-text =
    lumen lesson 1
    title: Rétrécissement

    step: Pourquoi ne pas faire la moyenne
    text: Mettre chaque sommet à la moyenne de ses voisins lisse aussi, et chaque passe enlève un peu à toutes les ondes, aux plus longues
      également : un tube devient plus fin et, à la fin, un fil. Le filtre en sinus cardinal fenêtré laisse les ondes longues entières.
    sample: aorta
    settings: reduction=0 adapt=no guard=no
    view: anterior
    show: response
    look: le volume dans le résultat au pied du panneau ; dans la réponse, avec « Laplacien à côté » coché, ce que la moyenne
      laisserait du vaisseau le plus fin.
    ask: Un filtre qui laisse les ondes longues entières peut-il quand même amincir un vaisseau ?
    answer: Oui, là où le vaisseau est lui-même une onde courte : son tour est sa longueur d'onde.

    step: Un vaisseau fin est une onde courte
    text: Avec une bande passante plus étroite, les ondes autour des artères rénales, longues de 19 mm, tombent dans ce qui est enlevé.
      Celles-ci perdent du calibre ; l'aorte, dont les ondes sont trois fois plus longues, le garde.
    settings: pass-band=0.006 iterations=200 reduction=0 adapt=no guard=no
    view: anterior
    show: calibre
    look: quelles branches changent de couleur en premier.

    step: Rendre le volume
    text: « Préserver le volume » repousse les sommets vers l'extérieur le long de leurs normales jusqu'à ce que le volume soit ce qu'il
      était, à 0,01 % près.
    settings: pass-band=0.006 iterations=200 preserve-volume=yes reduction=0 adapt=no guard=no
    view: anterior
    show: calibre
    ask: Le bon volume veut-il dire le bon calibre partout ?
    answer: Non. Le volume est un seul nombre pour tous les vaisseaux ; le tableau sous Vaisseaux donne chacun d'eux.

    step: À chaque vaisseau la sienne
    text: « Adapter au calibre » donne à chaque sommet une bande passante à lui, assez large pour que les ondes autour de son vaisseau passent.
    settings: reduction=0
    view: anterior
    show: calibre vessels
    look: le verdict au-dessus des vues, et le changement de chaque branche dans le tableau.

lesson-decimation = Ce que la décimation garde
lesson-decimation-text =
    lumen lesson 1
    title: Ce que la décimation garde

    step: Une contraction
    text: La décimation prend un sommet après l'autre, le moins cher d'abord. Le sommet va à un voisin, les triangles sur cette arête
      disparaissent, les autres autour de lui s'étirent sur le trou.
    sample: aorta
    settings: reduction=90
    show: flat collapses
    look: l'anneau, c'est-à-dire le sommet qui part ensuite, le trou autour de lui et les triangles qui le combleront. Reculez et avancez
      d'un pas.

    step: Qui peut partir
    text: Schroeder a cinq classes. Les sommets simples sont dans la paroi. Les sommets de bord vont le long de leur extrémité ouverte, ceux
      d'une arête vive le long de cette arête, pour que bords et plis restent. Les complexes restent.
    settings: reduction=90 feature-angle=60
    view: anterior
    show: classes lines
    look: les nombres à côté des couleurs, et les bords des extrémités ouvertes.
    ask: Des vaisseaux lisses n'ont presque pas d'arêtes vives. Où sont les sommets qui ne sont pas simples ?
    answer: Aux extrémités ouvertes : ce sont des sommets de bord.

    step: Ce que cela coûte
    text: Chaque pas a une erreur en millimètres, et tous les taux de réduction sont là d'un coup. La courbe entière peut donc être tracée.
    settings: reduction=98
    view: anterior
    show: deviation error
    look: « Erreur selon les triangles » à l'étape 3 du panneau ; cliquez le long de la courbe.
    ask: De 50 % à 90 %, quatre triangles sur cinq disparaissent. L'erreur est-elle multipliée par cinq ?
    answer: Sur des vaisseaux lisses à peu près : l'erreur croît avec le carré du côté d'un triangle, et ce carré est comme un sur
      leur nombre.

    step: Ce qui ne change jamais
    text: Aucune extrémité ouverte n'est fermée, aucun vaisseau n'est joint à un autre, et aucun triangle n'est amené à en croiser un
      autre. Un calibre peut changer : à partir de 99,7 % un vaisseau est pincé, et le verdict dit où. Là où rien de plus ne
      peut partir, la décimation s'arrête.
    settings: reduction=99.9
    view: anterior
    show: flat
    look: chaque extrémité ouverte est encore là, avec trois arêtes ou plus ; et l'endroit qui est pincé.

lesson-wire = Ce que sent un guide
lesson-wire-text =
    lumen lesson 1
    title: Ce que sent un guide

    step: L'entrée
    text: Un guide est une tige élastique. Il est avancé depuis l'aine, se courbe là où la paroi le dévie, et glisse avec frottement. La
      paroi est faite exactement des triangles qui sont montrés.
    sample: aorta
    settings: reduction=90
    view: anterior
    show: vessels
    look: les rayons dans le tableau ; un guide de 0,89 mm de diamètre doit y trouver son chemin.
    ask: Le guide touchera-t-il la paroi tout du long, ou en quelques endroits ?
    answer: En quelques-uns : il est raide et s'appuie à l'extérieur des courbes.

    step: L'autopilote
    text: L'autopilote avance et tourne le guide comme le ferait une main. La poussée est la force à la main, le long du guide.
    settings: reduction=90
    trial: autopilot
    look: Force paroi et Poussée dans le panneau, et la couleur de la paroi là où elle a été touchée.

    step: Moins de triangles
    text: La même chose avec un triangle sur cent. Chaque facette est un endroit plat avec une arête vers la suivante.
    settings: reduction=99
    trial: autopilot
    look: les barres, dont l'échelle est celle de l'étape d'avant.
    ask: La force sur la paroi est-elle une autre qu'avant ?
    answer: Un seul essai ne le dit pas : un autre ordre des triangles suffit à la changer. « Comparer à la surface non
      réduite » mesure la différence face à ce bruit.

lesson-solver = Du scanner au solveur
lesson-solver-text =
    lumen lesson 1
    title: Du scanner au solveur

    step: Léger, mais pas régulier
    text: Le niveau est léger et garde le calibre de chaque vaisseau : assez pour un guide. Un solveur d'écoulement remplit le vaisseau
      de tétraèdres, et ceux-ci valent ce que valent les triangles qui les portent.
    sample: aorta
    settings: reduction=90
    view: anterior
    look: le fil de fer : des triangles longs et minces le long des vaisseaux.

    step: Des extrémités pour un écoulement
    text: Chaque extrémité est coupée perpendiculairement au vaisseau, prolongée de 5 rayons par un tube qui devient un cercle, et
      fermée par une partie plane qui porte un nom. Noms et aires sont à l'étape 5 du panneau.
    sample: aorta
    settings: reduction=90
    show: solver
    look: les extrémités en couleur.
    ask: Pourquoi prolonger les extrémités ?
    answer: L'écoulement donné au solveur à une extrémité n'est pas celui du vaisseau. Le long du prolongement, il le devient.

    step: Des triangles selon le calibre
    text: Chaque vaisseau a 12 arêtes autour de lui : un vaisseau mince a de petits triangles, un large de grands. Aucun n'est loin
      d'être équilatéral.
    sample: aorta
    settings: reduction=90
    show: solver
    look: le fil de fer, là où une artère rénale quitte l'aorte.
    ask: Un polygone de 12 arêtes est dans son cercle. Quelle part de l'aire est perdue ?
    answer: 4,5 %. Lumen ramène les entrées et sorties à l'aire qu'elles avaient ; de la paroi, plus d'arêtes gardent plus.

## Le glossaire

# De chaque entrée le mot, un deux-points sans espace devant et une espace derrière, et ce qu'il veut dire. Elles sont montrées dans
# l'ordre de l'alphabet.

lesson-word-boundary-loop = Boucle de bord: Le bord d'une extrémité ouverte : une ligne fermée d'arêtes qui ont un triangle chacune.
lesson-word-calibre = Calibre: La largeur d'un vaisseau, ici le rayon du cercle qui a l'aire de sa section.
lesson-word-chebyshev-polynomials = Polynômes de Tchebychev: Les termes dont le filtre est la somme. Chacun coûte une passe sur la surface.
lesson-word-complex-vertex = Sommet complexe: Un sommet autour duquel les triangles ne forment pas de disque, comme là où trois feuillets se rejoignent. Il reste.
lesson-word-corner = Coin: Un sommet où une arête vive finit, ou où plus de deux se rejoignent.
lesson-word-decimation = Décimation: Enlever des sommets, les moins chers d'abord, et fermer le trou que chacun laisse.
lesson-word-deviation = Écart: La distance entre la surface réduite et la surface lissée, mesurée dans les deux sens, en mm.
lesson-word-eigenvalue-k = Valeur propre k: Ce qui dit combien une onde sur la surface est courte : 0 pour la plus longue, 2 pour la plus courte.
lesson-word-feature-edge = Arête vive: Une arête dont les deux triangles diffèrent en direction de plus que l'angle d'arête.
lesson-word-flip = Retournement: Un triangle tourne son autre face vers l'extérieur. Aucune contraction ne peut le causer.
lesson-word-gain = Gain: La part d'une onde que le filtre laisse : 100 % dans la bande passante, presque rien au-dessus.
lesson-word-half-edge-collapse = Contraction de demi-arête: Un sommet va là où est un voisin ; les triangles sur leur arête disparaissent.
lesson-word-interior-edge-vertex = Sommet d'arête intérieur: Un sommet dans la surface où deux arêtes vives se rejoignent.
lesson-word-level = Niveau: Une des surfaces d'un maillage progressif, avec un nombre de triangles.
lesson-word-link-condition = Condition de lien: Deux sommets ne peuvent en devenir un que s'ils ne partagent pas d'autres voisins que ceux en face de leur arête. Elle préserve la topologie.
lesson-word-marching-cubes = Marching cubes: La méthode qui place une surface autour des voxels d'une segmentation.
lesson-word-pass-band = Bande passante: Les valeurs propres qui passent le filtre : toutes celles sous ce nombre.
lesson-word-progressive-mesh = Maillage progressif: Tous les niveaux d'un calcul, dont tout taux de réduction se prend sans un autre calcul.
lesson-word-quadric = Quadrique: La somme des carrés des distances à un ensemble de plans, gardée en dix nombres.
lesson-word-reduction-rate = Taux de réduction: La part des triangles qui est enlevée, en pour cent.
lesson-word-simple-vertex = Sommet simple: Un sommet dans la surface et sur aucune arête vive.
lesson-word-surface-nets = Surface nets: La méthode qui donne un sommet à chaque cellule entre des voxels différents et l'y lisse.
lesson-word-topology = Topologie: Quels morceaux, trous et extrémités ouvertes il y a, quelle que soit leur forme.
lesson-word-wavelength = Longueur d'onde: La longueur d'une onde sur la surface, en mm. Le tour d'un vaisseau en est une.
lesson-word-window = Fenêtre: Des poids qui atténuent les termes du filtre, pour qu'il ondule moins.
