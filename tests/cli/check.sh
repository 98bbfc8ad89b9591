#!/usr/bin/env bash
# Checks the program: exit codes, one-sentence errors, and outputs that are whole or absent.
set -uo pipefail
bodice=$1 scratch=$2
rm -rf "$scratch" && mkdir -p "$scratch" && cd "$scratch" || exit 1
failures=0

# expect CODE DESCRIPTION COMMAND...: runs it and keeps its output in out.txt.
expect() {
  local wanted=$1 what=$2 got
  shift 2
  "$@" >out.txt 2>&1
  got=$?
  if [ "$got" -ne "$wanted" ]; then
    echo "FAILED: $what: exit $got, expected $wanted"; sed 's/^/    /' out.txt
    failures=$((failures + 1))
  fi
}
prints() { grep -q -- "$1" out.txt || { echo "FAILED: '$1' is not printed:"; sed 's/^/    /' out.txt; failures=$((failures + 1)); }; }
exists() { [ -s "$1" ] || { echo "FAILED: no $1"; failures=$((failures + 1)); }; }
absent() { [ ! -e "$1" ] || { echo "FAILED: $1 was left behind"; failures=$((failures + 1)); }; }
one_line() { [ "$(wc -l <out.txt)" -eq 1 ] || { echo "FAILED: not one line:"; sed 's/^/    /' out.txt; failures=$((failures + 1)); }; }

cp "$bodice" alone
expect 0 "help" "$bodice" --help
prints "drape"
expect 0 "help of fit" "$bodice" fit --help
prints "target-error-mm"
expect 0 "version" "$bodice" --version
expect 2 "no command" "$bodice"
expect 2 "unknown option" "$bodice" fit --frobnicate
expect 2 "two limits at once" "$bodice" fit --max-ellipsoids 50 --target-error-mm 2
expect 2 "one threshold of two" "$bodice" fit --mu-torso-mm 5
expect 2 "thresholds and a target" "$bodice" fit --mu-torso-mm 5 --mu-limbs-mm 4 --target-error-mm 2
expect 2 "more substeps than the solver takes" "$bodice" drape --substeps 129
expect 2 "a tier that does not exist" "$bodice" fit --tier perfect
expect 2 "a threshold of zero" "$bodice" fit --target-error-mm 0

expect 1 "a file that does not exist" "$bodice" fit nowhere.obj
prints "nowhere.obj"
one_line
echo "this is not a mesh" >text.obj
expect 1 "a file without a mesh" "$bodice" fit text.obj -o p.json
prints "text.obj"
one_line
absent p.json
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >triangle.obj
expect 1 "a triangle is no body" "$bodice" fit triangle.obj
one_line
expect 1 "an output folder that does not exist" "$bodice" fit -o no/such/folder/p.json
prints "folder"
expect 2 "a profile that does not exist" "$bodice" fit --profile martians
prints "ansur2"

# refused COMMAND...: bad usage is refused before any work.
refused() { expect 2 "bad usage accepted: $*" timeout 5 "$bodice" "$@"; }

# Numbers without a meaning are refused.
for value in nan inf 0 -1 1e999 2x ""; do refused fit --target-error-mm "$value"; prints "target-error-mm"; done
refused fit --target-error-mm 0
prints "above 0"
for value in nan -1; do refused fit triangle.obj --region-of triangle.obj --region-margin-mm "$value"; done
prints "at least 0"
for value in -1 18446744073709551616 1.5 0x10; do refused fit --seed "$value"; prints "whole number"; done
refused fit --threads 1.5
prints "whole number from 0 to 1024"
refused fit --max-ellipsoids 5x
for value in 0 nan 3; do refused fit --height "$value"; prints "0.4 to 2.6"; done
refused fit --height 1.7 --mass 500
refused drape --wind 1,2,nan
prints "finite"
refused drape --fabric wool
prints "silk"

