// Each level is halved and halved again, along meridians and parallels in turn, down to the tiles
// of the zooms that it serves. Halves share the vertices of their cut: tiles of a zoom meet.
// A level is never cut as a whole: depth first, with the pieces of one tile at each zoom in memory.
#include "core/pipeline/terrain_tiles/terrain_tiles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "core/geo/ellipsoid.h"
#include "core/geometry/floor_divide.h"
#include "core/io/gzip.h"
#include "core/io/quantized_mesh/layer_json.h"
#include "core/pipeline/report.h"
#include "core/pipeline/terrain_tiles/quantize_part.h"
#include "core/pipeline/terrain_tiles/split_part.h"
#include "core/pipeline/terrain_tiles/zoom_plan.h"

namespace farhorizon {

namespace {

// A tile before its metadata is known.
struct MadeTile {
  QuantizedTile tile;
  double error_m = 0;
};

// How far the flat pieces of a tile are under the ellipsoid, where it is parted by `halvings`: of a
// piece of w radians by w, R w^2 / 4.
double SagAt(int zoom, int halvings) {
  const double width = std::ldexp(std::numbers::pi, -zoom - halvings);
  return kEquatorialRadiusM * width * width / 4;
}

// The least halvings that leave no more of it than an eighth of what clients take the tile's error
// to be.
int HalvingsAt(int zoom) {
  int halvings = 0;
  while (SagAt(zoom, halvings) > ClientErrorAt(zoom) / 8) ++halvings;
  return halvings;
}

bool HasGround(const GlobePart& part, const std::vector<GlobeVertex>& vertices) {
  return std::any_of(part.triangles.begin(), part.triangles.end(), [&vertices](const auto& t) {
    return vertices[t[0]].is_ground && vertices[t[1]].is_ground && vertices[t[2]].is_ground;
  });
}

void Append(const GlobePart& from, GlobePart& to) {
  to.triangles.insert(to.triangles.end(), from.triangles.begin(), from.triangles.end());
  to.walls.insert(to.walls.end(), from.walls.begin(), from.walls.end());
}

// The quarters of a tile, west before east, south before north.
std::array<GlobePart, 4> Quarters(const GlobePart& part, const LatticePoint& middle,
                                  std::vector<GlobeVertex>& vertices) {
  std::array<GlobePart, 2> columns = SplitPart(part, Axis::kX, middle.x, vertices);
  std::array<GlobePart, 2> west = SplitPart(columns[0], Axis::kY, middle.y, vertices);
  std::array<GlobePart, 2> east = SplitPart(columns[1], Axis::kY, middle.y, vertices);
  return {std::move(west[0]), std::move(west[1]), std::move(east[0]), std::move(east[1])};
}

// `part` of a square of `side`, parted by `halvings` along both coordinates.
GlobePart Parted(GlobePart part, const LatticePoint& least, std::int64_t side, int halvings,
                 std::vector<GlobeVertex>& vertices) {
  if (halvings == 0 || (part.triangles.empty() && part.walls.empty())) return part;
  const std::int64_t half = side / 2;
  GlobePart whole;
  std::array<GlobePart, 4> quarters = Quarters(part, {least.x + half, least.y + half}, vertices);
  for (std::size_t k = 0; k < 4; ++k) {
    const LatticePoint corner = {least.x + (k < 2 ? 0 : half), least.y + (k % 2 == 0 ? 0 : half)};
    Append(Parted(std::move(quarters[k]), corner, half, halvings - 1, vertices), whole);
  }
  return whole;
}

LatticePoint LeastOf(const TileAddress& address) {
  return {address.x * TileSide(address.zoom), address.y * TileSide(address.zoom)};
}

// The address of a tile on the globe: `address` may go on beyond 180 degrees.
TileAddress OnGlobe(TileAddress address) {
  const std::int64_t columns = std::int64_t{2} << address.zoom;
  address.x = (address.x % columns + columns) % columns;
  return address;
}

// Makes tiles. Those of zoom 0 are kept: their metadata has all the others.
class Cutter {
 public:
  Cutter(double height_step_m, const RunControl& control, const TerrainSink& sink)
      : height_step_m_(height_step_m), control_(&control), sink_(&sink) {}

