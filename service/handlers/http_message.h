#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "service/auth/caller.h"
#include "service/text_list.h"
#include "service/url_query.h"

namespace farhorizon {

/// A request whose head ReadRequestHead has accepted. Names of header fields are in lower case; of
/// a field that decides where the request goes, where it ends or what it means there is at most
/// one.
struct HttpRequest {
  std::string method;
  std::string target;  ///< as sent: path and query
  std::string path;    ///< still percent-encoded
  std::string query;
  int version = 11;  ///< 10 or 11
  std::vector<std::pair<std::string, std::string>> headers;
  std::optional<std::int64_t> content_length;
  bool chunked = false;
  bool expects_continue = false;
  bool keep_alive = true;

  std::string peer;  ///< address, for the log; behind a trusted proxy, the client's
  Caller caller;
  std::string request_id;               ///< likewise
  std::string route;                    ///< the pattern of its path; empty: there is no route
  std::vector<std::string> parameters;  ///< the values of {…} in that pattern, decoded

  /// The first field of that name (in lower case); nullptr if there is none.
  [[nodiscard]] const std::string* Header(std::string_view name) const;
  [[nodiscard]] bool HasBody() const { return chunked || content_length.value_or(0) > 0; }
};

/// Bytes that are read as they are sent.
class BodySource {
 public:
  BodySource() = default;
  virtual ~BodySource() = default;
  BodySource(const BodySource&) = delete;
  BodySource& operator=(const BodySource&) = delete;

  /// Bytes from `offset` on: at least one and at most `most`, valid until the next call. After an
  /// error the connection is closed: the client sees a body that is too short, never a wrong one.
  virtual Result<std::string_view> Read(std::int64_t offset, std::int64_t most) = 0;
};

/// Part of a source as a body.
struct FileBody {
  std::shared_ptr<BodySource> source;
  std::int64_t offset = 0;
  std::int64_t bytes = 0;
};

/// Something that is waited for without a thread.
class Awaited {
 public:
  Awaited() = default;
  virtual ~Awaited() = default;
  Awaited(const Awaited&) = delete;
  Awaited& operator=(const Awaited&) = delete;

  /// Calls `wake` from now on, from any thread, whenever it is worth asking again.
  virtual void Listen(std::function<void()> wake) = 0;
};

/// A body that comes over time. How long it will be is not known.
class EventSource : public Awaited {
 public:
  struct Piece {
    std::string text;  ///< to be sent now; may be empty
    bool last = false;
  };
  /// What there is to send by now.
  virtual Piece Next() = 0;
};

struct HttpResponse;

/// A response that waits for something to happen.
class LateResponse : public Awaited {
 public:
  /// When it is to be given in any case, from its admission on.
  [[nodiscard]] virtual std::chrono::seconds Most() const = 0;
  /// nullptr if it is worth waiting on. last: it is not.
  virtual std::unique_ptr<HttpResponse> Try(bool last) = 0;
};

/// What a handler answers. The server adds Date, Connection, Content-Length, the CORS fields, and a
/// Content-Security-Policy that forbids everything where there is none.
struct HttpResponse {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  std::optional<FileBody> file;         ///< sent in place of `body`
  std::shared_ptr<EventSource> events;  ///< likewise
  std::shared_ptr<LateResponse> late;   ///< gives the response in place of this one

  std::string code;       ///< of the problem that it is, for the log
  std::string job_id;     ///< of the job that it is about, for the log
  std::string upload_id;  ///< of the upload, likewise

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

/// `text` with the letters A to Z in lower case.
std::string LowerCase(std::string_view text);

}  // namespace farhorizon
