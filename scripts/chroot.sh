# shellcheck shell=bash
# What runs commands of the committed HEAD in a bare Debian, as root; sourced, never run. Offers: require_root, use_tree SUITE_OR_TREE,
# run_in_tree COMMAND TIMES [SHARED [CACHE]], in_tree_name.
#
# A tree of a suite (bullseye, bookworm, trixie) is made by debootstrap; MIRROR and SECURITY_MIRROR name other mirrors. A folder that holds
# such a tree is taken as it is, and not written to.

# Inside the namespace. Arguments: tree, scratch folder, checkout, command line, once or twice, folders that are
# /shared and /cache inside, if any.
run_inside() {
  local tree=$1 scratch=$2 checkout=$3 command=$4 times=$5 shared=$6 cache=$7 root=$2/root
  mkdir -p "$scratch"/{upper,work,root}
  mount -t overlay overlay -o "lowerdir=$tree,upperdir=$scratch/upper,workdir=$scratch/work" "$root"
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  mount -t tmpfs tmpfs "$root/tmp"
  mount -t tmpfs tmpfs "$root/dev/shm"
  if [[ -n $shared ]]; then
    mkdir -p "$root/shared"
    mount --bind "$shared" "$root/shared"
  fi
  if [[ -n $cache ]]; then
    mkdir -p "$root/cache"
    mount --bind "$cache" "$root/cache"
  fi

  # apt in there reaches what apt out here reaches.
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  echo '127.0.0.1 localhost' > "$root/etc/hosts"
  apt-config dump | grep -iE '^Acquire::(https?::)?[^"]*Proxy|Check-(Valid-Until|Date)' \
    > "$root/etc/apt/apt.conf.d/99host" || true
  # Nobody needs the tree after a power cut.
  echo force-unsafe-io > "$root/etc/dpkg/dpkg.cfg.d/99host"
  git clone -q --no-hardlinks "$checkout" "$root/root/hovercraft_sim"

  local inside=(env -i HOME=/root LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
    "http_proxy=${http_proxy:-}" "https_proxy=${https_proxy:-}" chroot "$root"
    bash -c "cd /root/hovercraft_sim && $command")
  time "${inside[@]}"
  if [[ $times == twice ]]; then
    echo '== Again, without network'
    time unshare --net bash -c 'ip link set lo up; exec "$@"' bash "${inside[@]}"
  fi
}

require_root() {
  [[ $EUID -eq 0 ]] || {
    echo "${0##*/}: must be run as root: it makes a bare Debian, and mounts in a namespace of its own" >&2
    exit 1
  }
}

# use_tree SUITE_OR_TREE: sets $tree and $scratch, which goes at the end of the script.
use_tree() {
  tree=$1
  scratch=$(mktemp -d "${TMPDIR:-/var/tmp}/${0##*/}.XXXXXX")
  # shellcheck disable=SC2064
  trap "rm -rf --one-file-system '$scratch'" EXIT
  [[ ! -d $1 ]] || return 0
  case "$1" in
    bullseye | bookworm | trixie) ;;
    *)
      echo "${0##*/}: '$1' is neither a folder nor one of bullseye, bookworm, trixie" >&2
      exit 2
      ;;
  esac
  tree=$scratch/tree
  debootstrap --variant=minbase "$1" "$tree" ${MIRROR:+"$MIRROR"}
  # clang-tidy 22 is in bookworm's security archive only. What the indices of bullseye's name is no longer all there (November 2026): no
  # other suite takes it.
  [[ $1 != bookworm ]] || echo "deb ${SECURITY_MIRROR:-http://deb.debian.org/debian-security} $1-security main" >> "$tree/etc/apt/sources.list"
}

# run_in_tree COMMAND once|twice [SHARED [CACHE]]: in a checkout of HEAD in a fresh overlay of $tree. The folders are /shared and /cache inside. The mounts live in a
# namespace of their own and go with it, and so does every process that was started inside.
run_in_tree() {
  local checkout
  checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
  # What an earlier command left.
  rm -rf --one-file-system "$scratch"/{upper,work,root}
  export -f run_inside
  unshare --mount --propagation private --pid --fork --kill-child \
    bash -euo pipefail -c 'run_inside "$@"' bash "$tree" "$scratch" "$checkout" "$1" "$2" "${3:-}" "${4:-}"
}

# "Debian GNU/Linux 12 (bookworm)"
in_tree_name() {
  # shellcheck disable=SC1091
  (. "$tree/etc/os-release" && echo "$PRETTY_NAME")
}
