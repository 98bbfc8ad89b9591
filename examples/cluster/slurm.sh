#!/usr/bin/env bash
# Runs a batch on Slurm: an array of tasks, a shard each, and a summary when all have ended.
#   bash examples/cluster/slurm.sh MANIFEST OUT [SHARDS [SBATCH-OPTION...]]
# Run it again to go on: results that are there are skipped. MANIFEST and OUT are on a disk that all nodes see.
# A task takes the cores and memory that it is given: one job a core, each with its share of the memory.
#   SBATCH-OPTION         as sbatch takes them: --cpus-per-task=16 --mem=64G --time=4:00:00 --partition=...
#   BODICE                the program (default: bodice)
#   BODICE_BATCH_OPTIONS  options of `bodice batch`, as "--timeout 600 --retry 1"
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 2; }
manifest=$(realpath -e "$1")
mkdir -p "$2/slurm"
out=$(realpath "$2")
shards=${3:-100}
shift $(($# < 3 ? $# : 3))
bodice=$(command -v "${BODICE:-bodice}") || { echo "slurm.sh: no program bodice on the path; set BODICE" >&2; exit 1; }

task=$out/slurm/task.sh
cat >"$task.$$" <<'TASK'
#!/bin/bash
# A shard of a batch, in the cores and the memory that Slurm gave it.
manifest=$1 out=$2 bodice=$3 options=$4
export SLURM_CPUS_PER_TASK=${SLURM_CPUS_PER_TASK:-1}   # not set without --cpus-per-task, which means 1
cores=$SLURM_CPUS_PER_TASK
granted_mb=${SLURM_MEM_PER_NODE:-$((${SLURM_MEM_PER_CPU:-0} * cores))}
# Some of it is for the program itself. 0 is no limit, or all of the node.
if [ "$granted_mb" -gt 64 ] && [[ $options != *--memory* ]]; then
  options="--memory $(((granted_mb - 64) * 1048576 / 1000000 / cores)) $options"
fi
# exec, so that the signals of Slurm reach the program, which then ends within a second.
exec "$bodice" batch "$manifest" --out "$out" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" $options
TASK
mv "$task.$$" "$task"

array=$(sbatch --parsable --array="0-$((shards - 1))" --requeue --signal=B:TERM@30 --job-name=bodice \
  --output="$out/slurm/%A_%a.txt" "$@" "$task" "$manifest" "$out" "$bodice" "${BODICE_BATCH_OPTIONS:-}")
array=${array%%;*}
# A failed job fails its task: the summary waits for the end of all, good or bad.
merge=$(sbatch --parsable --dependency="afterany:$array" --requeue --job-name=bodice-summary --output="$out/slurm/summary.txt" \
  --wrap "exec '$bodice' batch --summary '$out'")
echo "array $array of $shards shards, then summary ${merge%%;*}: $out/summary.html"
echo "Run the same command again to go on where it ended."
