#include "service/handlers/subscriber.h"

#include <array>
#include <string>
#include <utility>

#include "service/handlers/problem.h"
#include "service/outgoing/callback_rules.h"

namespace farhorizon {

using nlohmann::json;

Result<Subscriber> ReadSubscriber(const HandlerContext& context, const json& request) {
  Subscriber whom;
  const auto given = request.find("subscriber");
  if (given == request.end()) return whom;
  if (!given->is_object()) return InvalidParameter("subscriber must be an object of URLs");
  if (!context.callbacks) {
    return Error{ErrorCode::kInvalidArgument,
                 "this service calls no subscriber: ask for the job's status, or let "
                 "callbacks.allow of its configuration name how the URL begins",
                 "callback-not-allowed"};
  }
  const std::array<std::pair<const char*, std::string*>, 3> known = {
      std::pair{"successUri", &whom.success_uri}, std::pair{"inProgressUri", &whom.in_progress_uri},
      std::pair{"failedUri", &whom.failed_uri}};
  std::size_t found = 0;
  for (const auto& [name, uri] : known) {
    if (!given->contains(name)) continue;
    ++found;
    const json& text = (*given)[name];
    if (!text.is_string())
      return InvalidParameter(std::string(name) + " of subscriber must be a URL");
    *uri = text.get<std::string>();
    const Result<OutgoingUrl> allowed = context.callbacks->Check(*uri);
    if (!allowed) {
      return Error{allowed.error().code, std::string(name) + ": " + allowed.error().message,
                   allowed.error().kind};
    }
  }
  if (found < given->size()) {
    return InvalidParameter(
        "subscriber has a member that is not known; known are successUri, "
        "inProgressUri and failedUri");
  }
  if (whom.success_uri.empty()) return InvalidParameter("subscriber must have a successUri");
  return whom;
}

}  // namespace farhorizon
