#include "service/handlers/json_sieve.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace farhorizon {

namespace {

// ParseStrictJson refuses the same, but only once it has the document.
constexpr std::size_t kMaxDepth = 64;
// No longer name is one of a path.
constexpr std::size_t kLongestKey = 64;

Error Fault(const std::string& what) {
  return {ErrorCode::kInvalidArgument, "the JSON is at fault: " + what, "invalid-json"};
}

// The character that follows the backslash of a short escape, undone; NUL for none.
char Undone(char c) {
  switch (c) {
    case '"':
    case '\\':
    case '/':
      return c;
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    default:
      return '\0';
  }
}

}  // namespace

JsonSieve::JsonSieve(std::vector<std::string> path, std::function<Status(std::string_view)> take,
                     std::size_t most_rest)
    : path_(std::move(path)), take_(std::move(take)), most_rest_(most_rest) {}

Status JsonSieve::Feed(std::string_view piece) {
  while (!piece.empty()) {
    std::size_t used = 1;
    if (in_ == In::kSieved) {
      Result<std::size_t> taken = FeedSieved(piece);
      if (!taken) return std::move(taken.error());
      used = *taken;
    } else if (in_ == In::kBetween) {
      Status fed = FeedBetween(piece[0]);
      if (!fed) return fed;
    } else {
      FeedKept(piece[0]);
    }
    piece.remove_prefix(used);
    if (rest_.size() > most_rest_) {
      return Error{ErrorCode::kResourceExhausted,
                   "the JSON has more than " + std::to_string(most_rest_) +
                       " bytes beside the DEM, which is a text in base64",
                   "body-too-large"};
    }
  }
  return Ok{};
}

Status JsonSieve::FeedBetween(char c) {
  rest_ += c;
  if (c == '{' || c == '[') {
    if (levels_.size() >= kMaxDepth) return Fault("it is more than 64 deep");
    levels_.push_back({c == '{', c == '{', {}});
  } else if ((c == '}' || c == ']') && !levels_.empty()) {
    levels_.pop_back();
  } else if (c == ',' && !levels_.empty()) {
    levels_.back().key_next = levels_.back().object;
  } else if (c == '"') {
    BeginText();
  }
  return Ok{};
}

void JsonSieve::BeginText() {
  const bool key = !levels_.empty() && levels_.back().key_next;
  if (key) {
    levels_.back().key_next = false;
    levels_.back().key.clear();
  }
  found_ = found_ || (!key && AtPath());
  in_ = key ? In::kKey : AtPath() ? In::kSieved : In::kText;
}

bool JsonSieve::AtPath() const {
  const bool deeper = levels_.size() == path_.size() + 1 && levels_.back().key == "value";
  if (levels_.size() != path_.size() && !deeper) return false;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    if (!levels_[i].object || (i < path_.size() && levels_[i].key != path_[i])) return false;
  }
  return true;
}

// A name or a text of the rest. Names are compared as they are written: one with an escape is none
// of a path, and the text stays in the rest.
void JsonSieve::FeedKept(char c) {
  rest_ += c;
  if (!escape_.empty()) {
    escape_.clear();
  } else if (c == '\\') {
    escape_ = c;
  } else if (c == '"') {
    in_ = In::kBetween;
    return;
  }
  if (in_ == In::kKey && levels_.back().key.size() <= kLongestKey) levels_.back().key += c;
}

Result<std::size_t> JsonSieve::FeedSieved(std::string_view piece) {
  if (!escape_.empty() || piece[0] == '\\') {
    Status fed = FeedEscape(piece[0]);
    if (!fed) return std::move(fed.error());
    return std::size_t{1};
  }
  if (piece[0] == '"') {
    rest_ += '"';
    in_ = In::kBetween;
    return std::size_t{1};
  }
  const auto ends = [](char c) {
    return c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20;
  };
  const auto* const end = std::find_if(piece.begin(), piece.end(), ends);
  const auto size = static_cast<std::size_t>(end - piece.begin());
  if (size == 0) return Fault("a control character in a text");
  Status taken = take_(piece.substr(0, size));
  if (!taken) return std::move(taken.error());
  return size;
}

Status JsonSieve::FeedEscape(char c) {
  escape_ += c;
  if (escape_.size() == 1) return Ok{};
  char undone = '\0';
  if (escape_[1] == 'u') {
    constexpr std::size_t kWhole = 6;  // \uXXXX
    if (escape_.size() < kWhole) return Ok{};
    unsigned code = 0;
    const char* const digits = escape_.data() + 2;
    const auto [stop, failure] = std::from_chars(digits, digits + 4, code, 16);
    // The text is in base64: nothing beyond ASCII is any of it.
    if (failure == std::errc() && stop == digits + 4 && code < 0x80) {
      undone = static_cast<char>(code);
    }
  } else {
    undone = Undone(c);
  }
  escape_.clear();
  if (undone == '\0') return Fault("an escape that no base64 has");
  return take_({&undone, 1});
}

}  // namespace farhorizon