  // Makes a tile of the ellipsoid alone, unless there is that tile. error_m: how high the ground in
  // it is.
  Status AddFlat(const TileAddress& address, double error_m) {
    if (made_.contains(OnGlobe(address))) return Ok{};
    const LatticePoint least = LeastOf(address);
    const std::int64_t side = TileSide(address.zoom);
    std::vector<GlobeVertex> vertices;
    for (const auto& [dx, dy] :
         {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
      const LatticePoint p = {least.x + dx * side, least.y + dy * side};
      vertices.push_back({p, 0, UpAt(p), 0, false});
    }
    return AddTile(address, {{{0, 1, 2}, {0, 2, 3}}, {}}, vertices, error_m);
  }

  // Makes the tiles of zooms `first` to `last` of a level, as far as there is ground in them.
  Status AddLevel(TiledLevel level, int first, int last) {
    const PlaceBox ground = BoxAround(level.mesh);
    int start = first;
    while (start > 0 && CountTiles(start, ground) > 4) --start;
    const std::int64_t side = TileSide(start);
    // A tile more at each side: the ground does not touch the box.
    const PlaceBox tiles = {
        {FloorDivide(ground.least.x, side) - 1, FloorDivide(ground.least.y, side) - 1},
        {FloorDivide(ground.greatest.x, side) + 2, FloorDivide(ground.greatest.y, side) + 2}};
    const PlaceBox box = {{tiles.least.x * side, tiles.least.y * side},
                          {tiles.greatest.x * side, tiles.greatest.y * side}};
    Result<GlobePart> whole = CoverBox(level.mesh, box);
    if (!whole) return std::move(whole.error());
    std::vector<GlobeVertex>& vertices = level.mesh.vertices;
    level.mesh.ground = {};
    first_ = first;
    last_ = last;
    error_m_ = level.geometric_error_m;
    GlobePart rest = *std::move(whole);
    for (std::int64_t x = tiles.least.x; x < tiles.greatest.x; ++x) {
      auto [column, east] = SplitPart(rest, Axis::kX, (x + 1) * side, vertices);
      rest = std::move(east);
      for (std::int64_t y = tiles.least.y; y < tiles.greatest.y; ++y) {
        auto [tile, north] = SplitPart(column, Axis::kY, (y + 1) * side, vertices);
        column = std::move(north);
        if (Status cut = Cut({start, x, y}, tile, vertices); !cut) return cut;
      }
    }
    return Ok{};
  }

  // Adds what the tiles so far need above them, and the two tiles of zoom 0, of the ellipsoid alone
  // where they are missing. error_m: how high the ground is. Then writes what was kept.
  Status Finish(double error_m) {
    const std::set<TileAddress> with_ground = made_;
    for (TileAddress address : with_ground) {
      while (address.zoom > 0) {
        address = {address.zoom - 1, address.x / 2, address.y / 2};
        if (Status added = AddFlat(address, error_m); !added) return added;
      }
    }
    for (const std::int64_t x : {0, 1}) {
      if (Status added = AddFlat({0, x, 0}, 0); !added) return added;
    }
    const std::vector<TileAddress> all(made_.begin(), made_.end());
    for (const auto& [address, tile] : kept_) {
      if (Status written = Write(address, tile, all); !written) return written;
    }
    return (*sink_)("layer.json", WriteLayerJson(all));
  }

 private:
  // Recursion: as deep as there are zooms, 22 at most.
  Status Cut(const TileAddress& address, const GlobePart& part,
             std::vector<GlobeVertex>& vertices) {
    if (!HasGround(part, vertices)) return Ok{};
    if (control_->StopRequested()) return Error{ErrorCode::kCancelled, "cancelled"};
    const std::size_t before = vertices.size();
    if (address.zoom >= first_) {
      if (Status added = AddTile(address, part, vertices, error_m_); !added) return added;
    }
    if (address.zoom < last_) {
      const std::int64_t half = TileSide(address.zoom + 1);
      const LatticePoint least = LeastOf(address);
      const std::array<GlobePart, 4> quarters =
          Quarters(part, {least.x + half, least.y + half}, vertices);
      for (std::int64_t k = 0; k < 4; ++k) {
        const TileAddress child = {address.zoom + 1, 2 * address.x + k / 2, 2 * address.y + k % 2};
        Status cut = Cut(child, quarters[static_cast<std::size_t>(k)], vertices);
        if (!cut) return cut;
      }
    }
    vertices.resize(before);
    return Ok{};
  }

  Status AddTile(const TileAddress& address, GlobePart part, std::vector<GlobeVertex>& vertices,
                 double error_m) {
    const std::size_t before = vertices.size();
    const int halvings = HalvingsAt(address.zoom);
    part = Parted(std::move(part), LeastOf(address), TileSide(address.zoom), halvings, vertices);
    QuantizedPart made = QuantizePart(address, part, vertices, height_step_m_);
    vertices.resize(before);
    if (made.has_fill) error_m += SagAt(address.zoom, halvings);
    const TileAddress on_globe = OnGlobe(address);
    // Of a DEM over the meridian of 180 degrees: in degrees of the globe, as clients have places.
    const double turn_deg =
        std::ldexp(180.0 * static_cast<double>(on_globe.x - address.x), -address.zoom);
    made.tile.rectangle.west += turn_deg;
    made.tile.rectangle.east += turn_deg;
    Check(made_.insert(on_globe).second, "a tile is made once");
    const MadeTile tile = {std::move(made.tile), error_m + made.moved_m};
    if (on_globe.zoom > 0) return Write(on_globe, tile, {});
    kept_.emplace_back(on_globe, tile);
    return Ok{};
  }

  Status Write(const TileAddress& address, const MadeTile& made,
               const std::vector<TileAddress>& all) {
    Result<std::string> bytes =
        Gzip(EncodeQuantizedMesh(made.tile, MetadataOfTile(address, RoundUp(made.error_m), all)));
    if (!bytes) return std::move(bytes.error());
    return (*sink_)(TileName(address), *bytes);
  }

  double height_step_m_;
  const RunControl* control_;
  const TerrainSink* sink_;
  std::set<TileAddress> made_;
  std::vector<std::pair<TileAddress, MadeTile>> kept_;
  int first_ = 0;
  int last_ = 0;
  double error_m_ = 0;
};

}  // namespace

Status CheckOffPoles(const Georeference& georeference, const Dem& dem) {
  for (const double sign : {-1.0, 1.0}) {
    const Enu pole = georeference.frame().ToEnu({0, 0, sign * kPolarRadiusM});
    Result<std::vector<GridPoint>> place = georeference.ToGrid({pole});
    if (!place) continue;  // the reference system does not have it
    const GridPoint& p = place->front();
    if (p.column > -1 && p.column < dem.columns && p.row > -1 && p.row < dem.rows) {
      return Error{ErrorCode::kUnsupportedData,
                   "a pole is on the DEM, and the tiles of quantized-mesh cannot show it; leave "
                   "quantized-mesh out of --formats",
                   "too-large-extent"};
    }
  }
  return Ok{};
}

Status WriteTerrainTiles(std::vector<TiledLevel> levels, const RunControl& control,
                         const TerrainSink& sink) {
  double least_m = 0;
  double greatest_m = 0;
  std::vector<double> errors_m;
  for (const TiledLevel& level : levels) {
    errors_m.push_back(level.geometric_error_m);
    for (const GlobeVertex& vertex : level.mesh.vertices) {
      least_m = std::min(least_m, vertex.height_m);
      greatest_m = std::max(greatest_m, vertex.height_m);
    }
  }
  const double most_height_m = std::max(-least_m, greatest_m);
  const ZoomPlan plan = PlanZooms(errors_m, most_height_m, BoxAround(levels.front().mesh));
  Cutter cutter(HeightStepOf(least_m, greatest_m), control, sink);
  for (std::size_t zoom = 0; zoom < plan.size();) {
    std::size_t end = zoom + 1;
    while (end < plan.size() && plan[end] == plan[zoom]) ++end;
    if (plan[zoom]) {
      Status added = cutter.AddLevel(std::move(levels[*plan[zoom]]), static_cast<int>(zoom),
                                     static_cast<int>(end) - 1);
      if (!added) return added;
    }
    zoom = end;
  }
  return cutter.Finish(most_height_m);
}

}  // namespace farhorizon
