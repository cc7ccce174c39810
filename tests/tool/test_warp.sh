#!/bin/sh
# warp: pictures of every kind, what is inside and outside, filtering, failures.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# The helper reads and writes pictures with libpng alone.
pictures=$scratch/pictures
"${CC:-cc}" -std=c11 -o "$pictures" "$here/pictures.c" -lpng || exit 1

square() { # LOW HIGH: a square cage in pixels
    printf '%s %s\n%s %s\n%s %s\n%s %s\n' "$1" "$1" "$2" "$1" "$2" "$2" "$1" "$2"
}
same_picture() {
    "$pictures" same "$1" "$2" || complain "$1 and $2 differ: $3"
}
pixel() { # FILE X Y SAMPLES
    [ "$("$pictures" at "$1" "$2" "$3")" = "$4" ] ||
        complain "pixel $2 $3 of $1 is $("$pictures" at "$1" "$2" "$3") instead of $4"
}
square 4 28 >cage.txt
square 2 14 >half.txt
square 4 12 >small.txt
square 8 24 >big.txt

# Cages that have nothing to do with the picture.
"$pictures" make in.png 32 30 3 8 ramp
square 100 200 >far.txt
run 0 warp -s far.txt -t far.txt in.png out.png
holds err 'far.txt: the source cage covers 0 pixels of the picture of 32 x 30; cages are in pixels'
holds err 'far.txt: the target cage covers 0 pixels'
same_picture in.png out.png "cage off the picture"
square 0 1 >unit.txt
run 0 warp -s unit.txt -t unit.txt in.png out.png
holds err 'the target cage covers 1 pixel of'
square -9 -2 >left.txt
run 0 warp -s cage.txt -t left.txt in.png out.png
holds err 'left.txt: the target cage covers 0 pixels'
square 4 40 >beyond.txt
run 0 warp -s cage.txt -t beyond.txt in.png out.png
holds err 'beyond.txt: the target cage reaches beyond the picture of 32 x 30; parts that land there are cut off'
printf '0 0\n32 0\n32 30\n0 30\n' >frame.txt
run 0 warp -s frame.txt -t frame.txt in.png out.png
[ ! -s err ] || complain "a cage on the picture: $(cat err)"
printf '\377\330\377\340JFIF' >photo.png
run 1 warp -s cage.txt -t cage.txt photo.png out.png
says 'photo.png: the JPEG picture cannot be read: '
printf 'II*\000' >photo.png
run 1 warp -s cage.txt -t cage.txt photo.png out.png
says 'photo.png: this is a TIFF picture'

# The same cage twice changes nothing, whatever the kind of picture.
for kind in "1 8" "2 8" "3 8" "4 8" "1 16" "2 16" "3 16" "4 16"; do
    # shellcheck disable=SC2086
    "$pictures" make in.png 32 30 $kind ramp
    run 0 warp -s cage.txt -t cage.txt in.png out.png
    same_picture in.png out.png "$kind"
    [ ! -s out ] || complain "warp writes to stdout"
done
"$pictures" palette in.png 32 32
run 0 warp -s cage.txt -t cage.txt in.png out.png
same_picture in.png out.png palette
[ "$("$pictures" kind out.png)" = "32 32 4 8" ] || complain "a palette becomes $("$pictures" kind out.png)"
run 0 warp -s cage.txt -t cage.txt - - <in.png
same_picture in.png out "through the standard streams"

# A flat picture stays flat; pixels outside the target cage are not touched, or cleared when asked.
"$pictures" make in.png 32 32 3 8 flat
run 0 warp -s half.txt -t cage.txt in.png out.png
same_picture in.png out.png flat
run 0 warp -s half.txt -t cage.txt --background 00000000 in.png out.png
[ "$("$pictures" kind out.png)" = "32 32 4 8" ] || complain "no alpha to be clear with"
pixel out.png 3 16 "0 0 0 0"
pixel out.png 4 16 "85 86 87 255"
pixel out.png 27 27 "85 86 87 255"
pixel out.png 28 27 "0 0 0 0"
"$pictures" make in.png 32 32 1 16 flat
run 0 warp -s half.txt -t cage.txt --background '#ff8000' in.png out.png
pixel out.png 0 0 "65535 32896 0"
pixel out.png 16 16 "21845 21845 21845"

