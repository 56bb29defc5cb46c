### The guidewire trial: a virtual wire is fed through the vessel, by hand or by an autopilot. Its part of the panel, its
### three views, the tables of the paper, and what the engine says of a trial.

## The panel

trial-title = Essai
trial-title-help = Dirige un guide dans le niveau affiché.
trial-adapt = Adapter le lissage au calibre et lancer
trial-adapt-help = Lisse moins les vaisseaux fins, pour qu'ils restent aussi larges ; « Annuler » revient en arrière
trial-start = Lancer l'essai
trial-tables = Tableaux III et IV
trial-tables-help = L'essai de l'article à plusieurs taux de réduction
trial-restart-to-try = Relancer pour essayer le guide et la graine tels qu'ils sont réglés maintenant.
trial-preparing = Préparation de l'essai
trial-finding = Recherche de la lumière et du trajet...
trial-at-entry = Le guide est à l'entrée.
trial-none-on = Aucun essai en cours.
trial-awaits = Adaptation du lissage : l'essai commence dès que le nouveau niveau est prêt.

## Buttons. Letters in brackets are keys

trial-restart = Relancer
trial-restart-help = Depuis l'entrée (R)
trial-autopilot = Autopilote
trial-autopilot-help = Dirige tout seul ; une main sur le guide reprend la conduite (G)
trial-pause = Pause
trial-pause-help = Met l'essai à l'arrêt (P)
trial-slow = Ralenti
trial-slow-help = À un quart de la vitesse (M)
trial-step-back = Revenir 1 s
trial-step-back-help = Une seconde en arrière, puis à l'arrêt (Z)
trial-close = Fermer
trial-close-help = Retour à la surface (Échap)
trial-save-log = Enreg. journal
trial-save-log-help = Mesures en CSV et un résumé en JSON
trial-open-log = Ouvrir journal...
trial-open-log-help = Rejoue un journal enregistré (CSV) sur ce niveau

## What could not be done

trial-no-surface = Il n'y a pas encore de surface où diriger un guide.
trial-computation-stopped = Le calcul s'est arrêté.
trial-stopped = L'essai s'est arrêté ({ $reason }). La surface est toujours ouverte ; le relancer.
trial-cancelled = Annulé.

## How the trial stands, in one sentence

trial-success = Succès : la pointe est arrivée après { $time } s ; force maximale sur la paroi { $force }.
trial-success-exchanged = Succès : la pointe est arrivée après { $time } s avec le guide { $wire }, après l'échec de { $failed } ; force maximale sur la paroi { $force }.
trial-failed = Échec après { $time } s : { $why }
trial-failed-exchanged = Échec après { $time } s avec le guide { $wire }, après l'échec de { $failed } : { $why }
trial-arrived = Succès : la pointe est à la cible.
trial-timed-out = Échec : le temps est écoulé.
trial-gave-up = Échec : l'autopilote a renoncé.
trial-input-over = La commande enregistrée est terminée.
trial-paused = En pause.
trial-looped = Le guide s'est replié sur lui-même : retirer.
trial-wrong-branch = Mauvaise branche : retirer et tourner.
trial-behind = La machine est en retard : l'essai va moins vite que le temps réel.
trial-steers = Autopilote : { $doing }.
trial-doing-following = suit le trajet
trial-doing-again = nouvel essai, tourné
trial-doing-withdrawing = retrait
trial-doing-exchanging = retrait du guide pour en prendre un autre
trial-doing-looking-ahead = simulation d'avance, essai { $attempt } sur { $attempts }
trial-feed-first = Avancer (W, S) et tourner (A, D) le guide jusqu'à la cible, ou laisser faire l'autopilote : le temps court à partir de là.
trial-feed = Avancer (W, S) et tourner (A, D) le guide jusqu'à la cible, ou laisser faire l'autopilote.
# The same where a finger points: by the pads under the thumbs.
trial-feed-first-touch = Avancer et tourner le guide jusqu'à la cible par les plages du bas, ou laisser faire l'autopilote : le temps court à partir de là.
trial-feed-touch = Avancer et tourner le guide jusqu'à la cible par les plages du bas, ou laisser faire l'autopilote.

## Gauges and numbers. The names are short: the number stands beside them

