#!/bin/sh
# Runs an experiment or a study in N shards with GNU parallel, and merges them into OUT/results.
#
#   parallel.sh N OUT COMMAND…
#   parallel.sh 16 out study monte-carlo --count 1000
#
# OUT/shard-i is the folder of shard i. The same command continues an interrupted run. JOBS is the number of shards at
# a time (default: the cores). PARALLEL holds further options of GNU parallel, for example --sshloginfile nodes for
# nodes that share the folders. CAPSTAN_CLI names the program where it is not in PATH.
set -eu
if [ $# -lt 3 ]; then
  echo "usage: parallel.sh N OUT COMMAND…" >&2
  exit 2
fi
shards=$1
out=$2
shift 2
program=${CAPSTAN_CLI:-capstan-cli}
mkdir -p "$out"
seq "$shards" | parallel --will-cite --quote --jobs "${JOBS:-100%}" --halt soon,fail=1 --joblog "$out/joblog" \
  "$program" "$@" --threads 1 --shard "{}/$shards" --out "$out/shard-{}"
set --
for i in $(seq "$shards"); do set -- "$@" "$out/shard-$i"; done
exec "$program" merge "$out/results" "$@"
