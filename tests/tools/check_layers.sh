#!/usr/bin/env bash
# Who may include whom: reads every #include of core/ and service/ and fails on any other arrow than
# those drawn in README "Where things are".
#   tests/tools/check_layers.sh [ROOT]       default: the tree this script stands in
set -euo pipefail
export LC_ALL=C
cd "${1:-"$(dirname "${BASH_SOURCE[0]}")/../.."}"

# Our own headers: what each room (a folder, but for files named below) may include beside itself.
below_horizon="core/base core/exact core/geometry core/terrain"
below_pipeline="$below_horizon core/horizon core/horizon/search core/horizon/lines core/horizon/visibility
  core/horizon/lines_of_sight core/horizon/trace core/simplify core/measure core/geo core/io core/io/dem"
declare -A may=(
  [core/base]=""
  [core/exact]="core/base"
  [core/geometry]="core/base core/exact"
  [core/terrain]="core/base core/exact core/geometry"
  # The rooms of core/horizon. Its root holds what the rooms share (the types of the result, witnesses, the
  # tree of merging hulls); `search` is what stands above the rooms (find_folder_of names its files).
  [core/horizon]="$below_horizon"
  [core/horizon/lines]="$below_horizon core/horizon"
  [core/horizon/visibility]="$below_horizon core/horizon"
  [core/horizon/sweep]="$below_horizon core/horizon core/horizon/visibility"
  # A second opinion: it shares no room with what it checks.
  [core/horizon/kinetic]="$below_horizon core/horizon core/horizon/kinetic/hulls core/horizon/kinetic/neighbours core/horizon/kinetic/bitangents"
  [core/horizon/kinetic/hulls]="$below_horizon"
  [core/horizon/kinetic/neighbours]="$below_horizon core/horizon/kinetic/hulls"
  [core/horizon/kinetic/bitangents]="$below_horizon core/horizon/kinetic/hulls"
  [core/horizon/lines_of_sight]="$below_horizon core/horizon core/horizon/lines core/horizon/visibility"
  [core/horizon/trace]="$below_horizon core/horizon core/horizon/sweep core/horizon/kinetic core/horizon/kinetic/hulls core/horizon/kinetic/bitangents"
  [core/horizon/search]="$below_horizon core/horizon core/horizon/visibility core/horizon/sweep core/horizon/kinetic"
  # Is a segment occluded by the DEM? What makes levels and what measures them ask alike.
  [core/horizon/guard]="$below_horizon core/horizon core/horizon/visibility"
  # The rooms of core/simplify, each above the one before; its root has the chain's order.
  [core/simplify/mesh]="$below_horizon"
  [core/simplify/lines]="$below_horizon core/horizon core/simplify/mesh"
  [core/simplify/prices]="$below_horizon core/horizon core/simplify/mesh core/simplify/lines"
  [core/simplify/work]="$below_horizon core/horizon core/horizon/guard core/horizon/visibility core/simplify/mesh core/simplify/lines core/simplify/prices"
  [core/simplify/order]="$below_horizon core/simplify/mesh core/simplify/prices core/simplify/work"
  [core/simplify/polish]="$below_horizon core/simplify/mesh core/simplify/prices core/simplify/work"
  [core/simplify/sides]="$below_horizon core/simplify/mesh core/simplify/work core/simplify/order"
  [core/simplify]="$below_horizon core/horizon core/simplify/mesh core/simplify/work core/simplify/order core/simplify/polish core/simplify/sides"
  # Both errors of any mesh: knows nothing of how a mesh was made.
  [core/measure]="$below_horizon core/horizon core/horizon/guard core/horizon/visibility"
  [core/geo]="core/base"
  [core/io]="core/base core/geometry core/terrain core/horizon core/horizon/lines_of_sight core/horizon/trace core/geo"
  # What a file is by its first bytes, and grids of text: neither knows GDAL.
  [core/io/file_kind]="core/base core/io/text_grid"
  [core/io/text_grid]="core/base"
  [core/io/raster]="core/base core/geo core/io core/io/file_kind core/io/text_grid"
  [core/io/dem]="core/base core/geometry core/terrain core/geo core/io core/io/text_grid core/io/raster core/io/dem/tiff core/io/dem/values core/io/dem/place"
  # The tags and blocks of a TIFF; what the numbers of a band mean; where its cells lie. Their root
  # has what is at hand while one raster is read.
  [core/io/dem/tiff]="core/base core/io core/io/dem"
  [core/io/dem/values]="core/base core/terrain core/geo core/io core/io/text_grid core/io/dem core/io/dem/tiff"
  [core/io/dem/place]="core/base core/terrain core/geo core/io core/io/dem"
  # Meshes that others wrote; `compare` alone reads them.
  [core/io/mesh_files]="core/base core/io"
  # Tiles of terrain for a globe: their bytes, and their list.
  [core/io/quantized_mesh]="core/base core/geo core/io"
  [core/pipeline]="$below_pipeline"
  [core/pipeline/compare]="$below_pipeline core/io/mesh_files core/pipeline"
  [core/pipeline/verify]="$below_pipeline core/pipeline core/pipeline/terrain_tiles core/io/quantized_mesh"
  [core/pipeline/report_page]="$below_pipeline core/pipeline"
  # Levels cut into tiles for a globe.
  [core/pipeline/terrain_tiles]="$below_pipeline core/io/quantized_mesh core/pipeline"
  # What stands above the rooms of core/pipeline: the build itself.
  [core/pipeline/build]="$below_pipeline core/pipeline core/pipeline/report_page core/pipeline/terrain_tiles"
  # The service's own root: clock, log, and the wrapper header of Asio. main.cpp is below.
  [service]="core/base"
  [service/worker]="core/base core/io core/pipeline core/pipeline/build service service/worker/spawner"
  # What shuts a worker in, and what starts it so.
  [service/worker/sandbox]="core/base core/io"
  [service/worker/spawner]="core/base core/geo core/io service/worker service/worker/sandbox"
  # Requests of this service to servers that clients name.
  [service/outgoing]="core/base core/io service"
  # Keys: who sends a request, and what they may.
  [service/auth]="core/base core/io service"
  # S3-compatible storage: it knows requests and keys, and no jobs.
  [service/s3]="core/base core/io service"
  [service/jobs]="core/base core/io core/pipeline service service/s3 service/worker service/worker/sandbox service/worker/spawner"
  # Looks at the data directory of a stopped service.
  [service/jobs/fsck]="core/base core/io service service/auth service/jobs"
  # What web pages consist of: their texts, and the files of CesiumJS.
  [service/pages]="core/base core/io core/pipeline/report_page service"
  [service/handlers]="core/base core/io core/io/file_kind core/pipeline service service/auth service/jobs service/outgoing service/pages"
  [service/http]="core/base service service/handlers"
  # The configuration consists of the options of the parts, so it stands above them.
  [service/config]="core/base service service/auth service/s3 service/worker service/jobs service/outgoing service/http"
  [service/cli]="core/base core/geo core/io core/pipeline core/pipeline/build service service/auth service/worker service/worker/sandbox service/worker/spawner service/jobs service/jobs/fsck service/outgoing service/handlers service/http service/pages core/pipeline/verify core/pipeline/compare core/horizon core/horizon/search service/config"
  [service/main.cpp]="core/base service service/cli"
)