trial-more-numbers = Autres valeurs
trial-wall-force = Force paroi
trial-wall-force-help = La plus grande force normale en un point de la paroi ; la barre grandit avec le maximum
trial-push-force = Poussée
trial-push-force-help = Ce qu'il faut pour tenir le guide au cathéter : négative s'il est retenu. La barre montre sa grandeur
trial-insertion = Insertion
trial-insertion-help = Longueur du guide hors du cathéter ; la barre finit avec le trajet jusqu'à la cible
trial-bar-up-to = { $what }, jusqu'à { $most }
trial-to-target = À la cible
trial-to-target-help = Distance de la pointe à la section de la cible
trial-elapsed = Écoulé
trial-elapsed-help = Temps simulé
trial-beam-time-help = Temps pendant lequel le faisceau était allumé
trial-contacts = Contacts
trial-contacts-sum = { $count }, { $force } en tout
trial-contacts-help = Points où le guide touche la paroi, et la somme de leurs forces
trial-tip-force = Force à la pointe
trial-tip-force-help = Sur la paroi, à moins de 5 mm de la pointe
trial-torque = Couple
trial-torque-help = Le moment autour de l'axe du guide, au cathéter
trial-branch = Branche
trial-branch-on = { $branch }, sur le trajet
trial-branch-off = { $branch }, hors du trajet
trial-branch-help = La branche de l'arbre vasculaire où est la pointe
trial-steps = Pas
trial-steps-rate = { $rate } par seconde
trial-steps-help = Ce que fait cette machine ; 500 par seconde suivent le temps réel
trial-unbalanced = Pas déséquilibrés
trial-unbalanced-help = Là où le guide se détend d'un coup, des pas sont freinés ou le cathéter attend : leurs forces ne sont pas en équilibre, et les forces affichées sont celles du dernier pas qui l'était
trial-unbalanced-unsettled = { $share } %, maintenant instable
trial-unbalanced-braked = { $share } %, maintenant freiné
trial-unbalanced-waiting = { $share } %, maintenant en attente
trial-unbalanced-held = { $share } %, maintenant tenu
trial-fed = Avance
trial-fed-of = { $fed } sur { $wanted } mm/s
trial-fed-help = Ce qui a été avancé au dernier pas, sur ce qui était demandé

## The wire

trial-wire = Guide
trial-wire-help = De quoi le guide est fait : un guide qui convient au trajet, sauf autre choix ; les valeurs sont repliées dessous
trial-proposed = Proposé
trial-wire-floppy = 0,014" souple
trial-wire-workhorse = 0,014" standard
trial-wire-stiff = 0,014" rigide
trial-wire-workhorse-j = 0,014" pointe en J
trial-wire-035-j = 0,035" pointe en J
trial-wire-035-stiff-j = 0,035" rigide, en J
trial-wire-035-curve = 0,035" à courbe de cathéter
trial-wire-035-angled = 0,035" coudé, longue courbure
trial-wire-035-angled-20 = 0,035" coudé, pointe de 20 mm
trial-wire-numbers = Pointe, rigidité, frottement
trial-tip-angle = Angle pointe
trial-tip-angle-help = L'angle dont la pointe est courbée avant d'entrer dans le vaisseau
trial-tip-length = Long. pointe
trial-tip-length-help = Longueur de la pointe courbée, depuis son extrémité
trial-tip-stiffness = Rigidité pointe
trial-tip-stiffness-help = Rigidité en flexion EI à la pointe
trial-shaft-stiffness = Rigidité corps
trial-shaft-stiffness-help = Rigidité en flexion EI du corps du guide
trial-friction = Frottement
trial-friction-help = Coefficient de frottement tant que le guide adhère à la paroi ; quand il glisse, il en garde la même part

## Where it enters and should go

trial-entry = Entrée
trial-entry-help = Où le guide sort de l'introducteur ou du cathéter
trial-target = Cible
trial-target-help = Où il doit aller
trial-direction = Sens
trial-direction-help = De quelle extrémité vient le guide
trial-swap = Inverser
trial-swap-help = Entrer par la cible et aller jusqu'à l'entrée
trial-swap-refused = Aucun guide ne peut entrer par la cible
trial-pick = Choisir
trial-pick-entry = Choisir l'entrée
trial-pick-target = Choisir la cible
trial-pick-help = Cliquer ensuite sur le vaisseau
trial-click-entry = Cliquer sur le vaisseau là où le guide entre.
trial-click-target = Cliquer sur le vaisseau là où il doit aller.
trial-click-entry-touch = Toucher le vaisseau là où le guide entre.
trial-click-target-touch = Toucher le vaisseau là où il doit aller.
trial-seed = Graine
trial-seed-help = Fait varier un peu l'entrée, la rotation et le frottement ; 0 ne change rien. Prend effet en relançant
trial-own = celle de l'exemple
trial-entry-wide = { $branch }, { $width } mm
trial-entry-ostium = ostium de { $branch }, { $width } mm
trial-target-room = { $branch }, aussi loin que possible
trial-target-open = { $branch }, extrémité ouverte
trial-target-closed = { $branch }, extrémité fermée
trial-target-away = { $name }, { $width } mm, à { $away } mm

