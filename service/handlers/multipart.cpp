#include "service/handlers/multipart.h"

#include <algorithm>
#include <array>
#include <utility>

#include "service/handlers/http_message.h"
#include "service/url_query.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMaxHeadBytes = 8192;
constexpr int kMaxParts = 16;

Error Broken(const std::string& why) {
  return {ErrorCode::kInvalidArgument, "the multipart form is at fault: " + why,
          "invalid-multipart"};
}

// The value of a parameter, name="value" or name=value, of a header field.
std::optional<std::string> FieldParameter(std::string_view field, std::string_view wanted) {
  std::size_t at = field.find(';');
  while (at != std::string_view::npos) {
    std::string_view rest = Trimmed(field.substr(at + 1));
    const std::size_t equals = rest.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    const std::string name = LowerCase(Trimmed(rest.substr(0, equals)));
    rest = rest.substr(equals + 1);
    std::string value;
    std::size_t end = 0;
    if (!rest.empty() && rest[0] == '"') {
      for (end = 1; end < rest.size() && rest[end] != '"'; ++end) {
        const char next = end + 1 < rest.size() ? rest[end + 1] : '\0';
        if (rest[end] == '\\' && (next == '"' || next == '\\')) ++end;
        value += rest[end];
      }
      if (end >= rest.size()) return std::nullopt;
    } else {
      end = std::min(rest.find(';'), rest.size());
      value = std::string(Trimmed(rest.substr(0, end)));
    }
    if (name == wanted) return value;
    field = rest.substr(std::min(end, rest.size()));
    at = field.find(';');
  }
  return std::nullopt;
}

// `text` with each `from` in it as `to`.
std::string Replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// The file name of a Content-Disposition. That of filename* is CHARSET'LANGUAGE'TEXT with escapes.
std::optional<std::string> FilenameIn(std::string_view field) {
  if (const auto extended = FieldParameter(field, "filename*")) {
    const std::size_t first = extended->find('\'');
    const std::size_t second = extended->find('\'', first + 1);
    if (first != std::string::npos && second != std::string::npos) {
      std::optional<std::string> name = PercentDecode(extended->substr(second + 1));
      if (name) return name;
    }
  }
  std::optional<std::string> name = FieldParameter(field, "filename");
  if (!name) return std::nullopt;
  for (const auto& [escape, character] :
       {std::pair("%22", "\""), std::pair("%0D", "\r"), std::pair("%0A", "\n")}) {
    name = Replaced(*std::move(name), escape, character);
  }
  return name;
}

// Whether bytes of this Content-Encoding or Content-Transfer-Encoding are those that are meant.
bool IsPlainCoding(std::string_view coding) {
  constexpr std::array<std::string_view, 5> kPlain = {"", "identity", "binary", "8bit", "7bit"};
  return std::find(kPlain.begin(), kPlain.end(), coding) != kPlain.end();
}

Result<PartHead> ReadPartHead(std::string_view head) {
  std::optional<PartHead> part;
  std::optional<std::string> coding;
  while (!head.empty()) {
    const std::size_t end = std::min(head.find("\r\n"), head.size());
    const std::string_view line = head.substr(0, end);
    head.remove_prefix(std::min(end + 2, head.size()));
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return Broken("a part's header field has no colon");
    const std::string name = LowerCase(line.substr(0, colon));
    const std::string_view field = Trimmed(line.substr(colon + 1));
    if (name == "content-encoding" || name == "content-transfer-encoding") {
      if (!coding && !IsPlainCoding(LowerCase(field))) coding = field;
    }
    if (part || name != "content-disposition" || MediaTypeIn(field) != "form-data") continue;
    std::optional<std::string> of_part = FieldParameter(field, "name");
    if (of_part) part = PartHead{*std::move(of_part), FilenameIn(field), {}};
  }
  if (!part) return Broken("a part has no 'Content-Disposition: form-data; name=…'");
  part->coding = std::move(coding);
  return *std::move(part);
}

}  // namespace

