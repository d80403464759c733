#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// A URL of http or https that this service may be sent to: written as libcurl itself would write
/// it, so that no two programs can read it in two ways.
struct OutgoingUrl {
  std::string text;    ///< all of it
  std::string scheme;  ///< "http" or "https"
  std::string host;    ///< in lower case; an address of IPv6 in brackets
  std::string port;    ///< also where the text has none
  std::string path;    ///< begins with a slash; still percent-encoded
  std::string query;   ///< with its question mark; empty without

  /// The part before the path, for people.
  [[nodiscard]] std::string Origin() const { return scheme + "://" + host + ":" + port; }
};

/// Reads a URL strictly [RFC 3986]. Refused are other schemes, user names, fragments, hosts that
/// are written otherwise than in lower-case ASCII without a dot at their end, addresses in odd
/// forms (0x7f.1, 2130706433), ports that go without saying, and paths that a server could resolve
/// to another: with "." or ".." as a segment, also before a semicolon, a backslash, an escape that
/// is none, or an encoded dot, slash, backslash, percent sign or control character.
/// Errors: kInvalidArgument "href-not-allowed": what is wrong with it.
Result<OutgoingUrl> ReadOutgoingUrl(const std::string& text);

/// URLs that begin like one of a list.
/// Threads: safe once made.
class UrlPrefixes {
 public:
  /// list: with commas, "https://tiles.example.org/dem, http://store:9000/". Each is a URL as
  /// ReadOutgoingUrl takes it, without a query. key: of the configuration, whose value it is.
  /// Errors: kInvalidArgument "invalid-config".
  static Result<UrlPrefixes> Read(const std::string& list, const std::string& key);

  [[nodiscard]] bool empty() const { return prefixes_.empty(); }
  /// Whether scheme, host and port are those of a prefix, and the path is its path, or continues it
  /// after a slash.
  [[nodiscard]] bool Have(const OutgoingUrl& url) const;

 private:
  std::vector<OutgoingUrl> prefixes_;
};

}  // namespace farhorizon
