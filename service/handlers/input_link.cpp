#include "service/handlers/input_link.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "service/handlers/problem.h"
#include "service/handlers/uploads.h"
#include "service/jobs/job.h"

namespace farhorizon {

namespace {

// Of the links of OGC API - Processes.
constexpr std::array<std::string_view, 5> kMembers = {"href", "type", "rel", "title", "hreflang"};

}  // namespace

Result<std::optional<InputLink>> ReadLink(const nlohmann::json& given) {
  if (!given.is_object() || !given.contains("href")) return std::optional<InputLink>();
  for (const auto& [name, value] : given.items()) {
    const bool known = std::find(kMembers.begin(), kMembers.end(), name) != kMembers.end();
    if (known && value.is_string()) continue;
    return InvalidParameter(
        "the input dem is a link, which has texts as href, type, rel, title and hreflang, not " +
        name.substr(0, 100) + (known ? " of another kind" : ""));
  }
  return std::optional<InputLink>(
      {given["href"].get<std::string>(), given.value("type", std::string())});
}

std::optional<std::string> OwnUploadOf(const HandlerContext& context, const HttpRequest& request,
                                       const std::string& href) {
  constexpr std::string_view kFolder = "/uploads/";
  const std::string* host = request.Header("host");
  const std::string authority = host == nullptr ? "" : *host;
  for (const std::string& base :
       {std::string(), context.base, "http://" + authority, "https://" + authority}) {
    const std::string folder = base + std::string(kFolder);
    if (!href.starts_with(folder)) continue;
    std::string id = href.substr(folder.size());
    if (IsJobId(id)) return id;
  }
  return std::nullopt;
}

Result<Upload> FindWholeUpload(const HandlerContext& context, const HttpRequest& request,
                               const std::string& id) {
  Result<Upload> upload = FindUpload(context, request, id);
  if (!upload || upload->IsComplete()) return upload;
  return Error{ErrorCode::kInvalidArgument,
               "of the upload " + std::to_string(upload->offset) + " bytes of " +
                   (upload->bytes ? std::to_string(*upload->bytes) : "an unknown number") +
                   " are there; send the rest, and then the job",
               "upload-incomplete"};
}

}  // namespace farhorizon
