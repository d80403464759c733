#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// Takes one long text out of a JSON document that arrives piece by piece, so that no more than the
/// rest of the document is ever held.
///
/// The text is the one at `path`, names of members from the outermost object on, or at `path` and
/// one more name: "value". In the rest it is empty. The rest decides whether the document is one:
/// whoever parses it finds every fault but those of the text itself, which are found here. How the
/// document is cut into pieces makes no difference.
class JsonSieve {
 public:
  /// take: gets the text piece by piece, its escapes undone. most_rest: bytes of the rest.
  JsonSieve(std::vector<std::string> path, std::function<Status(std::string_view)> take,
            std::size_t most_rest);

  /// Errors: kInvalidArgument "invalid-json" for a fault of the text, or nesting that is deeper
  ///   than ParseStrictJson takes; kResourceExhausted "body-too-large" where the rest is; those of
  ///   `take`.
  Status Feed(std::string_view piece);

  /// Whether the text has been met.
  [[nodiscard]] bool found() const { return found_; }
  [[nodiscard]] const std::string& rest() const { return rest_; }

 private:
  enum class In { kBetween, kKey, kText, kSieved };
  struct Level {
    bool object = false;
    bool key_next = false;
    std::string key;  // of the member that is being read
  };

  Status FeedBetween(char c);
  void FeedKept(char c);
  /// Takes what it can of a piece of the text; the number of bytes that it took.
  Result<std::size_t> FeedSieved(std::string_view piece);
  /// The next character of an escape.
  Status FeedEscape(char c);
  void BeginText();
  [[nodiscard]] bool AtPath() const;

  std::vector<std::string> path_;
  std::function<Status(std::string_view)> take_;
  std::size_t most_rest_;
  In in_ = In::kBetween;
  std::vector<Level> levels_;
  std::string escape_;  // what of an escape has come, from its backslash on
  std::string rest_;
  bool found_ = false;
};

}  // namespace farhorizon
