#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace farhorizon {

/// A sum of bytes that come piece by piece, of an algorithm that a protocol names. md5 and sha1
/// tell accidents of the network and no malice.
class Checksum {
 public:
  /// name: "md5", "sha1" or "sha256"; nullopt for any other, and for one that the system's policy
  /// leaves out.
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
