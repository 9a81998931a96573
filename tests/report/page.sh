#!/bin/sh
# Draws the page of a small run in Chromium and looks at it: page.sh BIGHT REPORT_JS.
# Exit status 77, skipped, where something that only this test needs is not there.
set -eu
bight=$1 script=$2
skip() {
  echo "skipped: $1"
  exit 77
}
command -v node >/dev/null || skip "no node (Debian package nodejs)"
command -v chromium >/dev/null || skip "no Chromium (Debian package chromium)"
[ -f "$script" ] || skip "no $script (./bight report builds it)"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/small.toml" <<'SCENE'
title = "Test & <small> knot"
[rod]
length = "350 mm"
diameter = "8.3 mm"
[material]
youngs_modulus = "1.25 MPa"
[path]
ebar = [30, 19]
record = [30, 25, 20, 19]
[rod1d]
segments = 120
[solid3d]
section_elements = 12
axial_ratio = 1.5
seed_ebar = 20
SCENE
printf 'ebar,force_normalised\n28,0.01\n24,0.016\n21,0.022\n' >"$folder/measured.csv"
"$bight" run "$folder/small.toml" --out "$folder/run" --quiet
"$bight" report "$folder/run" --script "$script" --measured "$folder/measured.csv"
cp -r "$folder/run" "$folder/unfinished"
rm "$folder/unfinished/summary.json"
cp -r "$folder/run" "$folder/odd"  # as if another version had written it
sed -i 's/"energy_J": {/"energy_J": null, "was": {/' "$folder/odd/summary.json"
mkdir "$folder/study"
cat >"$folder/study/study.csv" <<'CSV'
run,rod1d.segments,fidelity,status,reference,on_front,states,error_force_largest,wall_s,cpu_s,unknowns,newton_iterations,reason
"rod1d.segments=60,path.max_step=1",60,rod,finished,0,1,2,0.02,0.3,0.2,100,50,
rod1d.segments=120,120,rod,finished,0,1,2,0.004,0.5,0.4,200,60,
rod1d.segments=240,240,rod,finished,1,0,2,0,1.5,1.1,400,70,
rod1d.segments=9,9,rod,gave up,0,0,0,,0.1,0.1,20,5,"too few, by far"
CSV
for of in unfinished odd study; do "$bight" report "$folder/$of" --script "$script"; done
node "$(dirname "$0")/page.mjs" "$folder" "$(dirname "$script")" "$(command -v chromium)"
