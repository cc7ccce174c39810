#!/bin/sh
# Points: order, exit codes, what has no image, reports, files, threads, locale.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

# The cage goes to the cage, vertices and edges.
run 0 map -s source.txt -t target.txt -p source.txt
close_to out target.txt 1e-12
run 0 map -s source.txt -t target.txt -p target.txt --inverse
close_to out source.txt 1e-12
printf '5 0\n10 2.5\n7.5 5\n' >middles.txt
printf '6 0.5\n12 3.5\n9.25 6.5\n' >expected
run 0 map -s source.txt -t target.txt -p middles.txt
close_to out expected 1e-12

# On the cage, there and back is where one began, also through the coordinates.
run 0 map -s source.txt -t target.txt -p middles.txt -o there
run 0 map -s source.txt -t target.txt -p there -i
close_to out middles.txt 1e-12
run 0 encode -s source.txt -p middles.txt -o coords
run 0 decode -s source.txt --coords coords
close_to out middles.txt 1e-12
run 0 encode -s source.txt -p points.txt
awk '{ if (NF != 4 || $1 != int($1) || $1 < 0 || $1 > 5 || $2 < 0 || $3 < 0 || $4 < 0 || $4 > 1 ||
           $2 + $3 < 1 - 1e-12 || $2 + $3 > 1 + 1e-12) bad = 1 } END { exit bad || NR != 5 }' out ||
    complain "these are no coordinates: $(cat out)"

# The certified methods bring every point back, from anywhere inside.
awk 'BEGIN { for (i = 0; i < 500; i++) { x = (i * 0.618034) % 1 * 10; y = (i * 0.754878) % 1 * 10
             if (x > 0 && y > 0 && (x < 5 || y < 5)) printf "%.17g %.17g\n", x, y } }' >inside.txt
for method in foliation disc; do
    for map in mesh curves; do
        run 0 map -s source.txt -t target.txt -m "$method" --map "$map" -p inside.txt -o there
        run 0 map -s source.txt -t target.txt -m "$method" --map "$map" -p there -i
        close_to out inside.txt 1e-12
        run 0 map -s source.txt -t target.txt -m "$method" --map "$map" -p source.txt
        close_to out target.txt 1e-12
    done
    run 0 encode -s target.txt -m "$method" -p there -o coords
    run 0 decode -s target.txt -m "$method" --coords coords
    close_to out there 1e-12
done

# A point without an image: nan, exit 4, its count on stderr; the others keep their place.
printf '5 0\n8 8\nnan 1\n5 0\n' >some.txt
run 4 map -s source.txt -t target.txt -p some.txt
holds err "libicc: 2 of 4 points have no image: 1 outside the cage, 0 that the curves do not reach, 1 not finite"
[ "$(wc -l <err)" -eq 1 ] || complain "stderr is not one line"
[ "$(sed -n '2,3p' out | sort -u)" = "nan nan" ] || complain "not nan: $(cat out)"
[ "$(sed -n 1p out)" = "$(sed -n 4p out)" ] || complain "the order is lost"
run 4 encode -s source.txt -p some.txt -o coords
[ "$(sed -n 2p coords)" = "nan nan nan nan" ] || complain "not nan: $(cat coords)"
run 4 decode -s source.txt --coords coords
[ "$(sed -n 2p out)" = "nan nan" ] || complain "not nan: $(cat out)"
printf '0 0.7 0.7 0.5\n0 0.5 0.5 1.5\n' | run 4 decode -s source.txt
holds err '2 not finite or out of range'
printf '' | run 0 map -s source.txt -t target.txt
[ ! -s out ] || complain "no points, but images: $(cat out)"

# Numbers come out as they went in: every double survives %.17g.
printf '0.1 0.1\n0.30000000000000004 1e-300\n' >exact.txt
printf '0 0\n1 0\n1 1\n0 1\n' >square.txt
run 0 encode -s square.txt -p exact.txt

# The report.
run 4 map -s source.txt -t target.txt -p some.txt -o images --json=report.json
[ ! -s out ] || complain "the report went to stdout"
for member in '"command": "map"' '"source": "source.txt"' '"points": 4' '"without_image": 2' '"vertices": 6'; do
    holds report.json "$member"
done
run 4 map -s source.txt -t target.txt -p some.txt -o images --json
holds out '"points": 4'
run 0 info -s source.txt -t target.txt --json -m gradient
holds out '"cousin_violations": 0'
holds out '"inverted":'

