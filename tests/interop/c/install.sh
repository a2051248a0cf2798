#!/usr/bin/env bash
# Installs the compilers that units in C are compared with: gcc for 32 bits, clang and lld of Debian.
set -euo pipefail
. "$(dirname "$0")/../downloads.sh"

export DEBIAN_FRONTEND=noninteractive
apt_install gcc gcc-multilib clang lld
