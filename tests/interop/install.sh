#!/usr/bin/env bash
# Installs the real peers of the interop tests from Debian's packages (and npm, where a part needs
# it). Each part is a script of its own beside its tests.
set -euo pipefail
cd "$(dirname "$0")"
. ./downloads.sh

export DEBIAN_FRONTEND=noninteractive
try apt-get -o Acquire::Retries=3 update -qq
apt_install netcat-openbsd gcc gcc-multilib zsh fish
for part in */install.sh; do
    if [ -x "$part" ]; then "$part"; fi
done
