#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace farhorizon {

/// What is wrong with a page, a line for each; empty for a sound one.
///
/// Sound: every element is closed in order, except those of HTML that have no end; attributes are
/// quoted; no id is there twice, and each that an attribute names is there. The texts of <style>
/// and <script> are not looked at.
class HtmlOffences {
 public:
  static std::vector<std::string> Of(const std::string& page) {
    HtmlOffences offences(page);
    offences.Read();
    return offences.found_;
  }

 private:
  explicit HtmlOffences(const std::string& page) : page_(page) {}

  void Read() {
    std::size_t at = 0;
    while ((at = page_.find('<', at)) != std::string::npos) {
      if (page_.compare(at, 2, "<!") == 0) {
        at = page_.find('>', at);
        continue;
      }
      const std::size_t end = TagEnd(at);
      if (end == std::string::npos) return Say("a tag that does not end: " + page_.substr(at, 60));
      Tag(page_.substr(at + 1, end - at - 1));
      at = end + 1;
      if (!open_.empty() && (open_.back() == "style" || open_.back() == "script")) {
        at = page_.find("</" + open_.back() + ">", at);
        if (at == std::string::npos) return Say(open_.back() + " does not end");
      }
    }
    for (const std::string& name : open_) Say("<" + name + "> is never closed");
    for (const std::string& id : named_) {
      if (ids_.count(id) == 0) Say("no element has the id " + id);
    }
  }

  // The tag's '>', outside of quotes.
  [[nodiscard]] std::size_t TagEnd(std::size_t at) const {
    bool quoted = false;
    for (; at < page_.size(); ++at) {
      if (page_[at] == '"') quoted = !quoted;
      if (page_[at] == '>' && !quoted) return at;
    }
    return std::string::npos;
  }

  void Tag(std::string tag) {
    static constexpr std::array<std::string_view, 5> kVoid = {"meta", "link", "img", "input", "br"};
    if (tag.front() == '/') {
      const std::string name = tag.substr(1);
      if (open_.empty() || open_.back() != name) {
        Say("</" + name + "> closes " + (open_.empty() ? "nothing" : open_.back()));
      }
      if (!open_.empty()) open_.pop_back();
      return;
    }
    const bool closed = tag.back() == '/';
    if (closed) tag.pop_back();
    const std::string name = tag.substr(0, tag.find_first_of(" \n"));
    if (name.empty() ||
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyz123456") != std::string::npos) {
      Say("no element's name: " + name);
    }
    Attributes(tag.substr(name.size()));
    if (!closed && std::find(kVoid.begin(), kVoid.end(), name) == kVoid.end())
      open_.push_back(name);
  }

  void Attributes(std::string_view text) {
    while (true) {
      const std::size_t first = text.find_first_not_of(" \n");
      if (first == std::string_view::npos) return;
      text.remove_prefix(first);
      const std::size_t name_end = std::min(text.find_first_of("= \n"), text.size());
      const std::string name(text.substr(0, name_end));
      text.remove_prefix(name_end);
      if (text.empty() || text.front() != '=') continue;  // one without value
      if (text.size() < 2 || text[1] != '"') return Say(name + " has no quoted value");
      const std::size_t close = text.find('"', 2);
      Attribute(name, std::string(text.substr(2, close - 2)));
      text.remove_prefix(close + 1);
    }
  }

  void Attribute(const std::string& name, const std::string& value) {
    if (name.starts_with("on")) Say("a handler in an attribute: " + name);
    if (name == "id" && !ids_.insert(value).second) Say("the id " + value + " is there twice");
    if (name == "aria-labelledby" || name == "for") named_.insert(value);
    if (name == "href" && value.starts_with("#")) named_.insert(value.substr(1));
    const bool loads = name == "src" || name == "href" || name == "action" || name == "srcset";
    if (loads && !value.starts_with("#") && !value.starts_with("data:")) {
      Say(name + " leads out of the page: " + value);
    }
  }

  void Say(const std::string& what) { found_.push_back(what); }

  const std::string& page_;
  std::vector<std::string> open_;
  std::set<std::string> ids_;
  std::set<std::string> named_;
  std::vector<std::string> found_;
};

}  // namespace farhorizon
