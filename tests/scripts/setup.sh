#!/bin/sh
# scripts/setup, scripts/build and scripts/bare-debian on made-up machines: copies in a folder, in which apt-get, dpkg-query, sudo and os-release are fakes that write down how
# they are called. Usage: tests/scripts/setup.sh, from the root of the source tree.
# shellcheck disable=SC2016 # expanded by the fakes
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/tree/scripts" "$work/tree/cmake" "$work/tree/tests/cli/page" "$work/tools"
sed "s|/etc/os-release|$work/os-release|g; s|/usr/sbin/policy-rc.d|$work/policy-rc.d|g" scripts/setup >"$work/tree/scripts/setup"
cp scripts/build scripts/bare-debian "$work/tree/scripts"
chmod 755 "$work/tree/scripts"/*
cp cmake/dependencies.cmake "$work/tree/cmake"
cp tests/CMakeLists.txt "$work/tree/tests"
for tool in sh sed head tail awk cp chmod grep tr env mktemp mkdir touch rm cat uname dirname find install sort; do ln -s "$(command -v "$tool")" "$work/tools/$tool"; done

fake() { printf '#!/bin/sh\n%s\n' "$2" >"$work/bin/$1"; chmod 755 "$work/bin/$1"; }
# machine NAME CODENAME: a new one, whose user is root.
machine() {
  name=$1
  rm -rf "${work:?}/bin" "$work/calls" "$work/installed" "$work/policy-rc.d"
  mkdir "$work/bin"
  touch "$work/calls" "$work/installed"
  printf 'PRETTY_NAME="%s"\n%s\n' "$name" "${2:+VERSION_CODENAME=$2}" >"$work/os-release"
  fake id 'echo 0'
  fake dpkg-query "sed 's/\$/ installed/' '$work/installed'"
  # Debian's own refuses to work for others than dpkg.
  fake deb-systemd-helper "[ -n \"\${DPKG_MAINTSCRIPT_PACKAGE-}\" ] || exit 1; echo \"deb-systemd-helper \$*\" >>'$work/calls'"
  fake update-rc.d "echo \"update-rc.d \$*\" >>'$work/calls'"
  for tool in npm true; do fake "$tool" 'exit 0'; done
  apt_get ''
}
# apt_get CASES: an apt-get that does what CASES of a shell's `case` say, and else what it would do.
apt_get() {
  fake apt-get "
    case \" \$* \" in
      $1
    esac
    case \" \$* \" in
      *' --assume-no '*) printf 'Need to get 99.7 MB of archives.\nAfter this operation, 401 MB of additional disk space will be used.\n' ;;
      *' --simulate '* | *' --download-only '* | *' update '*) ;;
      *)
        echo \"installs \$*, policy: \$(cat '$work/policy-rc.d' 2>&1)\" >>'$work/calls'
        for word; do case \$word in -* | install) ;; *) echo \"\$word\" >>'$work/installed' ;; esac; done
        ;;
    esac"
}

faults=0
fault() { faults=$((faults + 1)); printf '%s: %s\n%s\n' "$name" "$1" "$(cat "$work/output" "$work/calls")" >&2; }
# run CODE SCRIPT [ARGUMENT...]: runs a script, which has to end with CODE.
run() {
  expected=$1 script=$2 code=0
  shift 2
  PATH="$work/bin:$work/tools" sh "$work/tree/scripts/$script" "$@" >"$work/output" 2>&1 || code=$?
  [ "$code" = "$expected" ] || fault "exit code $code, not $expected"
}
setup() { expected=$1; shift; run "$expected" setup "$@"; }
says() { grep -qF -- "$1" "$work/output" || fault "does not say: $1"; }
calls() { grep -qF -- "$1" "$work/calls" || fault "does not call: $1"; }
never() { ! grep -qF -- "$1" "$work/calls" || fault "calls: $1"; }
installs_nothing() { never installs; [ ! -e "$work/policy-rc.d" ] || fault 'leaves a policy-rc.d'; }

# The first step installs what renders, and nothing the second time.
for system in bookworm trixie noble; do
  machine "Some $system" "$system"
  setup 0
  says 'libfmt-dev'
  says '(99.7 MB to download, 401 MB on the disk)'
  calls 'exit 101'
  for package in cmake glslang-dev glslang-tools libembree-dev libstb-dev libtinyobjloader-dev zlib1g-dev; do calls " $package "; done
  for package in doctest-dev pybind11-dev slurmd gdb zsh clang; do never " $package "; done
  [ ! -e "$work/policy-rc.d" ] || fault 'leaves its policy-rc.d'
  : >"$work/calls"
  setup 0
  [ -z "$(cat "$work/calls" "$work/output")" ] || fault 'does something the second time'
done

machine 'tests' trixie
setup 0 test
for package in doctest-dev librapidcheck-dev pybind11-dev slurmd zsh; do calls " $package "; done
for service in munge slurmctld slurmd; do
  calls "deb-systemd-helper disable $service.service"
  calls "update-rc.d $service disable"
done
never ' chromium '
setup 0 ci
calls ' chromium '
calls ' shellcheck '

machine 'the archive' bookworm
setup 0 bundle
calls ' patchelf'
never ' doctest-dev '

machine 'Ubuntu has no package of Chromium' noble
setup 0 ci
calls ' shellcheck '
never ' chromium'

machine 'services that were there' bookworm
echo slurmd >"$work/installed"
setup 0 test
never 'disable slurmd.service'
calls 'disable munge.service'

machine 'a policy that was there' bookworm
echo mine >"$work/policy-rc.d"
setup 0
calls 'policy: mine'
[ "$(cat "$work/policy-rc.d")" = mine ] || fault 'changes a policy-rc.d that is not its own'

machine 'ended while it installs' bookworm
apt_get '*" -y install "*) kill -TERM "$PPID" ;;'
setup 130
[ ! -e "$work/policy-rc.d" ] || fault 'leaves its policy-rc.d'

machine 'apt-get breaks off' bookworm
apt_get '*" -y install "*) echo "E: the disk is full"; exit 100 ;;'
setup 1
says 'E: the disk is full'
[ ! -e "$work/policy-rc.d" ] || fault 'leaves its policy-rc.d'

machine 'no network, no lists' bookworm
apt_get '*" update "*) exit 100 ;; *" --simulate "*) echo "E: Unable to locate package cmake"; exit 100 ;;'
setup 1
says 'Is there a network? Nothing is installed.'
[ "$(wc -l <"$work/output")" = 1 ] || fault 'says more than a sentence'
installs_nothing

machine 'no network, but lists' bookworm
apt_get '*" update "*) exit 100 ;; *" --download-only "*) printf "E: cannot fetch %s\n" 1 2 3; exit 100 ;;'
setup 1
says 'cannot download the packages: cannot fetch 1. Is there a network? Nothing is installed.'
[ "$(wc -l <"$work/output")" = 2 ] || fault 'says more than what it wants and why not'
installs_nothing

machine 'a source that is out of reach, but none that is needed' bookworm
apt_get '*" update "*) exit 100 ;;'
setup 0
calls ' cmake '

machine 'unknown packages' trixie
apt_get '*" --simulate "*) printf "E: Unable to locate package libstb-dev\nE: Package '"'draco'"' has no installation candidate\n"; exit 100 ;;'
setup 1
says 'knows no package libstb-dev draco.'
installs_nothing

machine 'another fault of apt-get' trixie
apt_get '*" --simulate "*) echo "E: dpkg was interrupted"; exit 100 ;;'
setup 1
says 'E: dpkg was interrupted'
installs_nothing

machine 'neither root nor sudo' bookworm
fake id 'echo 1000'
setup 1 test
says 'apt-get update && apt-get install --no-install-recommends cmake ninja-build'
says ' doctest-dev '
installs_nothing
fake sudo 'exit 1'
setup 1
says 'apt-get update && apt-get install'
installs_nothing
fake sudo 'echo "sudo $*" >>"'"$work"'/calls"; exec "$@"'
setup 0
for command in 'env LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get' 'install -m 755' 'rm -f'; do calls "sudo $command"; done
calls ' cmake '

# Systems without a list of packages.
for system in fedora '' sid; do
  machine "System $system" "$system"
  setup 1
  says "$name is not Debian 12, Debian 13 or Ubuntu 24.04"
  says 'cmake ninja-build g++ pkg-config; docs/install.md'
  for tool in cmake ninja c++; do fake "$tool" 'exit 0'; done
  setup 1
  says 'calls pkg-config;'
  fake pkg-config 'exit 0'
  setup 0 test
  [ ! -s "$work/output" ] || fault 'says something although it has all tools'
  installs_nothing
done
machine 'no os-release' ''
rm "$work/os-release"
setup 1
says "$(uname -s) is not"

machine 'bad usage' bookworm
setup 2 all
setup 2 render --verbose
says 'usage: scripts/setup [render | test | ci | bundle] [--print]'
setup 0 render --print
says glslang-tools
installs_nothing

machine 'first the program, then the tests' bookworm
fake cmake 'echo "cmake $*" >>"'"$work"'/calls"
  touch build/release/build.ninja
  case "$*" in *EYERAY_TESTS=ON*) touch build/release/CTestTestfile.cmake ;; esac'
fake ninja "echo \"ninja \$*\" >>'$work/calls'"
mkdir -p "$work/tree/build/release"
run 0 build release eyeray
calls 'cmake --preset release -D EYERAY_TESTS=OFF -D EYERAY_PYTHON=OFF'
calls 'ninja --quiet -C build/release eyeray'
never ' doctest-dev '
: >"$work/calls"
run 0 build release eyeray
never cmake
run 0 build release
calls 'cmake --preset release -D EYERAY_TESTS=ON -D EYERAY_PYTHON=ON'
calls ' doctest-dev '
: >"$work/calls"
run 0 build release eyeray
run 0 build release
run 0 build release test_core
never cmake
calls 'ninja --quiet -C build/release test_core'

machine 'a bare Debian' bookworm
apt_get '*" indextargets "*) printf "Other main trixie http://other\nDebian main trixie-security http://security\nDebian main bookworm http://mirror\n"; exit ;;'
fake apt-config 'case $1 in shell) echo "http_proxy=http://proxy" ;; esac'
fake debootstrap 'echo "$http_proxy $*" >>"'"$work"'/calls"; mkdir -p "$5/etc/apt/apt.conf.d" "$5/usr/sbin"'
run 2 bare-debian trixie
says 'usage: scripts/bare-debian'
run 0 bare-debian trixie "$work/root"
calls "http://proxy --variant=minbase --force-check-gpg --include=ca-certificates trixie $work/root http://mirror"
[ -x "$work/root/usr/sbin/policy-rc.d" ] || fault 'services may start'
fake debootstrap 'echo "no such mirror"; exit 1'
EYERAY_MIRROR=http://mine run 4 bare-debian trixie "$work/other"
says 'cannot make a Debian trixie of http://mine: no such mirror'
apt_get '*" indextargets "*) exit ;;'
run 4 bare-debian trixie "$work/other"
says 'EYERAY_MIRROR='
fake id 'echo 1000'
run 1 bare-debian trixie "$work/other"
says 'an administrator runs'

[ "$faults" = 0 ] || { echo "$faults faults" >&2; exit 1; }
