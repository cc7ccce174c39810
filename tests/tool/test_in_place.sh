#!/bin/sh
# No command writes over one of its inputs, by whatever name the output goes, nor two outputs into one file. This is
# said before anything is read, so that the inputs here need not be what they are called.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

mkdir folder
for name in x y z; do echo "only copy of $name" >"$name"; done
cp x expected
ln -s "$PWD/x" folder/link
ln -s "$PWD/folder" elsewhere
ln x folder/hard
names="x ./x $PWD/x folder/../x folder/link elsewhere/link folder/hard"

# refused WORDS ARGUMENT...: for each name of x in place of OVER.
refused() {
    words=$1
    shift
    for name in $names; do
        line=
        for word in "$@"; do line="$line $(echo "$word" | sed "s|OVER|$name|")"; done
        # shellcheck disable=SC2086 # words without blanks
        run 2 $line
        says "$words"
        says 'write to another file'
        same x expected "libicc$line"
    done
}

# The file that is carried.
over="would be written over an input, 'x' of"
refused "OUT $over IN" warp -s y -t z x OVER
refused "OUT $over IN" pose -s y -a z --pose points.txt x OVER
refused "OUT $over IN" mesh -s y -t z x OVER
refused "OUT $over IN" mesh -s y -t z --outside keep --untangle x OVER
refused "OUT $over SURFACE" mesh --fill x OVER
refused "--output $over --points" encode -s y -p x -o OVER
refused "--output $over --coords" decode -s y --coords x -o OVER
refused "--output $over --points" weights -s y -a z -p x -o OVER
# A cage, or whatever else is read.
refused "OUT $over --source" warp -s x -t y z OVER
refused "OUT $over --target" mesh -s y -t x z OVER
refused "OUT $over --target" plot -s y -t x OVER
refused "OUT $over --mesh" mesh -s y -t z --mesh x y OVER
refused "OUT $over --target-mesh" mesh -s y -t z --mesh y --target-mesh x y OVER
refused "OUT $over --source" map -s x -t y --geojson z OVER
refused "OUT $over --landmarks" warp -s y -t z --match x y OVER
refused "OUT $over --handles" pose -s y -a x --pose z y OVER
refused "OUT $over --pose" pose -s y -a z --pose x y OVER
refused "OUT $over --binding" pose --binding x --pose y OVER
refused "--output $over --target" map -s y -t x -p z -o OVER
refused "--output $over --source" match -s x -t y -o OVER
refused "--target-output $over --target" match -s y -t x -o z --target-output OVER
refused "--triangulation $over --source" map -s x -t y --triangulation OVER
refused "--ties $over --target" map -s y -t x --ties OVER
refused "--repair $over --source" check -s x --repair OVER
refused "--boundary $over --source" check -s x --boundary OVER
refused "--picture $over --handles" weights -s y -a x --picture OVER
refused "--binding $over --points" weights -s y -a z -p x --binding OVER
refused "--json $over --source" info -s x --json=OVER
refused "--json $over IN" warp -s y -t z x other --json=OVER
refused "--json $over CAGE" animate -s y z film y x --json=OVER
# One shape of a file, and a file whose name has a #.
run 2 check -s 'x#body' --repair folder/link
says "--repair would be written over an input, 'x#body' of --source; write to another file"
cp x 'a#b'
run 2 check -s 'a#b' --repair './a#b'
says "would be written over an input, 'a#b' of --source"
# What comes through standard input.
run 2 warp -s y -t z - folder/link <x
says "OUT would be written over an input, '-' of IN; write to another file"
same x expected "through standard input"

# A frame.
mv x film-0002.png
run 2 animate -s y film-0002.png film.png y z y
says "OUT would be written over an input, 'film-0002.png' of IN; write to another file"
run 2 animate -s film-0002.png z film.png y z y
says "OUT would be written over an input, 'film-0002.png' of --source"
run 2 animate -s y z --steps 2 film.png y film-0002.png
says "OUT would be written over an input, 'film-0002.png' of CAGE"
same film-0002.png expected "frames"
[ ! -e film-0000.png ] || complain "frames were written"
mv film-0002.png x

# Two outputs.
run 2 match -s y -t z -o new --target-output new
says "--output and --target-output are one file, 'new'; write to two"
run 2 warp -s y -t z points.txt folder/hard --json=folder/link
says "--json and OUT are one file, 'folder/hard'; write to two"
run 2 map -s y -t z -o new.json --triangulation new.json
for name in new new.json; do [ ! -e "$name" ] || complain "$name was written"; done
same x expected "two outputs"
run 0 map -s source.txt -t target.txt -p points.txt -o /dev/null --json=/dev/null

# Points and layers whose images are all there may be replaced by them, which is said.
cp points.txt p.txt
run 0 map -s source.txt -t target.txt -p points.txt -o expected
run 0 map -s source.txt -t target.txt -p p.txt -o ./p.txt
[ "$(cat err)" = "libicc: ./p.txt: the points are replaced by their images" ] || complain "not said: $(cat err)"
same p.txt expected "points over themselves"
echo '{"type": "Point", "coordinates": [1, 1]}' >one.geojson
run 0 map -s source.txt -t target.txt --geojson one.geojson one.geojson
[ "$(cat err)" = "libicc: one.geojson: the layer is replaced by its image" ] || complain "not said: $(cat err)"

finish
