#include "service/handlers/route_scopes.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace farhorizon {

namespace {

struct Row {
  std::string_view method;
  std::string_view pattern;
  std::optional<Scope> needed;
};

// The routes that are not as their method suggests. A page is the same for everybody: it shows
// nothing of a job before it has been given a key.
constexpr std::array kRows = {
    Row{"GET", "/", std::nullopt},
    Row{"GET", "/viewer/{id}", std::nullopt},
    Row{"GET", "/assets/{fingerprint}/{path*}", std::nullopt},
    Row{"GET", "/healthz", std::nullopt},
    Row{"GET", "/readyz", std::nullopt},
    Row{"GET", "/metrics", Scope::kAdmin},
    Row{"POST", "/jobs/{id}/ticket", Scope::kRead},
    // Whoever may send a DEM may see how far it is, and give it up.
    Row{"GET", "/uploads/{id}", Scope::kSubmit},
    Row{"DELETE", "/uploads/{id}", Scope::kSubmit},
    Row{"OPTIONS", "/uploads", std::nullopt},
    Row{"OPTIONS", "/uploads/{id}", std::nullopt},
};

}  // namespace

std::optional<Scope> NeededScope(const std::string& method, const std::string& pattern) {
  const auto* const row = std::find_if(kRows.begin(), kRows.end(), [&](const Row& candidate) {
    return candidate.method == method && candidate.pattern == pattern;
  });
  if (row != kRows.end()) return row->needed;
  if (method == "GET") return Scope::kRead;
  if (method == "DELETE") return Scope::kDelete;
  if (method == "POST" || method == "PUT" || method == "PATCH") return Scope::kSubmit;
  return Scope::kAdmin;
}

}  // namespace farhorizon