# Foreign headers: a pattern of what stands in the angle brackets @ the files that may include it.
# The first row that matches decides; a header with a dot or a slash that is in no row is an offence,
# so that a new dependency has to be entered here.
foreign=(
  '(gdal|ogr|cpl_|vrt) @ ^core/io/((dem|raster)/([a-z]+/)?)?[^/]+\.cpp$'
  'draco/ @ ^core/io/(mesh_files/)?[^/]+\.cpp$'
  'meshoptimizer\.h$ @ ^core/io/mesh_files/[^/]+\.cpp$'
  'proj(_[a-z]+)?(\.h$|/) @ ^core/geo/[^/]+\.cpp$'
  'boost/multiprecision/ @ ^core/exact/'
  'boost/ @ ^service/asio\.h$ ^service/(http|worker|cli)/'
  'sqlite3 @ ^service/jobs/[a-z_0-9]+\.cpp$'
  'pqxx/ @ ^service/jobs/[a-z_0-9]+\.cpp$'
  'postgresql/ @ ^service/jobs/database_url\.cpp$'
  'curl/ @ ^service/curl\.h$ ^service/outgoing/outgoing_url\.cpp$'
  'pugixml @ ^service/s3/[a-z_0-9]+\.cpp$'
  'nlohmann/ @ ^core/(io|pipeline)/((compare|quantized_mesh)/)?[^/]+\.cpp$ ^core/io/mesh_files/(gltf_json\.h|[^/]+\.cpp)$ ^service/[a-z_0-9]+\.(h|cpp)$ ^service/(auth|handlers|jobs|worker|config|cli)/'
  'openssl/ @ ^core/io/[^/]+\.cpp$'
  'CLI/ @ ^service/cli/(command_line|run)\.cpp$'
  'prometheus/ @ ^service/metrics\.cpp$'
  # The system's own: files in core/io, processes and sockets in service.
  '((sys|netinet|arpa|linux)/)?[a-z_0-9]+\.h$ @ ^core/io/[^/]+\.cpp$ ^service/'
)
# A database hides behind one interface: it is seen by one file alone.
single=('sqlite3' 'pqxx' 'pugixml')

