// Heights at the posts and a sample of lines come first: what they attain is where the search for
// the silhouette's bound begins. It is proven edge by edge (core/measure/README.md, section 3):
// where an edge of one surface is no higher above the other one's ground than the bound, it is
// proven on the spot; for the rest, lines of sight are asked.
#include "core/measure/mesh_error.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/infinity.h"
#include "core/base/parallel_for.h"
#include "core/measure/facet_look.h"
#include "core/measure/ground_walk.h"
#include "core/measure/horizon_index.h"
#include "core/measure/line_sampling.h"
#include "core/measure/mesh_sides.h"
#include "core/measure/post_errors.h"
#include "core/measure/skyline_bound.h"
#include "core/measure/skyline_floor.h"
#include "core/measure/skyline_net.h"
#include "core/measure/welded_mesh.h"

namespace farhorizon {

namespace {

// Shares of Stage::kMeasure at which the steps end, about as they take time.
constexpr double kPosts = 0.2;
constexpr double kSampled = 0.5;
constexpr double kAbove = 0.8;

}  // namespace

struct MeshMeasurer::Dem {
  Dem(const Terrain& of, const Horizon& its_horizon, PostPlaces its_places)
      : terrain(&of),
        horizon(&its_horizon),
        places(std::move(its_places)),
        index(of, its_horizon),
        is_vertex(static_cast<std::size_t>(of.post_count())) {
    for (VertexId v = 0; v < of.post_count(); ++v) {
      is_vertex[static_cast<std::size_t>(v)] = of.IsVertex(v) ? 1 : 0;
    }
  }

  // What the first mesh needs and all share.
  Status Prepare(const RunControl& control) {
    if (sampled) return Ok{};
    const farhorizon::Dem& dem = terrain->dem();
    surface = OccludingSurface::Of(SkylineNetOf(*terrain, *horizon));
    strips = LineStrips::Of(dem.columns - 1, dem.rows - 1);
    Result<SkylineFloor> found = FloorLowered({}, control);
    if (!found) return std::move(found.error());
    floor = *std::move(found);
    Result<SampledSkyline> skyline = SampleSkyline(surface.net, dem.columns, dem.rows, control);
    if (!skyline) return std::move(skyline.error());
    sampled = *std::move(skyline);
    return Ok{};
  }

  // The floor of the horizon edges, each so much lower, without those that touch the outline: a
  // mesh may not have quite the DEM's.
  [[nodiscard]] Result<SkylineFloor> FloorLowered(const std::vector<double>& by_m,
                                                  const RunControl& control) const {
    std::vector<double> lowered_m(horizon->edges.size());
    for (std::size_t i = 0; i < lowered_m.size(); ++i) {
      const bool inner = index.inner()[i] != 0;
      lowered_m[i] = !inner ? kInfinity : by_m.empty() ? 0 : std::max(by_m[i], 0.0);
    }
    return FindSkylineFloor(surface.net, lowered_m, strips, control);
  }

  // The most of `sunk_m` over the horizon edges that do not touch the outline.
  [[nodiscard]] double MostInner(const std::vector<double>& sunk_m) const {
    double most = 0;
    for (std::size_t i = 0; i < sunk_m.size(); ++i) {
      if (index.inner()[i] != 0) most = std::max(most, sunk_m[i]);
    }
    return most;
  }

  const Terrain* terrain;
  const Horizon* horizon;
  PostPlaces places;
  HorizonIndex index;
  std::vector<std::uint8_t> is_vertex;
  OccludingSurface surface;
  LineStrips strips;
  SkylineFloor floor;
  std::optional<SampledSkyline> sampled;
};

namespace {

// How far beyond a mesh's outline there has to be ground for it to be a hole, columns or rows: more
// than rounding moves a vertex.
constexpr double kBeyond = 0.0625;

// Whether the terrain has ground where the mesh ends at a side, just beyond it.
bool EndsOverGround(const Terrain& terrain, const GridMesh& mesh, const MeshSide& side) {
  const GridPoint& a = mesh.points[static_cast<std::size_t>(side.a)];
  const GridPoint& b = mesh.points[static_cast<std::size_t>(side.b)];
  const double dx = b.column - a.column;
  const double dy = b.row - a.row;
  const double length = std::hypot(dx, dy);
  if (!(length > 0)) return false;
  // To the right of a -> b on the map where the triangle is on the left of it.
  const double beyond = (side.left != kNoneThere ? kBeyond : -kBeyond) / length;
  const double column = (a.column + b.column) / 2 - beyond * dy;
  const double row = (a.row + b.row) / 2 + beyond * dx;
  const farhorizon::Dem& dem = terrain.dem();
  if (!(column >= 0 && row >= 0 && column < dem.columns - 1 && row < dem.rows - 1)) return false;
  const auto c = static_cast<std::int32_t>(column);
  const auto r = static_cast<std::int32_t>(row);
  const Terrain::CellTriangles cell = terrain.Cell(c, r);
  for (int i = 0; i < cell.count; ++i) {
    const Triangle& t = cell.triangles[static_cast<std::size_t>(i)];
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3i p = terrain.Point(t[k]);
      const Point3i q = terrain.Point(t[(k + 1) % 3]);
      inside = inside && (q.y - p.y) * (column - p.x) - (q.x - p.x) * (row - p.y) >= 0;
    }
    if (inside) return true;
  }
  return false;
}

MeshDefects FindDefects(const Terrain& terrain, const GridMesh& mesh, const MeshSides& sides) {
  MeshDefects defects;
  defects.crowded_edges = sides.crowded;
  for (const std::array<std::int32_t, 3>& t : mesh.triangles) {
    const GridPoint& a = mesh.points[static_cast<std::size_t>(t[0])];
    const GridPoint& b = mesh.points[static_cast<std::size_t>(t[1])];
    const GridPoint& c = mesh.points[static_cast<std::size_t>(t[2])];
    const double turn =
        (b.row - a.row) * (c.column - a.column) - (b.column - a.column) * (c.row - a.row);
    defects.flipped += turn > 0 ? 0 : 1;
  }
  for (const MeshSide& side : sides.sides) {
    if (side.IsOutline() && EndsOverGround(terrain, mesh, side)) ++defects.open_edges;
  }
  return defects;
}

}  // namespace

