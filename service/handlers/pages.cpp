#include "service/handlers/pages.h"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>

#include "core/io/sha256.h"
#include "service/handlers/byte_range.h"
#include "service/handlers/capabilities.h"
#include "service/handlers/content_coding.h"
#include "service/handlers/jobs.h"
#include "service/handlers/json.h"
#include "service/handlers/problem.h"
#include "service/handlers/weighted_list.h"
#include "service/log.h"
#include "service/pages/pages.h"

namespace farhorizon {

namespace {

// The service alone is loaded from and asked; no script or style stands in the page.
constexpr const char* kIndexPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src 'self' data:; base-uri 'none'; form-action 'self'; frame-ancestors 'none'";
// CesiumJS compiles WebAssembly (the decoder of Draco), makes workers and pictures of blobs, and
// writes the style of its credits into the page.
constexpr const char* kViewerPolicy =
    "default-src 'none'; script-src 'self' blob: 'wasm-unsafe-eval'; "
    "style-src 'self' 'unsafe-inline'; "
    "connect-src 'self' blob: data:; img-src 'self' blob: data:; worker-src 'self' blob:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
// Of a script that runs as a worker, which has its own policy.
constexpr const char* kAssetPolicy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'";

HttpResponse NoAsset(const HttpRequest& request) {
  return ProblemResponse(request, {"no-such-resource", "no page has this part; load it again"});
}

// A text with an entity tag of its own: 304 where the client has it.
HttpResponse TextResponse(const HttpRequest& request, std::string text, const std::string& type,
                          const std::string& policy) {
  HttpResponse response;
  const std::string etag = "\"" + Sha256Hex(text) + "\"";
  response.status = StatusByConditions(request, etag);
  if (response.status == 412) {
    return ProblemResponse(request,
                           {"precondition-failed", "it is not the one that If-Match names"});
  }
  response.Set("ETag", etag);
  response.Set("Content-Type", type);
  response.Set("Content-Security-Policy", policy);
  if (response.status == 200) response.body = std::move(text);
  return response;
}

HttpResponse PageResponse(const HttpRequest& request, std::string page, const char* policy) {
  HttpResponse response =
      TextResponse(request, std::move(page), "text/html; charset=utf-8", policy);
  response.Set("Cache-Control", "no-cache");
  response.Set("Referrer-Policy", "no-referrer");
  return response;
}

HttpResponse ShowIndex(const HandlerContext& context, const HttpRequest& request) {
  HttpResponse response = WantsHtml(request)
                              ? PageResponse(request, IndexPage(), kIndexPolicy)
                              : TaggedJsonResponse(request, LandingDocument(context.base));
  response.Set("Vary", "Accept");
  return response;
}

// For people where a program would get the problem; its status either way.
HttpResponse NoViewer(const HttpRequest& request, const Problem& problem) {
  if (!WantsHtml(request)) return ProblemResponse(request, problem);
  HttpResponse response;
  response.status = problem.status;
  response.code = problem.code.name();
  response.Set("Vary", "Accept");
  response.Set("Content-Type", "text/html; charset=utf-8");
  response.Set("Content-Security-Policy", kIndexPolicy);
  response.body = NoJobPage(problem.detail);
  return response;
}

HttpResponse ShowViewer(const HandlerContext& context, const HttpRequest& request) {
  const std::string& id = request.parameters.at(0);
  // A browser that opens a page sends no key: the page is the same then for every id there may be,
  // and asks for one.
  if (!request.caller.IsStranger() || !IsJobId(id)) {
    const Result<Job> job = FindJob(context, request);
    if (!job) return NoViewer(request, ProblemOf(job.error()));
  }
  const std::string cesium =
      context.cesium == nullptr ? "" : "../assets/" + context.cesium->fingerprint();
  HttpResponse response = PageResponse(
      request, ViewerPage({"../jobs/" + id + "/results/", cesium, "../"}), kViewerPolicy);
  response.job_id = id;
  return response;
}

// A file, piece by piece.
class AssetSource : public BodySource {
 public:
  explicit AssetSource(UniqueFd file) : file_(std::move(file)) {}

  Result<std::string_view> Read(std::int64_t offset, std::int64_t most) override {
    constexpr std::int64_t kPiece = 65536;
    buffer_.resize(static_cast<std::size_t>(std::min(most, kPiece)));
    const ssize_t size = ::pread(file_.get(), buffer_.data(), buffer_.size(), offset);
    if (size <= 0) return Error{ErrorCode::kIo, "a file of the viewer cannot be read", "io"};
    return std::string_view(buffer_).substr(0, static_cast<std::size_t>(size));
  }

 private:
  UniqueFd file_;
  std::string buffer_;
};

HttpResponse SendAsset(const HttpRequest& request, const AssetFolder& folder,
                       const std::string& name) {
  const Asset* asset = folder.Find(name);
  if (asset == nullptr) return NoAsset(request);
  const Asset* packed = AcceptsGzip(request) ? folder.Find(name + ".gz") : nullptr;
  const Asset& sent = packed != nullptr ? *packed : *asset;
  const std::string etag = "\"" + sent.sha256 + "\"";
  HttpResponse response;
  response.status = StatusByConditions(request, etag);
  if (response.status == 412) return NoAsset(request);
  response.Set("ETag", etag);
  response.Set("Vary", "Accept-Encoding");
  response.Set("Content-Type", AssetMediaType(name));
  if (packed != nullptr) response.Set("Content-Encoding", "gzip");
  response.Set("Content-Security-Policy", kAssetPolicy);
  if (response.status != 200) return response;
  Result<UniqueFd> file = OpenAsset(sent);
  if (!file) {
    Log(LogLevel::kError, "a file of the viewer is lost", {{"error", file.error().message}});
    return NoAsset(request);
  }
  response.file = FileBody{std::make_shared<AssetSource>(*std::move(file)), 0, sent.bytes};
  return response;
}

HttpResponse ShowAsset(const HandlerContext& context, const HttpRequest& request) {
  const std::string& fingerprint = request.parameters.at(0);
  const std::string& name = request.parameters.at(1);
  HttpResponse response;
  if (fingerprint == PageFingerprint()) {
    const std::string_view text = PageFile(name);
    if (text.empty()) return NoAsset(request);
    response = TextResponse(request, std::string(text), AssetMediaType(name), kAssetPolicy);
  } else if (context.cesium != nullptr && fingerprint == context.cesium->fingerprint()) {
    response = SendAsset(request, *context.cesium, name);
  } else {
    return NoAsset(request);
  }
  if (response.status == 200 || response.status == 304) {
    response.Set("Cache-Control", "public, max-age=31536000, immutable");
  }
  return response;
}

}  // namespace

bool WantsHtml(const HttpRequest& request) {
  const std::string* field = request.Header("accept");
  if (field == nullptr) return false;
  int html = 0;
  int json = 0;
  for (const auto& [type, weight] : WeightedList(*field)) {
    if (type == "text/html") html = std::max(html, weight);
    if (type == "application/json") json = std::max(json, weight);
  }
  return html > 0 && html >= json;
}

std::vector<Route> PageRoutes(const HandlerContext& context) {
  return {
      BodylessRoute(
          "GET", "/", [context](const HttpRequest& request) { return ShowIndex(context, request); },
          WaitsFor::kNothing),
      BodylessRoute("GET", "/viewer/{id}",
                    [context](const HttpRequest& request) { return ShowViewer(context, request); }),
      BodylessRoute("GET", "/assets/{fingerprint}/{path*}",
                    [context](const HttpRequest& request) { return ShowAsset(context, request); })};
}

}  // namespace farhorizon