# Twice as large: bilinear, so a ramp stays a ramp. The middle of pixel 16 comes from 8.25.
"$pictures" make in.png 32 32 2 16 ramp
run 0 warp -s half.txt -t cage.txt in.png out.png
pixel out.png 16 16 "$(awk 'BEGIN { print 1023 * 7.75, int(1023 * 8.75 + 0.5) }' | awk '{ print int($1 + 0.5), $2 }')"

# Half as large: stripes of one pixel become an even grey instead of vanishing or beating.
"$pictures" make in.png 64 64 1 8 stripes
square 4 60 >wide.txt
run 0 warp -s wide.txt -t half.txt in.png out.png
for x in 4 5 6 7 8 9 10 11; do
    value=$("$pictures" at out.png "$x" 8)
    if [ "$value" -lt 96 ] || [ "$value" -gt 160 ]; then
        complain "stripes shrink to $value at $x"
    fi
done

# Pixels without an image keep their colour, are counted, and give exit code 4. A needle of a cage
# between the grid's vertices has many.
"$pictures" make in.png 64 64 1 8 flat
printf '2 2\n62 2\n62 20\n40 2.5\n30 2.5\n20 60\n2 60\n' >thin.txt
run 4 warp -s thin.txt -t thin.txt -m gradient --cells 8 in.png out.png
grep -q '^libicc: [0-9]* of 4096 pixels have no image' err || complain "not counted: $(cat err)"
same_picture in.png out.png "without an image"
echo old >kept.png
run 1 warp -s thin.txt -t thin.txt -m gradient --cells 8 --outside fail in.png kept.png
says 'pixels have no image in the source, so nothing is written'
holds kept.png old
run 0 warp -s thin.txt -t thin.txt --outside keep in.png out.png
run 0 warp -s thin.txt -t thin.txt in.png kept.png
same_picture kept.png out.png "pixels outside are kept"
run 0 warp -s thin.txt -t thin.txt --outside null in.png out.png
run 0 warp -s thin.txt -t thin.txt --background 00000000 in.png kept.png
same_picture kept.png out.png "pixels outside are cleared"
for method in foliation disc; do
    for map in mesh curves; do
        run 0 warp -s thin.txt -t thin.txt -m "$method" --map "$map" --cells 8 in.png out.png
        same_picture in.png out.png "$method, $map"
    done
done
run 0 warp -s thin.txt -t thin.txt in.png out.png --json
holds out '"without_image": 0'

# What is no picture, or half of one; nothing is left behind, nothing is overwritten.
printf 'no picture\n' >bad.png
echo old >out.png
run 1 warp -s cage.txt -t cage.txt bad.png out.png
says 'libicc: bad.png: this is not a PNG, JPEG, PNM or .npy picture'
for size in 20 60 100; do
    head -c "$size" in.png >bad.png
    run 1 warp -s cage.txt -t cage.txt bad.png out.png
    says 'libicc: bad.png: the PNG picture is damaged'
done
run 1 warp -s cage.txt -t cage.txt nowhere.png out.png
says 'libicc: nowhere.png: cannot be opened'
holds out.png old
run 1 warp -s cage.txt -t cage.txt in.png no/where.png
says 'libicc: no/where.png: cannot be written'

# Netpbm's formats lose nothing, by name and through the standard streams.
for kind in "1 8 pgm" "3 8 ppm" "1 16 pnm" "3 16 pnm" "2 8 pam" "4 16 pam"; do
    # shellcheck disable=SC2086
    set -- $kind
    "$pictures" make in.png 32 30 "$1" "$2" ramp
    run 0 warp -s far.txt -t far.txt in.png "out.$3"
    run 0 warp -s far.txt -t far.txt "out.$3" out.png
    same_picture in.png out.png "$kind"
    run 0 warp -s far.txt -t far.txt - - <"out.$3"
    cmp -s out "out.$3" || complain "not what came in: $kind"
done
"$pictures" make in.png 32 30 1 8 ramp
run 0 warp -s far.txt -t far.txt in.png out.ppm
[ "$(head -c 2 out.ppm)" = P6 ] || complain "grey in a PPM is not written in colours"
run 0 warp -s far.txt -t far.txt --background 11223344 - - <out.ppm
[ "$(head -c 2 out)" = P7 ] || complain "no PAM where there is an alpha"

