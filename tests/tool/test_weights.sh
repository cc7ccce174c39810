#!/bin/sh
# weights: what they promise, the handles' file, options, figures, reports, failures.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

printf '0 0\n10 0\n10 5\n5 5\n5 10\n0 10\n' >cage.txt
handles='[[1, 1], [9, 1], [9, 4], [4, 9], [1, 9]]'
echo "{\"handles\": $handles}" >plain.json
printf '1 1\n9 1\n9 4\n4 9\n1 9\n' >handles.txt
awk 'BEGIN { for (i = 0; i < 400; i++) { x = (i * 0.618034) % 1 * 10; y = (i * 0.754878) % 1 * 10
             if (x < 5 || y < 5) printf "%.17g %.17g\n", x, y } }' >inside.txt

# sums POINTS WEIGHTS: how far the sums are from 1, and the points from what the weights make of the handles.
sums() {
    paste -d ' ' "$1" "$2" | awk '
        BEGIN { while ((getline line < "handles.txt") > 0) { split(line, h, " "); hx[++m] = h[1]; hy[m] = h[2] } }
        { s = x = y = 0; for (j = 1; j <= m; j++) { w = $(j + 2); s += w; x += w * hx[j]; y += w * hy[j] }
          if (NF != m + 2) bad = 1
          d = sqrt((s - 1) ^ 2 + (x - $1) ^ 2 + (y - $2) ^ 2); if (d > worst) worst = d }
        END { print bad || NR == 0 ? 9 : worst + 0 }'
}
below() { # VALUE LIMIT WHAT
    awk "BEGIN { exit !($1 < $2) }" || complain "$3: $1 is not below $2"
}
member() { # FILE NAME
    sed -n 's/^ *"'"$2"'": \([^,]*\),*$/\1/p' "$1"
}

# Partition of unity, reproduction and the Lagrange property, whatever the options; one row a point, in order.
for how in "" "-w equality" "-w l1" "-k gauss" "--initial inverse" "--initial heat --steps 9" "--sampling grid" \
    "--spacing 0.5 --seed 7" "--sigma 0.4"; do
    # shellcheck disable=SC2086 # options
    run 0 weights -s cage.txt -a plain.json --spacing 0.2 -p inside.txt -o w $how
    below "$(sums inside.txt w)" 1e-9 "sums and reproduction, $how"
    # shellcheck disable=SC2086
    run 0 weights -s cage.txt -a plain.json --spacing 0.2 $how <handles.txt
    awk '{ for (j = 1; j <= NF; j++) { d = $j - (j == NR); if (d * d > 1e-16) bad = 1 } } END { exit bad || NR != 5 }' out ||
        complain "not 1 and 0 at the handles, $how: $(cat out)"
done
# Biharmonic weights only sum to 1.
run 0 weights -s cage.txt -a plain.json --spacing 0.2 -w biharmonic <handles.txt
awk '{ sum = 0; for (j = 1; j <= NF; j++) { sum += $j; d = $j - (j == NR); if (d * d > 1e-16) bad = 1 }
       if ((sum - 1) ^ 2 > 1e-20) bad = 1 } END { exit bad || NR != 5 }' out || complain "biharmonic: $(cat out)"
run 0 weights -s cage.txt -a plain.json --spacing 0.2 -p inside.txt -o w -w biharmonic
below 1e-3 "$(sums inside.txt w)" "biharmonic weights do not reproduce points"
run 0 weights -s cage.txt -a plain.json --spacing 0.2 -p inside.txt -o w --thesis
below "$(sums inside.txt w)" 1 "the thesis' settings"
below 1e-7 "$(sums inside.txt w)" "the thesis' settings have no affine part"

# The seed changes the samples, the threads change nothing.
run 0 weights -s cage.txt -a plain.json --spacing 0.2 -p inside.txt -o one -j 1
run 0 weights -s cage.txt -a plain.json --spacing 0.2 -p inside.txt -o three -j 3
same one three "threads"
run 0 weights -s cage.txt -a plain.json --spacing 0.2 -p inside.txt -o other --seed 1
cmp -s one other && complain "the seed does nothing"

