#!/bin/sh
# pose: points, meshes, pictures and bindings; the pose's file, folds, failures.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

pictures=$scratch/pictures
"${CC:-cc}" -std=c11 -o "$pictures" "$here/pictures.c" -lpng || exit 1

printf '0 0\n10 0\n10 5\n5 5\n5 10\n0 10\n' >cage.txt
echo '{"handles": [[1, 1], [9, 1], [9, 4], [4, 9], [1, 9]]}' >handles.json
printf '1 1\n9 1\n2.5 3.25\n7 2\n2 8\n4.5 4.5\n' >points.txt
echo '{"moves": []}' >rest.json
printf '{"transforms": [' >all.json
for handle in 0 1 2 3 4; do
    [ $handle = 0 ] || printf ', ' >>all.json
    printf '[[1, 0, 0.5], [0, 1, -0.25]]' >>all.json
done
echo ']}' >>all.json

pose() { # EXPECTED POSE ARGUMENT...
    expected=$1
    moves=$2
    shift 2
    run "$expected" pose -s cage.txt -a handles.json -t "$moves" --spacing 0.25 "$@"
}

# At rest nothing moves; when all handles are moved or turned by the same, so is everything.
pose 0 rest.json points.txt -
close_to out points.txt 1e-12
pose 0 all.json points.txt -
awk '{ printf "%.17g %.17g\n", $1 + 0.5, $2 - 0.25 }' points.txt >expected
close_to out expected 1e-12
echo '{"moves": [' >turn.json
for handle in '0, "move": [-2, 0]' '1, "move": [-10, 8]' '2, "move": [-13, 5]' '3, "move": [-13, -5]' '4, "move": [-10, -8]'; do
    echo "{\"handle\": $handle, \"turn\": 90}," >>turn.json
done
sed '$s/,$/]}/' turn.json >turned.json
pose 0 turned.json points.txt -
awk '{ printf "%.17g %.17g\n", -$2, $1 }' points.txt >expected
close_to out expected 1e-11

# A handle goes where its move takes it; a matrix and a turn leave it where it is.
echo '{"moves": [{"handle": 1, "move": [1, 2], "turn": -30, "matrix": [[2, 0], [0, 0.5]]}]}' >one.json
pose 0 one.json points.txt images
sed -n '1,2p' images >first
printf '1 1\n10 3\n' >expected
close_to first expected 1e-12

# Bindings: the same without shape and handles.
run 0 weights -s cage.txt -a handles.json --spacing 0.25 -p points.txt -b bound
run 0 pose -b bound -t one.json -
same out images "a binding"
run 0 pose -b bound -t one.json images --json
holds out '"points": 6'
head -c 100 bound >half
run 1 pose -b half -t one.json -
says 'libicc: half: '
run 1 pose -b points.txt -t one.json -
says 'libicc: points.txt: '

# Points that are not finite; what was written stays otherwise.
printf '1 1\nnan 2\n' >some.txt
pose 4 rest.json some.txt -
holds err '1 of 2 points have no image: they are not finite'
[ "$(sed -n 2p out)" = "nan nan" ] || complain "not nan: $(cat out)"
pose 0 rest.json - images <points.txt
close_to images points.txt 1e-12
printf '1 1\n2 x\n' >some.txt
echo old >images
pose 1 rest.json some.txt images
says 'libicc: some.txt:2: '
holds images old

# Orientation: a handle turned round turns what is near it over.
echo '{"moves": [{"handle": 1, "matrix": [[-1, 0], [0, 1]]}]}' >mirror.json
printf '8.9 1\n9.1 1\n1 2\n' >near.txt
pose 0 mirror.json near.txt images --json
holds out '"inverted": 2'
holds out '"orientation_kept": 1'
holds out '"lagrange": '

# Meshes, with exact counts.
cat >mesh.obj <<'END'
v 1 1 7
v 2 1 7
v 1 2 7
v 8.9 1 7
v 9.1 1 7
v 9 1.1 7
f 1 2 3
f 4 5 6
END
pose 0 rest.json mesh.obj out.obj
holds out '2 triangles: 2 keep their orientation, 0 inverted'
[ "$(grep -c '^v .* 7$' out.obj)" -eq 6 ] || complain "the third coordinate is lost"
pose 4 mirror.json mesh.obj out.obj --json
holds out '"inverted": 1'
pose 4 mirror.json mesh.obj -
holds err '1 inverted'
holds err '1 of 2 triangles is inverted or collapsed (numbers from 0: 1): all three corners lie on the boundary'
holds out 'f 4 5 6'
printf 'v 1 1 7\nf 1 2 3\n' >bad.obj
pose 1 rest.json bad.obj out.obj
says 'libicc: bad.obj:2: '

