#!/bin/sh
# plot: a drawing of well-formed XML with what it must hold.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

well_formed() {
    if command -v xmllint >/dev/null; then
        xmllint --noout "$1" || complain "$1 is not well-formed"
    fi
    [ "$(grep -o '<g[ >]' "$1" | wc -l)" -eq "$(grep -o '</g>' "$1" | wc -l)" ] || complain "$1 has open groups"
    if sed 's/base64,[^"]*//' "$1" | grep -qiE '[^a-z](nan|inf)[^a-z]'; then
        complain "$1 holds numbers that are none"
    fi
}

run 0 plot -s source.txt -m gradient drawing.svg
[ ! -s out ] || complain "plot writes to stdout"
for part in '<svg ' '<clipPath' 'image/png;base64' 'function and integral curves' 'fill="#dc2626"' '</svg>'; do
    holds drawing.svg "$part"
done
well_formed drawing.svg
run 0 plot -s source.txt -m gradient -
same out drawing.svg "on standard output"

# A certified method has leaves from every boundary point, and nothing without coordinates (rose).
for method in foliation disc; do
    run 0 plot -s source.txt -t target.txt -m "$method" --map curves --lines 77 drawing.svg
    for part in 'source: integral curves' 'target: checkerboard' 'target: uv map'; do
        holds drawing.svg "$part"
    done
    well_formed drawing.svg
    leaves=$(grep -A1 'stroke="#1d4ed8"' drawing.svg | grep -o M | wc -l)
    [ "$leaves" -ge 154 ] || complain "$leaves leaves instead of 77 in each shape with $method"
    run 2 plot -s source.txt -m "$method" --elevation drawing.svg
    says '--elevation needs --method gradient'
done

# What is drawn is the map that `map` makes: of a mesh its triangles, and no curves of the charts it began with.
for options in '' '--triangles' '-m foliation' '--improve 0'; do
    # shellcheck disable=SC2086 # words
    run 0 plot -s source.txt -t target.txt $options drawing.svg
    holds drawing.svg 'target: triangles of the map'
    if grep -qE 'stroke="#1d4ed8"|integral curves' drawing.svg; then complain "curves of a mesh map: plot $options"; fi
    well_formed drawing.svg
    cp drawing.svg "drawn$options.svg"
done
same 'drawn--triangles.svg' drawn.svg
if cmp -s 'drawn--improve 0.svg' drawn.svg; then complain "--improve changes nothing"; fi
run 2 plot -s source.txt -t target.txt --lines 7 drawing.svg
says '--lines draws integral curves, which a mesh map does not have; add --map curves'

run 0 plot -s source.txt -t target.txt -m gradient --elevation --compression --y-down --lines 20 drawing.svg
for part in 'source: checkerboard' 'target: uv map' 'target: elevation' 'source: function'; do
    holds drawing.svg "$part"
done
well_formed drawing.svg
run 0 plot -s source.txt -m gradient --cells 400 --elevation --function distance --tree paper drawing.svg
well_formed drawing.svg

# Shapes at odd places and of odd sizes.
awk '{ print $1 + 1e9, $2 - 1e9 }' OFMT=%.17g source.txt >far.txt
awk '{ print $1 "e-300", $2 "e-300" }' source.txt >small.txt
awk '{ print $1 * 1000, $2 }' source.txt >wide.txt
for cage in far.txt small.txt wide.txt; do
    run 0 plot -s "$cage" -m gradient --elevation drawing.svg
    well_formed drawing.svg
    run 0 plot -s "$cage" drawing.svg
    well_formed drawing.svg
done

# In space: a plane takes a half away, and the picture is a PNG or in an SVG.
make_cubes
# pixels FILE: a PNG's width and height.
pixels() {
    od -A n -t u1 -j 16 -N 8 "$1" | awk '{ print 256 * $3 + $4, 256 * $7 + $8 }'
}
for kind in "--map mesh" "--map curves" "--method field"; do
    # shellcheck disable=SC2086 # two words
    run 0 plot -s cube.obj -t moved.obj $kind drawing.svg
    for part in 'source: cut' 'target: image of the cut' 'clip-path="url(#side-1)"'; do
        holds drawing.svg "$part"
    done
    well_formed drawing.svg
    # shellcheck disable=SC2086
    run 0 plot -s cube.obj -t moved.obj $kind drawing.png
    [ ! -s out ] || complain "plot writes to stdout"
    pixels drawing.png | awk '{ exit !($1 > 400 && $1 < 1100 && $2 > 200 && $2 < 480) }' ||
        complain "a picture of $(pixels drawing.png)"
