#!/bin/sh
# check, info and mesh.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

# first_line TEXT: what check says first.
first_line() {
    head -n 1 out | grep -qE -- "^$1" || complain "the first line is not '$1': $(cat out)"
}

# Certified charts and maps.
for method in foliation disc; do
    run 0 check -s source.txt -t target.txt -m "$method" --map curves
    first_line 'one-to-one: yes, certified$'
    holds out 'source.txt: a simple polygon, 6 vertices, counter-clockwise, area 75'
    holds out "source.txt: $method chart certified"
    holds out "target.txt: $method chart certified"
    holds out 'map: curves, certified one-to-one'
    [ ! -s err ] || complain "certified, but: $(cat err)"
    run 0 check -s source.txt -t target.txt -m "$method" --map curves --json
    holds out '"certified": true'
    holds out "\"method\": \"$method\""
    run 0 check -s source.txt -m "$method"
    first_line 'one-to-one: yes, certified$'
    grep -q '^map' out && complain "a map without a target"
done

# The default is the mesh map, improved or not.
for improve in "" "--improve 0" "--improve 2"; do
    # shellcheck disable=SC2086
    run 0 check -s source.txt -t target.txt $improve
    grep -q 'map: mesh, certified one-to-one: all [0-9]* triangles keep' out || complain "no mesh: $(cat out)"
done
run 0 info -s source.txt -t target.txt --improve 0
holds out 'map         mesh, certified'
holds out '(steps: 0, refinements: 0)'
awk '$1 == "energy" { print $2 + 0 }' out >before
run 0 info -s source.txt -t target.txt --json
awk -F '[:,]' '/"energy_before"/ { before = $2 } /"energy"/ { after = $2 } /"steps"/ { steps = $2 }
    END { exit !(steps > 0 && after >= 4 && after < before) }' out || complain "not improved: $(cat out)"

# Valid, but not certifiable.
run 1 check -s source.txt -t target.txt -m gradient
first_line "one-to-one: not proved: the source's chart: the curves of method gradient merge$"
holds out 'source.txt: a simple polygon, 6 vertices, counter-clockwise, area 75'
holds err 'not certifiable'
[ "$(wc -l <err)" -eq 1 ] || complain "stderr is not one line"
run 1 check -s source.txt -m gradient
first_line 'one-to-one: not proved: the curves of method gradient merge$'
run 1 check -s source.txt -m gradient --json
holds out '"certified": false'

# Two certified charts of method field, and a map that loses the digits between them: it says so, as does info.
awk 'BEGIN { for (i = 0; i < 90; ++i) print cos(i * 0.0698131700798), sin(i * 0.0698131700798) }' >round
awk '{ print $1, $2 * 0.05 }' round >flat
awk '{ print $1, $2 * 0.7 }' round >mild
run 0 check -s round -t mild -m field -n 64
holds out 'map: curves, certified one-to-one'
run 1 check -s round -t flat -m field -n 64
first_line 'one-to-one: not proved: [1-9][0-9]* of [0-9]* sample points do not come back'
[ "$(grep -c 'field chart certified' out)" -eq 2 ] || complain "not both charts: $(cat out)"
grep -q '^map: curves, not certified: [1-9][0-9]* of [0-9]* sample points do not come back' out || complain "no reason: $(cat out)"
holds err 'the map is not certified'
run 1 check -s round -t flat -m field -n 64 --json
for line in '"not_certified_because": "' '"samples_lost": ' '"samples_flat": '; do
    holds out "$line"
done
run 0 info -s round -t flat -m field -n 64
grep -q '^            because [1-9][0-9]* of [0-9]* sample points do not come back' out || complain "info gives no reason: $(cat out)"
run 0 info -s round -t flat -m field -n 64 --json
holds out '"not_certified_because": "'
# Only what is amiss is named.
grep -q '[^0-9]0 of' out && complain "a reason that is none"

# Every crossing is listed, on its line.
printf '0 0\n10 0\n10 10\n7 -5\n4 10\n1 -5\n0 10\n' >crossed
run 1 check -s crossed
first_line 'one-to-one: not proved: 4 defects$'
[ "$(grep -c 'crosses' out)" -eq 4 ] || complain "not 4 crossings: $(cat out)"
holds out 'crossed:1: the edge from vertex 0 crosses the edge from vertex 2 (line 3)'
holds err 'libicc: crossed: 4 defects'
run 1 check -s crossed --repair mended
[ ! -e mended ] || complain "a cage that is not valid was written"
holds err 'nothing was written'

# A repeated vertex and a spike are mended, in both cages alike.
printf '0 0\n4 0\n4 0\n4 2\n4 4\n4 6\n4 4\n0 4\n' >spiked
printf '0 0\n4 0\n5 0\n5 2\n5 4\n5 5\n4.5 5\n0 5\n' >partner
run 0 check -s spiked --repair mended
run 0 check -s mended
holds out 'mended: a simple polygon, 5 vertices'
run 0 check -s spiked -t partner --repair both.geojson
run 0 check -s both.geojson -t both.geojson
[ "$(grep -c 'a simple polygon, 5 vertices' out)" -eq 2 ] || complain "not mended: $(cat out)"

