# Sourced by the scripts that set a machine up. need PACKAGE... installs the Debian packages that are
# missing; it touches nothing, and needs no network, when all are there. ICC_NO_APT=1 forbids
# installing. On other systems it leaves the finding of what is needed to CMake.
# shellcheck shell=sh

need() {
    command -v dpkg-query >/dev/null || return 0
    missing=
    for package in "$@"; do
        case $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) in
            installed*) ;;
            *) missing="$missing $package" ;;
        esac
    done
    [ -n "$missing" ] || return 0

    become=
    if [ "$(id -u)" -ne 0 ]; then
        become=sudo
    fi
    if [ -n "${ICC_NO_APT:-}" ] || { [ -n "$become" ] && ! command -v sudo >/dev/null; }; then
        echo "These packages are missing; as root run" >&2
        echo "  apt-get update && apt-get install --no-install-recommends -y$missing" >&2
        exit 1
    fi
    echo "installing:$missing"
    log=$(mktemp)
    # The list of packages is a list of words.
    # shellcheck disable=SC2086
    if ! { $become apt-get -q update &&
        $become env DEBIAN_FRONTEND=noninteractive apt-get -q install \
            --no-install-recommends -y $missing; } >"$log" 2>&1 </dev/null; then
        tail -n 20 "$log" >&2
        rm -f "$log"
        echo "apt-get could not install$missing" >&2
        exit 1
    fi
    rm -f "$log"
}

# quietly LOG COMMAND... shows what a command printed only when it fails.
quietly() {
    quiet_log=$1
    shift
    if ! "$@" >"$quiet_log" 2>&1 </dev/null; then
        tail -n 60 "$quiet_log" >&2
        echo "failed: $* (all of its output is in $quiet_log)" >&2
        exit 1
    fi
}
