#include "service/ip_networks.h"

#include <algorithm>
#include <arpa/inet.h>
#include <charconv>
#include <cstring>
#include <netinet/in.h>

#include "service/text_list.h"

namespace farhorizon {

namespace {

bool SameBits(const IpAddress& a, const IpAddress& b, unsigned bits) {
  const unsigned whole = bits / 8;
  if (!std::equal(a.begin(), a.begin() + whole, b.begin())) return false;
  const unsigned rest = bits % 8;
  return rest == 0 || ((a[whole] ^ b[whole]) >> (8 - rest)) == 0;
}

}  // namespace

std::optional<IpAddress> ReadIpAddress(const std::string& text) {
  IpAddress bytes{};
  if (::inet_pton(AF_INET6, text.c_str(), bytes.data()) == 1) return bytes;
  struct in_addr four {};
  if (::inet_pton(AF_INET, text.c_str(), &four) != 1) return std::nullopt;
  bytes[10] = bytes[11] = 0xFF;
  std::memcpy(bytes.data() + 12, &four, sizeof four);
  return bytes;
}

std::string IpAddressText(const IpAddress& address) {
  constexpr std::array<unsigned char, 12> kFour = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF};
  const bool four = std::equal(kFour.begin(), kFour.end(), address.begin());
  std::array<char, INET6_ADDRSTRLEN> text{};
  ::inet_ntop(four ? AF_INET : AF_INET6, address.data() + (four ? kFour.size() : 0), text.data(),
              text.size());
  return text.data();
}

Result<IpNetworks> IpNetworks::Read(const std::string& list, const std::string& key) {
  IpNetworks read;
  for (const std::string& entry : CommaList(list)) {
    const std::size_t slash = std::min(entry.find('/'), entry.size());
    const std::optional<IpAddress> address = ReadIpAddress(entry.substr(0, slash));
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
                   key + " has \"" + entry +
                       "\", expected addresses and networks, such as 127.0.0.1, 10.0.0.0/8",
                   "invalid-config"};
    }
    read.networks_.push_back({*address, bits + (four ? 96 : 0)});
  }
  return read;
}

bool IpNetworks::Has(const IpAddress& address) const {
  return std::any_of(networks_.begin(), networks_.end(), [&](const Network& network) {
    return SameBits(network.bytes, address, network.bits);
  });
}

}  // namespace farhorizon