refused query p.json triangle.obj --motion clip.glb --time nan
refused fitt
prints "no command 'fitt'"
prints "query"
one_line
expect 1 "a motion that is not made here" "$bodice" drape --motion wlak
prints "arms-up"
one_line
expect 2 "a clip of a made motion" "$bodice" drape --tier paper --vertices 2000 --motion walk --clip run
prints "no clip 'run'"
expect 2 "more frames than there may be" "$bodice" drape --tier paper --vertices 2000 --motion walk --dt 1e-9
prints "over 100000 frames"
expect 2 "a pose before the clip" "$bodice" fit --tier paper --vertices 2000 --poses sit@-1 -o poses.json
prints "no pose at -1 s"
expect 0 "a short built-in body has a mass of its height" "$bodice" fit --height 1.2 --tier paper --vertices 2000 -o short.json
printf '\xef\xbb\xbf0 0.5 0\n' >marked.txt
expect 0 "points behind a byte order mark" "$bodice" query short.json marked.txt
one_line
cp out.txt printed.txt
expect 0 "- is standard output" "$bodice" query short.json marked.txt -o -
cmp -s out.txt printed.txt || { echo "FAILED: -o - prints something else"; failures=$((failures + 1)); }
absent -
expect 0 "a taller body" "$bodice" make --height 1.6 --vertices 2000 -o tall.obj
expect 2 "colliders of another body" "$bodice" export short.json --to unity --body tall.obj -o unity.json
prints "not that of the proxy"
absent unity.json
for command in "--help" "fit --help" "query short.json marked.txt"; do
  "$bodice" $command >/dev/full 2>out.txt
  [ $? -eq 1 ] || { echo "FAILED: a full disk is not noticed by: $command"; failures=$((failures + 1)); }
  prints "Standard output"
done

# Empty names, as of unset variables, are refused.
refused fit ""
prints "built-in"
for option in --region-of -o --surface --glb --labels --report --picture --trace; do refused fit "$option" ""; prints "empty"; done
refused fit triangle.obj --mesh ""
refused drape triangle.obj ""
refused make --garment-out ""
refused query "" triangle.obj

# Options that would be ignored are refused.
for option in "--height 1.7" "--sex male" "--pose t" "--mass 60" "--vertices 5000"; do refused fit triangle.obj $option; prints "BODY"; done
for option in "--unit m" "--up y" "--mesh body" "--person 2" "--force"; do refused fit $option; prints "BODY"; done
refused fit --region-margin-mm 20
refused fit --surface-mm 5
refused drape --gust 0.5
refused drape triangle.obj triangle.obj --garment tunic
refused drape --picture d.png --no-picture
refused make --garment tunic
refused make triangle.obj
prints "garment-out"
refused make triangle.obj -o b.obj --garment-out g.obj

# The extension gives the format, and an unknown one is refused.
for option in "-o p.glb" "-o p" "--surface s.stl" "--glb g.obj" "--picture p.jpg"; do refused fit $option; prints "extension"; one_line; done
refused drape -o d.obj
refused make -o b.stl
refused make --garment-out g.glb
expect 0 "an extension in capitals" "$bodice" fit --tier paper --vertices 2000 -o P.BODICE
[ "$(head -c 1 P.BODICE)" != "{" ] || { echo "FAILED: JSON in P.BODICE"; failures=$((failures + 1)); }
expect 0 "a device has any name" "$bodice" fit --tier paper --vertices 2000 --surface /dev/null --report /dev/null --labels /dev/null

# No output overwrites an input or another output, by whatever name.
cp triangle.obj kept.obj && ln -s triangle.obj link.obj && ln triangle.obj hard.obj && cp triangle.obj p.json
for file in triangle.obj ./triangle.obj "$PWD/triangle.obj" "../${PWD##*/}/triangle.obj" link.obj hard.obj; do
  refused fit triangle.obj --surface "$file"
  prints "overwrite BODY"
  one_line
done
refused fit p.json -o p.json
refused fit body.obj --region-of triangle.obj --surface triangle.obj
refused make triangle.obj --garment-out triangle.obj
refused drape body.obj triangle.obj --labels triangle.obj
refused fit --profile p.json -o p.json
refused fit -o same.json --report same.json
prints "overwrite -o"
refused fit -o ./a.json --trace a.json
refused make -o b.obj --garment-out b.obj
refused drape -o d.glb --report d.png
refused query p.json triangle.obj -o triangle.obj
refused query p.json triangle.obj -o ./p.json
cmp -s triangle.obj kept.obj && cmp -s p.json kept.obj || { echo "FAILED: an input was overwritten"; failures=$((failures + 1)); }
for file in same.json a.json b.obj g.obj d.glb; do absent $file; done
rm p.json

# Things that are no person, and props beside a body.
box() { # box FILE X Y Z WIDTH
  awk -v x="$2" -v y="$3" -v z="$4" -v w="$5" 'BEGIN {
    for (k = 0; k < 8; ++k) print "v", x + w * (k % 2), y + w * (int(k / 2) % 2), z + w * int(k / 4)
    print "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6" }' >"$1"
}
box stool.obj 25 0 -20 40
refused fit --shape any
refused fit stool.obj --shape chair
refused drape --shape any
expect 1 "a box is no person" "$bodice" fit stool.obj -o p.json
absent p.json
expect 0 "a box as a thing" "$bodice" fit stool.obj --shape any --unit cm --tier solid -o p.json --report stool.json
prints "0.400 m tall"
for key in '"shape": "any"' '"part_1"' '"landmarks": \[\]'; do
  grep -q "$key" stool.json || { echo "FAILED: no $key in the report of a thing"; failures=$((failures + 1)); }
