#!/usr/bin/env bash
# The packages as a user meets them: installed by apt in a bare Debian 12, tried there by their own
# tests (debian/tests) as a user without rights, looked at for what hardens them, and compared with a
# second build. For root: ./dev package-test.
#
#   scripts/package-test.sh PACKAGES AGAIN [SAMPLES]   two folders of .deb; landings of the study (512)
set -euo pipefail
cd "$(dirname "$0")/.."
packages=$(realpath "$1")
again=$(realpath "$2")
samples=${3:-512}
[ "$(id -u)" -eq 0 ] || { echo "package-test: needs root (debootstrap, chroot)" >&2; exit 1; }

step() { printf '%4d s  %s\n' $SECONDS "$*"; }

step "two builds in two folders, the same bits"
for deb in "$packages"/*.deb; do
    cmp "$deb" "$again/${deb##*/}" || { echo "package-test: the build is not reproducible" >&2; exit 1; }
done

step "a bare Debian"
root=$(mktemp -d "${TMPDIR:-/tmp}/bolter-package-XXXXXX")
close() {
    ! mountpoint -q "$root/proc" || umount "$root/proc"
    rm -rf --one-file-system "$root"
}
trap close EXIT
debootstrap --variant=minbase bookworm "$root" "${MIRROR:-http://deb.debian.org/debian}" >"$packages/debootstrap.log" 2>&1 ||
    { tail -n 5 "$packages/debootstrap.log" >&2; exit 1; }
cp -r /etc/apt/sources.list* /etc/apt/apt.conf.d "$root/etc/apt/"
mount -t proc proc "$root/proc"
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages"
cp -r debian/tests "$root/packages/tests"
inside() { # inside USER COMMANDS
    env -i HOME=/home/user PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        AUTOPKGTEST_TMP=/home/user SAMPLES="$samples" \
        chroot --userspec="$1" "$root" bash -euc "cd /home/user; $2"
}
mkdir -p "$root/home"
chroot "$root" useradd --create-home user

step "apt install ./bolter_*.deb ./libbolter0_*.deb ./python3-bolter_*.deb"
inside root 'cd /packages
    { apt-get -qq update && apt-get -qq install -y ./bolter_*.deb ./libbolter0_*.deb ./python3-bolter_*.deb; } \
        >/packages/apt.log 2>&1 || { tail -n 20 /packages/apt.log; exit 1; }'

step "bolter study --example reference, $samples landings"
inside user 'bolter study --example reference --set campaign.samples=$SAMPLES | tail -n 3
    test -s reference/reliability.json -a -s reference/report.html
    man -w bolter-study >/dev/null 2>&1 || test -s /usr/share/man/man5/bolter-study.5.gz'

step "python3 -m bolter.examples.openturns_form"
inside user 'python3 -m bolter.examples.openturns_form'

step "debian/tests with libbolter-dev, bolter-doc, gcc"
inside root 'cd /packages
    apt-get -qq install -y --no-install-recommends ./libbolter-dev_*.deb ./bolter-doc_*.deb gcc libc6-dev pkg-config \
        >/packages/apt.log 2>&1 || { tail -n 20 /packages/apt.log; exit 1; }'
for test in reference client python; do
    inside user "sh /packages/tests/$test" >"$packages/$test.log" 2>&1 ||
        { tail -n 20 "$packages/$test.log" >&2; echo "package-test: debian/tests/$test failed" >&2; exit 1; }
done

step "hardening of what is installed"
scripts/lint-hardening.sh "$root"/usr/bin/bolter "$root"/usr/lib/*/libbolter.so.0

step "nothing is left when they are purged"
inside root 'apt-get -qq purge -y bolter libbolter0 python3-bolter libbolter-dev bolter-doc >/packages/apt.log 2>&1
    left=$(find /usr /etc /var/lib -path /var/lib/apt -prune -o -path /var/lib/dpkg -prune -o -name "*bolter*" -print)
    [ -z "$left" ] || { echo "left behind: $left"; exit 1; }'
step "done"
