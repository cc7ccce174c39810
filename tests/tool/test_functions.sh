#!/bin/sh
# The functions of method gradient: what info tells of how they were made, and maps and drawings with them.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

# member NAME: the value of the first member of that name in report.json.
member() {
    sed -n 's/^ *"'"$1"'": //p' report.json | sed 's/,$//' | head -n 1
}

expect() {
    [ "$(member "$1")" = "$2" ] || complain "$1 is $(member "$1") instead of $2: $3"
}

# below A B: two numbers.
below() {
    awk -v a="$1" -v b="$2" 'BEGIN { exit !(a != "" && a != "null" && a + 0 < b + 0) }'
}

one_maximum() {
    for count in "maxima 1" "minima 0" "saddles 0" "holes 0"; do
        # shellcheck disable=SC2086
        expect $count "$1"
    done
    grep -q first_critical report.json && complain "a critical point without need: $1"
}

# Every function that solves an equation tells how.
for function in laplace bilaplace clamped; do
    for how in constrained unconstrained; do
        run 0 info -s source.txt -m gradient -f "$function" "--$how" --json=report.json
        expect function "\"$function\"" "$how"
        expect constrained "$([ $how = constrained ] && echo true || echo false)" "$function $how"
        expect solver '"direct"' "$function $how"
        for name in unknowns violated active iterations inner_iterations factorisation_work least_log setup order \
            factor solve verify; do
            [ -n "$(member $name)" ] || complain "no $name: $function $how"
        done
        below 0 "$(member unknowns)" || complain "no unknowns: $function $how"
        below "$(member residual)" 1e-6 || complain "residual $(member residual): $function $how"
        [ "$function$how" = clampedunconstrained ] || one_maximum "$function $how"
        cp report.json first.json
        run 0 info -s source.txt -m gradient -f "$function:$how" --json=report.json
        sed '/seconds/,/}/d' first.json >first
        sed '/seconds/,/}/d' report.json >second
        same first second "--$how and $function:$how"
        run 0 info -s source.txt -m gradient -f "$function" "--$how"
        holds out "function $function, $how,"
        holds out "residual"
    done
done

# In an L the function without inequalities breaks some; with them none is broken, and some are active.
run 0 info -s source.txt -m gradient -f laplace --unconstrained --json=report.json
violated=$(member violated)
below 0 "$violated" || complain "nothing is violated in an L"
expect active 0 "unconstrained"
below "$(member least_log)" 0 || complain "the logarithms are above 0"
run 0 info -s source.txt -m gradient -f laplace --constrained --json=report.json
expect violated "$violated" "constrained"
below 0 "$(member active)" || complain "nothing is active in an L"
below 0 "$(member iterations)" || complain "no iterations in an L"
run 0 info -s source.txt -m gradient -f laplace --constrained --min-fall 0.01 --json=report.json
below "$violated" "$(member violated)" || complain "a larger eta does not break more inequalities"

# What there is by default: inequalities only where they are needed.
run 0 info -s source.txt -m gradient -f laplace --json=report.json
expect constrained false "default"
one_maximum "default"
run 0 info -s source.txt -m gradient -f decay --json=report.json
grep -q solution report.json && complain "decay solves nothing"
one_maximum decay

# The iterative solver finds the same function.
for solver in direct iterative; do
    run 0 info -s source.txt -m gradient -f laplace --solver "$solver" --json=report.json
    expect solver "\"$solver\"" "asked for"
    member least_log >"$solver"
done
close_to direct iterative 1e-6

