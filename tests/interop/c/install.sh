#!/usr/bin/env bash
# Installs the compilers that units in C are compared with: gcc for 32 bits, clang and lld of Debian.
set -euo pipefail

export DEBIAN_FRONTEND=noninteractive
apt-get -o DPkg::Lock::Timeout=300 install -y -qq --no-install-recommends \
  gcc gcc-multilib clang lld >/dev/null
