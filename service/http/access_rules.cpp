#include "service/http/access_rules.h"

#include <algorithm>
#include <arpa/inet.h>
#include <netinet/in.h>
#include <string_view>

#include "service/text_list.h"

namespace farhorizon {

namespace {

bool Contains(const std::vector<std::string>& list, std::string_view text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

std::vector<std::string> ListIn(std::string_view text) {
  std::vector<std::string> list = CommaList(text);
  for (std::string& entry : list) entry = LowerCase(entry);
  return list;
}

// "https://x:1" of "https://x:1/path".
std::string OriginOf(std::string_view url) {
  const std::size_t scheme = url.find("://");
  if (scheme == std::string_view::npos) return {};
  return LowerCase(url.substr(0, url.find('/', scheme + 3)));
}

// "x:1" of "https://x:1"; the port of the scheme is left out, as browsers leave it out.
std::string AuthorityOf(std::string_view origin) {
  const std::size_t scheme = origin.find("://");
  if (scheme == std::string_view::npos) return {};
  std::string_view authority = origin.substr(scheme + 3);
  const std::string_view usual = origin.substr(0, scheme) == "https" ? ":443" : ":80";
  if (authority.size() > usual.size() &&
      authority.substr(authority.size() - usual.size()) == usual) {
    authority.remove_suffix(usual.size());
  }
  return LowerCase(authority);
}

// "x" of "x:1", "[::1]" of "[::1]:1".
std::string NameOf(std::string_view authority) {
  std::string_view name = authority.substr(0, authority.find(']') + 1);
  if (name.empty()) name = authority.substr(0, authority.find(':'));
  if (!name.empty() && name.back() == '.') name.remove_suffix(1);
  return LowerCase(name);
}

bool IsAddress(const std::string& name) {
  struct in_addr four {};
  struct in6_addr six {};
  if (name.size() > 2 && name.front() == '[' && name.back() == ']') {
    const std::string inner = name.substr(1, std::min(name.find('%'), name.size() - 1) - 1);
    return ::inet_pton(AF_INET6, inner.c_str(), &six) == 1;
  }
  return ::inet_pton(AF_INET, name.c_str(), &four) == 1;
}

bool MayBeCalled(const std::string& name, const AccessRules& rules) {
  constexpr std::string_view kLocal = ".localhost";
  const bool local = name.find('.') == std::string::npos ||
                     (name.size() > kLocal.size() &&
                      name.compare(name.size() - kLocal.size(), kLocal.size(), kLocal) == 0);
  return IsAddress(name) || (local && !name.empty()) || Contains(rules.hosts, name);
}

bool IsOwn(const std::string& origin, const HttpRequest& request) {
  const std::string* host = request.Header("host");
  const std::string authority = AuthorityOf(origin);
  if (host == nullptr || authority.empty()) return false;
  const std::string scheme = origin.substr(0, origin.find("://") + 3);
  return authority == AuthorityOf(scheme + *host);
}

}  // namespace

AccessRules ReadAccessRules(const std::string& public_url, const std::string& hosts,
                            const std::string& origins) {
  AccessRules rules{ListIn(hosts), ListIn(origins)};
  const std::string own = OriginOf(public_url);
  if (!own.empty()) {
    rules.hosts.push_back(NameOf(AuthorityOf(own)));
    rules.origins.push_back(own);
  }
  return rules;
}

std::optional<Problem> CheckAccess(const HttpRequest& request, const AccessRules& rules) {
  const std::string* host = request.Header("host");
  if (host != nullptr && !MayBeCalled(NameOf(*host), rules)) {
    return Problem("misdirected-request",
                   "the service is not called " + NameOf(*host) +
                       "; where it is, let publicUrl or http.allowedHosts name it");
  }
  const std::string* origin = request.Header("origin");
  const bool reads = request.method == "GET" || request.method == "HEAD";
  if (origin == nullptr || reads || IsOwn(LowerCase(*origin), request) ||
      !CorsOf(request, rules).readable_by.empty()) {
    return std::nullopt;
  }
  return Problem("origin-not-allowed",
                 "pages of this origin may not use the service; where they "
                 "may, let http.corsOrigin name it");
}

Cors CorsOf(const HttpRequest& request, const AccessRules& rules) {
  if (Contains(rules.origins, "*")) return {"*", false};
  const std::string* origin = request.Header("origin");
  const bool listed = origin != nullptr && Contains(rules.origins, LowerCase(*origin));
  return {listed ? *origin : "", !rules.origins.empty()};
}

}  // namespace farhorizon
