#!/bin/sh
# Installs what is missing, builds the library, installs it below build/, compiles the examples
# against it, and runs them; the first one warps a picture.
set -eu
cd "$(dirname "$0")/.."
. cmake/deps.sh
need gcc libc6-dev make cmake pkg-config libpng-dev libjpeg-dev python3-numpy

build=build/examples
stage=$PWD/$build/stage
programs=$build/programs
out=$build/out
mkdir -p "$build" "$out"

echo "building and installing the library"
quietly "$build/configure.log" cmake -S . -B "$build/library" -DCMAKE_BUILD_TYPE=Release -DICC_BUILD_BENCHMARKS=OFF
quietly "$build/build.log" cmake --build "$build/library" --parallel "$(nproc)"
quietly "$build/install.log" cmake --install "$build/library" --prefix "$stage"

echo "building the examples against it"
quietly "$build/configure.log" cmake -S examples -B "$programs" -DCMAKE_PREFIX_PATH="$stage"
quietly "$build/build.log" cmake --build "$programs" --parallel "$(nproc)"

for name in inspect_stages maximum_and_rotation sparse_points solid_through_time mesh_4d; do
    "$programs/$name" >"$out/$name.txt"
    echo "$name"
    echo "the result is $out/$name.txt"
done
echo "l_to_square:"
"$programs/l_to_square" "$out/l_to_square.svg"

echo "animal_pose:"
"$programs/animal_pose" "$out/animal.vtk"

echo "mesh_morph examples/data/beam.mesh examples/data/bent.mesh"
"$programs/mesh_morph" examples/data/beam.mesh examples/data/bent.mesh "$out/beam.mesh" "$out/beam.vtk"

echo "warp_picture examples/data/chelsea.png"
"$programs/warp_picture" examples/data/chelsea.src.txt examples/data/chelsea.tgt.txt \
    examples/data/chelsea.png "$out/chelsea.png"

echo "functions.sh:"
LIBICC=$stage/bin/libicc sh examples/functions.sh "$out"

echo "kernel_pose:"
"$programs/kernel_pose" "$out/kernel_pose.svg"

echo "kernel.sh:"
LIBICC=$stage/bin/libicc sh examples/kernel.sh "$out"

PYTHONPATH=$PWD/bindings/python
LIBICC_LIBRARY=$(find "$stage" -name libicc.so.0)
export PYTHONPATH LIBICC_LIBRARY
echo "compare/compare.py:"
/usr/bin/python3 -B examples/compare/compare.py --cells 8 --steps 80 "$out/compare.svg"
echo "compare/bounded_biharmonic.py:"
/usr/bin/python3 -B examples/compare/bounded_biharmonic.py --cells 16
echo "compare/outlines.py:"
/usr/bin/python3 -B examples/compare/outlines.py --cells 25
echo "compare/reparent.py:"
/usr/bin/python3 -B examples/compare/reparent.py --cells 16
echo "compare/open_questions.py:"
/usr/bin/python3 -B examples/compare/open_questions.py --cells 16
echo "compare/corners.py:"
/usr/bin/python3 -B examples/compare/corners.py --cells 12 25 --turns 1
echo "compare/dual_functions.py:"
/usr/bin/python3 -B examples/compare/dual_functions.py "$out/dual_functions.svg"
echo "compare/texture.py:"
/usr/bin/python3 -B examples/compare/texture.py "$out/texture.svg"
echo "compare/skeleton.py:"
/usr/bin/python3 -B examples/compare/skeleton.py "$out/skeleton.svg"
