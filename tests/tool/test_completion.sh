#!/bin/sh
# Completion: what bash offers at several places; zsh and fish, where they are installed, can read theirs.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

run 2 completion
says "for which shell? bash, zsh or fish"
run 2 completion tcsh
for shell in bash zsh fish; do
    run 0 completion $shell
    cp out "script.$shell"
    if command -v $shell >/dev/null; then
        $shell -n "script.$shell" || complain "$shell does not read its script"
    fi
done

# offers WORDS WORD...: what bash has for the last of these words.
offers() {
    expected=$1
    shift
    bash -c '. ./script.bash; COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _libicc; echo "${COMPREPLY[*]}"' libicc "$@" >got
    [ "$(cat got)" = "$expected" ] || complain "for '$*' bash has '$(cat got)', not '$expected'"
}
if command -v bash >/dev/null; then
    offers 'map mesh match' libicc m
    offers 'foliation field' libicc map --method f
    offers 'foliation disc gradient field' libicc map -m ''
    offers '--source --source-crs --solver' libicc map --so
    offers '' libicc map --source island
    offers 'decode' libicc help dec
    offers 'zsh' libicc completion z

    # Every option that help lists, and no other.
    for command in map warp pose; do
        run 0 $command --help-all
        grep -oE '^ +(-[a-z], )?--[a-z-]+' out | grep -oE -- '--[a-z-]+' | sort -u >listed
        bash -c '. ./script.bash; COMP_WORDS=(libicc "$1" --) COMP_CWORD=2; _libicc; printf "%s\n" "${COMPREPLY[@]}"' bash \
            $command | sort -u >offered
        same listed offered "$command"
    done
fi
finish