# A result is written whole or not at all, and the old one stays until then.
printf 'old\n' >images
run 1 map -s source.txt -t bad -p points.txt -o images
holds images old
run 1 map -s source.txt -t target.txt -p points.txt -o nowhere/images
says 'libicc: nowhere/images: cannot be written'
ls ./*.part 2>/dev/null && complain "a temporary file was left behind"
if [ -w /dev/full ]; then
    awk 'BEGIN { for (i = 0; i < 3000; i++) print 1, 1 }' >long.txt
    for full in "map -s source.txt -t target.txt -p points.txt" "map -s source.txt -t target.txt -p long.txt" \
        "encode -s source.txt -p long.txt" "check -s source.txt -t target.txt" "check -s source.txt --json" \
        "info -s source.txt" "plot -s source.txt -" "--help" "map --help" "--version"; do
        # shellcheck disable=SC2086 # words
        "${tool:?}" $full >/dev/full 2>err
        [ $? -eq 1 ] || complain "a full disk was not noticed: $full"
        : >out
        says 'libicc: standard output: cannot be written: '
    done
    run 1 map -s source.txt -t target.txt -p points.txt -o /dev/full
    says 'libicc: /dev/full: cannot be written: '
fi

# A link goes on being one, and its file is written whole or not at all.
mkdir -p kept && printf 'old\n' >kept/images && ln -s kept/images link
run 0 map -s source.txt -t target.txt -p points.txt -o link
run 0 map -s source.txt -t target.txt -p points.txt
[ -L link ] || complain "the link was replaced by a file"
same kept/images out "through a link"
ln -s kept/later nowhere.txt
run 0 map -s source.txt -t target.txt -p points.txt -o nowhere.txt
[ -L nowhere.txt ] || complain "the link to nowhere was replaced"
same kept/later kept/images "through a link to nowhere"

# The triangles of the map, as PROJ reads them: all the cage's vertices with their images, counter-clockwise before and
# after, and both areas; whole or not at all.
run 0 map -s source.txt -t target.txt -p points.txt --triangulation mesh.json
cp out expected
run 0 map -s source.txt -t target.txt --triangulation again.json </dev/null
[ ! -s out ] || complain "no points, but images"
same mesh.json again.json
run 0 map -s source.txt -t target.txt -i -p target.txt --triangulation again.json
same mesh.json again.json "the inverse"
for member in '"file_type": "triangulation_file"' '"format_version": "1.1"' '"transformed_components": ["horizontal"]' \
    '"fallback_strategy": "none"' '"vertices_columns": ["source_x", "source_y", "target_x", "target_y"]' \
    '"triangles_columns": ["idx_vertex1", "idx_vertex2", "idx_vertex3"]'; do
    holds mesh.json "$member"
done
tr -d '[],' <mesh.json | awk '
    function area(x, y, i, j, k) { return ((x[j] - x[i]) * (y[k] - y[i]) - (x[k] - x[i]) * (y[j] - y[i])) / 2 }
    BEGIN { n = 0 } /"vertices":/ { part = 1; next } /"triangles":/ { part = 2; next }
    part == 1 && NF == 4 { x[n] = $1; y[n] = $2; u[n] = $3; v[n] = $4; n++ }
    part == 2 && NF == 3 { a = area(x, y, $1, $2, $3); b = area(u, v, $1, $2, $3); before += a; after += b
                           if (!(a > 0 && b > 0)) bad = 1 }
    END { exit bad || before < 75 - 1e-9 || before > 75 + 1e-9 || after < 105 - 1e-9 || after > 105 + 1e-9 }' ||
    complain "these are not the triangles of the map"
paste -d ' ' source.txt target.txt | while read -r line; do
    holds mesh.json "[$(echo "$line" | sed 's/ /, /g')]"
done
printf 'old\n' >mesh.json
# The bar of a dumb-bell that is four units in the last place wide: rounding spoils triangles of the file, which is said.
bell() {
    for p in 0,0 1,0 1,.5 3,.5 4,0 5,0 5,1 4,1 "3,.5+$1" "1,.5+$1" 1,1 0,1; do
        echo "$p"
    done | sed 's/\.5+/.5 /; s/,/ /' | awk -v offset="$2" '{ printf "%.17g %.17g\n", offset + $1, offset + ($2 + $3) }'
}
bell .25 0 >bell.txt
bell 4.76837158203125e-7 1073741824 >far.txt
bell 4.76837158203125e-7 0 >near.txt
run 4 map -s bell.txt -t far.txt --triangulation far.json </dev/null
says 'triangles are flat or reversed when their numbers are rounded'
rm far.json
run 1 map -s bell.txt -t far.txt --triangulation far.json --require certified </dev/null
[ ! -e far.json ] || complain "far.json was written"
run 0 map -s bell.txt -t near.txt --triangulation far.json --require certified </dev/null

run 1 map -s source.txt -t target.txt -p some.txt --outside fail --triangulation mesh.json
run 1 map -s source.txt -t target.txt -p nowhere --triangulation mesh.json
run 2 map -s source.txt -t target.txt -p points.txt -m gradient --triangulation mesh.json
says '--triangulation needs a mesh map'
run 2 map -s source.txt -t target.txt -p points.txt --triangulation -
says '--triangulation goes to a file'
run 2 map -s source.txt -t target.txt -p points.txt --triangulation mesh.png
[ "$(cat mesh.json)" = old ] || complain "a triangulation was written where nothing should be"
run 1 map -s source.txt -t target.txt -p points.txt --triangulation nowhere/mesh.json
says 'libicc: nowhere/mesh.json: cannot be written'
make_cubes
run 1 map -s cube.obj -t moved.obj -p points.txt --triangulation mesh.json
says '3 dimensions; --triangulation needs cages in the plane'

# Threads and locale do not change a bit.
awk 'BEGIN { for (i = 0; i < 3000; i++) printf "%.6f %.6f\n", (i * 0.618034) % 1 * 10, (i * 0.754878) % 1 * 10 }' >many.txt
run 4 map -s source.txt -t target.txt -p many.txt -j 1
mv out one
for threads in 2 3 8; do
    run 4 map -s source.txt -t target.txt -p many.txt -j "$threads"
    same out one "$threads threads"
done
for locale in $(locale -a 2>/dev/null | grep -E '^(de_DE|fr_FR|cs_CZ)' | head -n 2); do
    LC_ALL=$locale run 4 map -s source.txt -t target.txt -p many.txt
    same out one "$locale"
done
finish
