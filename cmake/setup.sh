# Sourced by ./run and ./test (bash): what the machine lacks, and the build. Everything it says goes to stderr, so that
# stdout belongs to the program. DIPTYCH_NO_INSTALL=1 turns installing off; something missing is then an error. CXX names the
# compiler, by default Debian's c++: CXX=clang++ ./test.

diptych_root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
diptych_build="$diptych_root/build/release"

say() { printf 'diptych: %s\n' "$*" >&2; }
die() { say "$@"; exit 2; }

# apt-get as root, directly or by sudo; its output only where it fails.
apt_get() {
    local -a as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || die "installing needs root or sudo; as root: apt-get $*"
        as_root=(sudo)
    fi
    local log status=0
    log="$(mktemp)"
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0 "$@" >"$log" 2>&1 || status=$?
    [ "$status" -eq 0 ] || cat "$log" >&2
    rm -f "$log"
    return "$status"
}

has_package() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# The package of the compiler $1. Debian names such a package after its command, but clang++ is part of clang.
compiler_package() {
    local command
    command="$(basename "$1")"
    case "$command" in
        c++) echo g++ ;;
        clang++*) echo "clang${command#clang++}" ;;
        *) echo "$command" ;;
    esac
}

# missing_packages: the packages of the build that are absent, one a line. A tool counts as present by its command,
# wherever it came from; a library by its package.
missing_packages() {
    local entry
    for entry in cmake:cmake ninja:ninja-build glslangValidator:glslang-tools spirv-val:spirv-tools; do
        command -v "${entry%%:*}" >/dev/null || echo "${entry##*:}"
    done
    command -v "${CXX:-c++}" >/dev/null || compiler_package "${CXX:-c++}"
    for entry in libembree-dev libtbb-dev libglm-dev libtinygltf-dev nlohmann-json3-dev libopenimageio-dev zlib1g-dev \
        libcli11-dev libfmt-dev libspdlog-dev libvulkan-dev libvulkan1 libglfw3-dev libimgui-dev fonts-roboto-unhinted catch2 \
        pybind11-dev python3-dev libopenmpi-dev openmpi-bin; do
        has_package "$entry" || echo "$entry"
    done
}

# install_missing WHY PACKAGE...
install_missing() {
    local why="$1"
    shift
    [ "$#" -gt 0 ] || return 0
    [ "${DIPTYCH_NO_INSTALL:-0}" != 1 ] || die "missing $why: $* (DIPTYCH_NO_INSTALL=1 forbids installing them)"
    say "installing Debian packages $why: $*"
    apt_get update || die "apt-get update failed"
    apt_get install --no-install-recommends "$@" || die "could not install: $*"
}

