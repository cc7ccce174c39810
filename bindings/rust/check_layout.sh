#!/bin/sh
# Compares libicc-sys with include/icc/api.json: sizes and offsets of structs, constants, and that nothing is missing on
# either side. The compiler compares its signatures with the headers.
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
        print "#include <icc/icc.h>\n#include <icc/stages.h>\n#include <icc/kernel.h>\n#include <icc/fit.h>\n#include <icc/coverage.h>"
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
        sub(/^r#/, "", words[3]) # a name that is a word of Rust
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

# What api.json says of the same items, in the same order.
python3 - "$prefix/include/icc/api.json" "$work/items" >"$work/api.txt" <<'END'
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    api = json.load(file)
SIZES = {"double": 8, "int64_t": 8, "uint64_t": 8, "size_t": 8, "callback": 8, "char": 1, "uint8_t": 1}
values = {name: value for enum in api["enums"].values() for name, value in enum["values"].items()}
members = {(name, m["name"]): m for name, struct in api["structs"].items() for m in struct["members"]}
for line in open(sys.argv[2], encoding="utf-8"):
    kind, name, *rest = line.split()
    if kind == "struct":
        print(name, api["structs"][name]["size"]["lp64"])
    elif kind == "const":
        print(name, values[name])
    elif kind == "field":
        member = rest[0].removeprefix("r#")
        m = members[name, member]
        size = 8 if "*" in m["type"] else SIZES.get(m["type"], 4)
        print(f"{name}.{member} {m['offset']['lp64']} {size * m.get('length', 1)}")
END

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
            member = $3
            sub(/^r#/, "", member)
            printf " println!(\"%s.%s {} {}\", at, size_behind(f)); }\n", $2, member
        }
        $1 == "const" { printf "println!(\"%s {}\", %s);\n", $2, $2 }
    ' "$work/items"
    echo '}'
} >"$work/layout.rs"

cc=${CC:-cc}
$cc -std=c11 -Werror=incompatible-pointer-types -Werror=pointer-sign -fsyntax-only -I"$prefix/include" "$work/signatures.c"

# The library itself is not linked: nothing of it is called.
rustc=${RUSTC:-rustc}
"$rustc" --edition 2021 --crate-type rlib --crate-name libicc_sys --out-dir "$work" "$source"
"$rustc" --edition 2021 --extern libicc_sys="$work/liblibicc_sys.rlib" -o "$work/layout_rust" "$work/layout.rs"
"$work/layout_rust" >"$work/rust.txt"
diff "$work/api.txt" "$work/rust.txt"

# What api.json lists, and what Rust does.
python3 - "$prefix/include/icc/api.json" <<'END' | sort >"$work/declared"
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    api = json.load(file)
print(*api["functions"], *api["structs"], *api["opaque"], *(n for e in api["enums"].values() for n in e["values"]), sep="\n")
END
{
    sed -n 's/^fn [^|]*|\([^|]*\)|.*/\1/p; s/^struct //p; s/^const //p' "$work/items"
    awk '/^opaque!\(/ { inside = 1 } inside && /^ *icc_/ { print $1; inside = 0 }' "$source"
} | sort >"$work/bound"
diff "$work/declared" "$work/bound"
echo "libicc-sys matches the headers: $(grep -c '^fn' "$work/items") functions," \
    "$(grep -c '^struct' "$work/items") structs, $(grep -c '^const' "$work/items") constants"
