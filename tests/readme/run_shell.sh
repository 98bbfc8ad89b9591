#!/usr/bin/env bash
# Runs every `sh` block of the README in an empty folder and an empty home, with this build as build/release and a
# body.obj, dress.obj, scan.obj and avatar.glb made by it: `bodice` is found only where the README's own commands put it.
# The set-up commands that call this test are checked for syntax only; those that set up Python are tested by capi_python.
set -euo pipefail
source_dir=$1 build_dir=$2 bodice=$3 scratch=$4
rm -rf "$scratch" && mkdir -p "$scratch/build" "$scratch/home" && cd "$scratch"
ln -s "$build_dir" build/release
ln -s "$source_dir/examples" examples
export HOME=$scratch/home

"$bodice" make -o body.obj --garment tunic --garment-out dress.obj --quiet
cp body.obj scan.obj
"$bodice" rig body.obj -o avatar.glb --clip walk --quiet
ran=0
while IFS= read -r line; do
  case $line in
    "" | "#"* | "sudo "* | "python3 "* | "/usr/bin/python3 "*) ;;
    "bash "*)
      script=${line#bash } script=${script%%[[:space:]]*}
      bash -n "$source_dir/$script"
      ;;
    "export "*) eval "$line" ;;
    *)
      echo "+ $line"
      bash -euo pipefail -c "$line" >output.txt 2>&1 || { cat output.txt; exit 1; }
      ran=$((ran + 1))
      ;;
  esac
done < <(awk '/^```sh/ { on = 1; next } /^```/ { on = 0 } on' "$source_dir/README.md")
[ "$ran" -gt 0 ] || { echo "README.md has no shell line to run"; exit 1; }
case $(command -v bodice) in
  "$HOME"/*) ;;
  *) echo "the README's commands do not put bodice on the path"; exit 1 ;;
esac
echo "$ran commands of the README ran"
