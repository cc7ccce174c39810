#!/bin/sh
# Cages that are turned, or whose y points down: what is said of a match, and --y-down, whose results are those of cages
# with y reversed by hand, to the last digit; and that remedies work which messages name.
# usage: test_turned.sh TOOL SCRATCH
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# Reverses y in columns of x and y, and in GeoJSON with a position a line.
turn() {
    awk '{ for (i = 2; i <= NF; i += 2) $i = 0 - $i; print }' OFMT=%.17g CONVFMT=%.17g "$1"
}
turn_json() {
    sed 's/\(\[-*[0-9.e-]*, \)\(-*[0-9.e-]*\)\]/\1~\2]/g; s/~-//g; s/~0\]/0]/g; s/~/-/g' "$1"
}

# A cage with a hole, a line and a point, and the same bent.
up() {
    printf '{"type": "FeatureCollection", "features": [%s]}\n' \
        '{"type": "Feature", "properties": {"role": "source"}, "geometry": {"type": "Polygon", "coordinates": [
            [[0, 0], [8, 1], [9, 5], [1, 6], [0, 0]], [[1, 2], [2, 2], [2, 3], [1, 2]]]}},
         {"type": "Feature", "properties": {"role": "source", "feature": 1}, "geometry": {"type": "Point", "coordinates": [5, 2]}},
         {"type": "Feature", "properties": {"role": "source", "feature": 2}, "geometry": {"type": "LineString", "coordinates": [[3, 4], [6, 4.5]]}}'
}
other() {
    printf '{"type": "FeatureCollection", "features": [%s]}\n' \
        '{"type": "Feature", "properties": {"role": "target"}, "geometry": {"type": "Polygon", "coordinates": [
            [[0, -1], [8, 0.5], [10, 5], [1, 7], [0, -1]], [[1, 2], [2, 1.5], [2.5, 3], [1, 2]]]}},
         {"type": "Feature", "properties": {"role": "target", "feature": 1}, "geometry": {"type": "Point", "coordinates": [6, 2]}},
         {"type": "Feature", "properties": {"role": "target", "feature": 2}, "geometry": {"type": "LineString", "coordinates": [[3, 4], [6, 5]]}}'
}
up >up.geojson
other >target.geojson
turn_json up.geojson >down.geojson
turn_json target.geojson >target_down.geojson
holds down.geojson '[9, -5], [1, -6]'
printf '5 2\n3 4\n0 0\n4 1\n7 4\n50 50\n' >points
turn points >points_down
printf '{"type": "FeatureCollection", "features": [\n%s\n%s\n%s\n]}\n' \
    '{"type": "Feature", "properties": {"a": 1}, "geometry": {"type": "LineString", "coordinates": [[3, 1], [7, 4], [5, 20]]}},' \
    '{"type": "Feature", "properties": {"a": 2}, "geometry": {"type": "Polygon", "coordinates": [[[3, 1], [7, 1.5], [7, 4], [3, 1]]]}},' \
    '{"type": "Feature", "properties": {"a": 3}, "geometry": {"type": "Polygon", "coordinates": [[[0.5, 1], [4, 1], [4, 3.5], [0.5, 3.5], [0.5, 1]]]}}' \
    >layer.geojson
turn_json layer.geojson >layer_down.geojson
printf 'v %s\n' '3 1 0' '7 1.5 0' '6 4 0' '90 90 0' >up.obj
printf 'f 1 2 3\nf 1 3 4\n' >>up.obj
awk '$1 == "v" { $3 = 0 - $3 } { print }' up.obj >down.obj

# numbers FILE: all of them, one a line.
numbers() {
    tr -cs '0-9.e+\n-' ' ' <"$1" | tr -s ' ' '\n' | grep '[0-9]'
}

