// Escaping is a matter of types: a file's name or metadata becomes Html by Text alone, so that no
// page can forget it.
#include "core/pipeline/report_page/html.h"

#include <cstdint>
#include <utility>

#include "core/base/result.h"

namespace farhorizon {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// The bytes of the character of UTF-8 that `text` begins with; 0 where it begins with none, or with
// a control character other than a tab and a line's end.
std::size_t CharacterSize(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return (first >= 0x20 && first != 0x7F) || first == '\t' || first == '\n';
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < size) return 0;
  std::uint32_t code = first & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return 0;
    code = code << 6U | (byte(i) & 0x3FU);
  }
  const bool shortest = size == 2 || code >= (size == 3 ? 0x800U : 0x10000U);
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  // U+0080 to U+009F are controls, too. U+202A to U+202E and U+2066 to U+2069 turn the direction of
  // the text around them.
  const bool control = code < 0xA0;
  const bool turning = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return shortest && !surrogate && !control && !turning && code <= 0x10FFFF ? size : 0;
}

std::string_view Escaped(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

}  // namespace

Html Html::Text(std::string_view text) {
  std::string markup;
  while (!text.empty()) {
    const std::size_t size = CharacterSize(text);
    if (size == 0) {
      markup += kReplacement;
    } else if (const std::string_view escaped = Escaped(text[0]); !escaped.empty()) {
      markup += escaped;
    } else {
      markup += text.substr(0, size);
    }
    text.remove_prefix(size == 0 ? 1 : size);
  }
  return Markup(std::move(markup));
}

Html Html::Markup(std::string markup) {
  Html html;
  html.markup_ = std::move(markup);
  return html;
}

Html operator""_html(const char* markup, std::size_t size) { return Html::Markup({markup, size}); }

Html Element(std::string_view tag, const Html& content, std::string_view classes) {
  std::string opening = "<" + std::string(tag);
  if (!classes.empty()) opening += " class=\"" + std::string(classes) + "\"";
  return Html::Markup(opening + ">" + content.markup() + "</" + std::string(tag) + ">");
}

std::string FillTemplate(std::string_view page,
                         const std::map<std::string, Html, std::less<>>& values) {
  std::string filled;
  for (std::size_t at = 0;;) {
    const std::size_t open = page.find("{{", at);
    filled += page.substr(at, open - at);
    if (open == std::string_view::npos) return filled;
    const std::size_t close = page.find("}}", open);
    Check(close != std::string_view::npos, "a template's braces are closed");
    const auto value = values.find(page.substr(open + 2, close - open - 2));
    Check(value != values.end(), "every name in a template has a value");
    filled += value->second.markup();
    at = close + 2;
  }
}

}  // namespace farhorizon
