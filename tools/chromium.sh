#!/usr/bin/env bash
# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

# Sees to it that tests/browser has a Chromium to run in: there already, installed by apt where that may be, or asked for.
set -euo pipefail

for name in "${CHROMIUM:-}" chromium chromium-browser google-chrome; do
    if [ -n "$name" ] && command -v "$name" >/dev/null; then exit 0; fi
done
if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
    echo "chromium: installing it by apt"
    apt-get update -qq
    # The fonts are for the digits and Greek letters of the page.
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends chromium fonts-dejavu-core >/dev/null
    exit 0
fi
echo "chromium: error: none found, and tests/browser need one (Debian: apt-get install chromium; Ubuntu: snap install" \
    "chromium), or name it: make test CHROMIUM=/path/to/chromium" >&2
exit 1