done
cp drawing.png first.png
run 0 plot -s cube.obj -t moved.obj --method field --threads 1 drawing.png
same drawing.png first.png "with one thread"
run 0 plot -s cube.obj -t moved.obj --slice 0.5,0.5,0.2,0,0,-3 --view 1,1,-2 drawing.png
cmp -s drawing.png first.png && complain "--slice and --view change nothing"
run 0 plot -s cube.obj -t moved.obj --slice 0.5,0.5,0.2,0,0,-1 --view 2,2,-4 again.png
same drawing.png again.png "lengths of vectors"
for scale in e-200 e200; do
    sed "s/^v \(.*\) \(.*\) \(.*\)/v \1$scale \2$scale \3$scale/" cube.obj >odd.obj
    run 0 plot -s odd.obj -t odd.obj drawing.svg
    well_formed drawing.svg
done
refuses() { # EXIT MESSAGE ARGUMENT...
    code=$1
    message=$2
    shift 2
    run "$code" plot "$@" none.png
    says "$message"
    [ ! -e none.png ] || complain "a picture was written: $*"
}
cubes='-s cube.obj -t moved.obj'
# shellcheck disable=SC2086 # four words
{
    refuses 1 'the plane of --slice misses the shape' $cubes --slice 0,0,2,0,0,1
    refuses 1 'the plane of --slice misses the shape' $cubes --slice 0,0,-1e300,0,0,1
    refuses 2 '--slice has a normal of length 0' $cubes --slice 1,1,1,0,0,0
    refuses 2 '--slice must be NX,NY,NZ or X,Y,Z,NX,NY,NZ' $cubes --slice 1,1
    refuses 2 '--view must be X,Y,Z, and not 0,0,0' $cubes --view 0,0,0
    refuses 2 '--view must be X,Y,Z, and not 0,0,0' $cubes --view 1,1
    refuses 2 '--view must be in front of the plane' $cubes --slice 0,0,1 --view 1,1,-0.1
    refuses 2 '--triangles is for drawings in the plane' $cubes --triangles
    refuses 2 '--lines is for drawings in the plane' $cubes --lines 7
    refuses 2 '--y-down is for drawings in the plane' $cubes --y-down
}
refuses 2 'a drawing in space shows a map: add --target FILE' -s cube.obj
refuses 2 "'rsvg-convert OUT.svg -o OUT.png' makes a PNG of OUT.svg" -s source.txt
if command -v rsvg-convert >/dev/null; then
    rsvg-convert drawing.svg -o remedy.png
    [ "$(head -c 4 remedy.png | tail -c 3)" = PNG ] || complain "the remedy makes no PNG"
fi
# One column's captions do not reach into the next: 280 pixels and the margin hold some 40 letters.
run 0 plot -s source.txt -t target.txt -m gradient -f laplace,distance drawing.svg
grep -oE '>[^<]*</text>' drawing.svg | awk 'length > 50 { print; bad = 1 } END { exit bad }' || complain "wide captions"
refuses 2 '--slice is for shapes in space' -s source.txt --slice 1,0,0
refuses 2 '--view is for shapes in space' -s source.txt --view 1,0,0

# A page for a browser: complete in itself, with as many numbers as it says, and cells that keep their sign.
run 0 plot -s source.txt -t target.txt --map mesh page.html
if grep -qE '(src|href)="?https?://' page.html; then complain "the page loads from the network"; fi
if command -v node >/dev/null; then
    cat >page.cjs <<'END'
const text = require('fs').readFileSync('page.html', 'utf8');
const d = JSON.parse(text.split('application/json">')[1].split('</script>')[0]);
const take = (s, type) => new type(Uint8Array.from(Buffer.from(s, 'base64')).buffer);
const [a, b, c] = [take(d.before, Float32Array), take(d.after, Float32Array), take(d.cells, Uint32Array)];
const at = (p, v) => [p[2 * v], p[2 * v + 1]];
const area = (p, [u, v, w]) => (v[0] - u[0]) * (w[1] - u[1]) - (v[1] - u[1]) * (w[0] - u[0]);
let bad = a.length !== 2 * d.vertices || b.length !== a.length || c.length !== 3 * d.simplices || !d.certified;
for (let t = 0; t < c.length; t += 3)
    for (const p of [a, b]) bad ||= !(area(p, [...c.subarray(t, t + 3)].map((v) => at(p, v))) > 0);
process.exit(bad || c.length === 0 ? 1 : 0);
END
    node page.cjs || complain "the page's data are wrong"
fi

echo old >drawing.svg
run 1 plot -s nowhere drawing.svg
holds drawing.svg old
run 1 plot -s source.txt no/where.svg
says 'libicc: no/where.svg: cannot be written'
finish
