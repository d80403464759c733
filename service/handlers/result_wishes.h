#pragma once

#include <map>
#include <optional>
#include <string>

namespace farhorizon {

/// How an output is sent: as itself, or as a link to it.
enum class Transmission { kValue, kReference };

/// What an execute request asks of the results.
struct ResultWishes {
  /// As they are, not as a JSON document of all.
  bool raw = false;
  /// The outputs by name; unset: all, by reference.
  std::optional<std::map<std::string, Transmission>> outputs = {};
};

/// The text that a job keeps of its wishes: empty for a document of all outputs by reference.
std::string WriteResultWishes(const ResultWishes& wishes);
/// The inverse of WriteResultWishes; of any other text, those that the empty one stands for.
ResultWishes ReadResultWishes(const std::string& text);

}  // namespace farhorizon
