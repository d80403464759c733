#include "service/handlers/input_link.h"

#include <string_view>
#include <utility>

#include "service/handlers/uploads.h"
#include "service/jobs/job.h"

namespace farhorizon {

Error HrefNotAllowed(const std::string& input) {
  return {
      ErrorCode::kInvalidArgument,
      "the input " + input +
          " is a link to elsewhere, and this service fetches nothing; send the value itself, or "
          "link to an upload of this service (POST /uploads)",
      "href-not-allowed"};
}

Result<std::optional<InputLink>> LinkOf(const std::string& name, const nlohmann::json& given) {
  if (!given.is_object() || !given.contains("href")) return std::optional<InputLink>();
  if (!given["href"].is_string() || given.contains("value")) {
    return Error{ErrorCode::kInvalidArgument,
                 "the input " + name + " must have either a value or an href, a URL",
                 "invalid-parameter"};
  }
  InputLink link{given["href"].get<std::string>(), ""};
  const auto type = given.find("type");
  if (type != given.end() && type->is_string()) link.type = type->get<std::string>();
  return std::optional<InputLink>(std::move(link));
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

Result<Upload> LinkedUpload(const HandlerContext& context, const HttpRequest& request,
                            const InputLink& link) {
  const std::optional<std::string> id = OwnUploadOf(context, request, link.href);
  if (!id) return HrefNotAllowed("dem");
  Result<Upload> upload = FindUpload(context, request, *id);
  if (!upload || upload->IsComplete()) return upload;
  return Error{ErrorCode::kInvalidArgument,
               "of the upload " + std::to_string(upload->offset) + " bytes of " +
                   (upload->bytes ? std::to_string(*upload->bytes) : "an unknown number") +
                   " are there; send the rest, and then the job",
               "upload-incomplete"};
}

}  // namespace farhorizon