# Edges: linear along them. Lines: straight, and parallel to another.
cat >edges.json <<END
{"handles": $handles, "edges": [[0, 1], [1, 2], [3, 4]]}
END
run 0 weights -s cage.txt -a edges.json --spacing 0.2 --json=report.json -p inside.txt -o w
holds report.json '"initial": "edges"'
below "$(member report.json linearity)" 0.05 "linearity along edges"
cat >lines.json <<END
{"handles": $handles,
 "lines": [{"from": [2, 2], "to": [2, 8]}, {"from": [3, 2], "to": [3, 5], "parallel": 0}]}
END
run 0 weights -s cage.txt -a lines.json --spacing 0.2 --along 2,2,2,8
awk '{ if (NF != 6) bad = 1; t[NR] = $1; for (j = 2; j <= NF; j++) w[NR, j] = $j }
     END { for (i = 1; i <= NR; i++) for (j = 2; j <= 6; j++) {
             d = w[i, j] - (w[1, j] * (1 - t[i]) + w[NR, j] * t[i]); if (d * d > 1e-4) bad = 1 }
           exit bad || NR != 401 || t[1] != 0 || t[NR] != 1 }' out || complain "a line does not stay straight"
cp out first
run 0 weights -s cage.txt -a lines.json --spacing 0.2 --along 3,2,3,5
paste -d ' ' first out | awk 'NR == 1 { for (j = 2; j <= 6; j++) { a[j] = $j; b[j] = $(j + 6) } }
     END { for (j = 2; j <= 6; j++) { d = ($j - a[j]) - 2 * ($(j + 6) - b[j]); if (d * d > 1e-12) exit 1 } }' ||
    complain "a line does not stay parallel"

# Weights that are linear along edges on the boundary, up to what lies between samples, where the others are not.
printf '1 1\n9 1\n9 4\n4 9\n1 9\n' >linear.txt
for linear in false true; do
    echo "{\"handles\": $handles, \"edges\": [[0, 1], [1, 2]], \"linear_edges\": $linear}" >linear.json
    run 0 weights -s linear.txt -a linear.json --weights equality --initial heat --spacing 0.2 --along 1,1,9,1
    awk '{ d = $2 - (1 - $1); d = d < 0 ? -d : d; if (d > most) most = d } END { print most }' out >"off.$linear"
done
paste off.false off.true | awk '{ exit !($1 > 0.1 && $2 < 0.03) }' ||
    complain "linear edges: off by $(cat off.false) without, by $(cat off.true) with"

# Further regions and curves; a stick figure has no source. A rigid part has less energy than before.
cat >stick.json <<'END'
{"handles": [[0, 0], [0, 4], [-3, 3], [3, 3], [-2, -4], [2, -4]],
 "curves": {"vertices": [[0, 0], [0, 4], [-3, 3], [3, 3], [-2, -4], [2, -4], [0, 2.5]],
            "segments": [[0, 6], [6, 1], [6, 2], [6, 3], [0, 4], [0, 5]]}}
END
printf '0 2\n-1 2.67\n' | run 0 weights -a stick.json
[ "$(wc -l <out)" -eq 2 ] || complain "no weights on curves"
cat >square.json <<END
{"handles": $handles, "regions": [[[-5, -5], [15, -5], [15, 15], [-5, 15]]]}
END
run 0 weights -s cage.txt -a square.json --spacing 0.2 -p inside.txt -o w
below "$(sums inside.txt w)" 1e-9 "a region around the source"
run 0 weights -a square.json --spacing 0.2 -p inside.txt -o w
for part in '"region": [[6, 1], [8, 1], [8, 3], [6, 3]]' '"centre": [7, 2], "radius": 1, "rigidity": 2.5'; do
    echo "{\"handles\": $handles, \"rigid\": [{$part}]}" >rigid.json
    run 0 weights -s cage.txt -a rigid.json --spacing 0.2 -p inside.txt -o w --json=report.json
    below "$(sums inside.txt w)" 1e-9 "a rigid part"
    sed -n '/rigid_energy/{n;N;p;}' report.json | tr -d ' \n' | awk -F , '{ exit !($2 < $1 && $2 > 0) }' ||
        complain "the energy does not fall"
