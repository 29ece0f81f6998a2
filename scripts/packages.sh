# The Debian packages: which are missing, and how they are installed. packages.txt is the only list.

# packages_of SCOPE...: names of the packages of these scopes (build, run, train, test, docker).
packages_of() {
  local scope
  for scope in "$@"; do
    awk -v scope="$scope" '!/^#/ && NF && $2 == scope { print $1 }' "$ROOT/packages.txt"
  done
}

# Of the names given, those that are not installed.
missing_packages() {
  local name
  for name in "$@"; do
    dpkg-query -W -f='${Status}' "$name" 2>/dev/null | grep -q 'ok installed' || echo "$name"
  done
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# install_packages SCOPE...: installs what is missing, without recommended packages; silent when nothing is.
install_packages() {
  local missing
  missing=$(missing_packages $(packages_of "$@"))
  [ -z "$missing" ] && return 0
  if [ "$(id -u)" != 0 ] && ! command -v sudo >/dev/null; then
    die 2 "These Debian packages are missing and neither root nor sudo is at hand: as root, run apt-get install --no-install-recommends" $missing
  fi
  say "Installing Debian packages:" $missing
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq update || say "apt-get update failed; trying with the package lists at hand"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y install --no-install-recommends $missing >/dev/null ||
    die 2 "The packages could not be installed. Is the Debian archive in reach? (apt-get update)"
}
