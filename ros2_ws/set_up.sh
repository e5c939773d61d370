#!/bin/sh
# Finds a Python of 3.11 to 3.14 and runs the set-up with it. PYTHON names one; else the one that the
# environment was made with, python3, python3.14 … python3.11. An argument names a package that is built on first use.
workspace=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P) || exit 1
unset PYTHONHOME PYTHONSAFEPATH
export _ROS_WHEELS_BOOTSTRAP_COMPLETE=1

is_supported() {
  "$1" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 14))' >/dev/null 2>&1
}

# What a Python says that cannot start at all, as a pyenv shim without its version does.
complaint_of() {
  message=$("$1" -c '' 2>&1) || [ -z "$message" ] || (set -f && set -- "$1:" $message && echo " ($*)")
}

if [ -n "${PYTHON:-}" ]; then
  if ! is_supported "$PYTHON"; then
    echo "set-up: PYTHON=$PYTHON is not a Python of 3.11 to 3.14: name one that is.$(complaint_of "$PYTHON")" >&2
    exit 2
  fi
else
  made_with=$(cat "$workspace/../.ros2/base_python" 2>/dev/null)
  for candidate in $made_with python3 python3.14 python3.13 python3.12 python3.11 /usr/bin/python3; do
    if is_supported "$candidate"; then
      PYTHON=$candidate
      break
    fi
  done
  if [ -z "${PYTHON:-}" ]; then
    echo "set-up: no Python of 3.11 to 3.14 found (looked for python3 and python3.14 to python3.11): install one" \
      "(Debian, Ubuntu: sudo apt install python3 python3-venv python3-dev) or name it with make PYTHON=/path/to/python3." \
      "$(for candidate in python3 python3.14 python3.13 python3.12 python3.11; do
        command -v "$candidate" >/dev/null && complaint_of "$candidate"
      done)" >&2
    exit 2
  fi
fi

case "$PYTHON" in
  */*) PYTHON=$(CDPATH='' cd -- "$(dirname -- "$PYTHON")" && pwd)/$(basename -- "$PYTHON") ;;
esac
cd -- "$workspace" && exec "$PYTHON" -B -m set_up "$@"