std::optional<std::string> MultipartBoundary(std::string_view content_type) {
  if (MediaTypeIn(content_type) != "multipart/form-data") return std::nullopt;
  std::optional<std::string> boundary = FieldParameter(content_type, "boundary");
  if (!boundary || boundary->empty() || boundary->size() > 70 || boundary->back() == ' ') {
    return std::nullopt;
  }
  const bool allowed = std::all_of(boundary->begin(), boundary->end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("'()+_,-./:=? ").find(c) != std::string_view::npos;
  });
  return allowed ? boundary : std::nullopt;
}

MultipartParser::MultipartParser(const std::string& boundary, PartReceiver receiver)
    : delimiter_("\r\n--" + boundary),
      receiver_(std::move(receiver)),
      // The first boundary of a body has no CRLF before it; with this one it is a delimiter, too.
      buffer_("\r\n") {}

Status MultipartParser::Feed(std::string_view piece) {
  buffer_ += piece;
  for (;;) {
    Result<bool> stepped = Step();
    if (!stepped) return std::move(stepped.error());
    if (!*stepped) return Ok{};
  }
}

Status MultipartParser::Finish() const {
  if (state_ == State::kEnd) return Ok{};
  return Broken("it stops before its closing boundary");
}

Result<bool> MultipartParser::Step() {
  switch (state_) {
    case State::kStart:
      if (buffer_.size() < delimiter_.size()) return false;
      if (buffer_.compare(0, delimiter_.size(), delimiter_) != 0) {
        return Broken("it does not start with its boundary");
      }
      buffer_.erase(0, delimiter_.size());
      state_ = State::kAfterBoundary;
      return true;
    case State::kAfterBoundary:
      return StepAfterBoundary();
    case State::kHead:
      return StepHead();
    case State::kData:
      return StepData();
    case State::kEnd:
      buffer_.clear();  // an epilogue is ignored [RFC 2046, section 5.1.1]
      return false;
  }
  return false;
}

Result<bool> MultipartParser::StepAfterBoundary() {
  if (buffer_.size() < 2) return false;
  const std::string next = buffer_.substr(0, 2);
  buffer_.erase(0, 2);
  if (next == "--") {
    state_ = State::kEnd;
  } else if (next == "\r\n") {
    if (++parts_ > kMaxParts) return Broken("it has more than 16 parts");
    state_ = State::kHead;
  } else {
    return Broken("a boundary is followed by something else");
  }
  return true;
}

Result<bool> MultipartParser::StepHead() {
  const std::size_t end = buffer_.find("\r\n\r\n");
  if (end == std::string::npos) {
    // A head of the greatest length may still wait for the rest of its CRLF CRLF.
    if (buffer_.size() < kMaxHeadBytes + 4) return false;
    return Broken("a part's head is longer than 8192 bytes");
  }
  if (end > kMaxHeadBytes) return Broken("a part's head is longer than 8192 bytes");
  Result<PartHead> head = ReadPartHead(std::string_view(buffer_).substr(0, end));
  if (!head) return std::move(head.error());
  buffer_.erase(0, end + 4);
  Status begun = receiver_.begin(*head);
  if (!begun) return std::move(begun.error());
  state_ = State::kData;
  return true;
}

Result<bool> MultipartParser::StepData() {
  const std::size_t found = buffer_.find(delimiter_);
  // The last bytes may be the beginning of a delimiter; they wait for the next piece.
  const std::size_t kept = delimiter_.size() - 1;
  const std::size_t ready = found != std::string::npos ? found
                            : buffer_.size() > kept    ? buffer_.size() - kept
                                                       : 0;
  if (ready > 0) {
    Status taken = receiver_.data(std::string_view(buffer_).substr(0, ready));
    if (!taken) return std::move(taken.error());
    buffer_.erase(0, ready);
  }
  if (found == std::string::npos) return false;
  buffer_.erase(0, delimiter_.size());
  state_ = State::kAfterBoundary;
  return true;
}

}  // namespace farhorizon
