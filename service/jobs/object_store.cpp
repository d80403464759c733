#include "service/jobs/object_store.h"

#include <algorithm>

#include "core/base/hex.h"

namespace farhorizon {

bool IsSha256(const std::string& text) {
  return text.size() == 64 && std::all_of(text.begin(), text.end(), IsLowerHexDigit);
}

}  // namespace farhorizon
