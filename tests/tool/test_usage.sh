#!/bin/sh
# Wrong usage is told in one line, with exit code 2 and nothing on stdout; help and version are not errors.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

run 0 --version
grep -q '^libicc [0-9]*\.[0-9]*\.[0-9]*$' out || complain "no version: $(cat out)"
run 0 --help
for command in map encode decode warp animate mesh check info plot match weights pose; do
    run 0 --help
    holds out "  $command "
    run 0 "$command" --help
    holds out "Usage: libicc $command"
    holds out "--source FILE"
    [ ! -s err ] || complain "$command --help writes to stderr"
    # Below an option nothing begins at the left but headings and the last line.
    awk -v c="$command" 'option && /^[^ ]/ && !/^(Options|Further options|.libicc)/ { print c ": at the left: " $0; bad = 1 }
        /^ +(-.|--)/ { option = 1 } END { exit bad }' out || complain "$command --help is broken off"
    run 0 "$command" -h
    run 2 "$command"
    says "(see 'libicc $command --help')"
    run 2 "$command" --nonsense
    says "--nonsense"
done


# Lines fit into a terminal.
for command in '' map fit encode decode warp animate mesh check info plot match weights pose demo; do
    # shellcheck disable=SC2086 # one word or none
    run 0 $command --help-all
    awk 'length > 80 { print; bad = 1 } END { exit bad }' out || complain "$command --help is wider than 80 columns"
done

run 2
says "which command?"
run 2 frobnicate
says "'frobnicate'"
run 2 weights --target target.txt
says "--target"
run 2 map --source source.txt
says "--target FILE is missing"
run 2 map --target target.txt
says "--source FILE is missing"
run 2 info --source
says "--source needs a value"
run 2 info -s source.txt extra
says "'extra' is one argument too many"
run 2 warp -s source.txt -t target.txt in.png
says "usage: libicc warp"
run 2 encode -s source.txt --inverse
says "--inverse"
run 2 info -s source.txt --quiet=yes
says "--quiet takes no value"

run 2 map -s source.txt -t target.txt --method fields
says "it may be: foliation, disc, gradient, field"
run 2 map -s source.txt -t target.txt --geojson
says "--geojson needs two files, IN and OUT"
run 2 map -s source.txt -t target.txt --geojson in out more
says "'more' is one argument too many"
run 2 map -s source.txt -t target.txt in out
says "'in' is one argument too many without --geojson"
run 2 map -s source.txt -t target.txt --geojson in out -p points.txt
says "--points and --output do not go with --geojson"
run 2 mesh -s source.txt -t target.txt --repair --inverse in out
says "--untangle does not go with --inverse"
run 2 mesh -s source.txt -t target.txt --untangle --inverse in out
says "--untangle does not go with --inverse"

# A name with another format's extension is refused before anything is read, and what stands there stays.
misnamed() { # NAME ARGUMENT...
    echo kept >"$1"
    name=$1
    shift
    run 2 "$@"
    says "'$name' is a name for"
    [ "$(cat "$name")" = kept ] || complain "$name was written"
}
for name in o.tif o.TIF o.webp o.svg o.txt o.png.gz; do
    misnamed "$name" warp -s nowhere -t nowhere nowhere.png "$name"
done
for name in o.tif o.pdf o.obj o.json; do misnamed "$name" plot -s nowhere "$name"; done
for name in o.png o.pdf o.obj o.json; do
    misnamed "$name" weights -s nowhere -a nowhere --picture "$name"
done
for name in o.dae o.usd o.txt o.png o.vtp; do misnamed "$name" mesh -s nowhere -t nowhere nowhere.obj "$name"; done
for name in o.geojson o.csv o.xlsx o.npy; do
    misnamed "$name" map -s nowhere -t nowhere -o "$name"
    misnamed "$name" encode -s nowhere -o "$name"
    misnamed "$name" decode -s nowhere -o "$name"
    misnamed "$name" weights -s nowhere -a nowhere -o "$name"
done
for name in o.kml o.gpkg o.shp o.txt; do
    misnamed "$name" map -s nowhere -t nowhere --geojson nowhere "$name"
done
for name in o.shp o.svg o.vtk; do
    misnamed "$name" check -s nowhere --repair "$name"
    misnamed "$name" check -s nowhere --boundary "$name"
