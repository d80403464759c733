#include "service/auth/link_tickets.h"

#include <charconv>

#include "core/base/hex.h"
#include "core/io/sha256.h"
#include "service/auth/api_key.h"
#include "service/random.h"

namespace farhorizon {

LinkTickets::LinkTickets() : secret_(ToHex(RandomBytes()) + ToHex(RandomBytes())) {}

std::string LinkTickets::Make(const std::string& key_id, const std::string& job_id,
                              std::int64_t expires_ms) const {
  const std::string said = key_id + "." + std::to_string(expires_ms);
  return said + "." + HmacSha256(secret_, said + "." + job_id).Hex();
}

std::optional<std::string> LinkTickets::KeyOf(std::string_view ticket, const std::string& job_id,
                                              std::int64_t now_ms) const {
  const std::size_t first = ticket.find('.');
  const std::size_t second = ticket.find('.', first == std::string_view::npos ? first : first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  const std::string said(ticket.substr(0, second));
  const std::optional<Digest> signature = Digest::FromHex(ticket.substr(second + 1));
  if (!signature || !SameDigest(*signature, HmacSha256(secret_, said + "." + job_id))) {
    return std::nullopt;
  }
  std::int64_t expires_ms = 0;
  std::from_chars(said.data() + first + 1, said.data() + said.size(), expires_ms);
  if (now_ms >= expires_ms) return std::nullopt;
  return said.substr(0, first);
}

}  // namespace farhorizon
