# shellcheck shell=bash disable=SC2034
# Shared by the scripts in this folder; sourced, never run. It moves to the root of the checkout, takes an
# environment in which ROS 1 works, and offers: install_packages PURPOSE..., configure SOURCE BUILD, enter_ros, require_localhost, free_port,
# beside COMMAND..., all_beside, note, fail.
#
# Packages come from Debian's own archive (11 to 13; Ubuntu from 22.04 on carries the same in universe) or, on
# Ubuntu 20.04, from the ROS archive (Noetic).

set -euo pipefail
# Begun by another script in the background, it ignores SIGINT, and bash lets nobody take that back: roslaunch would not end when a required
# process has, nor rosbag record.
if [[ ${BASH_SOURCE[1]:-} == "$0" ]] && ((0x$(sed -n 's/^SigIgn:[[:space:]]*//p' /proc/$$/status) & 2)); then
  exec perl -e '$SIG{INT} = "DEFAULT"; exec @ARGV' "$BASH" "$0" "$@"
fi
readonly CALLED_FROM=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# The system's Python first: catkin and the ROS tools find their modules with no other. What a sourced workspace or a
# virtual environment left behind goes; a ROS_DISTRO that is set makes Debian's catkin fail.
export PATH="/usr/bin:/bin:/usr/sbin:/sbin:$PATH"
export ROS_HOSTNAME=localhost
unset ROS_DISTRO ROS_IP ROS_MASTER_URI ROS_NAMESPACE ROS_PACKAGE_PATH CMAKE_PREFIX_PATH PYTHONPATH PYTHONHOME

readonly RELEASE_BUILD=build_release
JOBS=$(nproc)
readonly JOBS

note() { printf '\n== %s\n' "$*"; }
fail() {
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  exit 1
}

# The system, such as "debian 12".
system_name() {
  (
    ID='' VERSION_ID=''
    # shellcheck disable=SC1091
    [[ ! -r /etc/os-release ]] || . /etc/os-release
    echo "$ID $VERSION_ID"
  )
}

# Where its packages come from: debian, noetic (the ROS archive) or unknown.
system_family() {
  case "$(system_name)" in
    'debian 11' | 'debian 12' | 'debian 13' | 'ubuntu 22.04' | 'ubuntu 24.04') echo debian ;;
    'ubuntu 20.04') echo noetic ;;
    *) echo unknown ;;
  esac
}

# The packages for one purpose: core (without ROS), core_test, build (and run), test, lint, demo, papers (plot_run.py), python (the package
# hovercraft_core, identify, study), web, rviz.
packages_for() {
  local common
  case "$1" in
    core) common='g++ make cmake libboost-dev libeigen3-dev libfmt-dev libpng-dev libqhull-dev libyaml-cpp-dev' ;;
    clang) common='clang' ;;
    build) common="$(packages_for core) libboost-program-options-dev zlib1g-dev" ;;
    fast) common='ccache ninja-build' ;;
    test) common="$(packages_for clang) $(packages_for fast) libbenchmark-dev libgtest-dev pkg-config" ;;
    # The versions that decide; clang-tidy 22 takes half the time of 14 (scripts/clang_tidy.py).
    lint) common='clang-format-14 clang-tidy-22 catkin-lint codespell' ;;
    core_test) common='libgtest-dev' ;;
    bench) common='libbenchmark-dev pkg-config' ;;
    # What scripts/bench compares with.
    peers) common='libmujoco-dev libbullet-dev libode-dev libfcl-dev libbox2d-dev' ;;
    demo) common='' ;;
    papers) common='python3-matplotlib python3-numpy' ;;
    python) common='pybind11-dev python3-dev python3-numpy python3-scipy python3-yaml python3-matplotlib' ;;
    # What makes and tests the front end of pages (scripts/check_page). A node from elsewhere brings its own npm.
    web)
      common='nodejs chromium'
      command -v npm > /dev/null || common+=' npm'
      ;;
    rviz) common='' ;;
    *) fail "no packages are listed for '$1'" ;;
  esac
  # shellcheck disable=SC2086
  echo $common
  "packages_of_$(system_family)" "$1"
}

