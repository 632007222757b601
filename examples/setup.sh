# Sourced by examples/run and tests/run from the top of the tree. It defines
#
#     set_up EXTRAS      the package in .venv, built anew only where a source has changed; EXTRAS may be ""
#     environment        .venv without it, and first in the PATH
#
# and what that takes: compiler, Python's headers and LAPACK by apt-get, the rest by pip.

say() { printf 'gapbeam: %s\n' "$*"; }
fail() { say "$@" >&2; exit 1; }

# A virtual environment works in one place and with one interpreter only.
location() {
    pwd -P
    readlink -f .venv/bin/python || true
}

# What the installed package was made from.
fingerprint() {
    location
    find meson.build meson.options pyproject.toml fortran python examples/setup.sh \
        -name __pycache__ -prune -o -type f -exec cksum {} + | LC_ALL=C sort
}

has_python() { "$base_python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; }
has_venv() { "$base_python" -c 'import ensurepip, venv' 2>/dev/null; }
has_headers() {
    "$base_python" -c 'import os, sys, sysconfig
sys.exit(not os.path.exists(os.path.join(sysconfig.get_config_var("INCLUDEPY"), "Python.h")))' 2>/dev/null
}
has_fortran() { command -v gfortran >/dev/null; }
has_c() { command -v cc >/dev/null && echo '#include <math.h>' | cc -E - >/dev/null 2>&1; }
has_lapack() { command -v pkg-config >/dev/null && pkg-config --exists lapack; }

# Debian's names of what is missing and cannot be done without.
missing_packages() {
    has_venv || printf ' python3-venv'
    has_headers || printf ' python3-dev'
    has_fortran || printf ' gfortran'
    has_c || printf ' gcc libc6-dev'
}

as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo -n "$@"; fi; }
may_install() { command -v apt-get >/dev/null && as_root true 2>/dev/null; }
apt_install() {
    say "installing by apt-get: $*"
    as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get -qq -y --no-install-recommends install "$@" >/dev/null
}

system_packages() {
    has_python || fail "Python 3.11 or later is needed, and $base_python is none (PYTHON=NAME takes another)."
    missing=$(missing_packages)
    if [ -z "$missing" ] && has_lapack; then return; fi

    if may_install; then
        as_root apt-get -qq update || say "the lists of packages could not be renewed; those there are may do"
        # shellcheck disable=SC2086  # a list of words
        [ -z "$missing" ] || apt_install $missing || fail "apt-get could not install$missing."
        has_lapack || apt_install liblapack-dev pkg-config || true
        missing=$(missing_packages)
        [ -z "$missing" ] || fail "$base_python still lacks$missing; is it not the system's? PYTHON=/usr/bin/python3 takes that one."
    fi
    [ -z "$missing" ] || fail "please run 'apt-get install$missing', or what does the same on this system, and then this again."
    has_lapack || say "no LAPACK on this system: taking the one of scipy-openblas32"
}

make_environment() {
    [ ! -e .venv ] || [ -f .venv/gapbeam ] || fail "there is a .venv already that this script did not make: please move it."
    system_packages
    say "making the environment .venv"
    rm -rf .venv
    mkdir .venv
    : >.venv/gapbeam
    "$base_python" -m venv .venv
    location >.venv/gapbeam
}

# Options go to pip.
install_build_tools() {
    python -c 'import tomllib
print(*tomllib.load(open("pyproject.toml", "rb"))["build-system"]["requires"], sep="\n")' >.venv/build-tools
    pip install -q "$@" -r .venv/build-tools || return
    python -c 'import mesonpy
print(*mesonpy.get_requires_for_build_wheel(), sep="\n")' >.venv/build-tools
    pip install -q "$@" -r .venv/build-tools
}

install_package() {
    # The build tools stay in .venv, so that a later build goes on where the last one stopped.
    install_build_tools || return
    pip install -q --no-build-isolation --config-settings=build-dir=.venv/build/package ".${1:+[$1]}"
}

# Tells every ten seconds how far the build is.
tell_progress() {
    while sleep 10 >/dev/null 2>&1; do
        say "... $(find .venv/build/package -name '*.o' 2>/dev/null | wc -l) files compiled"
    done
}

environment() {
    base_python=${PYTHON:-python3}
    if [ ! -d .venv ] || ! location | cmp -s - .venv/gapbeam; then make_environment; fi
    PATH=$PWD/.venv/bin:$PATH
    export PATH PIP_DISABLE_PIP_VERSION_CHECK=1
}

set_up() {
    extras=$1
    environment
    if fingerprint | cmp -s - ".venv/installed-$extras"; then return; fi
    say "building and installing the package${extras:+ with what its extra $extras takes}, some two minutes on two cores"
    tell_progress &
    progress=$!
    install_package "$extras" || { kill "$progress"; fail "it could not be built: the reason stands above."; }
    kill "$progress"
    fingerprint >.venv/installed-
    fingerprint >".venv/installed-$extras"
}
