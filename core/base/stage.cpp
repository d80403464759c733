#include "core/base/stage.h"

namespace farhorizon {

const char* StageName(Stage stage) {
  switch (stage) {
    case Stage::kRead:
      return "read";
    case Stage::kSweep:
      return "sweep";
    case Stage::kCandidates:
      return "candidates";
    case Stage::kKineticSweep:
      return "kinetic-sweep";
    case Stage::kDecide:
      return "decide";
    case Stage::kSimplify:
      return "simplify";
    case Stage::kEncode:
      return "encode";
    case Stage::kMeasure:
      return "measure";
    case Stage::kLinesOfSight:
      return "lines-of-sight";
    case Stage::kEdgeMeasures:
      return "edge-measures";
    case Stage::kWrite:
      return "write";
    case Stage::kVerify:
      return "verify";
  }
  return "";
}

std::optional<Stage> StageFromName(std::string_view name) {
  for (const Stage stage : kStages) {
    if (name == StageName(stage)) return stage;
  }
  return std::nullopt;
}

}  // namespace farhorizon