# ros-std-msgs and its like hold the .msg files, the lib*-dev packages the generated headers.
packages_of_debian() {
  case "$1" in
    build) echo catkin ros-message-generation libdiagnostic-updater-dev \
      libbz2-dev libdynamic-reconfigure-config-init-mutex-dev python3-dynamic-reconfigure libgeometry-msgs-dev libinteractive-markers-dev libnav-msgs-dev \
      librosbag-dev libroscpp-dev libroslib-dev libros-rosgraph-msgs-dev libsensor-msgs-dev libstd-msgs-dev libstd-srvs-dev libtf2-msgs-dev \
      libtf2-ros-dev libvisualization-msgs-dev ros-geometry-msgs ros-std-msgs ros-std-srvs \
      python3-diagnostic-msgs python3-geometry-msgs python3-nav-msgs python3-sensor-msgs python3-std-msgs python3-std-srvs \
      python3-tf2-msgs python3-visualization-msgs python3-rospy python3-rosservice python3-rosbag python3-roslaunch \
      python3-rostopic rosbash rosout ;;
    # The runtime of clang's sanitizers; before, it was part of what clang depends on.
    clang) case "$(system_name)" in 'debian 12' | 'debian 13' | 'ubuntu 24.04') echo libclang-rt-dev ;; esac ;;
    demo) echo python3-rostest ;;
    test) echo librostest-dev python3-rosnode python3-rosmsg python3-tf2-ros ;;
    rviz) echo rviz ;;
  esac
}

packages_of_noetic() {
  case "$1" in
    build) printf 'ros-noetic-%s ' catkin diagnostic-updater dynamic-reconfigure geometry-msgs interactive-markers message-generation nav-msgs rosbag rosbash \
      roscpp rosgraph-msgs roslaunch roslib rosout rospy rosservice rostopic sensor-msgs std-msgs std-srvs tf2-msgs tf2-ros visualization-msgs ;;
    demo) echo ros-noetic-rostest ;;
    test) printf 'ros-noetic-%s ' rosnode rosmsg rosservice ;;
    rviz) printf 'ros-noetic-%s ' rviz ;;
  esac
}

