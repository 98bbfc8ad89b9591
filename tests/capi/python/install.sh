#!/usr/bin/env bash
# Installs the Python package with pip, offline and beside the library that was built, and imports it from there.
#   install.sh PYTHON PACKAGE LIBRARY SCRATCH
set -euo pipefail
python=$1 package=$2 library=$3 scratch=$4
"$python" -c "import setuptools, wheel, pip, numpy" 2>/dev/null ||
  { echo "skipped: pip, setuptools, wheel or numpy is not installed for $python"; exit 0; }
rm -rf "$scratch" && mkdir -p "$scratch" && cp -r "$package" "$scratch/source"
BODICE_LIBRARY=$library "$python" -m pip install --quiet --no-index --no-build-isolation --no-deps \
  --target "$scratch/site" "$scratch/source"
cd "$scratch"
env -u BODICE_LIBRARY PYTHONPATH="$scratch/site" "$python" -c "
import bodice
assert bodice.__file__.startswith('$scratch'), bodice.__file__
print(bodice.build())"