MeshMeasurer::MeshMeasurer(const Terrain& terrain, const Horizon& horizon, PostPlaces places)
    : dem_(std::make_unique<Dem>(terrain, horizon, std::move(places))) {}
MeshMeasurer::MeshMeasurer(MeshMeasurer&&) noexcept = default;
MeshMeasurer& MeshMeasurer::operator=(MeshMeasurer&&) noexcept = default;
MeshMeasurer::~MeshMeasurer() = default;

Result<MeshError> MeshMeasurer::Measure(const PlacedMesh& mesh, const RunControl& control) {
  control.Report(Stage::kMeasure, 0);
  Status prepared = dem_->Prepare(control);
  if (!prepared) return std::move(prepared.error());
  return MeasurePrepared(mesh, control);
}

Result<std::vector<MeshError>> MeshMeasurer::MeasureAll(std::span<const PlacedMesh> meshes,
                                                        int threads, const RunControl& control) {
  control.Report(Stage::kMeasure, 0);
  Status prepared = dem_->Prepare(control);
  if (!prepared) return std::move(prepared.error());
  std::vector<std::optional<Result<MeshError>>> found(meshes.size());
  const auto share = [&](std::size_t n) {
    return static_cast<double>(n) / static_cast<double>(meshes.size());
  };
  const auto measure = [&](std::size_t i, std::size_t end, std::size_t thread) {
    RunControl piece = control.Between(share(i), share(end));
    if (thread > 0) piece.progress = nullptr;  // reports come from one thread
    found[i] = MeasurePrepared(meshes[i], piece);
  };
  const bool done =
      ParallelForBatches(meshes.size(), 1, threads, Stage::kMeasure, control, measure);
  if (!done) return Error{ErrorCode::kCancelled, "stopped while measuring"};
  std::vector<MeshError> errors;
  for (std::optional<Result<MeshError>>& error : found) {
    if (!*error) return std::move(error->error());
    errors.push_back(**error);
  }
  return errors;
}

Result<MeshError> MeshMeasurer::MeasurePrepared(const PlacedMesh& mesh,
                                                const RunControl& control) const {
  Result<PlacedMesh> welded = WeldedMesh(mesh);
  if (!welded) return std::move(welded.error());
  const GridMesh& grid = welded->grid;
  const MeshSides sides = SidesOf(grid);
  Result<PostErrors> posts =
      MeasurePosts(*dem_->terrain, dem_->is_vertex, dem_->places, *welded, sides, control);
  if (!posts) return std::move(posts.error());
  MeshError error;
  error.vertical = posts->vertical;
  error.covered_share = posts->covered_share;
  error.defects = FindDefects(*dem_->terrain, grid, sides);
  error.defects.covered_twice = posts->covered_twice;
  const FacetLook look = MeasureFacets(*dem_->terrain, grid, dem_->places);
  error.facet_angle_rms_deg = look.angle_rms_deg;
  error.needle_share = look.needle_share;
  control.Report(Stage::kMeasure, kPosts);

  const farhorizon::Dem& dem = dem_->terrain->dem();
  const GroundWalk first =
      WalkGround(*dem_->terrain, *dem_->horizon, dem_->index, grid, sides, posts->rise, kInfinity);
  const OccludingSurface surface = OccludingSurface::Of(
      SkylineNetOf(dem, dem_->horizon->hulls, grid, sides, dem_->MostInner(first.sunk_m)));
  Result<SampledSkyline> skyline = SampleSkyline(surface.net, dem.columns, dem.rows, control);
  if (!skyline) return std::move(skyline.error());
  const SampledError sampled = Compare(*dem_->sampled, *skyline);
  error.silhouette.rms_m = sampled.rms_m;
  error.sampled_max_m = sampled.max_m;
  error.sampled_rim_m = sampled.outline_max_m;
  control.Report(Stage::kMeasure, kSampled);

  RaisedBounds bounds{sampled.max_m, std::max(sampled.max_m, sampled.outline_max_m)};
  const double allowed_m = WithRoom(bounds.inner_m, dem_->surface.relief_m);
  const GroundWalk walk =
      WalkGround(*dem_->terrain, *dem_->horizon, dem_->index, grid, sides, posts->rise, allowed_m);
  Result<RaisedBounds> above =
      BoundRaised(dem_->surface, dem_->floor, walk.mesh_raised, bounds, control);
  if (!above) return std::move(above.error());
  control.Report(Stage::kMeasure, kAbove);
  Result<SkylineFloor> floor = dem_->FloorLowered(walk.sunk_m, control);
  if (!floor) return std::move(floor.error());
  Result<RaisedBounds> below = BoundRaised(surface, *floor, walk.dem_raised, *above, control);
  if (!below) return std::move(below.error());
  // Where the search was cut short: on lines whose skyline is where both surfaces are, neither is
  // further above the other than they are apart. Errors at posts are floats.
  constexpr double kOfFloats = 1 + 1e-6;
  error.silhouette.max_m =
      std::min({std::max(above->inner_m, below->inner_m), walk.most_m, walk.common_m * kOfFloats});
  error.rim_m = std::max({above->outline_m, below->outline_m, error.silhouette.max_m});
  control.Report(Stage::kMeasure, 1);
  return error;
}

}  // namespace farhorizon
