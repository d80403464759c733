#pragma once

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// What a key may be used for.
enum class Scope {
  kSubmit,
  kRead,
  kDelete,
  kAdmin,  ///< all of these, on the jobs of all keys, and what the operator alone may see
};
inline constexpr std::array kScopeNames = {"submit", "read", "delete", "admin"};

/// A set of scopes.
class Scopes {
 public:
  constexpr Scopes() = default;
  constexpr Scopes(std::initializer_list<Scope> scopes) {
    for (const Scope scope : scopes) bits_ |= Bit(scope);
  }

  constexpr void Add(Scope scope) { bits_ |= Bit(scope); }
  /// kAdmin has every other.
  [[nodiscard]] constexpr bool Has(Scope scope) const {
    return (bits_ & (Bit(scope) | Bit(Scope::kAdmin))) != 0;
  }

  friend constexpr bool operator==(Scopes, Scopes) = default;

 private:
  static constexpr unsigned Bit(Scope scope) { return 1U << static_cast<unsigned>(scope); }
  unsigned bits_ = 0;
};

/// The scopes that a list with commas names, one at least. Errors: kInvalidArgument.
Result<Scopes> ReadScopes(std::string_view list);
/// The names of those that the set has: of kAdmin alone where it has that.
std::vector<std::string> NamesOf(Scopes scopes);

}  // namespace farhorizon
