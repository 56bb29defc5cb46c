### Appareils haptiques, manettes et son de la force : la partie du panneau de l'essai sous ses réglages, et ce qui est dit d'un
### appareil. Les noms des appareils, de leurs axes et de leurs rapports sont les mêmes dans toutes les langues.

## L'appareil qui tient le guide

# Devant la liste des appareils.
devices-device = Appareil
devices-device-help = Ce qui tient le guide, à côté des touches et des pavés
devices-look-again = Actualiser
devices-look-again-help = Liste les appareils branchés en ce moment
# Dans la liste des appareils : aucun d'eux.
devices-none = Aucun
# Dans la liste des appareils : celui qui se passe de matériel.
# Dans la liste des appareils : « feeder » est l'appareil ouvert que l'on peut construire.
devices-serial-feeder = Feeder en série
# Un appareil sans nom ; $numbers sont ceux de son fabricant et le sien.
devices-unnamed = Appareil { $numbers }
# Dans la liste des appareils, dans le navigateur : en demande un.
devices-pair = Associer un appareil...
devices-pair-serial = Associer en série...
devices-not-paired = Le navigateur n'a pas demandé d'appareil : recommencer l'association.
devices-no-hid = Ce navigateur n'atteint aucun appareil : Chrome et Edge le peuvent, sur un ordinateur. Les manettes marchent partout.
devices-only-serial = Ce navigateur n'atteint que le feeder ouvert, en série : les autres appareils demandent Chrome ou Edge, sur un ordinateur.
devices-again = Un appareil tient de nouveau le guide.
devices-again-unarmed = Un appareil tient de nouveau le guide ; sa force n'est pas armée.

## Les deux curseurs qui sont la main sur l'appareil virtuel

devices-hand-at = Main à
devices-hand-at-help = Où la main sur l'appareil virtuel veut son chariot
devices-turned-to = Tournée à
devices-turned-to-help = Où la main sur l'appareil virtuel veut son bouton

## Les axes : lequel avance le guide, lequel le tourne

devices-axis-help = Où l'axe se trouve entre ses bouts, et son nombre
devices-push = Pousser l'appareil vers l'avant, comme pour avancer le guide.
devices-turn = Le tourner à droite, comme pour tourner le guide.
# Pousser le guide, et le tourner autour de son axe : un pavé et une ligne pour chacun.
devices-feed = Avance
devices-roll = Rotation
devices-mapped-help = Quel axe, ce que sa course déplace, et quel sens est l'avant
devices-inverted = Inversé
# Une unité derrière un nombre : des mm par pas de l'appareil.
devices-per-count = { $unit }/pas
# Dit par les lecteurs d'écran ; $what est Avance ou Rotation.
devices-mapped-far = { $what } : course
devices-mapped-axis = { $what } : axe
devices-learn = Apprendre
devices-learn-help = Trouve quel axe est poussé et lequel est tourné
devices-forget = Oublier
devices-forget-help = Ces axes sont retenus pour les appareils de cette sorte, par fabricant, produit et descripteur : les oublie, et revient à ceux de la plupart des appareils
devices-no-force = Pas de force avec ces axes.

## Les pavés à l'écran ; les mots à leurs bouts aussi courts que possible

devices-feed-pad = Pavé d'avance
devices-feed-out = recul
devices-feed-in = avant
devices-feed-pad-help = Glisser à droite pour avancer, à gauche pour retirer (W, S)
devices-roll-pad = Pavé de rotation
devices-roll-left = à g.
devices-roll-right = à dr.
devices-roll-pad-help = Glisser de côté pour tourner le guide (A, D)

## La force d'un appareil

