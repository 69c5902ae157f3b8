#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A planned run as Slurm job arrays: one array a wave, each waiting for the one before, then the merge.
#   cambium plan fuse.yaml missions/* -o plan.json
#   pipelines/cluster/slurm.sh plan.json 16 /shared/cache fused [OPTION OF cambium...]
# The cache must lie on a file system that all nodes share. SBATCH_OPTIONS (such as "--partition=long
# --cpus-per-task=8 --mem=16G") go to every sbatch; CAMBIUM names the program. Prints the number of
# the merging job.
set -euo pipefail
[ $# -ge 4 ] || { sed -n 's/^# \{0,1\}//p' "$0" | tail -n +2; exit 2; }
plan=$(realpath "$1") shards=$2 cache=$(realpath -m "$3") out=$(realpath -m "$4")
shift 4
cambium=${CAMBIUM:-cambium}
read -ra options <<<"${SBATCH_OPTIONS:-}"
waves=$(sed -n 's/^ "waves": \([0-9]*\),$/\1/p' "$plan")
logs=$out.logs
mkdir -p "$logs"

# submit NAME DEPENDENCY SBATCH_OPTION... -- COMMAND...: prints the job's number.
submit() {
  local name=$1 after=$2 own=()
  shift 2
  while [ "$1" != -- ]; do own+=("$1"); shift; done
  shift
  local command
  command=$(printf '%q ' "$@")
  sbatch --parsable --job-name="$name" --output="$logs/$name-%A_%a.log" \
    ${after:+--dependency=afterok:$after --kill-on-invalid-dep=yes} "${options[@]}" "${own[@]}" \
    --wrap "${command//TASK/\$SLURM_ARRAY_TASK_ID}" | cut -d';' -f1
}

job=
for wave in $(seq "$waves"); do
  job=$(submit "cambium_wave_$wave" "$job" --array="1-$shards" -- \
    "$cambium" run "$plan" --shard "TASK/$shards" --wave "$wave" --cache "$cache" "$@")
done
submit cambium_merge "$job" -- "$cambium" merge "$plan" --cache "$cache" --out "$out" "$@"
