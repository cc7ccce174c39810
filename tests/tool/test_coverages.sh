#!/bin/sh
# map --by: two layers of polygons that share borders become one map, and what differs is named.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# layer NORTH SOUTH: a layer of two regions with these rings.
layer() {
    printf '{"type": "FeatureCollection", "features": [
  {"type": "Feature", "properties": {"name": "north"}, "geometry": {"type": "Polygon", "coordinates": [[%s]]}},
  {"type": "Feature", "properties": {"name": "south"}, "geometry": {"type": "Polygon", "coordinates": [[%s]]}}]}\n' "$1" "$2"
}
layer '[0,1],[4,1],[4,2],[0,2],[0,1]' '[0,0],[4,0],[4,1],[0,1],[0,0]' >old.geojson
layer '[0,1],[2,1.4],[4,1],[4,2],[0,2],[0,1]' '[4,1],[2,1.4],[0,1],[0,0],[4,0],[4,1]' >new.geojson
printf '2 1\n0 1\n3 2\n' >points.txt

# The border goes to the border.
run 0 map --source old.geojson --target new.geojson --by name --points points.txt -o images.txt
printf '2 1.4\n0 1\n3 2\n' >expected
close_to images.txt expected 1e-12
holds err '2 regions, 2 nodes, 3 borders'
run 0 map --source old.geojson --target new.geojson --by name --quiet --points points.txt -o images.txt
[ ! -s err ] || complain "--quiet, but: $(cat err)"

# A layer whose regions were drawn one by one is welded.
layer '[0,1.001],[2.001,1.4],[4,1],[4,2],[0,2],[0,1.001]' '[4,1.001],[2,1.4],[0,1],[0,0],[4,0],[4,1.001]' >noisy.geojson
run 0 map --source old.geojson --target noisy.geojson --by name --weld=0.01 --points points.txt -o images.txt
holds err '3 welded'

# Differences are named, and may be left out.
sed 's/"south"/"east"/' new.geojson >other.geojson
run 1 map --source old.geojson --target other.geojson --by name --points points.txt -o images.txt
says 'region "east", near (4, 1), is in the target only (and 1 more difference): leave it out'
run 0 map --source old.geojson --target other.geojson --by name --leave-out --points points.txt -o images.txt
holds err 'source only: the whole of "south"'
layer '[0,1],[4,1],[4,2],[0,2],[0,1]' '[0,0],[4,0],[4,1.2],[0,1],[0,0]' >over.geojson
run 1 map --source old.geojson --target over.geojson --by name --points points.txt -o images.txt
says 'regions "north" and "south" overlap at (4, 1): weld if they should only meet'

# Four regions meet at one corner. If one layer has a short border of two of them there, and the other one of the other
# two, its ends can be welded.
four() { # NW NE SE SW: the ring of each begins with its outer corners
    separator=
    printf '{"type": "FeatureCollection", "features": ['
    for one in nw:"$1" ne:"$2" se:"$3" sw:"$4"; do
        printf '%s{"type": "Feature", "properties": {"name": "%s"}, "geometry": {"type": "Polygon", "coordinates": [[%s]]}}' \
            "$separator" "${one%%:*}" "${one#*:}"
        separator=', '
    done
    printf ']}\n'
}
a='[-0.05,-0.05]' b='[0.05,0.05]' c='[-0.05,0.05]' d='[0.05,-0.05]'
four "[0,4],[-4,4],[-4,0],$a,$b,[0,4]" "[4,0],[4,4],[0,4],$b,[4,0]" "[0,-4],[4,-4],[4,0],$b,$a,[0,-4]" \
    "[-4,0],[-4,-4],[0,-4],$a,[-4,0]" >one.geojson
four "[0,4],[-4,4],[-4,0],$c,[0,4]" "[4,0],[4,4],[0,4],$c,$d,[4,0]" "[0,-4],[4,-4],[4,0],$d,[0,-4]" \
    "[-4,0],[-4,-4],[0,-4],$d,$c,[-4,0]" >two.geojson
printf '%s\n' '-4 0' '4 4' >points.txt
run 1 map --source one.geojson --target two.geojson --by name --points points.txt -o images.txt
says 'the border of regions "nw" and "se" near (-0.05, -0.05) is in the source only (and 9 more differences): leave it out, or weld its ends, which are 0.141421 apart'
run 1 map --source one.geojson --target two.geojson --by name --leave-out --points points.txt -o images.txt
says 'nothing is left'
run 0 map --source one.geojson --target two.geojson --by name --weld=0.15 --points points.txt -o images.txt
holds err '4 regions, 5 nodes, 8 borders'

# Usage.
run 1 map --source old.geojson --target new.geojson --by county --points points.txt -o images.txt
says 'feature 1 has no property "county"'
run 2 map --source old.geojson --target new.geojson --leave-out --points points.txt -o images.txt
says '--leave-out goes with --by'
run 2 map --source old.geojson --target new.geojson --by name --match auto --points points.txt -o images.txt
says '--match does not go with --by'

finish
