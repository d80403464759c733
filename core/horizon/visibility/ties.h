#pragma once

namespace farhorizon {

/// Whether ground at exactly the height of a line of sight occludes it.
enum class Ties {
  kPass,   ///< no: definition D2 (core/horizon/README.md, section 2)
  kBlock,  ///< yes: asks whether a segment, added to the set, would raise the skyline
};

}  // namespace farhorizon
