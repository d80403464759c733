#include "service/http/trusted_proxies.h"

#include <algorithm>
#include <arpa/inet.h>
#include <charconv>
#include <cstring>
#include <netinet/in.h>
#include <optional>
#include <string_view>

#include "service/text_list.h"

namespace farhorizon {

namespace {

using Address = std::array<unsigned char, 16>;

std::optional<Address> AddressIn(const std::string& text) {
  Address bytes{};
  if (::inet_pton(AF_INET6, text.c_str(), bytes.data()) == 1) return bytes;
  struct in_addr four {};
  if (::inet_pton(AF_INET, text.c_str(), &four) != 1) return std::nullopt;
  bytes[10] = bytes[11] = 0xFF;
  std::memcpy(bytes.data() + 12, &four, sizeof four);
  return bytes;
}

bool SameBits(const Address& a, const Address& b, unsigned bits) {
  const unsigned whole = bits / 8;
  if (!std::equal(a.begin(), a.begin() + whole, b.begin())) return false;
  const unsigned rest = bits % 8;
  return rest == 0 || ((a[whole] ^ b[whole]) >> (8 - rest)) == 0;
}

}  // namespace

Result<TrustedProxies> TrustedProxies::Read(const std::string& list) {
  TrustedProxies proxies;
  for (const std::string& entry : CommaList(list)) {
    const std::size_t slash = std::min(entry.find('/'), entry.size());
    const std::optional<Address> address = AddressIn(entry.substr(0, slash));
    const bool four = entry.find(':') == std::string::npos;
    const unsigned most = four ? 32 : 128;
    unsigned bits = most;
    bool sound = address.has_value();
    if (slash < entry.size()) {
      const char* end = entry.data() + entry.size();
      const auto [stop, failure] = std::from_chars(entry.data() + slash + 1, end, bits);
      sound = sound && failure == std::errc() && stop == end && bits <= most;
    }
    if (!sound) {
      return Error{ErrorCode::kInvalidArgument,
                   "http.trustedProxies has \"" + entry +
                       "\", expected addresses and networks, such as 127.0.0.1, 10.0.0.0/8",
                   "invalid-config"};
    }
    proxies.networks_.push_back({*address, bits + (four ? 96 : 0)});
  }
  return proxies;
}

bool TrustedProxies::Has(const std::string& address) const {
  if (networks_.empty()) return false;
  const std::optional<Address> bytes = AddressIn(address);
  return bytes && std::any_of(networks_.begin(), networks_.end(), [&](const Network& network) {
           return SameBits(network.bytes, *bytes, network.bits);
         });
}

std::string TrustedProxies::ClientOf(const HttpRequest& request, const std::string& peer) const {
  if (!Has(peer)) return peer;
  std::vector<std::string> path;
  for (const auto& [name, value] : request.headers) {
    if (name != "x-forwarded-for") continue;
    for (std::string& address : CommaList(value)) path.push_back(std::move(address));
  }
  while (!path.empty() && Has(path.back())) path.pop_back();
  return path.empty() || !AddressIn(path.back()) ? peer : path.back();
}

}  // namespace farhorizon