done
misnamed o.txt info -s nowhere --json=o.txt
misnamed o.svg weights -s nowhere -a nowhere --binding o.svg
# What depends on the input is refused when that is known.
misnamed o.obj check -s source.txt --repair o.obj
misnamed o.txt check -s source.txt -t target.txt --repair o.txt
printf 'v 1 1\nv 2 1\nv 2 2\nf 1 2 3\n' >t.obj
misnamed o.ply mesh -s source.txt -t target.txt t.obj o.ply
misnamed o.vtk mesh -s source.txt -t target.txt t.obj o.vtk
printf '{"handles": [[1, 1], [9, 1], [1, 9]]}' >h.json
printf '{"moves": []}' >p.json
misnamed o.png pose -s source.txt -a h.json --pose p.json t.obj o.png
misnamed o.txt pose -s source.txt -a h.json --pose p.json t.obj o.txt
misnamed o.obj pose -s source.txt -a h.json --pose p.json points.txt o.obj
misnamed o.png pose --binding nowhere --pose nowhere o.png
for name in o o.dat .png; do run 0 map -s source.txt -t target.txt -p points.txt -o $name; done

# Help of a command, in two ways; the papers' options come behind the usual ones.
run 0 map --help
for word in "--help-all" "--quiet"; do holds out "$word"; done
cp out expected
run 0 help map
same out expected "help map"
run 0 help
holds out 'Usage: libicc COMMAND'
run 2 help nothing
says "there is no command 'nothing' (see"
for words in transform:map georef:fit film:animate maap:map wrap:warp chekc:check anim:animate mathc:match inof:info pse:pose; do
    run 2 ${words%%:*}
    says "there is no command '${words%%:*}'; did you mean ${words#*:}? (see 'libicc --help')"
done
for words in sorce:source sourc:source pionts:points outsid:outside triangluation:triangulation; do
    run 2 map --${words%%:*} a
    says "there is no option --${words%%:*}; did you mean --${words#*:}? (see 'libicc map --help')"
done
run 2 map --no a
says 'there is no option --no (see'
for word in version --version -v -V; do
    run 0 $word
    [ "$(cut -d' ' -f1 <out)" = libicc ] || complain "$word prints no version"
done
# The usual options come first; the papers' options are listed only where all are asked for.
run 0 help warp
[ "$(grep -n -- '--source' out | head -n 1 | cut -d: -f1)" -lt "$(grep -n '^Further options' out | cut -d: -f1)" ] ||
    complain "--source is not among the usual options"
if grep -q -- '--min-fall\|--tree\|--function' out; then complain "help lists the papers' options"; fi
holds out "'libicc warp --help-all' also lists the options of the papers' method."
run 0 warp --help-all
[ "$(sed -n '/^Options of the papers/,$p' out | grep -c -- '--min-fall\|--tree\|--function')" = 3 ] ||
    complain "the papers' options are not in a group of their own"
sed '/^Options of the papers/,$d' out | grep -q -- '--min-fall' && complain "--min-fall stands among the usual options"
run 0 pose --help-all
holds out "--sigma LENGTH"
# Second meanings have long names; what was spelt before works.
run 0 help pose
if grep -q -- '-t, ' out; then complain "help tells of pose -t"; fi
run 0 pose -s source.txt -a h.json -t p.json points.txt -
cp out expected
run 0 pose -s source.txt -a h.json --pose p.json points.txt -
same out expected "pose -t"
run 2 map -s source.txt -t target.txt --tolerance 1
says "--tolerance goes with --geojson only"
run 2 map -s source.txt -t target.txt --outside clip
says "--outside clip goes with --geojson only"
run 2 map -s source.txt -t target.txt --outside nowhere
says "it may be: keep, null, clip, fail"
run 2 mesh -s source.txt -t target.txt --outside null in.obj out.obj
says "--outside null would leave vertices without a place"
run 2 warp -s source.txt -t target.txt --outside keep --background 00ff00 in.png out.png
says "--background clears pixels, but --outside keep does not"
for value in -1 nan inf x; do
    run 2 map -s source.txt -t target.txt --snap "$value"
    says "--snap '$value' must be a number of at least 0"
done
run 2 map -s source.txt -t - --geojson - out
says "only one input can be standard input"
for value in 0 -1 nan inf x ''; do
    run 2 map -s source.txt -t target.txt --geojson in out "--tolerance=$value"
    says "must be a number above 0"
