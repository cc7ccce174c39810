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
says 'region "east", near (4, 1), is in the target only (and 1 more differences) (--leave-out goes on)'
run 0 map --source old.geojson --target other.geojson --by name --leave-out --points points.txt -o images.txt
holds err 'source only: the whole of "south"'
layer '[0,1],[4,1],[4,2],[0,2],[0,1]' '[0,0],[4,0],[4,1.2],[0,1],[0,0]' >over.geojson
run 1 map --source old.geojson --target over.geojson --by name --points points.txt -o images.txt
says 'regions "north" and "south" overlap at (4, 1)'

# Usage.
run 1 map --source old.geojson --target new.geojson --by county --points points.txt -o images.txt
says 'feature 1 has no property "county"'
run 2 map --source old.geojson --target new.geojson --leave-out --points points.txt -o images.txt
says '--leave-out goes with --by'
run 2 map --source old.geojson --target new.geojson --by name --match auto --points points.txt -o images.txt
says '--match does not go with --by'

finish