# A gap that is narrower than a cell closes: the reason why there is a saddle is told, and where.
printf '0 0\n10 0\n10 10\n5.1 10\n5.1 9.9\n5.05 9.5\n7 9\n7 5\n3 5\n3 9\n4.95 9.5\n4.9 9.9\n4.9 10\n0 10\n' >gap.txt
run 0 info -s gap.txt -m gradient -f laplace --cells 12 --json=report.json
expect holes 1 gap
expect saddles 1 gap
holds report.json '"first_critical": ['
holds report.json '1 hole in the shape'
run 0 info -s gap.txt -m gradient -f laplace --cells 12
holds out 'the first besides the maximum lies at'
run 0 info -s gap.txt -m gradient -f laplace --cells 200 --json=report.json
one_maximum "a gap with small cells"

# A plate is highest beside a load that is not in its middle: the maximum moves there and says so. Whatever other
# critical points there are, a reason follows.
printf '0 0\n3 0\n3 1\n1 1\n1 3\n0 3\n' >corner.txt
for function in bilaplace clamped; do
    run 0 info -s corner.txt -m gradient -f "$function:unconstrained" --maximum 2.6,0.3 --cells 100 --json=report.json
    below 0.01 "$(member maximum_moved)" || complain "$function: the maximum has not moved"
    run 0 info -s corner.txt -m gradient -f "$function:unconstrained" --maximum 2.6,0.3 --cells 100
    holds out 'from the place chosen: the function is greatest here'
    grep -A 1 ':$' out | grep -q '^ *$' && complain "$function: a reason is missing"
    run 0 info -s corner.txt -m gradient -f "$function:constrained" --maximum 2.6,0.3 --cells 40 --json=report.json
    grep -q maximum_moved report.json && complain "$function: inequalities do not hold the maximum"
done

# A grid with one vertex inside: no function, no drawing of the others, no line of the cage to blame.
awk 'BEGIN { for (i = 0; i <= 20; i++) printf "%.1f 0\n", i / 10; print "0.9 1" }' >coarse.txt
run 1 info -s coarse.txt -m gradient -f laplace --cells 2
says 'libicc: coarse.txt: the grid is too coarse'
run 1 plot -s coarse.txt -m gradient -f decay,laplace,distance --cells 2 drawing.svg
says 'libicc: coarse.txt: the grid is too coarse'
[ ! -e drawing.svg ] || complain "a drawing although a function failed"
run 0 plot -s coarse.txt -m gradient -f decay,distance --cells 2 drawing.svg

# Maps and coordinates. In a convex cage nearly all points come back.
printf '0 0\n8 -1\n12 5\n7 10\n-1 7\n' >convex.txt
printf '5 4\n1 1\n9 3\n4 7.5\n6.25 1.5\n' >some.txt
for function in laplace bilaplace; do
    run 0 encode -s convex.txt -m gradient -f "$function" -p some.txt -o coords
    run 0 decode -s convex.txt -m gradient -f "$function" --coords coords
    close_to out some.txt 0.2
    run 0 map -s convex.txt -t convex.txt -m gradient -f "$function" -p some.txt
    close_to out some.txt 0.2
    run 0 map -s convex.txt -t convex.txt -m gradient -f "$function" -p convex.txt
    close_to out convex.txt 1e-12
done

# Drawings: a scale that shows something is told; several functions stand side by side.
run 0 plot -s source.txt -m gradient -f laplace --elevation drawing.svg
holds drawing.svg 'logarithm, over'
run 0 plot -s source.txt -m gradient -f distance drawing.svg
grep -q logarithm drawing.svg && complain "distance has no logarithm"
run 0 plot -s source.txt -t target.txt -m gradient --unconstrained -f distance,laplace:constrained,laplace drawing.svg
for heading in '>source<' '>distance<' '>laplace, constrained<' '>laplace, unconstrained<'; do
    [ "$(grep -cF "$heading" drawing.svg)" -eq 1 ] || complain "not once in the drawing: $heading"
done
[ "$(grep -c '>checkerboard<' drawing.svg)" -eq 4 ] || complain "not four checkerboards"
[ "$(grep -c 'expansion edges' drawing.svg)" -eq 3 ] || complain "not three numbers of expansion edges"
finish
