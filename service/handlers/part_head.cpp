#include "service/handlers/part_head.h"

#include <algorithm>
#include <array>
#include <utility>

#include "service/handlers/http_message.h"
#include "service/url_query.h"

namespace farhorizon {

namespace {

// Reads the quoted string that begins `text`, up to and with its closing quote; nullopt if it has
// none. A backslash is itself before anything but a quote or a backslash.
std::optional<std::string> TakeQuoted(std::string_view& text) {
  std::string value;
  std::size_t end = 1;
  for (; end < text.size() && text[end] != '"'; ++end) {
    const char next = end + 1 < text.size() ? text[end + 1] : '\0';
    if (text[end] == '\\' && (next == '"' || next == '\\')) ++end;
    value += text[end];
  }
  if (end >= text.size()) return std::nullopt;
  text.remove_prefix(end + 1);
  return value;
}

// The value of a parameter, name="value" or name=value, of a header field.
std::optional<std::string> FieldParameter(std::string_view field, std::string_view wanted) {
  for (std::size_t at = field.find(';'); at != std::string_view::npos; at = field.find(';')) {
    field = Trimmed(field.substr(at + 1));
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    const std::string name = LowerCase(Trimmed(field.substr(0, equals)));
    field.remove_prefix(equals + 1);
    std::optional<std::string> value;
    if (field.substr(0, 1) == "\"") {
      value = TakeQuoted(field);
      if (!value) return std::nullopt;
    } else {
      value = Trimmed(field.substr(0, field.find(';')));
    }
    if (name == wanted) return value;
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

}  // namespace

Error BrokenForm(const std::string& why) {
  return {ErrorCode::kInvalidArgument, "the multipart form is at fault: " + why,
          "invalid-multipart"};
}

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

Result<PartHead> ReadPartHead(std::string_view head) {
  std::optional<PartHead> part;
  std::optional<std::string> coding;
  while (!head.empty()) {
    const std::size_t end = std::min(head.find("\r\n"), head.size());
    const std::string_view line = head.substr(0, end);
    head.remove_prefix(std::min(end + 2, head.size()));
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return BrokenForm("a part's header field has no colon");
    const std::string name = LowerCase(line.substr(0, colon));
    const std::string_view field = Trimmed(line.substr(colon + 1));
    if (name == "content-encoding" || name == "content-transfer-encoding") {
      if (!coding && !IsPlainCoding(LowerCase(field))) coding = field;
    }
    if (part || name != "content-disposition" || MediaTypeIn(field) != "form-data") continue;
    std::optional<std::string> of_part = FieldParameter(field, "name");
    if (of_part) part = PartHead{*std::move(of_part), FilenameIn(field), {}};
  }
  if (!part) return BrokenForm("a part has no 'Content-Disposition: form-data; name=…'");
  part->coding = std::move(coding);
  return *std::move(part);
}

}  // namespace farhorizon
