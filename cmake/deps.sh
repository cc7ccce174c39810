# Sourced by the scripts that set a machine up. need PACKAGE... installs the Debian packages that are
# missing, and removes none for them; it touches nothing, and needs no network, when all are there. ICC_NO_APT=1 forbids
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
        echo "  apt-get update && apt-get install --no-install-recommends --no-remove -y$missing" >&2
        exit 1
    fi
    echo "installing:$missing"
    log=$(mktemp)
    # The list of packages is a list of words.
    # shellcheck disable=SC2086
    if ! { $become apt-get -q update &&
        $become env DEBIAN_FRONTEND=noninteractive apt-get -q install \
            --no-install-recommends --no-remove -o DPkg::Lock::Timeout=600 -y $missing; } >"$log" 2>&1 </dev/null; then
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

# step TOPIC NAME COMMAND... runs a command, whose output goes to $work/NAME.log, and prints the seconds that it
# took. It stops at the first thing in it that fails; so it is not called in a condition.
step() {
    topic=$1
    name=$2
    log=${work:?}/$name.log
    shift 2
    begin=$(date +%s)
    set +e
    (
        set -e
        "$@"
    ) >"$log" 2>&1 </dev/null
    status=$?
    set -e
    if [ "$status" -ne 0 ]; then
        tail -n 60 "$log" >&2
        echo "$topic: $name failed (all of its output is in $log)" >&2
        exit 1
    fi
    printf '%s: %-13s %4d s\n' "$topic" "$name" $(($(date +%s) - begin))
}

# The mirror that apt uses here.
debian_mirror() {
    # shellcheck disable=SC2016 # for apt-get
    found=$(apt-get indextargets --format '$(RELEASE) $(REPO_URI)' 'Created-By: Packages' |
        sed -n '/^bookworm /{s///p;q}')
    if [ -z "$found" ]; then
        echo "the sources of apt have no mirror of Debian bookworm" >&2
        return 1
    fi
    echo "$found"
}

# foreign_root MACHINE RELEASE PACKAGE,...: headers and libraries of a release of Debian for another machine, in the
# folder $root. They are unpacked only, so none of their scripts runs. Links to files of the root are made to lead there
# from outside.
foreign_root() {
    [ ! -e "${root:?}/complete" ] || return 0
    rm -rf "$root"
    uri=$(debian_mirror)
    mmdebstrap --variant=extract --architectures="$1" --aptopt='APT::Install-Recommends "false"' \
        --include="$3" "$2" "$root" "$uri"
    [ -e "$root/lib" ] || ln -s usr/lib "$root/lib"
    find "$root" -type l -lname '/*' | while read -r link; do
        ln -sfn "$root$(readlink "$link")" "$link"
    done
    touch "$root/complete"
}
