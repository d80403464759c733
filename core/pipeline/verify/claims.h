#pragma once

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/pipeline/verify/verify.h"

namespace farhorizon {

/// The list of checks that verification makes, in order.
class Claims {
 public:
  void Add(bool holds, std::string claim) { checks_.push_back({holds, std::move(claim)}); }

  /// That what was claimed is what was found.
  template <typename T>
  void Same(const std::string& what, const T& claimed, const T& found) {
    std::ostringstream line;
    line.precision(10);
    line << what << ": claimed " << claimed;
    if (!(claimed == found)) line << ", found " << found;
    Add(claimed == found, line.str());
  }

  /// That a measured error is no greater than claimed.
  void AtMost(const std::string& what, double claimed, double found) {
    std::ostringstream line;
    line.precision(10);
    line << what << ": claimed " << claimed << " m, found " << found << " m";
    Add(found <= claimed, line.str());
  }

  std::vector<ClaimCheck> Take() && { return std::move(checks_); }

 private:
  std::vector<ClaimCheck> checks_;
};

}  // namespace farhorizon
