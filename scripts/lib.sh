# Shared by the scripts: stages with wall times, and the totals of CTest.
# shellcheck shell=bash

passed=0
failed=0
failures=()  # names of stages that failed, and of tests: said once more at the end
skipped=()   # for each test that was skipped, why
too_late=()  # gates for which there was no time left

# stage NAME COMMAND...: runs the command and says how long it took.
stage() {
  local name=$1 begin=$SECONDS status=0
  shift
  echo "== $name"
  "$@" || status=$?
  echo "== $name: $((SECONDS - begin)) s$([[ $status == 0 ]] || echo ", FAILED ($status)")"
  ((status == 0)) || failures+=("$name")
  return "$status"
}

# begins NAME: whether there is time to begin that gate. After PLUMB_BEGIN_UNTIL [s since 1970] none begins, so that a
# slow machine ends with what it had time for; what it left out is said at the end and is no success.
begins() {
  (($(date +%s) < ${PLUMB_BEGIN_UNTIL:-9999999999})) || { too_late+=("$1"); return 1; }
}

# tally COMMAND...: a gate without CTest counts as one test.
tally() {
  begins "$1" || return 0
  if stage "$@"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
}

build_preset() {
  local launcher=()
  # It keeps what is compiled with a precompiled header only if told that macros and times in it do not matter, and
  # finds again what another clone compiled only if paths count from the clone.
  command -v ccache > /dev/null &&
    launcher=("-DCMAKE_CXX_COMPILER_LAUNCHER=env;CCACHE_SLOPPINESS=pch_defines,time_macros;CCACHE_BASEDIR=$PWD;CCACHE_NOHASHDIR=1;ccache")
  cmake --preset "$1" "${launcher[@]}" > /dev/null && cmake --build --preset "$@" -j "$(nproc)"
}

# test_preset PRESET [CTest arguments]: adds what CTest says to the totals; no test is a failure.
test_preset() {
  local log line total bad
  log=$(mktemp)
  ctest --preset "$@" 2>&1 | tee "$log" || true
  line=$(grep -E '% tests passed, [0-9]+ tests? failed out of [0-9]+' "$log" | tail -n 1)
  mapfile -t -O "${#failures[@]}" failures < <(sed -nE '/\(Skipped\)$/d; s/^\s*[0-9]+ - (\S+) \(.*/\1/p' "$log")
  mapfile -t -O "${#skipped[@]}" skipped < <(reasons_of_skips "build/$1/Testing/Temporary/LastTest.log")
  rm -f "$log"
  if [[ -z $line ]]; then
    failed=$((failed + 1))
    return 1
  fi
  total=${line##* }
  bad=$(sed -E 's/.*passed, ([0-9]+) tests? failed.*/\1/' <<< "$line")
  passed=$((passed + total - bad))
  failed=$((failed + bad))
  [[ $bad == 0 ]]
}

# reasons_of_skips LOG: for each test that GoogleTest skipped, the words after "FILE:LINE: Skipped".
reasons_of_skips() {
  [[ -r $1 ]] && awk 'why { print; why = 0 } /^[^ ]+:[0-9]+: Skipped$/ { why = 1 }' "$1"
}

# built_and_tested PRESET TARGETS [CTest arguments]: TARGETS, separated by blanks; all if there are none.
built_and_tested() {
  local preset=$1 targets=()
  begins "$preset ${2:-${*:3}}" || return 0
  if [[ -n $2 ]]; then
    read -ra targets <<< "$2"
    targets=(--target "${targets[@]}")
  fi
  shift 2
  if stage "build $preset" build_preset "$preset" "${targets[@]}"; then
    stage "test $preset" test_preset "$preset" "$@" || true
  else
    failed=$((failed + 1))
  fi
}

# For trap ... EXIT: the closing line, however the script ends. What stops it between gates is a
# failure, and so is no test at all.
close() {
  local status=$?
  ((status == 0)) || failed=$((failed + 1))
  ((${#failures[@]} == 0)) || printf 'FAILED: %s\n' "${failures[@]}"
  ((${#skipped[@]} == 0)) || echo "${#skipped[@]} tests skipped:" \
    "$(printf '%s\n' "${skipped[@]}" | sort | uniq -c | awk '{ n = $1; sub(/^ *[0-9]+ /, ""); printf "%s%d because \"%s\"", sep, n, $0; sep = ", " }')"
  ((${#too_late[@]} == 0)) || printf 'NOT RUN, the time was up: %s\n' "${too_late[@]}"
  echo "$passed passed, $failed failed"
  ((status == 0)) || exit "$status"
  ((failed == 0 && passed > 0)) || exit 1
}
