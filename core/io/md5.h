#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace farhorizon {

/// Computes the MD5 of bytes that come piece by piece: for protocols that ask for it as a sum
/// against accidents, and for nothing else.
class Md5 {
 public:
  Md5();
  ~Md5();

  void Add(std::string_view bytes);
  /// In base64 [RFC 4648]; nullopt where the system's policy leaves MD5 out.
  /// Requires: called once, last.
  std::optional<std::string> Finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace farhorizon