## The fluoroscope

trial-fluoroscopy = Radioscopie
trial-pedal-help = La pédale : marche ou arrêt (Espace). À l'arrêt, la dernière image reste
trial-contrast = Contraste
trial-contrast-help = Un bolus de produit de contraste que le sang emporte (C)
trial-roadmap = Roadmap
trial-roadmap-help = Montre la lumière sur l'image
trial-pulses = Cadence
trial-pulses-help = Images par seconde quand le faisceau est allumé
trial-arm-ap = Face
trial-arm-lao-45 = OAG 45
trial-arm-lat = Profil
trial-arm-rao-30 = OAD 30
trial-arm-lao = OAG
trial-arm-rao = OAD
trial-arm-cran = CRAN
trial-arm-caud = CAUD
trial-arm-angles = { $side } { $turned }°  { $tilt } { $tilted }°
trial-arm-turned = Tourné { $turned }°  incliné { $tilted }°
trial-arm-preset-help = Arceau : { $angle } (touche { $key })
trial-beam-on = { $rate } images/s, champ { $field } mm
trial-beam-off = Dernière image (Espace : marche)

## The views

trial-view = Vue de l'essai
trial-fluoroscopy-view = Vue de la radioscopie
trial-tip-view = Vue depuis la pointe
trial-view-title = Guide dans le vaisseau
trial-tip-title = Depuis la pointe
trial-tip-hide = Ôter
trial-tip-hide-help = Masquer la vue depuis la pointe
trial-tip-show = Pointe
trial-tip-show-help = Afficher la vue depuis la pointe
trial-large = Grand
trial-large-back = Petit
trial-large-name = Grande radioscopie
trial-large-back-name = Radioscopie à côté des autres
trial-large-help = La radioscopie en grande image avec les autres par-dessus, et retour (F)
trial-finding-way = Recherche du trajet : { $percent } %
trial-none-on-problem = Aucun essai en cours : le panneau dit pourquoi.
trial-no-device = Il n'y a pas de périphérique graphique pour dessiner.
trial-not-drawn = L'essai ne peut pas être dessiné : { $why }.
trial-surface-not-drawn = La surface ne peut pas être dessinée : { $why }.
trial-wire-not-drawn = Le guide ne peut pas être dessiné : { $why }.
trial-fluoroscopy-not-drawn = La radioscopie ne peut pas être dessinée : { $why }.
trial-too-thin-ring = Trop fin pour le guide
trial-no-way-ring = Sans issue
trial-missed-fork-ring = Bifurcation manquée
trial-pinched = Pincé
trial-tip-here = Pointe, ce niveau
trial-tip-unreduced = Pointe, non réduit

## The comparison with the unreduced surface

trial-compare = Comparer à la surface non réduite
trial-compare-help = Rejoue la même commande sur la surface avant sa réduction
trial-comparing = Comparaison
trial-comparing-percent = Comparaison : { $percent } %
trial-cancel = Annuler
trial-cancel-comparison = Annuler la comparaison
trial-cancel-comparison-help = Ne plus comparer ; l'essai continue
trial-smallest = Lumière min.
trial-smallest-was = { $after } mm, avant { $before } mm
trial-smallest-help = Diamètre là où le trajet est le plus étroit, après et avant la réduction
trial-pinched-places = { $count ->
    [one] { $count } endroit
   *[other] { $count } endroits
}
trial-pinched-help = Entourés dans la vue
trial-largest-deviation = Écart maximal
trial-largest-deviation-help = Entre les deux pointes au même moment
trial-noise = Bruit
trial-noise-help = Entre les pointes sur la surface non réduite et sur la même avec ses triangles dans un autre ordre : ce qui est plus petit ne dit rien de la réduction
trial-deviation = Écart
trial-deviation-plot = Écart de la pointe selon l'insertion
trial-deviation-plot-help = Écart de la pointe en mm selon l'insertion en cm ; gris : bruit
trial-path = la trajectoire de la pointe diffère d'au plus { $most } mm
trial-path-more = la trajectoire de la pointe diffère d'au plus { $most } mm, alors que la surface non réduite diffère d'elle-même de { $noise } mm au plus avec ses triangles dans un autre ordre
trial-path-noise = la trajectoire de la pointe diffère d'au plus { $most } mm, pas plus que le bruit, car la surface non réduite diffère d'elle-même de { $noise } mm au plus avec ses triangles dans un autre ordre
trial-verdict-chance-yes = À { $gone } %, ce guide arrive, mais qu'il arrive ou non relève du hasard : sur la surface non réduite, il arrive avec { $arrives } des { $all } ordres des triangles ; { $path }.
trial-verdict-chance-no = À { $gone } %, ce guide n'arrive pas, mais qu'il arrive ou non relève du hasard : sur la surface non réduite, il arrive avec { $arrives } des { $all } ordres des triangles ; { $path }.
trial-verdict-both = À { $gone } %, ce guide arrive ; { $path }.
trial-verdict-neither = Avec cette commande, ce guide n'arrive sur aucune des deux surfaces ; à { $gone } %, { $path }.
trial-verdict-reduced = À { $gone } %, ce guide arrive ; avec la même commande, il n'arrive pas sur la surface non réduite, et { $path }.
trial-verdict-unreduced = À { $gone } %, ce guide n'arrive pas, alors qu'il arrive sur la surface non réduite ; { $path }.