done

# Painted weights rise where the brush was, one stroke after the other, and stay as they were elsewhere.
stroke='{"handle": 1, "centre": [7, 2], "radius": 2, "amount": 0.2}'
echo "{\"handles\": $handles}" >plain.json
echo "{\"handles\": $handles, \"paint\": [$stroke]}" >once.json
echo "{\"handles\": $handles, \"paint\": [$stroke, $stroke]}" >twice.json
printf '7 2\n1.5 8\n' >where.txt
for name in plain once twice; do
    run 0 weights -s cage.txt -a $name.json --spacing 0.2 -p where.txt -o $name.out
done
paste -d ' ' plain.out once.out twice.out |
    awk 'NR == 1 { exit !($7 > $2 + 0.05 && $12 > $7 + 0.05) }' || complain "painted weights do not rise"
paste -d ' ' plain.out once.out |
    awk 'NR == 2 { for (j = 1; j <= 5; j++) { d = $j - $(j + 5); if (d * d > 1e-6) exit 1 } }' ||
    complain "painted weights change far away"

# Or start from given weights: then those come out that are nearest to them.
printf '3 3\n9 3\n' >middle.txt
run 0 weights -s cage.txt -a plain.json --spacing 0.2 -p middle.txt -o plain.out
for given in "0, 0, 0.5, 0.5, 0" "1, 1, 0, 0, 1"; do
    echo "{\"handles\": $handles, \"paint\": [{\"centre\": [3, 3], \"radius\": 1, \"weights\": [$given]}]}" >from.json
    run 0 weights -s cage.txt -a from.json --spacing 0.2 -p middle.txt -o "from${given%%,*}.out"
    run 0 weights -s cage.txt -a from.json --spacing 0.2 -p inside.txt -o w
    below "$(sums inside.txt w)" 1e-9 "sums where weights start from $given"
done
paste -d ' ' from1.out from0.out | awk 'NR == 1 { exit !($2 > $7 + 0.1 && $5 > $10 + 0.1 && $8 > $3 + 0.1 && $9 > $4 + 0.1) }' ||
    complain "weights do not start where they should"
paste -d ' ' plain.out from1.out |
    awk 'NR == 2 { for (j = 1; j <= 5; j++) { d = $j - $(j + 5); if (d * d > 1e-6) exit 1 } }' ||
    complain "weights that start anew change far away"
echo '{"handles": [[0, 0]], "paint": [{"handle": 0, "centre": [1, 1], "radius": 1, "weights": [1]}]}' >both.json
run 1 weights -s cage.txt -a both.json
says 'libicc: both.json: paint[0] must have either "weights" or "handle" and "amount"'
echo '{"handles": [[0, 0]], "paint": [{"centre": [1, 1], "radius": 1, "weights": [1, 2]}]}' >many.json
run 1 weights -s cage.txt -a many.json
says 'libicc: many.json: paint[0].weights is not a list of 1 finite numbers'

# In space.
make_cubes
echo '{"handles": [[0.1, 0.1, 0.1], [0.9, 0.1, 0.1], [0.1, 0.9, 0.1], [0.1, 0.1, 0.9], [0.9, 0.9, 0.9]]}' >cube.json
printf '0.3 0.4 0.5\n0.9 0.1 0.1\n' | run 0 weights -s cube.obj -a cube.json --spacing 0.1
awk '{ s = 0; for (j = 1; j <= NF; j++) s += $j; if (NF != 5 || (s - 1) ^ 2 > 1e-18) exit 1 }' out ||
    complain "no weights in space: $(cat out)"