# The reference: nothing is turned. `way`: which of the two is turned, and where the results are.
for way in source target; do
    if [ $way = source ]; then
        s=down.geojson t=target.geojson
        from=down into=up back_from=up back_into=down
    else
        s=up.geojson t=target_down.geojson
        from=up into=down back_from=down back_into=up
    fi
    for inverse in '' --inverse; do
        [ -z "$inverse" ] || from=$back_from into=$back_into
        input=points
        [ $from = up ] || input=points_down
        run 4 map -s up.geojson -t target.geojson $inverse --outside keep -p points
        cp out expected
        if [ $into = down ]; then
            turn expected >turned
            mv turned expected
        fi
        # What is outside stays as it was given.
        sed '$d' expected >inside
        run 4 map -s $s -t $t --y-down=$way $inverse --outside keep -p $input
        sed '$d' out >found
        same found inside "map --y-down=$way $inverse"
        tail -n 1 out >found
        tail -n 1 $input >expected
        same found expected "map --y-down=$way $inverse, outside"
        for outside in null clip keep; do
            layer=layer.geojson
            [ $from = up ] || layer=layer_down.geojson
            run 4 map -s up.geojson -t target.geojson $inverse --outside $outside --geojson layer.geojson a.geojson
            run 4 map -s $s -t $t --y-down=$way $inverse --outside $outside --geojson $layer b.geojson
            # The digits; a ring that was cut may begin elsewhere. What was outside and kept has not been mapped.
            numbers a.geojson | tr -d '-' | sort -u >a
            numbers b.geojson | tr -d '-' | sort -u >b
            [ $outside = keep ] || same a b "map --geojson --outside $outside $inverse --y-down=$way"
        done
        mesh=up.obj
        [ $from = up ] || mesh=down.obj
        run 4 mesh -s up.geojson -t target.geojson $inverse --outside keep up.obj a.obj
        cp out a
        run 4 mesh -s $s -t $t --y-down=$way $inverse --outside keep $mesh b.obj
        same out a 'mesh'
        numbers a.obj | tr -d '-' >a
        numbers b.obj | tr -d '-' >b
        close_to a b 1e-12
    done
    run 0 map -s up.geojson -t target.geojson --triangulation a.json --ties a.geojson -p /dev/null
    run 0 map -s $s -t $t --y-down=$way --triangulation b.json --ties b.geojson -p /dev/null
    numbers a.json | tr -d '-' >a
    numbers b.json | tr -d '-' >b
    close_to a b 1e-12
    # Cages and ties come out as they were given: what is written is taken again.
    cp b.geojson ties_$way.geojson
    run 0 map -s ties_$way.geojson --y-down=$way -p /dev/null
    numbers a.geojson | tr -d '-' >a
    numbers b.geojson | tr -d '-' >b
    close_to a b 1e-12
    run 0 check -s $s -t $t --y-down=$way
    holds out 'one-to-one: yes, certified'
    run 0 plot -s $s -t $t --y-down=$way picture.svg
done

# Cages without features go by text; both, or none, is the same.
printf '0 0\n100 10\n90 80\n0 70\n' >pixels
printf '0 0\n100 -10\n90 -80\n0 -70\n' >metres
printf '50 40\n' >inside
printf '50 -40\n' >expected
run 1 map -s pixels -t metres -p inside
says 'turn the same way; negate y where it points down, else match the outlines (--y-down=source or --y-down=target; else --match auto)'
run 1 warp -s pixels -t metres in.pgm out.pgm
for remedy in --y-down=source '--y-down target' '--match auto'; do
    # shellcheck disable=SC2086 # two words
    run 0 map -s pixels -t metres $remedy -p inside
    [ "$remedy" = '--match auto' ] || close_to out expected 1e-12
    # shellcheck disable=SC2086
    run 0 check -s pixels -t metres $remedy
done
run 1 map -s pixels -t metres --y-down=both -p inside
tail -r pixels >/dev/null 2>&1
awk '{ row[NR] = $0 } END { print row[1]; for (k = NR; k > 1; k--) print row[k] }' pixels >clockwise
run 1 check -s pixels -t clockwise
says '--match auto'
run 0 check -s pixels -t clockwise --match auto
run 0 map -s pixels -t clockwise --match auto -p inside
close_to out inside 1e-9
run 2 map -s pixels -t metres --y-down
says '--y-down needs a value: source|target|both'
run 2 map -s pixels -t metres --y-down=up
says 'it may be: source, target, both'
run 2 plot -s pixels -t metres --y-down=source out.vtk
says '--y-down is for drawings in the plane'
make_cubes
run 1 check -s cube.obj -t moved.obj --y-down=source
says '--y-down is for cages with vertices in the plane'
# Maxima are places of the cages' own.
run 0 map -s pixels -t metres --y-down=target --method foliation --maximum 50,40 --target-maximum 50,-40 -p inside
close_to out expected 1
# So are landmarks, and what a match writes.
printf '0 0 0 0\n90 80 90 -80\n' >landmarks
run 0 match -s pixels -t metres --y-down=source --landmarks landmarks -o a.txt --target-output b.txt
same a.txt pixels
same b.txt metres

# An outline that was digitised with y down is told by a match, whichever way it goes in; following the message helps.
awk 'BEGIN { for (k = 0; k < 60; k++) { t = k * 0.10471975511965977
    r = 1 + 0.2 * cos(2 * t) + 0.12 * sin(3 * t) + 0.08 * cos(5 * t + 1)
    printf "%.17g %.17g\n", r * cos(t), r * sin(t) } }' >up.txt
awk 'BEGIN { for (k = 0; k < 45; k++) { t = k * 0.13962634015954636 + 0.9
    r = 1 + 0.2 * cos(2 * t) + 0.12 * sin(3 * t) + 0.08 * cos(5 * t + 1)
    printf "%.17g %.17g\n", 3 * r * cos(t), -3 * r * sin(t) } }' >down.txt
