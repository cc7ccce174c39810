#!/bin/sh
# Builds libicc in build/release and does three jobs with it: bends a fish, poses a figure with bones, and moves a
# county with its roads. It installs the Debian packages that are missing. The results are in build/examples/out.
# usage: sh examples/run.sh [--all]
# --all: then runs every program of this folder, one line each.
set -eu
cd "$(dirname "$0")/.."
. cmake/deps.sh
case ${1:-} in
    '' | --all) ;;
    *)
        echo "usage: sh examples/run.sh [--all]" >&2
        exit 2
        ;;
esac
need gcc libc6-dev make cmake pkg-config libpng-dev libjpeg-dev zlib1g-dev python3-numpy python3-pil

build=build/release
out=build/examples/out
rm -rf "$out"
mkdir -p "$build" "$out"

# The folder of tests/run.sh. What it was configured with before stays as it is.
[ -e "$build/tools/libicc" ] || echo "building libicc in $build; the first time this takes some minutes"
quietly build/examples/configure.log cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Release
quietly build/examples/build.log cmake --build "$build" --parallel "$(nproc)" --target libicc_tool icc icc_static

PATH=$PWD/$build/tools:$PATH
PYTHONPATH=$PWD/bindings/python
LIBICC_LIBRARY=$PWD/$build/lib/libicc.so.0
PYTHONDONTWRITEBYTECODE=1
export PATH PYTHONPATH LIBICC_LIBRARY PYTHONDONTWRITEBYTECODE
examples=$PWD/examples

# shown COMMAND... prints a command and the first line of what it says.
shown() {
    echo "   $*"
    "$@" >said.txt
    sed -n '1s/^/      /p' said.txt
    rm said.txt
}

# drawn CASE OPTION... draws the case before, by a thin-plate spline, and by libicc.
drawn() {
    /usr/bin/python3 "$examples/thin_plate.py" "$@" | sed 's/^/   /'
}

bend_a_fish() (
    "$build/tools/libicc" demo "$out/fish" >"$out/demo.txt"
    cd "$out/fish"
    shown libicc check --source before.txt --target after.txt
    shown libicc warp --source before.txt --target after.txt --background 78b9d7 fish.png bent.png
)

pose_a_figure() (
    mkdir "$out/figure"
    cd "$out/figure"
    /usr/bin/python3 "$examples/character.py" .
    shown libicc check --source character.geojson
    drawn character.geojson figure.png
)

move_a_county() (
    mkdir "$out/county"
    cd "$out/county"
    /usr/bin/python3 "$examples/county.py" .
    shown libicc map --source county.geojson --target county.geojson --geojson county-data.geojson moved.geojson
    drawn county.geojson county.png --layer county-data.geojson
)

echo "1. Bend a fish, whose outline before and after is known: in $out/fish"
bend_a_fish
echo "2. Pose a figure with bones: in $out/figure"
pose_a_figure
echo "3. Move a county with its roads: in $out/county"
move_a_county

# ran NAME COMMAND... runs a program; what it prints goes to NAME.txt.
ran() {
    name=$1
    shift
    quietly "$out/$name.txt" "$@"
    echo "   $name"
}

all_others() {
    stage=$PWD/build/examples/stage
    programs=build/examples/programs
    compare=$examples/compare
    data=$examples/data
    quietly build/examples/install.log cmake --install "$build" --prefix "$stage"
    quietly build/examples/configure.log cmake -S examples -B "$programs" -DCMAKE_PREFIX_PATH="$stage"
    quietly build/examples/build.log cmake --build "$programs" --parallel "$(nproc)"

    for name in inspect_stages maximum_and_rotation sparse_points solid_through_time mesh_4d; do
        ran "$name" "$programs/$name"
    done
    # shellcheck disable=SC2016
    ran stages sh -euc '"$1" 60 <"$2" >"$3"' sh "$programs/stages" "$data/tripus.src.txt" "$out/stages.svg"
    ran l_to_square "$programs/l_to_square" "$out/l_to_square.svg"
    ran animal_pose "$programs/animal_pose" "$out/animal.vtk"
    ran mesh_morph "$programs/mesh_morph" "$data/beam.mesh" "$data/bent.mesh" "$out/beam.mesh" "$out/beam.vtk"
    ran warp_picture "$programs/warp_picture" "$data/chelsea.src.txt" "$data/chelsea.tgt.txt" "$data/chelsea.png" \
        "$out/chelsea.png"
    ran functions sh "$examples/functions.sh" "$out"
    ran kernel_pose "$programs/kernel_pose" "$out/kernel_pose.svg"
    ran kernel sh "$examples/kernel.sh" "$out"
    ran compare /usr/bin/python3 "$compare/compare.py" --cells 8 --steps 80 "$out/compare.svg"
    ran bounded_biharmonic /usr/bin/python3 "$compare/bounded_biharmonic.py" --cells 16
    ran symmetric_weights /usr/bin/python3 "$compare/symmetric_weights.py"
    ran outlines /usr/bin/python3 "$compare/outlines.py" --cells 25
    ran facets /usr/bin/python3 "$compare/facets.py" --quick
    ran reparent /usr/bin/python3 "$compare/reparent.py" --cells 16
    ran open_questions /usr/bin/python3 "$compare/open_questions.py" --cells 16
    ran corners /usr/bin/python3 "$compare/corners.py" --cells 12 25 --turns 1
    ran dual_functions /usr/bin/python3 "$compare/dual_functions.py" "$out/dual_functions.svg"
    ran texture /usr/bin/python3 "$compare/texture.py" "$out/texture.svg"
    ran skeleton /usr/bin/python3 "$compare/skeleton.py" "$out/skeleton.svg"
}

if [ "${1:-}" = --all ]; then
    echo "All other programs: NAME prints to $out/NAME.txt and draws into $out"
    all_others
fi

echo
echo "Open these pictures in $out: fish/bent.png beside fish/fish.png, figure/figure.png, county/county.png."
echo "Change a number in $out/fish/after.txt, then run the first command of $out/demo.txt."
echo "That file has more to try with the fish; docs/README.md says which page does what."