# Points without weights: nan, exit 4. Bindings have none.
printf '1 2\nnan 1\n2 inf\n' >some.txt
run 4 weights -s cage.txt -a plain.json --spacing 0.2 -p some.txt
holds err 'libicc: 2 of 3 points have no weights: they are not finite'
[ "$(sed -n '2,3p' out | sort -u)" = "nan nan nan nan nan" ] || complain "not nan: $(cat out)"
run 1 weights -s cage.txt -a plain.json --spacing 0.2 -p some.txt -b bound
says 'libicc: some.txt:2: point 1 is not finite'
[ ! -e bound ] || complain "a binding is left behind"
run 0 weights -s cage.txt -a plain.json --spacing 0.2 -p inside.txt -b bound
[ ! -s out ] || complain "weights were written beside a binding"
[ "$(head -c 8 bound)" = LICCBIND ] || complain "this is no binding"

# The report.
run 0 weights -s cage.txt -a plain.json --spacing 0.2 -p inside.txt -o w --json
for part in '"command": "weights"' '"handles": "plain.json"' '"kind": "blue"' '"weights": "qp"' '"infeasible": ' \
    '"definiteness": 0.' '"lagrange": ' '"least_weight": ' '"without_weights": 0' '"factor": '; do
    holds out "$part"
done
below "$(member out unity)" 1e-11 unity
below "$(member out reproduction)" 1e-9 reproduction
[ "$(member out infeasible)" -gt 0 ] || complain "nothing is outside the hull of the handles"

# Figures.
for scale in "" --log; do
    # shellcheck disable=SC2086 # none or one
    run 0 weights -s cage.txt -a edges.json --spacing 0.2 --picture figure.svg --handle 2 $scale
    [ ! -s out ] || complain "a figure and weights"
    holds figure.svg '</svg>'
    holds figure.svg 'data:image/png;base64,'
    [ "$(grep -c '<circle' figure.svg)" -eq 5 ] || complain "handles are missing"
    # shellcheck disable=SC2086
    run 0 weights -s cage.txt -a edges.json --spacing 0.2 --along 1,1,9,1 --picture along.svg $scale
    holds along.svg '</svg>'
done
run 0 weights -a stick.json --spacing 0.2 --picture - --y-down
holds out '</svg>'
run 1 weights -s cage.txt -a plain.json --spacing 0.2 --picture figure.svg --handle 5
says 'libicc: plain.json: there is no handle 5 for --handle; the last is 4'
run 1 weights -s cube.obj -a cube.json --spacing 0.1 --picture figure.svg
says 'needs a shape in the plane'

# What is wrong with the handles' file, and where.
wrong() { # JSON MESSAGE
    printf '%s\n' "$1" >bad.json
    run 1 weights -s cage.txt -a bad.json --spacing 0.2 -p inside.txt
    says "libicc: bad.json: $2"
}
wrong '[]' 'the file is not an object'
wrong '{}' 'there is no list "handles"'
wrong '{"handles": []}' 'there is no list "handles"'
wrong '{"handles": [[1, 1], [2]]}' 'handles[1] is not a list of 2 finite numbers'
wrong '{"handles": [[1]]}' 'handles[0] is not a point'
wrong '{"handles": [[1, 1], [2, 1e999]]}' 'handles[1] is not a list of 2 finite numbers'
wrong '{"handles": [[1, 1], [2, 3, 4]]}' 'handles[1] is not a list of 2 finite numbers'
wrong '{"handels": [[1, 1]]}' "the file has a member 'handels'; it may have: handles,"
wrong "{\"handles\": $handles, \"edges\": [[0, 1], [1, 5]]}" 'edges[1] must be a handle, a whole number from 0 to 4'
wrong "{\"handles\": $handles, \"edges\": [[0, 1, 2]]}" 'edges[0] is not a pair'
wrong "{\"handles\": $handles, \"linear_edges\": 1}" 'linear_edges must be true or false'
wrong "{\"handles\": $handles, \"linear_edges\": true}" 'linear_edges needs edges'
wrong "{\"handles\": [[2, 2], [7, 3], [3, 5]], \"edges\": [[0, 1]], \"linear_edges\": true}" 'linear_edges: no sample lies on an edge'
wrong "{\"handles\": $handles, \"lines\": [{\"from\": [1, 2]}]}" 'lines[0].to is not a list of 2'
wrong "{\"handles\": $handles, \"lines\": [{\"from\": [1, 2], \"to\": [2, 2], \"parallel\": 0}]}" \
    'lines[0].parallel must be a line before it, but there is none'