# info.
run 0 info -s source.txt -t target.txt -m gradient
for line in 'cage        6 vertices' 'method      gradient' 'maximum ' 'tree ' 'critical    1 maxima, 0 minima, 0 saddles' \
    'unreachable' 'uncovered' 'collapsed' 'not inward' 'map ' 'seconds'; do
    holds out "$line"
done
for method in foliation disc; do
    run 0 info -s source.txt -t target.txt -m "$method"
    for line in 'cage        6 vertices' "method      $method, certified" 'maximum ' 'mesh ' \
        '  0.00 % collapses, 0.00 % inverts, 0.00 % has no image' 'distortion  mean ' 'seconds'; do
        holds out "$line"
    done
    grep -qE '^(tree|critical|uncovered)' out && complain "$method has no tree"
    run 0 info -s source.txt -t target.txt -m "$method" --json
    holds out '"certified": true'
done
# Nothing is distorted where nothing changes, whatever the size.
awk '{ print 3 * $1, 3 * $2 }' source.txt >larger.txt
run 0 info -s source.txt -t larger.txt
awk '$1 == "distortion" { found = $3 + 0 > 3.999 && $3 + 0 < 4.01 } END { exit !found }' out ||
    complain "distortion of a similarity: $(cat out)"
run 0 info -s source.txt --maximum 2.5,2.5 --cells 20 -m gradient
awk '$1 == "maximum" { dx = $2 - 2.5; dy = $3 - 2.5; found = dx * dx + dy * dy <= 0.125 + 1e-9 }
     END { exit !found }' out || complain "not the nearest grid vertex: $(cat out)"

# mesh: the file stays as it is but for two numbers a vertex.
cat >mesh.obj <<'END'
# two triangles
mtllib a.mtl
v 5 0 7 1.0
v  10 0	0
v 10 2.5 0
v 7.5 5 0
vt 0 0
f 1/1 2/1 3/1
f -4 -2 -1
END
run 0 mesh -s source.txt -t target.txt mesh.obj out.obj
holds out '2 triangles: 2 keep their orientation, 0 inverted, 0 collapsed'
holds out 'mesh and image are certified one-to-one'
run 0 mesh -s source.txt -t target.txt --json mesh.obj out.obj
holds out '"certified": true'
run 0 mesh -s source.txt -t target.txt -i out.obj back.obj
grep '^v ' mesh.obj | awk '{ print $2, $3, $4 }' >expected
grep '^v ' back.obj | awk '{ print $2, $3, $4 }' >got
close_to got expected 1e-12
grep -v '^v ' mesh.obj >expected
grep -v '^v ' out.obj >got
same got expected "what is no vertex"
holds out.obj ' 7 1.0'
printf 'OFF # plane\n4 2 0\n5 0 0\n10 0 0\n10 2.5 0\n7.5 5 0\n3 0 1 2 255 0 0\n4 0 1 2 3\n' >mesh.off
run 0 mesh -s source.txt -t target.txt mesh.off out.off
holds out '1 triangles: 1 keep their orientation'
holds out '1 quadrilaterals: 1 positive, 0 inverted, 0 undecided, 0 not positive before, 0 without image'
printf 'v 5 0\nv 10 0\nv 10 0\nv 8 8\nf 1 2 3\nf 1 2 4\n' >flat.obj
run 4 mesh -s source.txt -t target.txt --outside keep flat.obj out.obj
holds out '0 keep their orientation, 0 inverted, 0 collapsed, 1 flat before, 1 without image'
holds out '; not certified'
holds err '1 of 4 vertices have no image and stay where they are; the first is vertex 3 (from 0), outside'
[ "$(sed -n 4p out.obj)" = 'v 8 8' ] || complain "the vertex outside has moved"
# Two triangles beside each other on the cage are fine one by one, but overlap together.
printf 'v 0 0\nv 5 0\nv 5 5\nv 0 5\nf 1 2 3\nf 1 2 4\n' >overlap.obj
run 0 mesh -s source.txt -t target.txt overlap.obj out.obj
holds out '2 keep their orientation'
holds out 'not certified: simplices 0 and 1 lie on the same side of edge (0, 1), so they overlap'

run 1 mesh -s source.txt -t target.txt --require certified overlap.obj out.obj
# The outer two corners of a triangle lie on the outline, and so does the third: no vertex can be moved.
printf '0 0\n10 0\n10 10\n0 10\n' >square.txt
printf '0 0\n10 0\n3 2\n0 10\n' >dart.txt
printf 'v 0 0\nv 10 0\nv 10 10\nv 0 10\nf 1 2 4\nf 2 3 4\n' >ear.obj
for option in '' --untangle; do
    # shellcheck disable=SC2086 # an option or none
    run 4 mesh -s square.txt -t dart.txt $option ear.obj out.obj
    holds out '2 triangles: 1 keep their orientation, 1 inverted'
    holds err '1 of 2 triangles is inverted or collapsed (numbers from 0: 1): all three corners lie on the boundary'
    [ -e out.obj ] || complain "nothing was written"
