#!/usr/bin/env bash
# Installs the Python package with pip, offline, with the library that was built, and imports it from there.
#   install.sh PYTHON ROOT LIBRARY SCRATCH
set -euo pipefail
python=$1 root=$2 library=$3 scratch=$4
"$python" -c "import pip, numpy" 2>/dev/null || { echo "skipped: pip or numpy is not installed for $python"; exit 0; }
rm -rf "$scratch" && mkdir -p "$scratch"
BODICE_LIBRARY=$library "$python" -m pip install --quiet --no-index --no-deps --target "$scratch/site" "$root"
cd "$scratch"
env -u BODICE_LIBRARY PYTHONPATH="$scratch/site" "$python" -c "
import bodice
assert bodice.__file__.startswith('$scratch'), bodice.__file__
print(bodice.build())"
