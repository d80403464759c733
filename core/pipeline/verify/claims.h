#pragma once

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/pipeline/verify/verify.h"

namespace farhorizon {

/// A list of claims and whether they hold, in the order in which they were checked.
class Claims {
 public:
  void Add(bool holds, std::string claim) { checks_.push_back({holds, std::move(claim)}); }

  void Append(std::vector<ClaimCheck> checks) {
    for (ClaimCheck& check : checks) checks_.push_back(std::move(check));
  }

  /// Checks that `found` is `claimed`. what: the value's name in the claim's text.
  template <typename T>
  void Same(const std::string& what, const T& claimed, const T& found) {
    std::ostringstream line;
    line.precision(10);
    line << what << ": claimed " << claimed;
    if (!(claimed == found)) line << ", found " << found;
    Add(claimed == found, line.str());
  }

  /// Checks that an error, in metres, is no greater than claimed.
  void AtMost(const std::string& what, double claimed, double found, const char* unit = "m") {
    std::ostringstream line;
    line.precision(10);
    line << what << ": claimed " << claimed << " " << unit << ", found " << found << " " << unit;
    Add(found <= claimed, line.str());
  }

  std::vector<ClaimCheck> Take() && { return std::move(checks_); }

 private:
  std::vector<ClaimCheck> checks_;
};

}  // namespace farhorizon
