#include "core/pipeline/sweep_picture.h"

#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "core/horizon/trace/sweep_trace.h"
#include "core/io/file.h"
#include "core/io/sweep_svg.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

namespace {

std::string Metres(double value) {
  std::ostringstream text;
  text.precision(8);
  text << value << " m";
  return text.str();
}

}  // namespace

Status WriteSweepPicture(const std::filesystem::path& dem, const std::filesystem::path& out,
                         double height_m, const BuildOptions& options, const RunControl& control) {
  if (out.extension() != ".svg") {
    return Error{
        ErrorCode::kInvalidArgument,
        "a trace is a picture: its file must end in .svg, not \"" + out.extension().string() + "\"",
        "unknown-format"};
  }
  control.Report(Stage::kRead, 0);
  Result<std::unique_ptr<TerrainInput>> input = TerrainInput::Open(dem, options, control);
  if (!input) return std::move(input.error());
  control.Report(Stage::kRead, 1);
  const Dem& grid = (*input)->dem();
  const double quanta = std::round((height_m - grid.height_offset_m) / grid.quantum_m);
  constexpr double kLimit = 1 << 30;  // no height of a Dem has more quanta
  Result<SweepTrace> trace = Error{ErrorCode::kInvalidArgument, "", "no-such-level"};
  if (std::abs(quanta) < kLimit) {
    trace = TraceSweep((*input)->terrain(), static_cast<std::int32_t>(quanta), control);
  }
  if (!trace && trace.error().kind == "no-such-level") {
    const auto [least, most] = (*input)->report().heights_m;
    return Error{ErrorCode::kInvalidArgument,
                 "no ground is cut at " + Metres(height_m) + "; heights are " + Metres(least) +
                     " to " + Metres(most),
                 "no-such-level"};
  }
  if (!trace) return std::move(trace.error());
  const double drawn_m = grid.height_offset_m + trace->height * grid.quantum_m;
  control.Report(Stage::kWrite, 0);
  Status written =
      WriteFile(out, DrawSweep(*trace, dem.filename().string() + " at " + Metres(drawn_m)));
  control.Report(Stage::kWrite, 1);
  return written;
}

}  // namespace farhorizon
