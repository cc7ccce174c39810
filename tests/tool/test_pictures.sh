#!/bin/sh
# Pictures that other programs have written, and what those read of ours: Netpbm's, and Pillow for what JPEG files say.
# usage: test_pictures.sh TOOL SCRATCH
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
for program in pngtopnm pnmtojpeg jpegtopnm pnmtopng; do
    if ! command -v "$program" >/dev/null; then
        echo "skipped: $program is missing"
        exit 77
    fi
done
if ! /usr/bin/python3 -c 'import numpy, PIL' 2>/dev/null; then
    echo "skipped: Pillow is missing"
    exit 77
fi

data=$(cd "$here/../../examples/data" && pwd)
warp() { # IN OUT
    run 0 warp -s "$data/chelsea.src.txt" -t "$data/chelsea.tgt.txt" "$1" "$2"
}
same() {
    cmp -s "$1" "$2" || complain "$3"
}

# What comes through pipes is what goes through files, whichever way it was written.
pngtopnm "$data/chelsea.png" >in.ppm
warp "$data/chelsea.png" png.png
warp in.ppm out.ppm
pngtopnm png.png >expected.ppm
same out.ppm expected.ppm "a PPM is warped to something else than a PNG"
warp - - <in.ppm
same out expected.ppm "through pipes"
warp - out.ppm <"$data/chelsea.png"
same out.ppm expected.ppm "a PNG in a pipe"

# JPEG, read as libjpeg's own programs do: the same pixels.
for how in "-quality=90" "-quality=75 -progressive" "-quality=60 -greyscale" "-quality=80 -restart=8"; do
    # shellcheck disable=SC2086
    pnmtojpeg $how in.ppm >in.jpg
    jpegtopnm in.jpg 2>log >plain.pnm
    warp in.jpg out.pnm
    warp plain.pnm expected.pnm
    same out.pnm expected.pnm "a JPEG is read otherwise: $how"
done

# Colour profile, size of pixels, orientation.
/usr/bin/python3 - <<'END' || complain "Pillow writes no JPEG"
from PIL import Image, ImageCms
exif = Image.Exif()
exif[0x112] = 8
profile = ImageCms.ImageCmsProfile(ImageCms.createProfile('sRGB')).tobytes()
Image.open('in.ppm').save('side.jpg', quality=95, exif=exif, dpi=(300, 200), icc_profile=profile)
END
printf '5 5\n200 5\n200 200\n5 200\n' >cage.txt
for out in side-out.jpg side-out.png; do
    run 0 warp -s cage.txt -t cage.txt side.jpg $out
done
/usr/bin/python3 - <<'END' || complain "what a JPEG says about its picture is lost"
import numpy as np
from PIL import Image, ImageOps
side = Image.open('side.jpg')
upright = np.asarray(ImageOps.exif_transpose(side)).astype(int)
for name, limit in (('side-out.png', 0), ('side-out.jpg', 1.5)):
    out = Image.open(name)
    off = np.abs(np.asarray(out) - upright)
    assert out.info['icc_profile'] == side.info['icc_profile'], name
    assert np.allclose(out.info['dpi'], (200, 300), atol=0.02), (name, out.info['dpi'])
    assert not out.getexif(), name
    assert off.mean() <= limit, (name, off.max(), off.mean())
END

finish
