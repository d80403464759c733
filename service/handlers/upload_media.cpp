// The first bytes of a body tell its format, better than its Content-Type does. So that is refused
// only where the body cannot be the file itself: a form of another kind, a page.
#include "service/handlers/upload_media.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "service/handlers/part_head.h"
#include "service/handlers/problem.h"

namespace farhorizon {

namespace {

constexpr const char* kAccepted =
    "image/tiff, text/plain, application/zip, application/octet-stream, multipart/form-data, "
    "application/json";

constexpr const char* kJson = "application/json";

// Types that programs give to files of heights.
constexpr std::array<std::string_view, 13> kDemTypes = {"",
                                                        "application/geotiff",
                                                        "application/octet-stream",
                                                        "application/x-geotiff",
                                                        "application/x-zip-compressed",
                                                        "application/zip",
                                                        "binary/octet-stream",
                                                        "image/geotiff",
                                                        "image/tiff",
                                                        "image/x-geotiff",
                                                        "image/x-tiff",
                                                        "text/csv",
                                                        "text/plain"};

HttpResponse RefuseCoding(const HttpRequest& request, const std::string& coding) {
  HttpResponse response = ProblemResponse(
      request, {"unsupported-media-type",
                "the body has the Content-Encoding " + coding +
                    ", which is not undone here; send the file as it is. A GeoTIFF can be "
                    "compressed within: gdal_translate -co COMPRESS=DEFLATE IN OUT"});
  response.Set("Accept-Encoding", "identity");
  return response;
}

HttpResponse RefuseType(const HttpRequest& request, const std::string& media) {
  const bool by_default = media == "application/x-www-form-urlencoded";
  HttpResponse response = ProblemResponse(
      request,
      {"unsupported-media-type",
       "the Content-Type is " + media.substr(0, 100) +
           (by_default ? ", which curl --data-binary and wget --post-file write by themselves; add "
                         "-H 'Content-Type: application/octet-stream' (wget: --header)"
                       : std::string("; send the DEM with one of ") + kAccepted)});
  response.Set("Accept-Post", kAccepted);
  return response;
}

// The first coding of the body other than none.
std::optional<std::string> CodingOf(const HttpRequest& request) {
  for (const auto& [name, value] : request.headers) {
    if (name != "content-encoding") continue;
    for (std::string_view rest = value; !rest.empty();) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      const std::string coding = LowerCase(Trimmed(rest.substr(0, comma)));
      rest.remove_prefix(std::min(comma + 1, rest.size()));
      if (!coding.empty() && coding != "identity") return coding.substr(0, 100);
    }
  }
  return std::nullopt;
}

}  // namespace

std::variant<UploadMedia, HttpResponse> ReadUploadMedia(const HttpRequest& request) {
  if (const auto coding = CodingOf(request)) return RefuseCoding(request, *coding);
  const std::string* type = request.Header("content-type");
  const std::string media = type != nullptr ? MediaTypeIn(*type) : "";
  if (media == "multipart/form-data") {
    UploadMedia form{MultipartBoundary(*type)};
    if (form.boundary) return form;
    return ProblemResponse(
        request, {"invalid-multipart", "the Content-Type has no boundary that can be used"});
  }
  if (media == kJson) return UploadMedia{.json = true};
  if (IsDemMediaType(media)) return UploadMedia{};
  return RefuseType(request, media);
}

std::variant<UploadMedia, HttpResponse> ReadExecutionMedia(const HttpRequest& request) {
  if (const auto coding = CodingOf(request)) return RefuseCoding(request, *coding);
  const std::string* type = request.Header("content-type");
  if (type != nullptr && MediaTypeIn(*type) == kJson) return UploadMedia{.json = true};
  HttpResponse response = ProblemResponse(
      request, {"unsupported-media-type",
                "an execute request has the Content-Type application/json; files and forms go to "
                "/jobs"});
  response.Set("Accept-Post", kJson);
  return response;
}

bool IsDemMediaType(std::string_view media) {
  return std::find(kDemTypes.begin(), kDemTypes.end(), media) != kDemTypes.end();
}

}  // namespace farhorizon
