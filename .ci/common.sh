# shellcheck shell=bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# What the scripts of this folder share. Sourced by them; goes to the root of the source.
set -eu -o pipefail

root=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
cd -- "$root"
unset WEFT_BUILD_DIR WEFT_LANES

heading() { printf '\n== %s (%d:%02d)\n' "$1" $((SECONDS / 60)) $((SECONDS % 60)); }

# Fails the run with what is missing when a step cannot be done.
fail() {
    printf 'ci: %s\n' "$*" >&2
    exit 1
}

install_tools() {
    local wanted=(clang clang-format-14 clang-tidy-14 oclgrind ccache shellcheck)
    local missing=() tool package sudo=()
    # libFuzzer, the plots of reports and a browser; unlike tools, libraries are not to be found by a
    # command.
    local libraries=(libclang-rt-dev python3-matplotlib chromium-driver python3-selenium)
    # A second OpenCL runtime comes from PyPI, a third with Mesa; and engines that run farms.
    libraries+=(python3-venv mesa-opencl-icd slurm-wlm munge parallel)
    for tool in "${wanted[@]}"; do
        command -v "$tool" >/dev/null || missing+=("$tool")
    done
    for package in "${libraries[@]}"; do
        dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
            missing+=("$package")
    done
    ((${#missing[@]} == 0)) && return 0
    ((EUID != 0)) && sudo=(sudo)
    "${sudo[@]}" apt-get -q update
    for package in "${missing[@]}"; do
        # Not every Debian release has every one; the steps below say what they leave out.
        if apt-cache show "$package" >/dev/null 2>&1; then
            "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
                apt-get -q install -y --no-install-recommends "$package"
        fi
    done
}

# Snakemake and Dask, in build/farm.
install_farm_engines() {
    [[ -x build/farm/bin/snakemake ]] && return 0
    python3 -m venv build/farm
    build/farm/bin/pip install --quiet --no-input snakemake dask distributed
}

# build PRESET [CMAKE_OPTION...]: everything, the tests included.
build() {
    local preset=$1 generator=()
    shift
    if [[ ! -f build/$preset/CMakeCache.txt ]] && command -v ninja >/dev/null; then
        generator=(-G Ninja)
    fi
    cmake --preset "$preset" "${generator[@]}" "$@"
    cmake --build "build/$preset" --parallel "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}"
}

# Tests that skip themselves pass; a log of a full run should show which.
list_skipped() {
    echo "skipped tests:"
    grep -ohE '^\[  SKIPPED \] [A-Za-z0-9_./]+$' "build/$1/Testing/Temporary/LastTest.log" |
        sort -u || echo "none"
}
