#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace farhorizon {

/// Text that may stand in an HTML page as it is. Whatever comes from a file becomes one by Text
/// alone.
class Html {
 public:
  Html() = default;
  /// `text` as a reader sees it, between tags and in quoted attributes. What is no character of
  /// UTF-8, or one that a page may not have, becomes the replacement character.
  static Html Text(std::string_view text);
  /// Markup that the program has made. Requires: nothing in it comes from a file.
  static Html Markup(std::string markup);

  Html& operator+=(const Html& more) {
    markup_ += more.markup_;
    return *this;
  }
  friend Html operator+(Html a, const Html& b) { return a += b; }
  [[nodiscard]] const std::string& markup() const { return markup_; }
  [[nodiscard]] bool empty() const { return markup_.empty(); }

 private:
  std::string markup_;
};

/// Markup that stands in the source: "<td>"_html.
Html operator""_html(const char* markup, std::size_t size);

/// <tag class="...">content</tag>; no attribute where `classes` is empty.
Html Element(std::string_view tag, const Html& content, std::string_view classes = {});

/// `page` with each {{name}} replaced by its value. Values are not looked through again.
/// Requires: every name in the page has a value.
std::string FillTemplate(std::string_view page,
                         const std::map<std::string, Html, std::less<>>& values);

}  // namespace farhorizon
