#pragma once

#include <string>
#include <vector>

namespace farhorizon {

/// Something that the data leaves open, or says twice, and that the program has decided: which way,
/// and how the user states it otherwise.
struct Assumption {
  std::string code;  ///< for programs: a row of proto/assumptions.md, such as "height-unit"
  std::string text;  ///< for people: one sentence, with the remedy
};
using Assumptions = std::vector<Assumption>;

}  // namespace farhorizon
