#include "service/handlers/content_coding.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "service/handlers/weighted_list.h"

namespace farhorizon {

std::vector<Coding> AcceptedCodings(const HttpRequest& request) {
  const std::string* field = request.Header("accept-encoding");
  if (field == nullptr) return {};
  std::optional<int> gzip;
  std::optional<int> zstd;
  std::optional<int> identity;
  std::optional<int> all;
  for (std::string_view rest = *field; !rest.empty();) {
    const std::size_t comma = rest.find(',');
    const std::string_view item = rest.substr(0, comma);
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
    const std::size_t semicolon = item.find(';');
    const std::string coding = LowerCase(Trimmed(item.substr(0, semicolon)));
    std::optional<int> weight = 1000;
    if (semicolon != std::string_view::npos) weight = WeightOf(Trimmed(item.substr(semicolon + 1)));
    if (!weight) return {};
    if (coding == "gzip" || coding == "x-gzip") gzip = weight;
    if (coding == "zstd") zstd = weight;
    if (coding == "identity") identity = weight;
    if (coding == "*") all = weight;
  }
  if (!gzip) gzip = all;
  const auto is_taken = [&identity](const std::optional<int>& weight) {
    return weight.value_or(0) > 0 && *weight >= identity.value_or(0);
  };
  std::vector<Coding> codings;
  if (is_taken(zstd)) codings.push_back(Coding::kZstd);
  if (is_taken(gzip)) codings.push_back(Coding::kGzip);
  if (codings.size() == 2 && *gzip > *zstd) std::ranges::reverse(codings);
  return codings;
}

bool AcceptsGzip(const HttpRequest& request) {
  return std::ranges::count(AcceptedCodings(request), Coding::kGzip) > 0;
}

}  // namespace farhorizon