wrong "{\"handles\": $handles, \"regions\": [[[0, 0], [1, 1]]]}" 'regions[0] has 2 vertices'
wrong "{\"handles\": $handles, \"regions\": [[[20, 0], [30, 0], [20, 9], [30, 9]]]}" 'regions[0]: '
wrong "{\"handles\": $handles, \"curves\": {\"vertices\": [[0, 0]], \"segments\": [[0, 1]]}}" 'curves.segments[0] must be'
wrong "{\"handles\": $handles, \"rigid\": [{}]}" 'rigid[0] must have either'
wrong "{\"handles\": $handles, \"rigid\": [{\"centre\": [1, 1], \"radius\": -1}]}" 'rigid[0].radius must be above 0'
wrong "{\"handles\": $handles, \"rigid\": [{\"centre\": [70, 1], \"radius\": 1}]}" 'rigid[0] holds no sample'
wrong "{\"handles\": $handles, \"paint\": [{\"handle\": 5}]}" 'paint[0].handle must be a handle'
wrong "{\"handles\": $handles, \"paint\": [{\"handle\": 0, \"centre\": [1, 1], \"radius\": 0}]}" 'paint[0].radius must be above 0'
wrong "{\"handles\": $handles, \"paint\": [{\"handle\": 0, \"centre\": [1, 1], \"radius\": 1}]}" 'paint[0].amount'
wrong "{\"handles\": $handles, \"paint\": [{\"handle\": 0, \"centre\": [70, 1], \"radius\": 1, \"amount\": 1}]}" \
    'paint[0] holds no sample'
wrong '{"handles": [[1, 1], [9, 1], [8, 8]]}' 'handle 2 is outside the shape'
wrong '{"handles": [[1, 1], [9, 1], [1, 4], [9, 1]]}' 'handle'
wrong '{"handles": [[1, 1], [2, 1], [3, 1]]}' ''
printf '{"handles":\n[[1, 1],\n [2, 2}' >bad.json
run 1 weights -s cage.txt -a bad.json --spacing 0.2 -p inside.txt
says 'libicc: bad.json:3: this is not valid JSON'
printf '{"handles":\n[[1, 1],' >bad.json
run 1 weights -s cage.txt -a bad.json --spacing 0.2 -p inside.txt
says 'bad.json:2: the JSON ends early'
run 1 weights -s cage.txt -a nowhere.json --spacing 0.2 -p inside.txt
says 'libicc: nowhere.json: cannot be opened'
run 1 weights -s cube.obj -a plain.json -p inside.txt
says 'the handles have 2 coordinates, but the cage 3'
printf '0 0\n4 4\n4 0\n0 4\n' >crossed.txt
run 1 weights -s crossed.txt -a plain.json -p inside.txt
says 'libicc: crossed.txt:1: '
run 1 weights -s cage.txt -a plain.json -p inside.txt --spacing 50
[ "$(wc -l <err)" -eq 1 ] || complain "stderr is not one line"
run 1 weights -s cage.txt -a plain.json -p inside.txt --sampling grid --kernel gauss --spacing 0.5 --sigma 9
[ "$(wc -l <err)" -eq 1 ] || complain "stderr is not one line"

# Wrong usage.
run 2 weights -s cage.txt
says '--handles FILE is missing'
run 2 weights -a plain.json
says '--source FILE is missing'
run 2 weights -s cage.txt -a plain.json --along 1,2,3
says '--along must be'
run 2 weights -s cage.txt -a plain.json --along 1,2,3,4,5,6
says '--along has 6 coordinates; it needs 4 here'
run 2 weights -s cage.txt -a plain.json --along 1,2,3,4 -p inside.txt
says 'exclude each other'
run 2 weights -s cage.txt -a plain.json --log
says 'go with --picture'
run 2 weights -s cage.txt -a - -p -
says 'only one input can be standard input'
run 2 weights -s cage.txt -a plain.json --weights best
says 'it may be: qp, equality, l1, biharmonic'
run 2 weights -s cage.txt -a plain.json -p inside.txt --json
says 'cannot both go to standard output'

finish
