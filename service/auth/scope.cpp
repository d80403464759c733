#include "service/auth/scope.h"

#include <algorithm>
#include <iterator>

#include "service/text_list.h"

namespace farhorizon {

Result<Scopes> ReadScopes(std::string_view list) {
  Scopes scopes;
  for (const std::string& name : CommaList(list)) {
    const auto* const found = std::find(kScopeNames.begin(), kScopeNames.end(), name);
    if (found == kScopeNames.end()) {
      return Error{ErrorCode::kInvalidArgument,
                   "there is no scope \"" + name + "\"; scopes are submit, read, delete, admin"};
    }
    scopes.Add(static_cast<Scope>(std::distance(kScopeNames.begin(), found)));
  }
  if (scopes == Scopes()) {
    return Error{ErrorCode::kInvalidArgument,
                 "a key without a scope is of no use; scopes are submit, read, delete, admin"};
  }
  return scopes;
}

std::vector<std::string> NamesOf(Scopes scopes) {
  if (scopes.Has(Scope::kAdmin)) return {"admin"};
  std::vector<std::string> names;
  for (const Scope scope : {Scope::kSubmit, Scope::kRead, Scope::kDelete}) {
    if (scopes.Has(scope)) names.emplace_back(kScopeNames.at(static_cast<std::size_t>(scope)));
  }
  return names;
}

}  // namespace farhorizon
