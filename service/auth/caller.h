#pragma once

#include <string>

#include "service/auth/scope.h"

namespace farhorizon {

/// Who sends a request. As it is made: whoever reaches a service that asks for no keys, who may do
/// and see all.
struct Caller {
  std::string key_id = {};  ///< empty where no key was asked for
  std::string owner = {};   ///< whose jobs the caller's are; likewise
  Scopes scopes = {Scope::kAdmin};

  /// Somebody without a key, where keys are asked for.
  static Caller Stranger() { return {.scopes = {}}; }
  [[nodiscard]] bool IsStranger() const { return scopes == Scopes(); }

  [[nodiscard]] bool SeesAll() const { return scopes.Has(Scope::kAdmin); }
  /// Whether the jobs of `whose` are the caller's to see.
  [[nodiscard]] bool Sees(const std::string& whose) const {
    return SeesAll() || (!owner.empty() && owner == whose);
  }
};

}  // namespace farhorizon