# install_packages PURPOSE...: installs by apt what these purposes lack; does nothing, and needs no network, if nothing is missing.
install_packages() {
  if [[ $(system_family) == unknown ]]; then
    explain_unknown_system "$@"
    return
  fi
  local missing=() package purpose
  for purpose in "$@"; do
    for package in $(packages_for "$purpose"); do
      is_installed "$package" || missing+=("$package")
    done
  done
  if [[ ${#missing[@]} -eq 0 ]]; then
    return
  fi
  note "Installing ${#missing[@]} packages and what they need"
  local as_root=()
  if [[ $EUID -ne 0 ]]; then
    command -v sudo > /dev/null || fail "as root, run: apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  # An index that cannot be fetched matters only if a package is then not found.
  "${as_root[@]}" apt-get update -qq || note 'apt-get update failed; going on with the index that is there'
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    -o Dpkg::Use-Pty=0 "${missing[@]}" > /dev/null || explain_failed_install "${missing[@]}"
}

is_installed() {
  [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2> /dev/null) == installed ]]
}

explain_failed_install() {
  if [[ $(system_family) == noetic ]]; then
    fail "apt could not install: $*. ROS Noetic's own archive must be among apt's sources:" \
      'http://wiki.ros.org/noetic/Installation/Ubuntu, steps 1.2 and 1.3'
  fi
  fail "apt could not install: $*"
}

# On a system whose package names are not known: goes on if ROS and the compiler are there, else says what is needed.
explain_unknown_system() {
  if command -v cmake > /dev/null && command -v roslaunch > /dev/null; then
    note 'This system is none of Debian 11 to 13, Ubuntu 20.04 to 24.04: nothing is installed, what is there is used'
    return
  fi
  cat >&2 << 'TEXT'
This system is none of Debian 11, 12, 13 or Ubuntu 20.04, 22.04, 24.04. Install these by hand, then run this again:
  a C++17 compiler, make, CMake 3.16, Python 3 (with matplotlib for plot_run.py)
  Boost (program_options), BZip2, Eigen 3.3, fmt, libpng, qhull, yaml-cpp, zlib (with their headers)
  ROS 1: catkin, roscpp, roslib, rospy, rosbag, tf2_ros, tf2_msgs, geometry_msgs, nav_msgs, sensor_msgs, std_msgs, std_srvs, rosgraph_msgs,
  visualization_msgs, diagnostic_updater, dynamic_reconfigure, message_generation, roslaunch, rosservice, rosbash, rosout; for the
  tests also rostest, rostopic, rosnode, rosmsg, GoogleTest, Google Benchmark, clang with its sanitizers' runtime;
  for pictures of the running simulation rviz
TEXT
  exit 1
}

# beside COMMAND...: runs the command beside what comes next, once a processor is free. all_beside waits for those that began, prints what they
# said in the order in which they did, and fails if one of them failed.
beside_answers=()
beside() {
  [[ -n ${beside_folder:-} ]] || beside_folder=$(mktemp -d)
  local answer=$beside_folder/${#beside_answers[@]}
  beside_answers+=("$answer")
  while [[ $(jobs -pr | wc -l) -ge $JOBS ]]; do wait -n || true; done
  { "$@" && touch "$answer.passed"; } > "$answer" 2>&1 &
}

all_beside() {
  local answer all_passed=yes
  wait
  for answer in ${beside_answers[@]+"${beside_answers[@]}"}; do
    cat "$answer"
    [[ -e $answer.passed ]] || all_passed=no
  done
  rm -rf "${beside_folder:-}"
  beside_folder='' beside_answers=()
  [[ $all_passed == yes ]]
}

# configure SOURCE BUILD OPTION...: by CMake, with what makes builds fast where it is there. ccache keeps what was compiled in
# $XDG_CACHE_HOME/hovercraft_sim (~/.cache/hovercraft_sim), which a CI may keep from run to run: it goes by content.
configure() {
  local source=$1 folder=$2 fast=()
  shift 2
  if command -v ccache > /dev/null; then
    export CCACHE_DIR=${CCACHE_DIR:-${XDG_CACHE_HOME:-$HOME/.cache}/hovercraft_sim/ccache}
    export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 CCACHE_DEPEND=1 CCACHE_MAXSIZE=${CCACHE_MAXSIZE:-2G}
    fast+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  # A folder keeps the generator that it was configured with.
  if command -v ninja > /dev/null && [[ ! -f $folder/CMakeCache.txt ]]; then fast+=(-G Ninja); fi
  cmake -S "$source" -B "$folder" ${fast[@]+"${fast[@]}"} "$@"
}

# build_sanitized TARGET...: with the second compiler, the sanitizers and what libFuzzer needs; Eigen's assertions are on. One folder for the
# gtests and the fuzzers: warnings are errors. Rostests are not run under the sanitizers; clang-tidy says what clang warns of in them.
readonly SANITIZE_BUILD=build/sanitize
build_sanitized() {
  local level=-O1 log=$SANITIZE_BUILD/configure.log
  # At -O1 clang++ 11 makes a call of each accessor of Eigen: the tests of world take over 12 minutes, those of clang++ 14 two to three.
  [[ $(clang++ -dumpversion | cut -d. -f1) -ge 14 ]] || level=-O2
  mkdir -p "$SANITIZE_BUILD"
  if ! configure . "$SANITIZE_BUILD" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=$level -g1" \
    -DHOVERCRAFT_FUZZ=ON -DHOVERCRAFT_UNITY=ON -DCATKIN_ENABLE_TESTING=ON -DHOVERCRAFT_WARNINGS_AS_ERRORS=ON > "$log" 2>&1; then
    cat "$log"
    return 1
  fi
  cmake --build "$SANITIZE_BUILD" --target "$@" -- -j"$JOBS"
}

# Takes ROS into the environment where it lies outside /usr.
enter_ros() {
  require_localhost
  if [[ $(system_family) == noetic ]]; then
    set +u
    # shellcheck disable=SC1091
    . /opt/ros/noetic/setup.bash
    set -u
  fi
}

# This machine finds itself by the name that the nodes give each other.
require_localhost() {
  getent ahostsv4 "$ROS_HOSTNAME" > /dev/null ||
    fail "the name $ROS_HOSTNAME cannot be resolved, by which ROS nodes find each other: put \"127.0.0.1 $ROS_HOSTNAME\" into /etc/hosts"
}

# A TCP port of this machine that nobody listens on, for a roscore of our own beside any other. A failure ends the script, but only
# in an assignment of its own: port=$(free_port).
free_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}