done
grep -q '"part":"part_1"' p.json || { echo "FAILED: no part_1 in the proxy of a thing"; failures=$((failures + 1)); }
expect 0 "no unit is a warning" "$bodice" fit stool.obj --shape any --tier solid
prints "read in meters"
refused fit stool.obj --shape any --measurements m.json
one_line
absent m.json
rm p.json
box stool_m.obj 0.6 0 -0.2 0.4
expect 0 "a skirt beside a stool" "$bodice" drape --vertices 3000 --tier solid --frames 2 --substeps 4 \
  --prop stool_m.obj -o prop.glb --report prop.json --no-picture
prints "stool_m.obj"
grep -qa '"prop"' prop.glb || { echo "FAILED: no prop in the GLB"; failures=$((failures + 1)); }
grep -q '"props"' prop.json || { echo "FAILED: no props in the report"; failures=$((failures + 1)); }
expect 1 "a prop that does not exist" "$bodice" drape --vertices 3000 --tier solid --prop nowhere.obj -o none.glb
prints "nowhere.obj"
absent none.glb
refused drape --prop stool_m.obj -o stool_m.obj

# A body that moves under its garment.
refused drape --motion ""
refused drape --clip walk
refused drape --motion walk --ramp -1
refused drape --fit-map size
expect 1 "a motion file that does not exist" "$bodice" drape --motion nowhere.bvh --tier solid -o none.glb
prints "nowhere.bvh"
absent none.glb
expect 0 "a skirt on a body that walks" "$bodice" drape --vertices 3000 --tier solid --motion walk --frames 4 --keep 3 \
  --substeps 4 -o walk.glb --report walk.json --film-strip walk_strip.png --contact-sheet walk_sheet.png --fit-map strain -q
exists walk.glb
exists walk_strip.png
exists walk_sheet.png
for key in '"ramp_s"' '"kept"' '"proxy_error_mm"' '"over_half_mm_cm2"' '"overlapped_cm2"' '"fit_map"'; do
  grep -q "$key" walk.json || { echo "FAILED: no $key in the report"; failures=$((failures + 1)); }
done
for word in JOINTS_0 inverseBindMatrices '"cloth"'; do
  grep -qa -- "$word" walk.glb || { echo "FAILED: no $word in the GLB of the walk"; failures=$((failures + 1)); }
done

# A rig: any tool's skinned GLB, for a body that has none.
refused rig -o r.obj
refused rig --clip fly
prints "walk"
refused rig body.obj -o body.obj
for value in nan 90; do refused rig --arms-out "$value"; done
expect 1 "a triangle has no joints" "$bodice" rig triangle.obj -o none.glb
one_line
absent none.glb
expect 0 "make a body to rig" "$bodice" make --vertices 3000 --pose sit -o seated.obj -q
expect 0 "rig it" "$bodice" rig seated.obj -o seated.glb --clip walk sit
prints "22 joints, 2 clips"
exists seated.glb
for word in '"skins"' '"inverseBindMatrices"' '"JOINTS_0"' '"WEIGHTS_0"' '"walk"' '"sit"' '"forearm_l"'; do
  grep -qa -- "$word" seated.glb || { echo "FAILED: no $word in the rigged GLB"; failures=$((failures + 1)); }
done
grep -qa '"dance"' seated.glb && { echo "FAILED: a clip that was not requested"; failures=$((failures + 1)); }
expect 0 "rig it again" "$bodice" rig seated.obj -o again.glb --clip walk sit --threads 1 -q
cmp -s seated.glb again.glb || { echo "FAILED: one worker gives another rig"; failures=$((failures + 1)); }
expect 0 "the built-in body brings its rig" "$bodice" rig --vertices 2000 -o builtin.glb
prints "9 clips"
expect 0 "a rigged file is a body" "$bodice" fit seated.glb --tier paper -o seated.json -q

