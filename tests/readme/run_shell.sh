#!/usr/bin/env bash
# Runs every `sh` block of the README in an empty folder, with `bodice` on the path and a body.obj and dress.obj
# made by it. The two set-up commands are checked for syntax only: they call this test.
set -euo pipefail
source_dir=$1 bodice=$2 scratch=$3
rm -rf "$scratch" && mkdir -p "$scratch/bin" && cd "$scratch"
ln -s "$bodice" bin/bodice
export PATH="$scratch/bin:$PATH"

bodice make -o body.obj --garment tunic --garment-out dress.obj --quiet
ran=0
while IFS= read -r line; do
  case $line in
    "" | "#"*) ;;
    "bash "*)
      script=${line#bash } script=${script%%[[:space:]]*}
      bash -n "$source_dir/$script"
      ;;
    *)
      echo "+ $line"
      bash -euo pipefail -c "$line" >output.txt 2>&1 || { cat output.txt; exit 1; }
      ran=$((ran + 1))
      ;;
  esac
done < <(awk '/^```sh/ { on = 1; next } /^```/ { on = 0 } on' "$source_dir/README.md")
[ "$ran" -gt 0 ] || { echo "README.md has no shell line to run"; exit 1; }
echo "$ran commands of the README ran"
