#!/usr/bin/env bash
# tests/mutants/run.sh [-B FOLDER] [-p FOLDER] [-j N] [NAME...]: holds the tests to finding the faults of mutants.txt, all or
# those named. Builds once (in -B), with every mutant inside and the environment to choose one (CMake: DIPTYCH_MUTANT=ALL), or
# takes the programs of such a build from where they lie (-p), sees every gate pass without a mutant, then runs each mutant's
# gates, N mutants at a time, and prints a table. Exit code 1 where one survives. Only a failed check kills: running out of time,
# an unknown test and a build that fails are errors, exit code 2.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
list=$root/tests/mutants/mutants.txt
build=$root/build/mutants
programs= jobs=1
while getopts B:p:j: option; do
    case $option in
        B) build=$OPTARG ;;
        p) programs=$OPTARG ;;
        j) jobs=$OPTARG ;;
        *) exit 2 ;;
    esac
done
shift $((OPTIND - 1))
limit=${DIPTYCH_GATE_SECONDS:-600} # a gate

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

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
log=$scratch/log
if [ -z "$programs" ]; then
    mkdir -p "$build"
    programs=$build/tests log=$build/mutants.log
    cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
        -DDIPTYCH_MUTANT=ALL >"$log" 2>&1 || fail "CMake failed: $log"
    ninja -C "$build" "${targets[@]}" >>"$log" 2>&1 || fail "the build failed: $log"
fi

# run_gate MUTANT FOLDER:TEST sets `outcome`: pass, fail (a check failed), skip or what went wrong.
run_gate() {
    local folder=${2%%:*} test=${2#*:} code=0 output
    output=$(DIPTYCH_MUTANT=$1 timeout "$limit" "$programs/tests_$folder" "$test" 2>&1 </dev/null) || code=$?
    printf '== %s: %s: exit code %s\n%s\n' "${1:-no mutant}" "$2" "$code" "$output" >>"$log.$BASHPID"
    case $code in
        0) if grep -q 'All tests passed' <<<"$output"; then outcome=pass; else outcome="no such test"; fi ;;
        77) outcome=skip ;;
        124) outcome="out of time" ;;
        # A mutant may also end the program, before or after the check that it fails: Catch then may not come to its sums.
        *) if grep -qE '^assertions:.* failed|^with expansion:' <<<"$output"; then outcome=fail; else outcome="exit code $code"; fi ;;
    esac
}

# each COMMAND: gives it one line of the input after another, `jobs` at a time. Answers lie in $scratch/answers/LINE.
each() {
    local line count=0
    rm -rf "$scratch/answers"
    mkdir "$scratch/answers"
    while IFS= read -r line; do
        [ "$(jobs -rp | wc -l)" -lt "$jobs" ] || wait -n
        "$@" "$line" >"$scratch/answers/$(printf %04d $count)" </dev/null &
        count=$((count + 1))
    done
    wait
    cat "$log".* >>"$log" 2>/dev/null || true
    rm -f "$log".*
}
answers() { cat "$scratch"/answers/* 2>/dev/null || true; }

# Prints "OUTCOME GATE" of a gate in right code.
check_gate() {
    run_gate "" "$1"
    printf '%s|%s\n' "$outcome" "$1"
}

# Prints the mutant's row.
judge_mutant() {
    local killers="" blind="" start=$SECONDS gate
    while IFS= read -r gate; do
        if grep -qxF "skip|$gate" "$scratch/right"; then
            blind+="${blind:+; }$gate (skipped)"
            continue
        fi
        run_gate "$1" "$gate"
        case $outcome in
            fail) killers+="${killers:+; }$gate" ;;
            pass) blind+="${blind:+; }$gate" ;;
            *) blind+="${blind:+; }$gate ($outcome)" ;;
        esac
    done <<<"${gates[$1]}"
    printf '| %s | %s | %s | %d |\n' "$1" "${killers:-NOTHING}" "$blind" $((SECONDS - start))
}

each check_gate < <(for name in "${names[@]}"; do printf '%s\n' "${gates[$name]}"; done | sort -u)
answers >"$scratch/right"
if grep -vE '^(pass|skip)\|' "$scratch/right" >&2; then
    cp "$log" "${TMPDIR:-/tmp}/mutants.log" 2>/dev/null || true
    fail "a gate that fails without a mutant proves nothing: ${TMPDIR:-/tmp}/mutants.log"
fi

printf '| mutant | killed by | passed | seconds |\n|---|---|---|---|\n'
each judge_mutant < <(printf '%s\n' "${names[@]}")
answers
mapfile -t survivors < <(answers | sed -n 's/^| \([A-Z_]*\) | NOTHING |.*/\1/p')
if [ ${#survivors[@]} != 0 ]; then
    echo "${#survivors[@]} of ${#names[@]} survived: ${survivors[*]}"
    exit 1
fi
echo "all ${#names[@]} killed"