## The tables of the paper

trial-tables-aorta = Tableau III : l'autopilote dans l'aorte.
trial-tables-coronary = Tableau IV : l'autopilote dans l'aorte et les artères coronaires.
trial-tables-other = L'autopilote dans cette surface.
trial-tables-brackets = Les valeurs de l'article sont entre parenthèses.
trial-tables-progress = Tableaux
trial-tables-cancel = Annuler tableaux
trial-tables-again = Refaire
trial-tables-copy = Copier
trial-tables-copy-help = En texte, une tabulation entre les colonnes
trial-tables-failed = { $rate } % : { $why }
trial-tables-yes = oui
trial-tables-no = non
trial-tables-two = { $first } ; { $mean }
trial-column-rate = Taux
trial-column-rate-help = La part des triangles qui a été supprimée
trial-column-triangles = Triangles
trial-column-triangles-help = Ce qui restait
trial-column-initial-fps = Images/s début
trial-column-initial-fps-help = Images par seconde pendant la première seconde simulée (article)
trial-column-average-fps = Images/s moy.
trial-column-average-fps-help = Moyenne des cinq stations (article)
trial-column-worst-fps = Images/s min.
trial-column-worst-fps-help = La station la plus lente
trial-column-simulation = Simulation, ms
trial-column-simulation-help = Pour calculer 1/60 s : dans la première seconde, et en moyenne aux stations
trial-column-drawing = Dessin, ms
trial-column-drawing-help = Pour dessiner une image de 1280 × 800
trial-column-steps = Pas/s
trial-column-steps-help = Pas de 2 ms que cette machine calcule en une seconde
trial-column-success = Succès
trial-column-success-help = Indique si la pointe est arrivée (article)
trial-column-peak-force = Force max., N
trial-column-peak-force-help = La plus grande force sur la paroi en un point, dans les pas en équilibre
trial-column-mean-force = Force moy., N
trial-column-mean-force-help = La somme des forces sur la paroi, en moyenne sur les pas en équilibre
trial-column-unbalanced = Déséquilibre, %
trial-column-unbalanced-help = Pas dont les forces n'étaient pas en équilibre ; les forces sont celles des autres
trial-column-time = Temps, s
trial-column-time-help = Temps simulé jusqu'à la cible

## What came of a trial: clauses without a capital letter or a full stop

trial-end-running = pas encore terminé : la pointe est à { $away } mm de la cible
trial-end-arrived = la pointe est arrivée après { $time } s
trial-end-timed-out = le temps de l'autopilote, { $limit } s, était écoulé, la pointe encore à { $away } mm de la cible
trial-end-over = la commande enregistrée était terminée, la pointe encore à { $away } mm de la cible
trial-end-gave-up = { $count ->
    [one] l'autopilote a renoncé après { $count } retrait, la pointe encore à { $away } mm de la cible
   *[other] l'autopilote a renoncé après { $count } retraits, la pointe encore à { $away } mm de la cible
}
trial-end-missed = { $why } ; { $missed }
trial-missed-fork = il a manqué la bifurcation à { $along } mm sur le trajet : { $into } au lieu de { $instead }
trial-missed-route = il a manqué la bifurcation à { $along } mm sur le trajet : { $into } au lieu de la suite du trajet
trial-another-branch = une autre branche

## Why a trial cannot begin: clauses that a capital letter and a full stop are given to