# Prints a deb822 source of suite $2: the machine's own source of suite $1, with only suite and components replaced, so
# mirror, keys and options stay.
source_of_suite() {
    local suite="$1" other="$2" uri
    uri="$(apt-get indextargets 'Created-By: Packages' 'Origin: Debian' "Release: $suite" 'Component: main' \
        --format '$(REPO_URI)' | head -n 1)"
    uri="${uri%/}"
    [ -n "$uri" ] || return 1
    { cat /etc/apt/sources.list.d/*.sources 2>/dev/null || true; } | awk -v RS= -v suite="$suite" -v other="$other" -v uri="$uri" '
        index($0, uri) && !/\nEnabled: *no/ && $0 ~ "(^|\n)Suites:[^\n]*[ \t]" suite "([ \t\n]|$)" {
            lines = split($0, line, "\n")
            for (i = 1; i <= lines; ++i) {
                if (line[i] !~ /^[ \t]/) replaced = line[i] ~ /^(Suites|Components|Types):/
                if (!replaced && line[i] !~ /^#/) print line[i]
            }
            print "Types: deb\nSuites: " other "\nComponents: main"
            found = 1
            exit
        }
        END { exit !found }' && return 0
    { cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null || true; } | awk -v suite="$suite" -v other="$other" -v uri="$uri" '
        $1 == "deb" && index($0, uri) && $0 ~ "[ \t]" suite "[ \t]" {
            print "Types: deb\nURIs: " uri "\nSuites: " other "\nComponents: main"
            if (match($0, /\[[^]]*\]/)) {
                options = split(substr($0, RSTART + 1, RLENGTH - 2), option, " ")
                for (i = 1; i <= options; ++i) {
                    sub(/^arch=/, "Architectures=", option[i])
                    sub(/=/, ": ", option[i])
                    gsub(/,/, " ", option[i])
                    print option[i]
                }
            }
            found = 1
            exit
        }
        END { exit !found }'
}

# Lavapipe, Mesa's Vulkan device on the CPU, has ray tracing from 24.3 on.
mesa_suffices() { dpkg --compare-versions "${1:-0}" ge 24.3; }
mesa_installed() { has_package mesa-vulkan-drivers && dpkg-query -W -f '${Version}' mesa-vulkan-drivers; }
mesa_candidate() { LC_ALL=C apt-cache policy mesa-vulkan-drivers | awk '$1 == "Candidate:" { print $2 }'; }

has_ray_tracing_device() {
    [ -z "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] || return 0
    local folder
    for folder in /usr/share /etc; do
        if [ -e /dev/nvidiactl ] && compgen -G "$folder/vulkan/icd.d/nvidia*.json" >/dev/null; then return 0; fi
    done
    mesa_suffices "$(mesa_installed)"
}

ensure_vulkan_device() {
    if has_ray_tracing_device; then return 0; fi
    if [ "${DIPTYCH_NO_INSTALL:-0}" = 1 ]; then
        say "no Vulkan device with ray tracing; Mesa 24.3 or later is one (DIPTYCH_NO_INSTALL=1 forbids installing it)"
        return 0
    fi
    local suite
    suite="$(. /etc/os-release && echo "${VERSION_CODENAME:-}")"
    case "$(mesa_candidate)" in "" | "(none)") apt_get update || true ;; esac
    if mesa_suffices "$(mesa_candidate)"; then
        install_missing "for a Vulkan device with ray tracing on the CPU" mesa-vulkan-drivers
    elif [ "$suite" = bookworm ]; then
        install_mesa_from_backports "$suite" ||
            say "no Vulkan device with ray tracing: Mesa could not be installed from $suite-backports"
    else
        say "no Vulkan device with ray tracing: this system's Mesa is older than 24.3"
    fi
}

install_mesa_from_backports() {
    local suite="$1" file=/etc/apt/sources.list.d/diptych-backports.sources text
    local -a as_root=()
    [ "$(id -u)" -eq 0 ] || as_root=(sudo)
    if [ -z "$(apt-get indextargets "Release: $suite-backports" --format '$(REPO_URI)')" ]; then
        text="$(source_of_suite "$suite" "$suite-backports")" || return 1
        say "adding $file: Debian 12's own Mesa has no ray tracing on the CPU, its backports do"
        text="# Added by Diptych, for Mesa with ray tracing on the CPU."$'\n'"$text"
        printf '%s\n' "$text" | "${as_root[@]}" tee "$file" >/dev/null || return 1
        apt_get update || return 1
    fi
    # The EGL and GLX halves keep Mesa of one version, or Debian's own could no longer be installed beside it.
    say "installing from $suite-backports for a Vulkan device with ray tracing on the CPU: mesa-vulkan-drivers, libegl-mesa0," \
        "libglx-mesa0"
    apt_get install --no-install-recommends -t "$suite-backports" mesa-vulkan-drivers libegl-mesa0 libglx-mesa0
}

# diptych_setup [EXTRA_PACKAGE...]: everything the build and a render need.
diptych_setup() {
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        say "not a Debian system: trusting that what README.md names is installed"
        return 0
    fi
    local -a missing
    local extra
    mapfile -t missing < <(missing_packages)
    for extra in "$@"; do
        has_package "$extra" || missing+=("$extra")
    done
    install_missing "that Diptych is built from and tested with" "${missing[@]}"
    ensure_vulkan_device
}

# Whether the release tree is configured for the compiler that CXX names.
is_configured() {
    local compiler
    [ -e "$diptych_build/build.ninja" ] || return 1
    [ -n "${CXX:-}" ] || return 0
    compiler="$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$diptych_build/CMakeCache.txt")"
    [ "$(basename "$compiler")" = "$(basename "$CXX")" ]
}

# diptych_compile [TARGET]: configures and builds the release tree; quiet where there is little to do.
diptych_compile() {
    local -a quiet=(--quiet)
    [ -x "$diptych_build/diptych" ] || quiet=()
    local log="$diptych_build/configure.log"
    mkdir -p "$diptych_build"
    if ! is_configured; then
        say "configuring build/release${CXX:+ for $CXX}"
        (cd "$diptych_root" && cmake --preset release --fresh) >"$log" 2>&1 || { cat "$log" >&2; die "configuring failed"; }
    fi
    [ "${#quiet[@]}" -gt 0 ] || say "building build/release; a few minutes the first time"
    cmake --build "$diptych_build" --target "${1:-all}" -- "${quiet[@]}" >&2 || die "the build failed"
}
