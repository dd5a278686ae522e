#!/usr/bin/env bash
# tests/mutants/run.sh [-B FOLDER] [NAME...]: holds the tests to finding the faults of mutants.txt, all or those named.
# Builds once, with every mutant inside and the environment to choose one (CMake: DIPTYCH_MUTANT=ALL), sees every gate pass
# without a mutant, then runs each mutant's gates and prints a table. Exit code 1 where one survives. Only a failed check
# kills: running out of time, an unknown test and a build that fails are errors, exit code 2.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
list=$root/tests/mutants/mutants.txt
build=$root/build/mutants
if [ "${1:-}" = -B ]; then
    build=$2
    shift 2
fi
limit=600 # seconds a gate
log=$build/mutants.log

trim() { sed 's/^[[:space:]]*//; s/[[:space:]]*$//'; }
field() { cut -d'|' -f"$1" | trim; }
fail() {
    echo "mutants: $*" >&2
    exit 2
}

names=("$@")
if [ ${#names[@]} = 0 ]; then
    mapfile -t names < <(grep '^[A-Z]' "$list" | field 1)
fi
declare -A gates
targets=()
for name in "${names[@]}"; do
    line=$(grep "^$name |" "$list") || fail "no mutant $name in $list"
    gates[$name]=$(field 4 <<<"$line" | tr ';' '\n' | trim)
    while IFS=: read -r folder _; do
        targets+=("tests_$folder")
    done <<<"${gates[$name]}"
done
mapfile -t targets < <(printf '%s\n' "${targets[@]}" | sort -u)

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
    -DDIPTYCH_MUTANT=ALL >"$log" 2>&1 || fail "CMake failed: $log"
ninja -C "$build" "${targets[@]}" >>"$log" 2>&1 || fail "the build failed: $log"

# run_gate MUTANT FOLDER:TEST sets `outcome`: pass, fail (a check failed), skip or what went wrong.
run_gate() {
    local folder=${2%%:*} test=${2#*:} code=0 output
    output=$(DIPTYCH_MUTANT=$1 timeout "$limit" "$build/tests/tests_$folder" "$test" 2>&1 </dev/null) || code=$?
    printf '== %s: %s: exit code %s\n%s\n' "${1:-no mutant}" "$2" "$code" "$output" >>"$log"
    case $code in
        0) if grep -q 'All tests passed' <<<"$output"; then outcome=pass; else outcome="no such test"; fi ;;
        77) outcome=skip ;;
        124) outcome="out of time" ;;
        *) if grep -qE '^assertions:.* failed' <<<"$output"; then outcome=fail; else outcome="exit code $code"; fi ;;
    esac
}

unusable=0
declare -A skipped
while IFS= read -r gate; do
    run_gate "" "$gate"
    case $outcome in
        pass) ;;
        skip) skipped[$gate]=1 ;;
        *)
            echo "without a mutant, $gate: $outcome" >&2
            unusable=1
            ;;
    esac
done < <(for name in "${names[@]}"; do printf '%s\n' "${gates[$name]}"; done | sort -u)
[ "$unusable" = 0 ] || fail "a gate that fails without a mutant proves nothing: $log"

survivors=()
printf '| mutant | killed by | passed | seconds |\n|---|---|---|---|\n'
for name in "${names[@]}"; do
    killers="" blind="" start=$SECONDS
    while IFS= read -r gate; do
        if [ -n "${skipped[$gate]:-}" ]; then
            blind+="${blind:+; }$gate (skipped)"
            continue
        fi
        run_gate "$name" "$gate"
        case $outcome in
            fail) killers+="${killers:+; }$gate" ;;
            pass) blind+="${blind:+; }$gate" ;;
            *) blind+="${blind:+; }$gate ($outcome)" ;;
        esac
    done <<<"${gates[$name]}"
    [ -n "$killers" ] || survivors+=("$name")
    printf '| %s | %s | %s | %d |\n' "$name" "${killers:-NOTHING}" "$blind" $((SECONDS - start))
done
if [ ${#survivors[@]} != 0 ]; then
    echo "${#survivors[@]} of ${#names[@]} survived: ${survivors[*]}"
    exit 1
fi
echo "all ${#names[@]} killed"
