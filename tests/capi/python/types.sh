#!/usr/bin/env bash
# The stub of the Python package states what the package has, and the example programs are typed by it.
#   types.sh PYTHON SOURCE SCRATCH
set -euo pipefail
python=$1 source=$2 scratch=$3
"$python" -c 'import mypy.stubtest, numpy' 2>/dev/null || { echo "skipped: $python has no mypy and numpy"; exit 0; }
export MYPYPATH="$source/modules/capi/python" PYTHONPATH="$source/modules/capi/python" MYPY_CACHE_DIR="$scratch"
printf 'bodice\\._.*\n' >"$scratch.allowed"
"$python" -m mypy.stubtest --concise --ignore-missing-stub --allowlist "$scratch.allowed" --ignore-unused-allowlist bodice
"$python" -m mypy --no-error-summary --cache-dir "$scratch" "$source/examples/collision_loss.py" || exit 1
# A check that cannot fail is none: a wrong call is found.
printf 'import bodice\nbodice.fit([[0.0]], [[0]], "best")\n' >"$scratch.py"
if "$python" -m mypy --strict --no-error-summary --cache-dir "$scratch" "$scratch.py" >"$scratch.log"; then
  echo "types.sh: mypy takes a tier that there is not" >&2; exit 1
fi
grep -q 'Argument 3 to "fit"' "$scratch.log"
