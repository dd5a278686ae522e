#!/usr/bin/env bash
# Tries the project on a Debian with nothing installed: a debootstrap chroot that gets a copy of the working tree
# (tracked and untracked files, no build output) and runs a command in it. Needs root, debootstrap and a network.
#   tests/scripts/fresh-debian.sh [--suite bookworm] [--keep FOLDER] [COMMAND...]      default command: ./test
# --keep makes or reuses FOLDER as the chroot and leaves it there. Mirror, certificate authorities and apt's settings (proxy,
# checks) are the machine's own. Files the command writes under out/ in the copy lie in FOLDER/root/diptych/out.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
suite=bookworm
keep=
while [ "$#" -gt 0 ]; do
    case "$1" in
        --suite) suite="$2"; shift 2 ;;
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

if [ ! -e "$chroot_dir/etc/debian_version" ]; then
    mirror="$(apt-get indextargets 'Created-By: Packages' 'Origin: Debian' 'Component: main' --format '$(REPO_URI)' |
        grep -v security | head -n 1)"
    debootstrap --variant=minbase "$suite" "$chroot_dir" "${mirror:?no Debian mirror among the apt sources}"
fi
cp -L /etc/resolv.conf /etc/hosts "$chroot_dir/etc/"
grep -lsE '^ *Acquire::' /etc/apt/apt.conf.d/* /etc/apt/apt.conf 2>/dev/null |
    while read -r file; do cp "$file" "$chroot_dir/etc/apt/apt.conf.d/"; done || true
# Local certificate authorities: Debian's ca-certificates takes them up when it is installed.
mkdir -p "$chroot_dir/usr/local/share/ca-certificates" "$chroot_dir/root/diptych"
find /usr/local/share/ca-certificates -name '*.crt' -exec cp -t "$chroot_dir/usr/local/share/ca-certificates" {} + || true
git -C "$root" ls-files -z --cached --others --exclude-standard |
    (cd "$root" && while IFS= read -r -d '' file; do [ ! -e "$file" ] || printf '%s\0' "$file"; done) |
    tar -C "$root" --null --files-from=- -c | tar -C "$chroot_dir/root/diptych" -x
mountpoint -q "$chroot_dir/proc" || mount -t proc proc "$chroot_dir/proc"
mountpoint -q "$chroot_dir/dev" || mount --bind /dev "$chroot_dir/dev"

chroot "$chroot_dir" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM="${TERM:-dumb}" \
    bash -c 'cd /root/diptych && exec "$@"' bash "$@"
