#!/bin/bash
# Tests and measures slagflow on a GPU, and needs nothing but its driver: scripts/bench --device --pack has made this folder.
#   ./measure.sh [--seconds N] [--short] [FOLDER]   results go to FOLDER, by default results/ here; ends within N seconds (480)
# Each part leaves its file as soon as it has ended, and parts.json tells how each did: read them with
# scripts/bench --read FOLDER. --short tries whether all is there, with small parts.
set -u
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
limit=480 short= results=$here/results
while [ $# -gt 0 ]; do
  case $1 in
    --seconds) limit=${2:?seconds}; shift ;;
    --short) short=1 ;;
    -*) echo "usage: ${0##*/} [--seconds N] [--short] [FOLDER]" >&2; exit 2 ;;
    *) results=$1 ;;
  esac
  shift
done
mkdir -p "$results" || exit 1
results=$(cd "$results" && pwd)
export SLAGFLOW_SOURCE=$here
export OMP_WAIT_POLICY=passive  # or else slagflow starts itself anew to set it, which the loader below does not let it

# Its own C library: that of the machine may be older.
program() {
  local name=$1
  shift
  "$here/lib/ld-linux-x86-64.so.2" --library-path "$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" "$here/bin/$name" "$@"
}
export -f program
export here

parts=()
# part NAME SECONDS COMMAND...: at most so long, and not beyond the end; what it says goes to NAME.log.
part() {
  local name=$1 most=$2 begin=$SECONDS left status
  shift 2
  left=$((limit - SECONDS))
  if [ "$left" -lt 5 ]; then
    status='"no time was left"'
  else
    [ "$left" -ge "$most" ] || most=$left
    echo "$name, at most $most s"
    timeout -k 5 "$most" bash -c 'program "$@"' "$name" "$@" >"$results/$name.log" 2>&1
    status=$?
    [ "$status" -eq 0 ] || tail -n 3 "$results/$name.log"
  fi
  parts+=("{\"part\": \"$name\", \"status\": $status, \"seconds\": $((SECONDS - begin))}")
  local IFS=,
  printf '[%s]\n' "${parts[*]}" >"$results/parts.json"
}

bench() {  # bench NAME SECONDS FILTER [OPTION...]
  local name=$1 most=$2 filter=$3
  shift 3
  part "$name" "$most" bench_step --benchmark_filter="$filter" --benchmark_out="$results/$name.json" \
    --benchmark_out_format=json "$@"
}

discharge() {  # discharge NAME SECONDS LOOP [OPTION...]
  local name=$1 most=$2 loop=$3
  shift 3
  rm -rf "$results/run"
  part "$name" "$most" slagflow run "$here/cases/dam_discharge.toml" -o "$results/run" --quiet \
    --set "numerics.solver_loop=$loop" --set output.walls=false "$@"
  [ ! -e "$results/run/summary.json" ] || cp "$results/run/summary.json" "$results/$name.json"
  rm -rf "$results/run"
}

agreement() {
  part agreement 60 agreement write "$results/agreement.bin"
  part agreement_compare 10 agreement compare "$here/agreement.cpu" "$results/agreement.bin"
}

{ nvidia-smi --query-gpu=name,memory.total,driver_version,clocks.max.sm,power.limit --format=csv || echo "no nvidia-smi"; } \
  >"$results/device.csv" 2>&1
cat "$results/device.csv"
if [ -n "$short" ]; then
  small=(--set resolution.spacing=0.005 --set output.end_time=0.005)
  discharge discharge 200 batch "${small[@]}"
  discharge discharge_conditional 200 conditional "${small[@]}"
  part tests 100 test_core --gtest_filter='LaunchGraph*:CellGrid*:Ordering*' --gtest_output="json:$results/tests.json"
  agreement
  bench bench_copy 60 copy
else
  bench steps 60 '^step/spacing_um:(2000|1000)/'
  discharge discharge 60 batch --set output.end_time=1
  discharge discharge_conditional 60 conditional --set output.end_time=1
  bench steps_million 60 '^step/spacing_um:464/'
  agreement
  SLAGFLOW_GRAPH_LOOPS=1 part tests 120 test_core --gtest_brief=1 --gtest_output="json:$results/tests.json" \
    --gtest_filter=-ParticleArrays.AreTheRowsOfTheTableInTheReadme
  bench parts 90 '^(copy|neighbours|density|wall_pressure|viscous|snapshot)'
  bench steps_ten_million 200 '^step/spacing_um:215/' --benchmark_min_time=0.2
fi
echo "results in $results after $SECONDS s"
grep -vq '"status": [^0]' "$results/parts.json"
