#!/bin/sh
# SHA-256 of what the command line makes of every file and of a set of settings; times and versions are left out.
#
#   cargo build --release && tests/digests.sh target/release/lumen > after.txt
#
# The lists of two builds are the same where both give the same bytes. Files are those of LUMEN_DATA
# (../shared/data beside the checkout by default) and Lumen's own samples. About 6 minutes on 2 cores.
set -u
lumen=${1:?usage: tests/digests.sh LUMEN}
here=$(cd "$(dirname "$0")/.." && pwd)
data=${LUMEN_DATA:-$here/../shared/data}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Times, and where files lie.
plain() {
  sed -E -e "s#$data/##g" -e "s#$work/##g" -e '/"(stages|times|step)_?(ms)?": \{/,/\}/d' \
    -e '/_ms"|"ms"|_seconds"|"version"|_per_second/d' -e 's/[0-9]+(\.[0-9]+)? +(ms|s)\b/T/g' -e 's/ +T$/ T/'
}

# digest NAME COMMAND...: of what the command prints, its exit status and the file it writes.
digest() {
  name=$1
  shift
  rm -rf "$work/out" && mkdir "$work/out"
  "$@" > "$work/stdout" 2> "$work/stderr"
  status=$?
  sum=$({ echo "$status"; plain < "$work/stdout"; plain < "$work/stderr"
    for file in "$work/out"/*; do
      case $file in
        *.json | *.csv | *.txt | *.html) plain < "$file" ;;
        *) [ -f "$file" ] && cat "$file" ;;
      esac
    done; } | sha256sum | cut -c1-64)
  echo "$sum  $name"
}

out=$work/out
for file in "$data"/formats/* "$data"/nasty/* "$data"/reject/* "$data"/public/*/* "$data"/real/* "$data"/volumes/*; do
  [ -f "$file" ] && digest "inspect ${file#"$data"/}" "$lumen" inspect "$file" --json
done
for file in "$data"/formats/* "$data"/nasty/* "$data"/real/*; do
  [ -f "$file" ] && digest "optimise ${file#"$data"/}" \
    "$lumen" optimise "$file" -o "$out/a.ply" --report "$out/a.json" --reduction 90
done
one=sample:aorta
n=0
while read -r options; do
  n=$((n + 1))
  # shellcheck disable=SC2086
  digest "optimise $one $options" "$lumen" optimise "$one" -o "$out/a.vtp" --report "$out/a.json" $options
done <<'SETTINGS'
--reduction 0
--reduction 99.9
--reduction safe --branches
--smoothing paper --reduction 97
--smoothing none
--pass-band 0.1 --iterations 60 --window nuttall --no-adapt --no-guard
--pass-band 1.5 --iterations 7 --window blackman
--preserve-volume --window hanning
--method quadric --reduction 95 --spare-thin
--method quadric --max-deviation 0.2
--triangles 3000 --feature-angle 20
--keep-all-components --max-deviation 0.05
--weld 0.01 --split --fill-holes 5
--tolerance 0.5 --branches --branches-csv a.csv --with deviation
SETTINGS
rm -f a.csv
for format in stl ply obj vtp vtk glb; do
  digest "written as $format" "$lumen" optimise sample:coronary -o "$out/a.$format"
done
digest "centreline" "$lumen" centreline sample:coronary -o "$out/a.vtp"
digest "centreline table" "$lumen" centreline sample:aorta -o "$out/a.csv"
digest "phantom" "$lumen" phantom coronary --triangles 50000 -o "$out/a.ply"
digest "tables" "$lumen" tables sample:aorta
digest "trial" "$lumen" trial sample:aorta --reduction 95 --log "$out/a.csv" --json "$out/a.json"
for volume in "$data"/volumes/*; do
  [ -f "$volume" ] && digest "surface ${volume#"$data"/}" "$lumen" surface "$volume" --threshold 150 -o "$out/a.ply"
done
