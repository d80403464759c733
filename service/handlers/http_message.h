#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/unique_fd.h"
#include "service/percent.h"

namespace farhorizon {

/// A request as the gate let it in. Header names are in lower case, at most one of a name that may
/// stand once.
struct HttpRequest {
  std::string method;
  std::string target;  ///< as sent: path and query
  std::string path;    ///< percent-encoded still
  std::string query;
  int version = 11;  ///< 10 or 11
  std::vector<std::pair<std::string, std::string>> headers;
  std::optional<std::int64_t> content_length;
  bool chunked = false;
  bool expects_continue = false;
  bool keep_alive = true;

  std::string peer;                     ///< address, for the log
  std::vector<std::string> parameters;  ///< what stood for {…} in the route, decoded

  /// The first of that name (in lower case); nullptr where there is none.
  [[nodiscard]] const std::string* Header(std::string_view name) const;
  [[nodiscard]] bool HasBody() const { return chunked || content_length.value_or(0) > 0; }
};

/// Part of an open file as a body.
struct FileBody {
  std::shared_ptr<UniqueFd> fd;
  std::int64_t offset = 0;
  std::int64_t bytes = 0;
};

/// What a handler answers. Date, Connection, Content-Length and CORS fields are the server's.
struct HttpResponse {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  std::optional<FileBody> file;  ///< in place of body

  void Set(std::string name, std::string value) {
    headers.emplace_back(std::move(name), std::move(value));
  }
  [[nodiscard]] std::int64_t BodyBytes() const {
    return file ? file->bytes : static_cast<std::int64_t>(body.size());
  }
};

/// "Not Found" for 404.
const char* ReasonPhrase(int status);

/// The media type of a Content-Type field, in lower case and without parameters.
std::string MediaTypeIn(std::string_view content_type);

/// Lower case, of ASCII.
std::string LowerCase(std::string_view text);
/// Without blanks and tabs at either end.
std::string_view Trimmed(std::string_view text);

}  // namespace farhorizon
