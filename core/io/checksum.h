#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace farhorizon {

/// A sum of bytes that come piece by piece, of an algorithm that a client has chosen: sha1, which
/// tells accidents of the network and no malice, or sha256.
class Checksum {
 public:
  /// name: "sha1" or "sha256"; nullopt for any other.
  static std::optional<Checksum> Named(std::string_view name);
  ~Checksum();
  Checksum(Checksum&&) noexcept;
  Checksum& operator=(Checksum&&) noexcept;

  void Add(std::string_view bytes);
  /// The bytes of the sum. Requires: called once, last.
  std::string Finish();

 private:
  struct State;
  explicit Checksum(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace farhorizon
