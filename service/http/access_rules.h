#pragma once

#include <optional>
#include <string>
#include <vector>

#include "service/handlers/http_message.h"
#include "service/handlers/problem.h"

namespace farhorizon {

/// By which names clients may call the service, and the pages of which origins may use it.
///
/// A browser lets every page send requests to every address. So a page that a stranger wrote could
/// use a service that only its own machine or network reaches: by an ordinary request, which has
/// the page's origin in Origin; or under a name of the stranger's own that he lets point to this
/// machine (DNS rebinding), which then stands in Host.
struct AccessRules {
  std::vector<std::string> hosts;    ///< names in Host, in lower case, beside those that always may
  std::vector<std::string> origins;  ///< such as "https://globe.example"; "*" for all
};

/// public_url: its host and its origin are allowed. hosts, origins: lists with commas.
AccessRules ReadAccessRules(const std::string& public_url, const std::string& hosts,
                            const std::string& origins);

/// The problem that answers a request which the rules do not allow.
///
/// Host may be an address (nobody can let it point elsewhere), a name without a dot or below
/// .localhost (nobody can register it), or one of rules.hosts. Where Origin names another origin
/// than the service's own and those of the rules, only GET and HEAD are answered, without CORS
/// fields: the page cannot read the response.
std::optional<Problem> CheckAccess(const HttpRequest& request, const AccessRules& rules);

/// Who may read a response in a browser, beside the service's own pages.
struct Cors {
  std::string readable_by;         ///< an origin or "*"; empty: nobody
  bool depends_on_origin = false;  ///< a request with another Origin may get another answer
};
Cors CorsOf(const HttpRequest& request, const AccessRules& rules);

}  // namespace farhorizon