done
run 2 map -s source.txt -t target.txt -m gradient --map mesh
says "--map mesh needs a method that can be certified"
run 2 plot -s source.txt --triangles out.svg
says "--triangles needs a mesh map"
run 2 plot -s source.txt -t target.txt --map curves --triangles out.svg
says "--triangles needs a mesh map"
run 2 info -s source.txt --method magic
says "it may be: foliation, disc, gradient"
for pair in "--function distance" "--function laplace" "--tree paper" "--constrained " "--unconstrained " \
    "--min-fall 1e-3" "--solver direct"; do
    # shellcheck disable=SC2086
    run 2 info -s source.txt $pair
    says "${pair% *} needs --method gradient"
    # shellcheck disable=SC2086
    run 2 info -s source.txt $pair --method disc
    says "${pair% *} needs --method gradient"
done
# Functions: names, what they have, how many.
for names in magic laplace,magic '' 'laplace,' ',laplace' laplac; do
    run 2 plot -s source.txt -m gradient "--function=$names" out.svg
    says "is unknown; it may be: decay, distance, laplace, bilaplace, clamped"
done
for names in laplace:loose laplace: decay:constrained distance:unconstrained clamped:constrainedly; do
    run 2 info -s source.txt -m gradient --function "$names"
    says "--function '$names': after the colon"
done
run 2 info -s source.txt -m gradient --function laplace,decay
says "only plot takes several"
run 2 plot -s source.txt -m gradient -f decay,decay,decay,decay,decay,decay,decay,decay,decay out.svg
says "--function takes at most 8 names"
for pair in "--constrained " "--unconstrained " "--min-fall 1e-3" "--solver iterative"; do
    for function in decay distance; do
        # shellcheck disable=SC2086
        run 2 info -s source.txt -m gradient --function $function $pair
        says "${pair% *} needs --function laplace, bilaplace, clamped or harmonic"
    done
    # shellcheck disable=SC2086
    run 2 info -s source.txt -m gradient $pair
    says "${pair% *} needs --function laplace, bilaplace, clamped or harmonic"
done
run 2 info -s source.txt -m gradient -f laplace --constrained --unconstrained
says "--constrained and --unconstrained exclude each other"
for value in 0 -1e-6 nan 0.011 1 x ''; do
    run 2 info -s source.txt -m gradient -f laplace --constrained "--min-fall=$value"
    says "must be a number above 0 and at most 0.01"
done
run 2 info -s source.txt -m gradient -f laplace --solver magic
says "it may be: direct, iterative"

run 2 map -s source.txt -t target.txt --method disc --maximum 1,1
says "--method disc has no --maximum"
run 2 map -s source.txt -t target.txt --method disc --target-maximum 1,1
says "--method disc has no --maximum"
for value in 1 0 -3 2.5 20000 many '' 1e99; do
    run 2 info -s source.txt "--cells=$value"
    says "--cells '$value' must be a whole number from 2 to 16384"
done
for value in '1,' ',2' '1 2' 'nan,1' a,b '1,2,3,4,5,6,7' ''; do
    run 2 info -s source.txt --maximum "$value"
    says "must be numbers X,Y or X,Y,Z"
done
for value in 1 '1,2,3'; do
    run 2 info -s source.txt --maximum "$value"
    says "coordinates, but the cage 2"
    run 2 map -s source.txt -t target.txt --target-maximum "$value"
    says "coordinates, but the cage 2"
done
run 2 warp -s source.txt -t target.txt --background red a.png b.png
says "RRGGBB"
run 2 map -s - -t target.txt
says "only one input can be standard input"
run 2 map -s source.txt -t target.txt --json
says "use --json=FILE"

# The same option in every spelling.
run 0 info --source source.txt --cells 20 --method gradient
sed '/^seconds/d' out >first
for spelling in "--source=source.txt --cells=20 --method=gradient" "-s source.txt -n 20 -m gradient" \
    "-ssource.txt -n20 -mgradient" "-q -n20 -m gradient -s source.txt" "-qs source.txt --threads=1 --cells 20 --improve 0 --method gradient --function decay --tree thesis"; do
    # shellcheck disable=SC2086
    run 0 info $spelling
    sed '/^seconds/d' out >second
    same first second "$spelling"
done
finish
