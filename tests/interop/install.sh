#!/usr/bin/env bash
# Installs the real peers of the interop tests from Debian's packages (and npm, where a part needs
# it). Each part is a script of its own beside its tests.
set -euo pipefail
cd "$(dirname "$0")"

export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
apt-get -o DPkg::Lock::Timeout=300 install -y -qq --no-install-recommends netcat-openbsd gcc gcc-multilib zsh fish >/dev/null
for part in */install.sh; do
    if [ -x "$part" ]; then "$part"; fi
done