trial-place = ({ $x } ; { $y } ; { $z })
trial-entry-outside = l'entrée { $at } est hors du vaisseau, à { $distance_mm } mm de sa paroi
trial-target-outside = la cible { $at } est hors du vaisseau, à { $distance_mm } mm de sa paroi
trial-no-way = aucun passage ouvert ne mène de l'entrée à la cible : la lumière s'arrête en { $at }, à { $gap_mm } mm de celle de la cible
trial-too-short = l'entrée et la cible sont à { $length_mm } mm l'une de l'autre : trop proches pour un trajet
trial-too-thin = la lumière est trop fine pour un guide de { $wire_mm } mm : elle mesure { $lumen_mm } mm en { $at }, à { $arc_mm } mm sur le trajet ; moins de lissage garde les vaisseaux fins plus larges
trial-no-entry = aucun vaisseau de cette surface n'a d'extrémité où un guide puisse entrer ; indiquer une entrée
trial-no-target = aucun vaisseau de cette surface n'est assez loin de l'entrée pour être une cible ; indiquer une cible
trial-tight = le guide ne tient pas là où il entre : la paroi est à { $distance_mm } mm, le rayon du guide est de { $radius_mm } mm
trial-no-direction = l'entrée n'a pas de direction
trial-load = une charge de { $load } N par mm de guide n'est pas possible : elle va de 0 à { $most } N
trial-not-inside = l'entrée n'est pas dans le vaisseau
trial-wire-impossible = cette valeur du guide n'est pas possible : { $what } { $value }
trial-wire-diameter = diamètre
trial-wire-shaft-stiffness = rigidité du corps
trial-wire-tip-stiffness = rigidité de la pointe
trial-wire-torsion-ratio = rapport de torsion
trial-wire-length = longueur
trial-wire-density = masse volumique
trial-wire-tip-element = élément à la pointe
trial-wire-shaft-element = élément du corps
trial-wire-soft-part = partie souple
trial-wire-taper = partie conique
trial-wire-bend = courbure
trial-wire-bend-angle = angle de la courbure
trial-wire-straight-end = extrémité droite
trial-wire-static-friction = frottement statique
trial-wire-kinetic-friction = frottement cinétique

## What a wire's tip does not reach

trial-reach-none = Aucun guide ne devrait entrer dans la branche à la bifurcation à { $along } mm sur le trajet, qui tourne de { $turn }° hors d'une lumière large de { $width } mm : il faut une pointe qui se porte à { $takes } mm de côté, et celle-ci se porte à { $reach } mm.
trial-reach-another = Ce guide ne devrait pas entrer dans la branche à la bifurcation à { $along } mm sur le trajet, qui tourne de { $turn }° hors d'une lumière large de { $width } mm : il faut une pointe qui se porte à { $takes } mm de côté, et celle-ci se porte à { $reach } mm. La pointe d'un autre guide y arrive.

## Why a log cannot be replayed: clauses as above

trial-log-none = ce n'est pas le journal d'un essai de Lumen : sa première ligne n'est pas « # lumen trial log »
trial-log-schema = le journal a le schéma { $found } ; cette version lit les schémas { $oldest } à { $newest }
trial-log-setup = les réglages du journal sont illisibles : { $why }
trial-log-no-setup = le journal ne dit pas quels étaient les réglages
trial-log-line = la ligne { $line } du journal est illisible : { $what }
trial-log-steps = le nombre de pas n'est pas un nombre
trial-log-step = le pas n'est pas un nombre
trial-log-feed = l'avance n'est pas un nombre
trial-log-roll = la rotation n'est pas un nombre
trial-log-wire = le guide n'est aucun de ceux du montage
trial-log-order = le pas n'est pas après le précédent
trial-log-columns = les colonnes ne sont pas celles d'un journal

# The sweep below the tables.
trial-sweep = { $seeds } essais par taux
trial-sweep-help = Ce que la réduction fait au guide : le pilote automatique avec plusieurs graines à chaque taux, et la même commande sur la surface non réduite
trial-sweep-what = Médiane et maximum des essais.
# Beside the plot, in the colours of its curves.
trial-sweep-largest = écart, maximum
trial-sweep-median = médiane
trial-sweep-noise = bruit, maximum
trial-sweep-plot = Écart de la pointe à la surface non réduite selon la réduction
trial-sweep-arrived = { $arrived } sur { $seeds }
trial-column-arrive = Arrivent
trial-column-arrive-help = Essais dans lesquels le guide a atteint sa cible
trial-column-deviation = Écart, mm
trial-column-deviation-help = Entre la pointe ici et sur la surface non réduite avec la même commande
trial-column-noise = Bruit, mm
