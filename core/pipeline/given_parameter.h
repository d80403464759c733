#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/pipeline/build_options.h"

namespace farhorizon {

/// A parameter of a build as it is given.
struct GivenParameter {
  std::string_view name;
  const std::string& value;

  /// Of a value that is no `what`.
  [[nodiscard]] Error Expected(const std::string& what) const {
    return {ErrorCode::kInvalidArgument, FlagOf(name) + " is \"" + value + "\", expected " + what,
            "invalid-parameter"};
  }
};

}  // namespace farhorizon
