#!/bin/sh
# The shared library exports exactly the functions that the public headers declare, under the version
# ICC_0, and the static one defines nothing outside icc_ and iccp_. From the C library both take only what gives the
# same bits everywhere: of its mathematics nothing but functions whose results IEEE 754 or C fixes exactly.
# Neither has variables that outlive a call, of a thread or of all.
# usage: check_symbols.sh CC NM INCLUDE_DIR SHARED_LIBRARY STATIC_LIBRARY
set -eu
cc=$1 nm=$2 include=$3 shared=$4 static=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Each declaration of an exported function, put on one line, is what carries the attribute.
for header in "$include"/icc/*.h; do
    echo "#include <icc/${header##*/}>"
done >"$work/all.c"
"$cc" -E -P -I"$include" "$work/all.c" | tr '\n' ' ' | tr ';' '\n' |
    sed -n 's/.*visibility("default").*[^a-z0-9_]\(icc_[a-z0-9_]*\)(.*/\1/p' |
    sort -u >"$work/declared"
"$nm" -D --defined-only "$shared" | awk '$2 != "A" { print $3 }' | sort >"$work/versioned"
sed 's/@@ICC_0$//' "$work/versioned" >"$work/exported"

failed=0
if ! [ -s "$work/declared" ]; then
    echo "no declarations found in $include/icc"
    failed=1
fi
if ! diff -u "$work/declared" "$work/exported"; then
    echo "-: declared but not exported; +: exported but not declared (or without version ICC_0)"
    failed=1
fi
# The sanitizers mark each global with a twin of their own.
"$nm" -g --defined-only "$static" | awk 'NF == 3 { print $3 }' |
    grep -v -e '^icc_' -e '^iccp_' -e '^__odr_asan' >"$work/foreign" || true
if [ -s "$work/foreign" ]; then
    echo "the static library defines names outside icc_ and iccp_:"
    cat "$work/foreign"
    failed=1
fi

# Variables that may be written to, but for those that the linker makes constant and those of sanitizers.
"$nm" -f sysv "$static" | awk -F'|' '$4 ~ /TLS/ || $7 ~ /^\.t?(data|bss)/ || $7 ~ /COM/ { print $1, $7 }' |
    grep -v -e '\.data\.rel\.ro' -e '^__' >"$work/variables" || true
"$nm" -f sysv "$static" | grep -q '\.data\.rel\.ro' || { echo "nothing seen of the static library's data"; failed=1; }
"$nm" -u "$static" | grep -e __tls_get_addr -e _TLS_MODULE_BASE_ >>"$work/variables" || true
if [ -s "$work/variables" ]; then
    echo "the library keeps state in variables:"
    cat "$work/variables"
    failed=1
fi

# Names that begin with two underscores are the compilers' and sanitizers' own.
imported() {
    sed -n 's/^.* [Uw] //p' | sed 's/@.*//' | sort -u | grep -v -e '^icc_' -e '^iccp_' -e '^__' -e '^_ITM_' -e '^_GLOBAL_'
}
exact='ceil copysign fabs floor fmod frexp ldexp nextafter round scalbn sqrt trunc'
other='bcmp clock_gettime fegetenv fesetenv free malloc memcmp memcpy memmove memset snprintf vsnprintf'
threads='pthread_create pthread_join pthread_mutex_init pthread_mutex_destroy pthread_mutex_lock
  pthread_mutex_unlock pthread_cond_init pthread_cond_destroy pthread_cond_wait pthread_cond_broadcast'
echo "$exact $other $threads" | tr ' ' '\n' >"$work/allowed"
"$nm" -D --undefined-only "$shared" | imported >"$work/imported"
"$nm" --undefined-only "$static" | imported >>"$work/imported"
grep -qx malloc "$work/imported" || { echo "nothing seen of what the library imports"; failed=1; }
if grep -vxF -f "$work/allowed" "$work/imported" | sort -u | grep .; then
    echo "these are imported, and not known to give the same results with every C library"
    failed=1
fi
exit $failed