expect 0 "make a body and a garment" "$bodice" make --vertices 4500 -o body.obj --garment skirt --garment-out skirt.obj
exists body.obj
exists skirt.obj
expect 0 "a garment for a body" "$bodice" make body.obj --garment-out poncho.obj --garment poncho --unit m --up y -q
exists poncho.obj
awk '$1 == "v" { print $1, $2 / 0.3048, $3 / 0.3048, $4 / 0.3048; next } { print }' body.obj >feet.obj
expect 0 "a body in feet" "$bodice" fit feet.obj --unit ft --tier paper
prints "unit ft, 1.6[0-9]* m tall"
expect 0 "fit it" "$bodice" fit body.obj --tier solid -o p.json --glb p.glb --surface s.obj --labels l.txt --report r.json --picture p.png --trace t.json
for file in p.json p.glb s.obj l.txt r.json p.png t.json; do exists $file; done
for file in m.json m.yaml; do
  expect 0 "measurements in $file" "$bodice" fit body.obj --tier paper --measurements $file
  exists $file
  expect 0 "a number in $file" grep -q 'waist_over_bust_line"*: [0-9]' $file
done
refused fit body.obj --measurements m.txt
expect 0 "millimeters" grep -q '^  height: 1[0-9][0-9][0-9]\.' m.yaml
expect 0 "measurements for GarmentCode" "$bodice" fit body.obj --tier paper --measurements m.yaml --measurements-unit cm
expect 0 "centimeters" grep -q '^  height: 1[0-9][0-9]\.' m.yaml
refused fit body.obj --measurements m.yaml --measurements-unit furlong
expect 0 "regions and a heat map" "$bodice" fit body.obj --tier solid --segmentation seg.json --heat-map heat.png
prints "heat map"
exists heat.png
expect 0 "six regions" grep -q '"left_arm":\[[0-9].*"face_internal"' seg.json
refused fit --segmentation none.json; prints "OBJ"
absent none.json
expect 0 "a budget of time" "$bodice" fit body.obj --budget-us 90 --region-of skirt.obj
prints "10,000 particles near the skin take"
for budget in 1e-9 50; do
  expect 0 "a budget that no proxy can be given" "$bodice" fit body.obj --budget-us $budget
  prints "10,000 particles near the skin take"
  grep -q "gives that time here" out.txt && { echo "FAILED: another budget is advised"; cat out.txt; failures=$((failures + 1)); }
done
expect 0 "fit the whole body" "$bodice" fit body.obj --tier tight --max-ellipsoids 30 -o whole.json
expect 0 "and what a skirt can reach of it" "$bodice" fit body.obj --tier tight --max-ellipsoids 30 --region-of skirt.obj --region-exact -o near.json
[ "$(wc -c <near.json)" -lt "$(wc -c <whole.json)" ] || { echo "FAILED: nothing is out of a skirt's reach"; failures=$((failures + 1)); }
awk '$1 == "v" && n++ % 20 == 0 { print $2, $3, $4 }' skirt.obj >points.txt
for proxy in whole near; do "$bodice" query $proxy.json points.txt | cut -d' ' -f1-7 >$proxy.txt; done
# Single precision is relative to the origin of each proxy, so that they agree to a micrometer.
paste -d' ' whole.txt near.txt | awk '{ d = $1 - $8; if (d > 1e-6 || d < -1e-6) bad = 1 } END { exit bad || NR < 100 }' || { echo "FAILED: an exact region gives other distances"; failures=$((failures + 1)); }
expect 0 "a surface in large cells" "$bodice" fit body.obj --tier relief --max-ellipsoids 16 --surface coarse.obj --surface-mm 20 -o r.bodice
[ "$(($(wc -c <coarse.obj) * 5))" -lt "$(wc -c <s.obj)" ] || { echo "FAILED: the cells are no larger"; failures=$((failures + 1)); }
for mm in 0.1 500; do expect 2 "a surface in $mm mm" "$bodice" fit body.obj --surface x.obj --surface-mm $mm; prints "Give"; done
absent x.obj
expect 2 "an exact region of nothing" "$bodice" fit body.obj --region-exact
expect 0 "fit the built-in body, binary proxy" "$bodice" fit --tier paper --vertices 4500 -o p.bodice --quiet
exists p.bodice
[ -s out.txt ] && { echo "FAILED: --quiet printed"; failures=$((failures + 1)); }

printf '0 5 0\n0 0.95 0\n' >points.txt
expect 0 "query the proxy" "$bodice" query p.json points.txt
[ "$(wc -l <out.txt)" -eq 2 ] || { echo "FAILED: not a line a point"; failures=$((failures + 1)); }
awk 'NR == 1 && $1 < 3 { bad = 1 } NR == 2 && $1 > 0 { bad = 1 } END { exit bad }' out.txt ||
  { echo "FAILED: a far point is not far, or the hip is not inside"; cat out.txt; failures=$((failures + 1)); }
