# Source this file (bash or zsh): ROS 2, both packages and the `bench` command become visible in this shell.
# It changes nothing in the shell where set-up was not run or another ROS 2 is sourced; it says so and returns 1.

_contact_bench_source() {
  local root="$1" environment="$1/.ros2" workspace="$1/ros2_ws" shell="$2" entry options
  if [ ! -f "$environment/workspace.stamp" ] || [ ! -f "$workspace/install/setup.$shell" ]; then
    echo "contact bench: set-up was not run yet (or was interrupted): run \`make setup\` in $root." >&2
    return 1
  fi
  if [ -f "$environment/share/rclpy/package.xml" ]; then
    while IFS= read -r entry; do
      case "$entry" in
        "" | "$root"/*) ;;
        *)
          echo "contact bench: another ROS 2 is sourced in this shell ($entry): use a fresh shell, or run \`make setup\` here to build on it." >&2
          return 1
          ;;
      esac
    done <<PREFIXES
$(printf '%s' "${AMENT_PREFIX_PATH:-}" | tr ':' '\n')
PREFIXES
  fi

  # colcon's files read unset variables and let commands fail: not a matter for the caller's options.
  options=$-
  set +eu
  # The overlay names its underlay and brings it along.
  . "$workspace/install/setup.$shell"
  . "$environment/local_setup.$shell"
  case "$options" in *u*) set -u ;; esac
  case "$options" in *e*) set -e ;; esac

  # What was built on first use comes last: a package of the same name that is installed hides it.
  if [ -d "$workspace/on_use" ]; then
    while IFS= read -r entry; do
      case ":$AMENT_PREFIX_PATH:" in *":$entry:"*) continue ;; esac
      export AMENT_PREFIX_PATH="$AMENT_PREFIX_PATH:$entry" LD_LIBRARY_PATH="${LD_LIBRARY_PATH:-}:$entry/lib"
      export PYTHONPATH="${PYTHONPATH:-}:$(find "$entry/lib" -maxdepth 2 -name '*-packages' -path '*/python3*' | head -n 1)"
    done <<PREFIXES
$(find "$workspace/on_use" -mindepth 3 -maxdepth 3 -type d -path '*/install/*')
PREFIXES
  fi

  # An empty entry stands for the current folder: what a stranger's bag was unpacked with would be imported and loaded.
  for entry in PYTHONPATH LD_LIBRARY_PATH AMENT_PREFIX_PATH; do
    eval "options=\"\${$entry:-}\""
    case "${options:+:$options:}" in
      *::*) export "$entry=$(printf '%s' "$options" | sed -E 's/:+/:/g; s/^:|:$//g')" ;;
    esac
  done

  export COLCON_DEFAULTS_FILE="$workspace/colcon_defaults.yaml"
  export ROS_AUTOMATIC_DISCOVERY_RANGE="${ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}"
  export FASTRTPS_DEFAULT_PROFILES_FILE="${FASTRTPS_DEFAULT_PROFILES_FILE:-$workspace/fastdds_profile.xml}"
  # Else Fast DDS also obeys a DEFAULT_FASTRTPS_PROFILES.xml of the current folder, in each process that opens ROS.
  export SKIP_DEFAULT_XML_FILE="${SKIP_DEFAULT_XML_FILE:-1}"
  # Five processes share the cores: one thread each unless the caller asks for more.
  export NUMBA_NUM_THREADS="${NUMBA_NUM_THREADS:-1}" OPENBLAS_NUM_THREADS="${OPENBLAS_NUM_THREADS:-1}"
}

if [ -n "${ZSH_VERSION:-}" ]; then
  eval '_contact_bench_file="${(%):-%x}"'
  _contact_bench_shell=zsh
else
  _contact_bench_file="${BASH_SOURCE[0]}"
  _contact_bench_shell=bash
fi
_contact_bench_root="$(CDPATH='' cd -- "$(dirname -- "$_contact_bench_file")/.." && pwd -P)"
_contact_bench_source "$_contact_bench_root" "$_contact_bench_shell" && _contact_bench_status=0 || _contact_bench_status=1
unset -f _contact_bench_source
unset _contact_bench_root _contact_bench_file _contact_bench_shell
# The status is handed on by the last command, which also unsets the variable that holds it.
if [ "$_contact_bench_status" = 0 ]; then unset _contact_bench_status; else unset _contact_bench_status; return 1; fi