turn down.txt >upright.txt
run 0 check -s upright.txt -t up.txt --match auto
[ ! -s err ] || complain "a note about a match that is right: $(cat err)"
grep -qE '^matched: turned by -?0\.[0-9]+ degrees$' out || complain 'check does not say the turn'
printf '0.3 0.3\n' >inside
for command in 'check' 'map -p inside'; do
    # shellcheck disable=SC2086 # words
    run 0 $command -s down.txt -t up.txt --match auto
    grep -q 'degrees to match, but the mirror image fits better; is y down in one of them? (--y-down=source or --y-down=target)' err ||
        complain "$command does not tell a mirror image: $(cat err)"
    # shellcheck disable=SC2086
    run 0 $command -s down.txt -t up.txt --match auto --y-down=source
    [ ! -s err ] || complain "a note about a match that is right: $(cat err)"
done
printf '0.9 -0.9\n' >inside
run 0 map -s down.txt -t up.txt --match auto --y-down=source -p inside
printf '0.3 0.3\n' >expected
close_to out expected 0.02
# Two that are turned, without a mirror: said, unless any turn is as good.
awk '{ print -$2, $1 }' upright.txt >quarter.txt
run 0 map -s quarter.txt -t up.txt --match auto -p inside
grep -q 'turned by -90 degrees to match; if that is not meant' err || complain "a quarter turn is not told: $(cat err)"
run 0 map -s quarter.txt -t up.txt --match auto --turning free -p inside
[ ! -s err ] || complain "a note about a turn that is as good as any: $(cat err)"

# Longitudes that jump: refused, and each of the two remedies works.
islands() {
    printf '{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"role": "source"}, "geometry": {"type": "Polygon", "coordinates": [[
 [0, 0], [6, 0], [6, 4], [0, 4], [0, 0]]]}},
{"type": "Feature", "properties": {"role": "target"}, "geometry": {"type": "%s", "coordinates": %s}}]}\n' "$1" "$2"
}
islands Polygon '[[[177.1, -19.2], [-179.9, -19.3], [-179.8, -16.1], [177, -16.3], [177.1, -19.2]]]' >jumps.geojson
printf '3 2\n' >inside
for command in check 'map -p inside' 'match'; do
    # shellcheck disable=SC2086 # words
    run 1 $command -s jumps.geojson -t jumps.geojson
    says 'target: the longitude jumps from 177.1 to -179.9 after vertex 0: to cross the antimeridian write 180.1'
done
sed 's/-179.9/180.1/; s/-179.8/180.2/' jumps.geojson >goes_on.geojson
run 0 map -s goes_on.geojson -t goes_on.geojson -p inside
[ ! -s err ] || complain "a note about longitudes that go on: $(cat err)"
printf '178.6 -17.7\n' >expected
close_to out expected 0.3
islands Polygon '[[[-170, -30], [170, -30], [170, 40], [-170, 40], [-170, -30]]]' >round.geojson
run 1 check -s round.geojson -t round.geojson
says 'the longitude jumps from -170 to 170 after vertex 0: to cross the antimeridian write -190'
sed 's/\[170, -30\]/[0, -30], &/; s/40\], \[-170/40], [0, 40], [-170/; s/\[6, 0\], \[6, 4\]/[3, 0], [6, 0], [6, 4], [3, 4]/' \
    round.geojson >between.geojson
run 0 check -s between.geojson -t between.geojson
sed 's/"features"/"crs": {"type": "name", "properties": {"name": "EPSG:2056"}}, &/' round.geojson >named.geojson
run 0 check -s named.geojson -t named.geojson
# The whole earth, degrees without a jump, what is not in degrees.
islands Polygon '[[[-180, -90], [180, -90], [180, 90], [-180, 90], [-180, -90]]]' >earth.geojson
islands Polygon '[[[-70, -30], [95, -30], [95, 40], [-70, 40], [-70, -30]]]' >wide.geojson
islands Polygon '[[[-170, -30], [170, -30], [170, 140], [-170, 140], [-170, -30]]]' >other.geojson
for name in earth wide other; do
    run 0 check -s $name.geojson -t $name.geojson
    [ ! -s err ] || complain "a note about $name: $(cat err)"
done
# Cut there into two polygons: said.
islands MultiPolygon '[[[[177, -19], [180, -19], [180, -16], [177, -16], [177, -19]]],
    [[[-180, -19], [-178, -19], [-178, -16], [-180, -16], [-180, -19]]]]' >halves.geojson
run 1 check -s halves.geojson -t halves.geojson
says 'it is cut at the antimeridian: joined, with longitudes that go on beyond 180, it is mapped as one'
# A layer that jumps is carried, the long way round, and that is said.
printf '{"type": "LineString", "coordinates": [[179, 0], [-179, 1]]}\n' >line.geojson
run 0 map -s earth.geojson -t earth.geojson --inverse --geojson line.geojson out.geojson
grep -q 'jump by more than 180 degrees; they are taken the long way round' err || complain "a line that jumps: $(cat err)"
finish