# Certified: handles and outline go where the pose takes them, and nothing turns over.
pose 0 all.json --certified points.txt images
awk '{ printf "%.17g %.17g\n", $1 + 0.5, $2 - 0.25 }' points.txt >expected
close_to images expected 1e-12
holds out 'certified one-to-one: '
holds out ' 0 % of the shape is turned over'
cat >pins.json <<'END'
{"handles": [[0, 0], [10, 0], [10, 10], [0, 10], [3, 5], [7, 5]], "edges": [[0, 1], [1, 2], [2, 3], [3, 0]],
 "regions": [[[0, 0], [10, 0], [10, 10], [0, 10]]]}
END
pins() { # EXPECTED POSE ARGUMENT...
    expected=$1
    moves=$2
    shift 2
    run "$expected" pose -a pins.json -t "$moves" --spacing 0.5 "$@"
}
echo '{"moves": [{"handle": 4, "move": [3, 2]}, {"handle": 5, "move": [-3, -2], "turn": 30}]}' >pass.json
printf '0 0\n10 10\n3 5\n7 5\n10 4\n' >at.txt
printf '0 0\n10 10\n6 7\n4 3\n10 4\n' >wanted
pins 0 pass.json --certified at.txt images --json=report.json
close_to images wanted 1e-2
head -n 4 images >some.txt
head -n 4 wanted >expected
close_to some.txt expected 1e-12
holds report.json '"inverted": 0'
holds report.json '"certified": {'
holds report.json '"folded_pose": 0.'
pins 0 pass.json --certified --tolerance 0.5 at.txt images
holds out 'certified one-to-one: '
printf '1 1\n20 20\nnan 2\n10 3\n' >some.txt
pins 4 pass.json --certified some.txt -
holds err '2 of 4 points have no image: they are outside the shape'
[ "$(sed -n '2,3p' out)" = "nan nan
nan nan" ] || complain "not nan: $(cat out)"
sed 's/^v 9.1/v 99/' mesh.obj >far.obj
pins 1 pass.json --certified far.obj images
says 'far.obj: vertex 4 is outside the shape, so nothing was written'
pins 0 pass.json --certified --require certified mesh.obj out.obj
holds out ', 0 inverted'
pins 1 pass.json --require certified mesh.obj out.obj
says '--certified makes them one-to-one'
# A handle on the outline is a vertex of it; the outline may be a region of the handles' file.
echo '{"handles": [[0, 5], [10, 0], [3, 3], [0, 0]], "regions": [[[0, 0], [10, 0], [10, 10], [0, 10]]]}' >region.json
echo '{"moves": [{"handle": 0, "move": [1, 0]}, {"handle": 2, "move": [4, 1]}]}' >one.json
printf '0 5\n10 0\n3 3\n' >at.txt
printf '1 5\n10 0\n7 4\n' >expected
run 0 pose -a region.json -t one.json --spacing 0.5 --certified at.txt images
close_to images expected 1e-12
# Small loops of the outline go away when it is followed less closely.
cat >loop.json <<'END'
{"handles": [[0, 0], [10, 0], [10, 10], [0, 10]], "edges": [[0, 1], [1, 2], [2, 3], [3, 0]],
 "regions": [[[0, 0], [10, 0], [10, 10], [0, 10]]]}
END
echo '{"moves": [{"handle": 1, "turn": 160}]}' >spin.json
run 0 pose -a loop.json -t spin.json --spacing 0.5 --certified at.txt images
holds out 'the posed outline meets itself unless it is followed less closely: by up to '
run 1 pose -a loop.json -t spin.json --spacing 0.5 --certified --tolerance 0.01 at.txt images
says 'the posed outline meets itself'
# What cannot be one-to-one is refused by name.
echo '{"moves": [{"handle": 1, "move": [-20, 30]}]}' >bad.json
pose 1 bad.json --certified at.txt images
says 'libicc: bad.json: the posed outline meets itself, edge '
echo '{"moves": [{"handle": 4, "move": [4, 0]}]}' >bad.json
pins 1 bad.json --certified at.txt images
says 'libicc: bad.json: handle 5, posed, is where another one or a corner is'
echo '{"transforms": [' >bad.json
for handle in 0 1 2 3 4; do
    [ $handle = 0 ] || printf ', ' >>bad.json
    printf '[[-1, 0, 10], [0, 1, 0]]' >>bad.json
done
echo ']}' >>bad.json
pose 1 bad.json --certified at.txt images
says 'the pose turns the outline over'
echo '{"handles": [[1, 1], [9, 1], [5, 9]], "regions": [[[0, 0], [9, 0], [9, 9]]]}' >two.json
run 1 pose -s cage.txt -a two.json -t rest.json --certified at.txt images
says 'two.json: --certified poses one region, but there are 2'
run 2 pose -b bound -t rest.json --certified images
says '--certified needs the shape and the handles'
pose 2 rest.json --tolerance 1 at.txt images
says '--tolerance goes with --certified'

# In space: a turn has an axis.
make_cubes
echo '{"handles": [[0.1, 0.1, 0.1], [0.9, 0.1, 0.1], [0.1, 0.9, 0.1], [0.1, 0.1, 0.9], [0.9, 0.9, 0.9]]}' >cube.json
printf '{"moves": [{"handle": 4, "turn": 90, "axis": [0, 0, 1]}, {"handle": 0, "move": [0, 0, 0.5]}]}' >spin.json
printf '0.9 0.9 0.9\n0.1 0.1 0.1\n0.1 0.9 0.1\n' | run 0 pose -s cube.obj -a cube.json --spacing 0.1 -t spin.json - -
printf '0.9 0.9 0.9\n0.1 0.1 0.6\n0.1 0.9 0.1\n' >expected
close_to out expected 1e-12
run 0 pose -s cube.obj -a cube.json --spacing 0.1 -t spin.json cube.obj out.obj
holds out '12 triangles carried'

# Pictures: at rest the same, of every kind. What is outside the shape stays.
printf '4 4\n28 4\n28 26\n4 26\n' >cage.txt
echo '{"handles": [[6, 6], [26, 6], [26, 24], [6, 24], [16, 15]]}' >handles.json
for kind in "1 8" "2 8" "3 8" "4 8" "1 16" "2 16" "3 16" "4 16"; do
    # shellcheck disable=SC2086
    "$pictures" make in.png 32 30 $kind ramp
    run 0 pose -s cage.txt -a handles.json -t rest.json in.png out.png
    "$pictures" same in.png out.png || complain "a picture at rest changes: $kind"
    [ ! -s out ] || complain "something is said: $(cat out)"
done
pixel() { # FILE X Y SAMPLES
    [ "$("$pictures" at "$1" "$2" "$3")" = "$4" ] ||
        complain "pixel $2 $3 of $1 is $("$pictures" at "$1" "$2" "$3") instead of $4"
}
sed 's/0.5\]/2]/g; s/-0.25\]/0]/g' all.json >right.json
"$pictures" make in.png 32 30 1 16 ramp
run 0 pose -s cage.txt -a handles.json -t right.json in.png out.png
pixel out.png 10 10 "$("$pictures" at in.png 8 10)"
pixel out.png 29 10 "$("$pictures" at in.png 27 10)"
pixel out.png 30 10 "$("$pictures" at in.png 30 10)"
pixel out.png 4 10 "$("$pictures" at in.png 4 10)"
run 0 pose -s cage.txt -a handles.json -t right.json --background ff0000 - - <in.png
mv out out.png
[ "$("$pictures" kind out.png)" = "32 30 3 16" ] || complain "no colour: $("$pictures" kind out.png)"
pixel out.png 4 10 "65535 0 0"
pixel out.png 30 10 "65535 0 0"

# A fold: said, and what is the right way round is on top.
echo '{"moves": [{"handle": 4, "move": [25, 0]}]}' >fold.json
run 0 pose -s cage.txt -a handles.json -t fold.json in.png out.png
grep -q '% of the shape is turned over$' out || complain "the fold is not told: $(cat out)"
run 0 pose -s cage.txt -a handles.json -t fold.json in.png out.png --json
holds out '"folded": 0.'

run 1 pose -s cage.txt -a handles.json -t fold.json --certified in.png out.png
says 'handle 4, posed, is not inside the posed outline'
sed 's/25/9/' fold.json >nearer.json
run 0 pose -s cage.txt -a handles.json -t nearer.json --certified --background ff0000 in.png out.png
holds out 'certified one-to-one: '
pixel out.png 2 10 "65535 0 0"
run 0 pose -s cage.txt -a handles.json -t rest.json --certified in.png out.png --json
holds out '"folded_pose": 0,'
"$pictures" same in.png out.png || complain "a certified picture at rest changes"

echo '{"handles": [[0, 0], [0, 4], [3, 3]], "curves": {"vertices": [[0, 0], [0, 4], [3, 3]], "segments": [[0, 1], [1, 2]]}}' >stick.json
run 1 pose -a stick.json -t rest.json in.png out.png
says 'a picture needs a shape with a region'
run 1 pose -s cube.obj -a cube.json --spacing 0.1 -t rest.json in.png out.png
says 'this is a picture, but the handles are in space'
head -c 60 in.png >bad.png
run 1 pose -s cage.txt -a handles.json -t rest.json bad.png out.png
says 'libicc: bad.png: the PNG picture is damaged'

# What is wrong with the pose's file, and where.
wrong() { # JSON MESSAGE
    printf '%s\n' "$1" >bad.json
    run 1 pose -s cage.txt -a handles.json -t bad.json points.txt -
    says "libicc: bad.json: $2"
}
wrong '{}' 'the file must have either "transforms" or "moves"'
wrong '{"moves": [], "transforms": []}' 'the file must have either "transforms" or "moves"'
wrong '{"transforms": []}' 'there are 0 transforms, but 5 handles'
wrong '{"transforms": [[[1, 0, 0], [0, 1, 0]], [[1, 0, 0]], [], [], []]}' 'transforms[1] has 1 rows instead of 2'
wrong '{"transforms": [[[1, 0, 0], [0, 1]], 1, 2, 3, 4]}' 'transforms[0][1] is not a list of 3 finite numbers'
wrong '{"moves": {}}' 'moves is not a list'
wrong '{"moves": [{"move": [1, 1]}]}' 'moves[0].handle must be a handle, a whole number from 0 to 4'
wrong '{"moves": [{"handle": 0}, {"handle": 0}]}' 'moves[1] moves handle 0 again'
wrong '{"moves": [{"handle": 1, "move": [1]}]}' 'moves[0].move is not a list of 2 finite numbers'
wrong '{"moves": [{"handle": 1, "turn": "left"}]}' 'moves[0].turn is not a finite number'
wrong '{"moves": [{"handle": 1, "turn": 9, "axis": [0, 0, 1]}]}' 'moves[0].axis goes with a turn in space'
wrong '{"moves": [{"handle": 1, "rotate": 9}]}' "moves[0] has a member 'rotate'; it may have: handle, move"
wrong '{"moves": [{"handle": 1, "matrix": [[1, 0]]}]}' 'moves[0].matrix has 1 rows instead of 2'
run 1 pose -s cube.obj -a cube.json -t bad.json points.txt -
printf '{"moves": [{"handle": 1, "turn": 9}]}' >bad.json
run 1 pose -s cube.obj -a cube.json -t bad.json points.txt -
says 'moves[0].axis is not a list of 3'
printf '{"moves": [{"handle": 1, "turn": 9, "axis": [0, 0, 0]}]}' >bad.json
run 1 pose -s cube.obj -a cube.json -t bad.json points.txt -
says 'moves[0].axis has no direction'

# Wrong usage.
run 2 pose -s cage.txt -a handles.json in out
says '--pose FILE is missing'
run 2 pose -s cage.txt -t rest.json in out
says '--handles FILE is missing'
run 2 pose -s cage.txt -a handles.json -t rest.json points.txt
says 'usage: libicc pose'
run 2 pose -b bound -s cage.txt -t rest.json out
says '--source and --handles do not go with --binding'
run 2 pose -b bound -t rest.json in out
says 'give one file, OUT'
run 2 pose -b bound -t rest.json
says 'usage: libicc pose'
run 2 pose -s cage.txt -a handles.json -t - - -
says 'only one input can be standard input'
run 2 pose -s cage.txt -a handles.json -t rest.json points.txt - --json
says 'cannot both go to standard output'

finish
