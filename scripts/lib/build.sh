# SPDX-License-Identifier: Apache-2.0
# Builds a preset. To be sourced, in the repository's root.

# build PRESET TARGET...
build() {
  echo "== build: $1"
  cmake --preset "$1" --log-level=WARNING >/dev/null
  cmake --build --preset "$1" --target "${@:2}"
}