# Pictures as text, with numbers of any range.
printf 'P2 # grey\n3 2 9\n0 3 6\n9 1 2' >grey.pgm
run 0 warp -s far.txt -t far.txt grey.pgm out.png
pixel out.png 1 0 85
pixel out.png 0 1 255
printf 'P1\n3 2\n101 0 1 0' >bits.pbm
run 0 warp -s far.txt -t far.txt bits.pbm out.png
pixel out.png 0 0 0
pixel out.png 1 0 255
run 2 warp -s far.txt -t far.txt bits.pbm out.pbm
says "'out.pbm' is a name for PBM"
while IFS='|' read -r text message; do
    # shellcheck disable=SC2059
    printf "$text" >bad.ppm
    run 1 warp -s far.txt -t far.txt bad.ppm out.png
    says "bad.ppm: $message"
done <<'END'
P6\n2 2\n255\n0123456789|the PNM picture of 2 x 2 is damaged: the file ends early
P6\n2 2\n255\n0123456789abP6\n|more follows after the PNM picture
P6\n2 0\n255\n|the header of the PNM picture is damaged
P6\n2 2\n65536\n0123456789ab|the header of the PNM picture is damaged
P6\n99999999 99999999\n255\n0123456789ab|the PNM picture of 99999999 x 99999999 is damaged
P6\n99999999999999999999 2\n255\n0|the header of the PNM picture is damaged
P2\n2 1\n9\n3 10|the PNM picture is damaged: a sample is missing or too large
P7\nWIDTH 2\nHEIGHT 1\nDEPTH 5\nMAXVAL 255\nENDHDR\n0123456789|the header of the PNM picture is damaged
P7\nWIDTH 2\nHEIGHT 1|the header of the PNM picture is damaged
END

# JPEG: near, as its quality says; the name says the format, or the input does.
for channels in 1 3; do
    "$pictures" make in.png 32 30 $channels 8 flat
    run 0 warp -s far.txt -t far.txt in.png out.jpg
    run 0 warp -s far.txt -t far.txt out.jpg out.png
    "$pictures" near in.png out.png 2 || complain "a JPEG is far from what it was made of"
    run 0 warp -s far.txt -t far.txt - - <out.jpg
    [ "$(head -c 3 out | od -An -tx1)" = " ff d8 ff" ] || complain "a JPEG does not stay one"
done
"$pictures" make in.png 32 30 3 8 ramp
run 0 warp -s far.txt -t far.txt --quality 100 in.png fine.jpeg
run 0 warp -s far.txt -t far.txt --quality 10 in.png coarse.JPG
[ "$(wc -c <coarse.JPG)" -lt "$(wc -c <fine.jpeg)" ] || complain "quality changes nothing"
run 0 warp -s far.txt -t far.txt fine.jpeg out.png
"$pictures" near in.png out.png 6 || complain "the best quality is bad"
run 2 warp -s far.txt -t far.txt --quality 50 in.png out.ppm
says "--quality is for JPEG, and 'out.ppm' will be PPM"
run 1 warp -s far.txt -t far.txt --background 00000000 in.png out.jpg
says 'out.jpg: the picture has an alpha, which JPEG cannot hold'
run 1 warp -s far.txt -t far.txt in.png out.pgm
says 'out.pgm: the picture has colours, which PGM cannot hold'
head -c 300 fine.jpeg >bad.jpg
run 1 warp -s far.txt -t far.txt bad.jpg out.png
says 'bad.jpg: the JPEG picture cannot be read: '

# A photograph is put upright: with Exif's orientation 6 its first column is what is seen on top.
exif() { # ORIENTATION: fine.jpeg with it; in octal
    head -c 2 fine.jpeg
    printf '\377\341\000\042Exif\000\000II*\000\010\000\000\000'
    # shellcheck disable=SC2059
    printf "\\001\\000\\022\\001\\003\\000\\001\\000\\000\\000\\0$1\\000\\000\\000\\000\\000\\000\\000"
    tail -c +3 fine.jpeg
}
run 0 warp -s far.txt -t far.txt fine.jpeg in.png
while read -r orientation x y; do # where what is at 5, 3 comes to lie
    exif "$orientation" >turned.jpg
    run 0 warp -s far.txt -t far.txt turned.jpg out.png
    pixel out.png "$x" "$y" "$("$pictures" at in.png 5 3)"
    run 0 warp -s far.txt -t far.txt turned.jpg out.jpg
    grep -q Exif out.jpg && complain "an upright picture says that it is not"
done <<'END'
1 5 3
2 26 3
3 26 26
4 5 26
5 3 5
6 26 5
7 26 26
10 3 26
END

finish