bad=0
offence() {
  echo "$1: $2" >&2
  bad=1
}

# Sets `folder` to the row of `may` that a path belongs to: its folder, but for the files that have a
# row elsewhere. No output to be captured: ten thousand subshells took a minute.
find_folder_of() {
  case $1 in
    service/main.cpp) folder=$1 ;;
    core/horizon/find_horizon.* | core/horizon/candidate_decider.* | core/horizon/join_horizons.* | core/horizon/occluded_edges.*)
      folder=core/horizon/search ;;
    core/pipeline/build.* | core/pipeline/write_levels.*) folder=core/pipeline/build ;;
    */*) folder=${1%/*} ;;
    *) folder=. ;;
  esac
}

check_own() { # PLACE FILE TARGET
  local folder from to
  find_folder_of "$2"
  from=$folder
  find_folder_of "$3"
  to=$folder
  if [[ ! $3 =~ ^(core|service)/ ]]; then
    offence "$1" "includes \"$3\": name it from the root, and only core/ and service/"
  elif [[ ! -v may[$from] ]]; then
    offence "$1" "folder $from has no row in check_layers.sh"
  elif [[ $to != "$from" && " ${may[$from]} " != *" $to "* ]]; then
    offence "$1" "$from may not include $to ($3)"
  fi
}

check_foreign() { # PLACE FILE TARGET
  [[ $3 == *[./]* ]] || return 0 # the standard library
  local row files file
  for row in "${foreign[@]}"; do
    [[ $3 =~ ^(${row% @ *}) ]] || continue
    files=${row#* @ }
    for file in $files; do
      [[ $2 =~ $file ]] && return
    done
    offence "$1" "<$3> may not be included here, only in $files"
    return
  done
  offence "$1" "<$3> is in no row of check_layers.sh"
}

count=0
include='^([^:]+):([0-9]+):[[:space:]]*#[[:space:]]*include[[:space:]]*([<"])([^>"]+)[>"]'
while IFS= read -r line; do
  [[ $line =~ $include ]] || continue
  file=${BASH_REMATCH[1]} place=${BASH_REMATCH[1]}:${BASH_REMATCH[2]}
  target=${BASH_REMATCH[4]}
  count=$((count + 1))
  if [[ ${BASH_REMATCH[3]} == '"' ]]; then
    check_own "$place" "$file" "$target"
  else
    check_foreign "$place" "$file" "$target"
  fi
done < <(grep -rnE --include='*.h' --include='*.cpp' '^[[:space:]]*#[[:space:]]*include' core service)

for header in "${single[@]}"; do
  mapfile -t users < <(grep -rlE --include='*.h' --include='*.cpp' "#include <$header" service || true)
  ((${#users[@]} <= 1)) || offence "${users[1]}" "<$header…> already belongs to ${users[0]} alone"
done

((count)) || offence "$PWD" "no #include found: is this the root of the tree?"
((bad)) || echo "check_layers: $count includes, every one along an arrow"
exit "$bad"
