#!/usr/bin/env bash
# Tries the project on a Debian or Ubuntu with nothing installed: a debootstrap chroot that gets a copy of the working tree
# (tracked and untracked files, no build output) and runs a command in it. Needs root, debootstrap and a network.
#   tests/scripts/fresh-debian.sh [--suite bookworm] [--mirror URI] [--keep FOLDER] [COMMAND...]     default command: ./test
# The command starts with an empty environment. With another compiler: fresh-debian.sh --suite trixie env CXX=clang++ ./test.
# Suites: bookworm, trixie; noble, which needs an Ubuntu mirror and the package ubuntu-keyring. --keep makes or reuses FOLDER as
# the chroot and leaves it there. Certificate authorities, apt's settings (proxy, checks) and, without --mirror, the mirror are
# the machine's own. Files the command writes under out/ in the copy lie in FOLDER/root/diptych/out.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
suite=bookworm
mirror=
keep=
while [ "$#" -gt 0 ]; do
    case "$1" in
        --suite) suite="$2"; shift 2 ;;
        --mirror) mirror="$2"; shift 2 ;;
        --keep) keep="$2"; shift 2 ;;
        *) break ;;
    esac
done
[ "$#" -gt 0 ] || set -- ./test
[ "$(id -u)" -eq 0 ] || { echo "fresh-debian: needs root" >&2; exit 2; }

chroot_dir="${keep:-$(mktemp -d)}"
unmount() {
    local folder
    for folder in dev proc; do
        if mountpoint -q "$chroot_dir/$folder"; then umount -l "$chroot_dir/$folder"; fi
    done
    # Never removes a tree in which something is still mounted.
    if [ -z "$keep" ] && ! grep -q " $chroot_dir/" /proc/mounts; then rm -rf --one-file-system "$chroot_dir"; fi
}
trap unmount EXIT

origin=Debian
components=main
script=()
case "$suite" in noble | plucky | questing)
    origin=Ubuntu
    components=main,universe
    script=(gutsy)  # all of Ubuntu's suites share it, and an older debootstrap lacks the newer names
    ;;
esac
if [ ! -e "$chroot_dir/etc/debian_version" ]; then
    : "${mirror:=$(apt-get indextargets 'Created-By: Packages' "Origin: $origin" 'Component: main' --format '$(REPO_URI)' |
        grep -v security | head -n 1)}"
    [ -n "$mirror" ] || { echo "fresh-debian: no mirror of $origin among the apt sources: give --mirror URI" >&2; exit 2; }
    debootstrap --variant=minbase --components="$components" "$suite" "$chroot_dir" "$mirror" "${script[@]}"
    if [ "$origin" = Ubuntu ]; then  # as every installed Ubuntu has it, and where its newer Mesa is
        echo "deb $mirror $suite-updates ${components//,/ }" >>"$chroot_dir/etc/apt/sources.list"
    fi
fi
cp -L /etc/resolv.conf /etc/hosts "$chroot_dir/etc/"
grep -lsE '^ *Acquire::' /etc/apt/apt.conf.d/* /etc/apt/apt.conf 2>/dev/null |
    while read -r file; do cp "$file" "$chroot_dir/etc/apt/apt.conf.d/"; done || true
# Local certificate authorities: Debian's ca-certificates takes them up when it is installed.
mkdir -p "$chroot_dir/usr/local/share/ca-certificates" "$chroot_dir/root/diptych"
find /usr/local/share/ca-certificates -name '*.crt' -exec cp -t "$chroot_dir/usr/local/share/ca-certificates" {} + || true
# Sources that a reused chroot has and the working tree no longer has would be built too.
find "$chroot_dir/root/diptych" -mindepth 1 -maxdepth 1 ! -name build ! -name out -exec rm -rf {} +
git -C "$root" ls-files -z --cached --others --exclude-standard |
    (cd "$root" && while IFS= read -r -d '' file; do [ ! -e "$file" ] || printf '%s\0' "$file"; done) |
    tar -C "$root" --null --files-from=- -c | tar -C "$chroot_dir/root/diptych" -x
mountpoint -q "$chroot_dir/proc" || mount -t proc proc "$chroot_dir/proc"
mountpoint -q "$chroot_dir/dev" || mount --bind /dev "$chroot_dir/dev"

chroot "$chroot_dir" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM="${TERM:-dumb}" \
    bash -c 'cd /root/diptych && exec "$@"' bash "$@"
