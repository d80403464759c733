#!/usr/bin/env bash
# check_layers.sh must see what it is there to see: each case puts one include into a small sound
# tree and expects the very offence, or none.
set -euo pipefail
check="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/check_layers.sh"
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

expect() { # STATUS TEXT FILE INCLUDE: what check_layers.sh does when FILE includes INCLUDE
  local output status=0
  rm -rf "${tree:?}"/*
  mkdir -p "$tree/core/base" "$tree/service" "$(dirname "$tree/$3")"
  echo '#include <vector>' >"$tree/core/base/result.h"
  echo '#include "core/base/result.h"' >"$tree/service/log.h"
  echo "#include $4" >>"$tree/$3"
  output=$("$check" "$tree" 2>&1) || status=$?
  if [[ $status -ne $1 || $output != *"$2"* ]]; then
    echo "FAILED: $3 including $4: expected status $1 and '$2', got $status and: $output"
    failures=$((failures + 1))
  fi
}

sound='every one along an arrow'
# Down an arrow.
expect 0 "$sound" core/pipeline/build.cpp '"core/horizon/horizon.h"'
expect 0 "$sound" service/http/router.cpp '"service/handlers/jobs.h"'
expect 0 "$sound" core/io/dem/read_dem.cpp '<gdal_priv.h>'
expect 0 "$sound" core/geo/crs.cpp '<proj_experimental.h>'
expect 0 "$sound" core/io/mesh_files/meshopt_view.cpp '<meshoptimizer.h>'
expect 0 "$sound" core/io/mesh_files/draco_file.cpp '<draco/compression/decode.h>'
expect 0 "$sound" core/exact/int128.h '<boost/multiprecision/cpp_int.hpp>'
expect 0 "$sound" service/jobs/sqlite_job_store.cpp '<sqlite3.h>'
# Up, or across.
expect 1 'core/base may not include core/io' core/base/result.cpp '"core/io/file.h"'
expect 1 'core/horizon may not include core/simplify' core/horizon/horizon.h '"core/simplify/lod_chain.h"'
expect 1 'core/terrain may not include service/jobs' core/terrain/dem.cpp '"service/jobs/job.h"'
expect 1 'service/jobs may not include service/http' service/jobs/job.cpp '"service/http/server.h"'
expect 1 'core/geo may not include core/io' core/geo/crs.cpp '  "core/io/file.h"  // indented'
expect 1 'has no row' core/misc/thing.h '"core/base/result.h"'
expect 1 'name it from the root' core/base/result.cpp '"result.h"'
expect 1 'name it from the root' core/base/result.cpp '"tests/support/ascii_dem.h"'
# A room by itself: the second engine shares no algorithm with the first.
expect 1 'core/horizon/kinetic may not include core/horizon/sweep' core/horizon/kinetic/scene.cpp '"core/horizon/sweep/hull_sweep.h"'
expect 1 'core/horizon/kinetic may not include core/horizon/visibility' core/horizon/kinetic/scene.h '"core/horizon/visibility/occluder_set.h"'
expect 1 'core/horizon/kinetic may not include core/horizon/lines_of_sight' core/horizon/kinetic/scene.h '"core/horizon/lines_of_sight/lines_of_sight.h"'
expect 1 'core/horizon/sweep may not include core/horizon/search' core/horizon/sweep/candidates.cpp '"core/horizon/find_horizon.h"'
expect 1 'core/horizon/attic has no row' core/horizon/attic/thing.h '"core/base/result.h"'
expect 0 "$sound" core/horizon/find_horizon.cpp '"core/horizon/kinetic/kinetic_horizon.h"'
# Foreign headers outside their rooms, or in a header of the core.
expect 1 '<gdal_priv.h> may not be included here' core/io/dem/read_dem.h '<gdal_priv.h>'
expect 1 '<ogrsf_frmts.h> may not be included here' core/geo/crs.cpp '<ogrsf_frmts.h>'
expect 1 '<proj.h> may not be included here' core/io/dem/read_dem.cpp '<proj.h>'
expect 1 '<draco/mesh/mesh.h> may not be included here' core/pipeline/build.cpp '<draco/mesh/mesh.h>'
expect 1 '<meshoptimizer.h> may not be included here' core/io/glb.cpp '<meshoptimizer.h>'
expect 1 'core/pipeline may not include core/io/mesh_files' core/pipeline/report.cpp '"core/io/mesh_files/read_mesh.h"'
expect 1 '<boost/asio.hpp> may not be included here' service/handlers/jobs.cpp '<boost/asio.hpp>'
expect 1 '<nlohmann/json.hpp> may not be included here' core/pipeline/build.h '<nlohmann/json.hpp>'
expect 1 '<sqlite3.h> may not be included here' service/http/router.cpp '<sqlite3.h>'
expect 1 'is in no row' core/base/result.cpp '<fmt/core.h>'

# One file alone may know the database.
rm -rf "${tree:?}"/*
mkdir -p "$tree/core" "$tree/service/jobs"
echo '#include <sqlite3.h>' | tee "$tree/service/jobs/one.cpp" >"$tree/service/jobs/two.cpp"
if "$check" "$tree" >/dev/null 2>"$tree/said" || ! grep -q 'alone' "$tree/said"; then
  echo 'FAILED: two files that include <sqlite3.h> went unnoticed'
  failures=$((failures + 1))
fi

((failures == 0)) && echo 'check_layers_test: every offence was seen'
