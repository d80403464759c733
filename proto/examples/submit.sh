#!/bin/sh
# A DEM by itself, and as a form. usage: submit.sh DEM [URL]
dem=$1 url=${2:-http://127.0.0.1:8080}
curl --fail-with-body -H 'Content-Type: image/tiff' --data-binary "@$dem" "$url/jobs?levels=4"
curl --fail-with-body -F "dem=@$dem" -F 'params={"levels": 4, "formats": ["3dtiles", "geojson"]}' "$url/jobs"