done
run 4 mesh -s square.txt -t dart.txt --json=report.json ear.obj out.obj
tr -d ' \n' <report.json >flat.json
holds flat.json '"turned":[1],"turned_on_boundary":[1]'
cp out.obj dart.obj
run 1 mesh -s square.txt -t dart.txt --require certified --untangle ear.obj out.obj
run 1 mesh -s square.txt -t dart.txt --require certified --inverse dart.obj out.obj
holds err "not certified from target to source"

make_cubes
# --require certified: refused is what is not certified, and 4 becomes 1.
rm -f images
run 1 map -s square.txt -t dart.txt -m gradient --require certified -p points.txt -o images
says 'the map is not certified, so nothing is written'
[ ! -e images ] || complain "the images of a map that is not certified were written"
run 0 map -s square.txt -t dart.txt --require certified -p points.txt -o images
printf '1 1\n50 50\n' >far.txt
run 4 map -s square.txt -t dart.txt -p far.txt -o images
run 1 map -s square.txt -t dart.txt --require certified -p far.txt -o images
printf '{"type": "Point", "coordinates": [50, 50]}' >far.geojson
run 4 map -s square.txt -t dart.txt --geojson far.geojson out.geojson
run 1 map -s square.txt -t dart.txt --geojson --require certified far.geojson out.geojson
run 1 map -s square.txt -t dart.txt -m gradient --geojson --require certified far.geojson out.geojson
run 0 check -s square.txt -t dart.txt --require certified
run 1 check -s square.txt -t dart.txt --require certified -m gradient
run 1 check -s cube.obj --require certified
holds err 'there is no map or chart to certify'
run 0 check -s cube.obj --require certified -m foliation
run 2 check -s square.txt -t dart.txt --require exact
says "it may be: certified"
run 2 warp -s square.txt -t dart.txt --require certified in.png out.png

# A mesh that is sampled from a one-to-one map can invert; --repair moves its inner vertices.
awk -v n=20 'BEGIN { h = 10 / n
    for (j = 0; j <= n; j++) for (i = 0; i <= n; i++) if (i <= n / 2 || j <= n / 2) {
        id[i, j] = ++k; printf "v %.17g %.17g\n", i * h, j * h }
    for (j = 0; j < n; j++) for (i = 0; i < n; i++) if (i < n / 2 || j < n / 2)
        printf "f %d %d %d\nf %d %d %d\n", id[i, j], id[i + 1, j], id[i + 1, j + 1],
            id[i, j], id[i + 1, j + 1], id[i, j + 1] }' >grid.obj
printf '0 0\n1 -3\n2 9\n9 9\n3 12\n-6 2\n' >bent.txt
run 4 mesh -s source.txt -t bent.txt grid.obj out.obj
holds out '; not certified'
holds err '--untangle moves inner vertices'
grep -q ' 0 inverted' out && complain "nothing to repair: $(cat out)"
rm out.obj
run 1 mesh -s source.txt -t bent.txt --require certified grid.obj out.obj
holds err 'the mesh and its image are not certified, so nothing was written'
[ ! -e out.obj ] || complain "what is not certified was written"
run 0 mesh -s source.txt -t bent.txt --require certified --untangle grid.obj out.obj
[ -e out.obj ] || complain "what is certified was not written"
run 0 mesh -s source.txt -t bent.txt --repair grid.obj out.obj
holds out '600 triangles: 600 keep their orientation, 0 inverted, 0 collapsed'
holds out 'mesh and image are certified one-to-one'
[ "$(grep -c '^v ' out.obj)" -eq 341 ] || complain "vertices were added or lost"

printf 'v 5 0\nv 10 zero\n' >bad
run 1 mesh -s source.txt -t target.txt bad out.obj
says "libicc: bad:2: 'zero'"
printf 'v 5 0\nf 1 2 3\n' >bad
run 1 mesh -s source.txt -t target.txt bad out.obj
says 'libicc: bad:2: the face has the vertex 2; there are 1 so far'
printf 'v 5 0\nv 6 0\nf 1 0 2\n' >bad
run 1 mesh -s source.txt -t target.txt bad out.obj
says 'libicc: bad:3: the face has the vertex 0'
printf 'OFF\n2 1 0\n5 0 0\n' >bad
run 1 mesh -s source.txt -t target.txt bad out.obj
says 'libicc: bad:4: the file ends early'
printf 'nothing\n' >bad
run 1 mesh -s source.txt -t target.txt bad out.obj
says 'libicc: bad: there are no vertices'

# Of a star all of whose edges cross the list ends, and says so.
awk 'BEGIN { for (k = 0; k < 801; k++) { a = 8 * atan2(1, 1) * (k * 400 % 801) / 801; printf "%.17g %.17g\n", cos(a), sin(a) } }' >star.txt
run 1 check -s star.txt
holds out 'there may be more defects; the list ends here, after 13204'
finish