cp out.txt exact.txt
expect 0 "points from standard input" "$bodice" query p.json - <points.txt
cmp -s out.txt exact.txt || { echo "FAILED: standard input gives other distances"; failures=$((failures + 1)); }
expect 0 "points within a meter" "$bodice" query p.json points.txt --within 1
[ "$(head -1 out.txt) $(tail -1 out.txt)" = "inf nan nan nan nan nan nan none $(tail -1 exact.txt)" ] ||
  { echo "FAILED: --within 1 leaves the wrong point out"; cat out.txt; failures=$((failures + 1)); }
expect 0 "distances to first order" "$bodice" query p.json points.txt --fast
paste -d' ' out.txt exact.txt | awk '{ d = $1 - $9; if (NR == 1 && (d == 0 || d > 1 || d < -1) || $1 * $9 < 0) bad = 1 } END { exit bad || NR != 2 }' ||
  { echo "FAILED: a distance to first order is exact, or far off"; cat out.txt; failures=$((failures + 1)); }
expect 2 "a negative --within" "$bodice" query p.json points.txt --within -1
expect 1 "a malformed point from standard input" "$bodice" query p.json - <<<"0 5"
prints "standard input: line 1"
printf '1e30 0 0\n' >points.txt
expect 0 "a point beyond single precision" "$bodice" query r.bodice points.txt
prints "^inf nan nan nan nan nan nan none$"
expect 1 "a folder of points" "$bodice" query p.json .
one_line
printf '0 5\n' >points.txt
expect 1 "a malformed point" "$bodice" query p.json points.txt
prints "line 1"
head -c 100 p.json >cut.json
printf '0 5 0\n' >points.txt
expect 1 "a truncated proxy" "$bodice" query cut.json points.txt
prints "cut.json"

# A second body stands beside the first; a stretched body contradicts what is known of people.
awk '$1 == "v" { v[++n] = $0; x[n] = $2; y[n] = $3; z[n] = $4 } $1 == "f" { f[++m] = $2 " " $3 " " $4 }
  END { for (i = 1; i <= n; ++i) print v[i]; for (i = 1; i <= n; ++i) print "v", x[i] + 1.6, y[i], z[i]
        for (i = 1; i <= m; ++i) { split(f[i], k, " "); print "f", f[i]; print "f", k[1] + n, k[2] + n, k[3] + n } }' body.obj >two.obj
for person in 1 2; do
  expect 0 "person $person of two" "$bodice" fit two.obj --person $person --tier paper --labels labels.txt
  prints "2 bodies; number $person"
  awk '{ if ($1 > 0.8) ++right } END { print right == NR ? "right" : right == 0 ? "left" : "both" }' labels.txt
done | sort >sides.txt
printf 'left\nright\n' | cmp -s - sides.txt || { echo "FAILED: not one person each:"; cat sides.txt; failures=$((failures + 1)); }
expect 1 "a third person of two" "$bodice" fit two.obj --person 3 --tier paper
prints "from 1 to 2"
awk '$1 == "v" { print "v", $2, 2.5 * $3, $4; next } { print }' body.obj >stretched.obj
expect 1 "a body that is no person's" "$bodice" fit stretched.obj --unit m --tier paper -o stretched.json
prints "force"
absent stretched.json
expect 0 "the same, forced" "$bodice" fit stretched.obj --unit m --tier paper -o stretched.json --force
prints "went on although"

expect 0 "drape files" "$bodice" drape body.obj skirt.obj --tier paper --frames 5 --wind -1,0,2 --gust 0.5 -o d.glb --report d.json
exists d.glb
exists d.png
prints "true skin"
expect 0 "drape, report to standard output" "$bodice" drape --tier paper --vertices 4500 --frames 3 -o e.glb --no-picture --json
prints '"penetration"'
absent e.png
expect 0 "drape, the waistband free" "$bodice" drape --tier paper --vertices 4500 --frames 3 -o free.glb --no-picture --hold none -q
cmp -s e.glb free.glb && { echo "FAILED: --hold none is ignored"; failures=$((failures + 1)); }
expect 1 "benches that are elsewhere" ./alone bench
prints "BODICE_BUILD_BENCH"
expect 1 "a garment that does not exist" "$bodice" drape body.obj nowhere.obj -o f.glb
absent f.glb

[ "$failures" -eq 0 ] && echo "all checks of the program passed"
exit $((failures > 0))