devices-felt-as = Ressenti
devices-felt-as-help = La part de sa force maximale avec laquelle l'appareil fait sentir 1 N le long du guide
devices-torque-as = Couple
devices-torque-as-help = La part de sa force maximale avec laquelle l'appareil fait sentir 1 N mm autour du guide
devices-stop-force = Arrêter
devices-stop-force-help = L'appareil lâche aussitôt (Échap)
devices-ask-arm-force = Armer la force...
devices-ask-arm-force-help = Dit ce qui va bouger, puis le permet
# Lu avant qu'un moteur bouge pour la première fois : chaque mot compte.
devices-force-warning = L'appareil repoussera de lui-même, avec jusqu'à 40 % de sa force. Tenez-le sans serrer, et éloignez cheveux, câbles et tasses. Échap, le bouton d'arrêt ou quitter cette fenêtre y met fin.
devices-arm-force = Armer la force
devices-not-now = Plus tard
devices-felt = Force
devices-felt-help = Ce que la main retient au cathéter
devices-latency = Latence
devices-latency-help = Du rapport d'entrée au rapport de sortie : la moitié, 95 % et 99 % ne durent pas plus
devices-save-latency = Enregistrer
devices-save-latency-help = Enregistre ces temps, le nom de l'appareil et la version de Lumen dans une petite table, et rien d'autre
devices-ended-hidden = La force a cessé lorsque la fenêtre a été quittée.
devices-ended-unplugged = La force a cessé lorsque l'appareil a été débranché.
devices-ended-no-number = La force a cessé : l'essai n'a donné aucun nombre pour elle.
devices-ended-refused = La force a cessé : l'appareil ne prend plus de rapports.

## Une manette qui vibre

devices-stop-rumble = Ne plus vibrer
devices-stop-rumble-help = La manette s'arrête aussitôt (Échap)
devices-ask-arm-rumble = Faire vibrer...
devices-ask-arm-rumble-help = Dit quand la manette vibrera, puis le permet
devices-rumble-warning = La manette vibrera d'autant plus fort que la main retient plus de force au cathéter, avec jusqu'à 40 % de sa puissance. Échap, le bouton d'arrêt ou quitter cette fenêtre y met fin.
devices-arm-rumble = Faire vibrer
devices-arm-rumble-help = Désormais, la manette vibre
devices-leave-still = Laisser calme
devices-leave-still-help = La manette ne vibre pas

## Un son à la place d'une force

devices-sound = Son de la force
devices-sound-help = Un son d'autant plus aigu et plus fort que la main retient plus de force au cathéter, jusqu'à 0,1 N ou 1 N mm
devices-no-sound = La force ne s'entend pas ici : le programme de bureau la joue sous Linux par pw-play, paplay ou aplay, un navigateur par Web Audio.

## Pourquoi un appareil n'est pas servi, dans le navigateur

devices-no-serial-in-worker = Ce navigateur n'ouvre pas de ports série dans un Worker.
devices-no-timer = Le navigateur ne donne pas de minuterie.
devices-not-there = L'appareil n'est plus là ; le rebrancher pour continuer.
devices-no-axis = L'appareil n'a pas d'axe qui puisse avancer ou tourner le guide.
devices-not-opened = L'appareil n'a pas pu être ouvert : un autre programme le tient, ou cet utilisateur n'en a pas le droit (sous Linux il faut une règle udev, voir docs/haptics.md).
devices-no-answer = Le port est ouvert, mais ce qui s'y trouve ne répond pas comme le feeder ouvert.

## La même chose dans le programme de bureau ; chacun est seul

devices-gone = l'appareil n'est plus là
devices-report-refused = l'appareil ne prend pas le rapport { $id } : { $reason }
devices-descriptor-cut = le descripteur des rapports s'arrête dans l'élément à l'octet { $at }
devices-descriptor-long = le descripteur des rapports a { $bytes } octets, plus de { $most }
devices-descriptor-many = l'appareil a plus de { $fields } champs, ou des collections à plus de { $depth } niveaux
devices-report-long = le rapport { $id } de l'appareil a plus de { $most } octets
devices-report-id = un rapport de l'appareil a l'identifiant { $id }, qui n'est pas entre 1 et 255

## Ce qui ne se peut pas dans un essai ; l'application met une majuscule et un point

devices-no-trial = aucun essai n'est en cours
devices-log-not-written = le journal ne peut pas être écrit : { $error }
devices-log-other-surface = le journal est d'une autre surface, ou d'un autre niveau : ouvrir d'abord celle-ci
devices-log-other-route = le journal a une autre entrée ou une autre cible que le trajet affiché de { $length } mm : lancer d'abord un essai avec celles-ci
