#pragma once

#include <optional>
#include <string>

#include "service/auth/scope.h"

namespace farhorizon {

/// What a key must have for a route; nullopt where none is needed. The one place that says so: a
/// route without a row there needs the scope that its method suggests, so that a new one is never
/// open by oversight. proto/openapi.yaml says the same, which a test holds to this.
std::optional<Scope> NeededScope(const std::string& method, const std::string& pattern);

}  // namespace farhorizon
