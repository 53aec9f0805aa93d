#!/bin/sh
# What scripts/bundle puts where, and what it refuses: a copy in a made-up tree, with fakes of the tools that read packages and libraries.
# scripts/check-bundle tries the real archive. Usage: tests/scripts/bundle.sh, from the root of the source tree.
# shellcheck disable=SC2016 # expanded by the fakes
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tree=$work/tree system=$work/lib/a-linux-gnu
mkdir -p "$work/bin" "$work/doc" "$work/common-licenses" "$system" "$tree/scripts" "$tree/scenes" "$tree/build/release"
sed "s|/usr/share/doc|$work/doc|g; s|/usr/share/common-licenses|$work/common-licenses|g" scripts/bundle >"$tree/scripts/bundle"
touch "$tree/LICENSE" "$tree/scenes/whitted.toml" "$tree/scripts/verify-in-ci" "$work/common-licenses/GPL-3"

fake() { printf '#!/bin/sh\n%s\n' "$2" >"$1"; chmod 755 "$1"; }
# Each library is its own package.
for library in libc.so.6 libm.so.6 libfmt.so.9 libz.so.1 libLLVM-15.so.1 libdrm.so.2 libvulkan.so.1 libvulkan_lvp.so libglm-dev mesa-vulkan-drivers; do
  echo "$library" >"$system/$library"
  mkdir "$work/doc/$library"
  echo "licence of $library" >"$work/doc/$library/copyright"
done
echo '{"ICD": {"library_path": "libvulkan_lvp.so", "api_version": "1.3"}}' >"$work/lvp_icd.x.json"
fake "$tree/build/release/eyeray" 'echo eyeray 1.2.3'
fake "$tree/scripts/build" 'exit 0'
fake "$tree/scripts/setup" 'case "$*" in *--print*) printf "cmake\nlibglm-dev\n" ;; esac'
fake "$work/bin/dpkg" "case \$1 in
  -L) cat '$work/packaged' ;;
  -S) shift; for file; do echo \"\${file##*/}: \$file\"; done ;;
esac"
fake "$work/bin/dpkg-query" 'for package; do :; done; echo "$package 1.0"'
fake "$work/bin/patchelf" "echo \"\$*\" >>'$work/patched'"
fake "$work/bin/strip" 'cp "$3" "$2"'
linked() { printf '\t%s => %s (0x0)\n' "$1" "$system/$1"; }
{ linked libfmt.so.9; linked libz.so.1; linked libm.so.6; linked libc.so.6; } >"$work/eyeray.loads"
{ linked libLLVM-15.so.1; linked libz.so.1; linked libdrm.so.2; linked libc.so.6; } >"$work/libvulkan_lvp.so.loads"
fake "$work/bin/ldd" "cat '$work/'\"\${1##*/}\".loads"
printf '%s\n' "$system/libvulkan_lvp.so" "$work/lvp_icd.x.json" >"$work/packaged"

fault() { echo "$1" >&2; cat "$work/output" >&2; exit 1; }
bundle() { code=0; PATH="$work/bin:$PATH" sh "$tree/scripts/bundle" >"$work/output" 2>&1 || code=$?; }
bundle
[ "$code" = 0 ] || fault 'does not make an archive'
tar -xzf "$tree"/build/release/eyeray-1.2.3-linux-*.tar.gz -C "$work"
cd "$work/eyeray-1.2.3"
find . -type f | sort | grep -v '^./share/licences' >"$work/files"
cat >"$work/expected" <<'EXPECTED'
./README
./bin/eyeray
./bin/verify-in-ci
./lib/fallback/libdrm.so.2
./lib/fallback/libvulkan.so.1
./lib/fallback/libz.so.1
./lib/libLLVM-15.so.1
./lib/libeyeray_lvp.so
./lib/libfmt.so.9
./libexec/eyeray
./share/vulkan/icd.d/lvp_icd.json
./whitted.toml
EXPECTED
diff "$work/expected" "$work/files" >&2 || fault 'the archive has other files'
grep -q '"library_path": "../../../lib/libeyeray_lvp.so", "api_version": "1.3"' share/vulkan/icd.d/lvp_icd.json || fault 'the manifest names another driver'
[ -f "share/vulkan/icd.d/../../../lib/libeyeray_lvp.so" ] || fault 'the driver is not where its manifest is looking'
grep -qF -- "--set-rpath \$ORIGIN/../lib:$system:" "$work/patched" || fault "the machine's libraries do not come after those that are always ours"
grep -q ':$ORIGIN/../lib/fallback build' "$work/patched" || fault 'the fallback does not come last'
for package in libfmt.so.9 libz.so.1 libLLVM-15.so.1 libdrm.so.2 libvulkan.so.1 libglm-dev mesa-vulkan-drivers; do
  [ "$(cat "share/licences/$package")" = "licence of $package" ] || fault "no licence of $package"
  grep -qx "$package 1.0" share/licences/packages.txt || fault "no version of $package"
done
for licence in eyeray common-licenses/GPL-3; do [ -f "share/licences/$licence" ] || fault "no licence $licence"; done
fake libexec/eyeray 'echo "$VK_ADD_DRIVER_FILES $1 $2"'
mkdir "$work/path"
ln -s "$work/eyeray-1.2.3/bin/eyeray" "$work/path/eyeray"
[ "$(VK_ADD_DRIVER_FILES=/other.json "$work/path/eyeray" a 'b c')" = \
  "$work/eyeray-1.2.3/bin/../share/vulkan/icd.d/lvp_icd.json:/other.json a b c" ] || fault 'the start script finds no driver through a link'

refuses() {
  cd "$work"
  bundle
  [ "$code" != 0 ] || fault "makes an archive although $1"
  grep -qF "$2" "$work/output" || fault "does not say that $1"
  [ -z "$(find "$tree/build/release" -name '*.tar.gz')" ] || fault "leaves an archive although $1"
}
printf '\tlibx.so.1 => not found\n' >>"$work/eyeray.loads"
refuses 'the program lacks a library' 'build/release/eyeray lacks a library'
sed -i '$d' "$work/eyeray.loads"
rm "$work/doc/libz.so.1/copyright"
refuses 'a licence is missing' 'libz.so.1/copyright'
: >"$work/packaged"
refuses 'there is no lavapipe' 'mesa-vulkan-drivers has no lavapipe'
