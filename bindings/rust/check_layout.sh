#!/bin/sh
# Compares libicc-sys with the headers: sizes and offsets of structs, constants, signatures, and that nothing
# is missing on either side.
# usage: check_layout.sh PREFIX      where libicc is installed
set -eu
prefix=$(cd "$1" && pwd)
cd "$(dirname "$0")"
source=libicc-sys/src/lib.rs
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# One line for each item: struct NAME, field STRUCT NAME TYPE, const NAME, fn RESULT|NAME|TYPE,TYPE,..
awk '
    /^ *\/\// { next }
    /^pub struct / { name = $3; print "struct", name; next }
    /^}/ { name = "" }
    name != "" && /^    pub / {
        field = $2; sub(":", "", field)
        type = $0; sub(/^[^:]*: */, "", type); sub(/,$/, "", type)
        print "field", name, field, type
    }
    /^pub const / { constant = $3; sub(":", "", constant); print "const", constant }
    /^    pub fn / { text = "" ; inside = 1 }
    inside { text = text $0 " " }
    inside && /;$/ {
        inside = 0
        gsub(/ +/, " ", text)
        sub(/^ pub fn /, "", text)
        function_name = text; sub(/\(.*/, "", function_name)
        result = "void"
        if (text ~ /\) -> /) { result = text; sub(/.*\) -> /, "", result); sub(/; $/, "", result) }
        inner = text; sub(/^[^(]*\(/, "", inner); sub(/\)( -> .*)?; $/, "", inner); sub(/, *$/, "", inner)
        n = split(inner, parts, ",")
        types = ""
        for (i = 1; i <= n; i++) {
            sub(/^[^:]*: */, "", parts[i]); gsub(/^ +| +$/, "", parts[i])
            types = types (i > 1 ? "," : "") parts[i]
        }
        print "fn " result "|" function_name "|" types
        name = ""
    }
' "$source" >"$work/items"

# Types of members and functions in C, which the compiler compares with the headers. Pointers of Rust are read from
# the left; members that are functions have the right size only.
awk -F'|' '
    function c_type(rust,    out, constant) {
        out = ""
        while (rust ~ /^\*(const|mut) /) {
            constant = rust ~ /^\*const /
            sub(/^\*(const|mut) /, "", rust)
            out = (constant ? " const" : "") " *" out
        }
        if (rust in base) rust = base[rust]
        return rust out
    }
    BEGIN {
        base["usize"] = "size_t"; base["i32"] = "int32_t"; base["u32"] = "uint32_t"; base["u8"] = "uint8_t"
        base["i64"] = "int64_t"; base["u64"] = "uint64_t"
        base["f64"] = "double"; base["c_char"] = "char"; base["c_void"] = "void"
        print "#include <icc/icc.h>\n#include <icc/stages.h>\n#include <icc/kernel.h>"
    }
    /^struct / { split($0, words, " "); printf "static const %s %s_;\n", words[2], words[2] }
    /^field / && !/Option</ {
        split($0, words, " ")
        type = $0; sub(/^field [^ ]+ [^ ]+ /, "", type)
        bounds = ""
        if (type ~ /^\[/) {
            bounds = type; sub(/.*; /, "[", bounds)
            sub(/^\[/, "", type); sub(/;.*/, "", type)
        }
        if (type == "") next
        member = words[2] "_." words[3]
        printf "%s const (*const check_%s_%s)%s = &%s;\n", c_type(type), words[2], words[3], bounds, member
    }
    /^fn / {
        sub(/^fn /, "", $1)
        n = split($3, types, ",")
        list = n == 0 ? "void" : ""
        for (i = 1; i <= n; i++) list = list (i > 1 ? ", " : "") c_type(types[i])
        printf "%s (*const check_%s)(%s) = %s;\n", c_type($1), $2, list, $2
    }
' "$work/items" >"$work/signatures.c"

{
    echo '#include <icc/icc.h>'
    echo '#include <icc/stages.h>'
    echo '#include <icc/kernel.h>'
    echo '#include <stdio.h>'
    echo 'int main(void) {'
    awk '
        $1 == "struct" { printf "printf(\"%s %%zu\\n\", sizeof(%s));\n", $2, $2 }
        $1 == "field" {
            printf "printf(\"%s.%s %%zu %%zu\\n\",", $2, $3
            printf " offsetof(%s, %s), sizeof(((%s *)0)->%s));\n", $2, $3, $2, $3
        }
        $1 == "const" { printf "printf(\"%s %%ld\\n\", (long)%s);\n", $2, $2 }
    ' "$work/items"
    echo 'return 0; }'
} >"$work/layout.c"

{
    echo 'use libicc_sys::*;'
    echo 'fn size_behind<T>(_: *const T) -> usize { std::mem::size_of::<T>() }'
    echo 'fn main() {'
    awk '
        $1 == "struct" { printf "println!(\"%s {}\", std::mem::size_of::<%s>());\n", $2, $2 }
        $1 == "field" {
            printf "{ let s = std::mem::MaybeUninit::<%s>::uninit();", $2
            printf " let f = unsafe { std::ptr::addr_of!((*s.as_ptr()).%s) };", $3
            printf " let at = f as usize - s.as_ptr() as usize;"
            printf " println!(\"%s.%s {} {}\", at, size_behind(f)); }\n", $2, $3
        }
        $1 == "const" { printf "println!(\"%s {}\", %s);\n", $2, $2 }
    ' "$work/items"
    echo '}'
} >"$work/layout.rs"

cc=${CC:-cc}
$cc -std=c11 -Werror=incompatible-pointer-types -Werror=pointer-sign -fsyntax-only -I"$prefix/include" "$work/signatures.c"
$cc -std=c11 -I"$prefix/include" -o "$work/layout_c" "$work/layout.c"
"$work/layout_c" >"$work/c.txt"

# The library itself is not linked: nothing of it is called.
rustc=${RUSTC:-rustc}
"$rustc" --edition 2021 --crate-type rlib --crate-name libicc_sys --out-dir "$work" "$source"
"$rustc" --edition 2021 --extern libicc_sys="$work/liblibicc_sys.rlib" -o "$work/layout_rust" "$work/layout.rs"
"$work/layout_rust" >"$work/rust.txt"
diff "$work/c.txt" "$work/rust.txt"

# What the headers declare, and what Rust does.
cat "$prefix"/include/icc/*.h >"$work/headers"
{
    grep -o 'ICC_API .*' "$work/headers" | grep -o 'icc_[a-z_0-9]* *(' | tr -d ' ('
    grep -o '^typedef struct icc_[a-z_0-9]*' "$work/headers" | sed 's/.* //'
    grep -o '^ *ICC_[A-Z_0-9]* = ' "$work/headers" | tr -d ' ='
} | sort >"$work/declared"
{
    sed -n 's/^fn [^|]*|\([^|]*\)|.*/\1/p; s/^struct //p; s/^const //p' "$work/items"
    awk '/^opaque!\(/ { inside = 1 } inside && /^ *icc_/ { print $1; inside = 0 }' "$source"
} | sort >"$work/bound"
diff "$work/declared" "$work/bound"
echo "libicc-sys matches the headers: $(grep -c '^fn' "$work/items") functions," \
    "$(grep -c '^struct' "$work/items") structs, $(grep -c '^const' "$work/items") constants"
