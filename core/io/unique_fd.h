#pragma once

#include <utility>

namespace farhorizon {

/// A file descriptor that its one owner closes. Destructor and Reset leave errno as it is, so that
/// the cause of a failure survives them.
class UniqueFd {
 public:
  UniqueFd() = default;
  explicit UniqueFd(int fd) : fd_(fd) {}
  UniqueFd(UniqueFd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  UniqueFd& operator=(UniqueFd&& other) noexcept {
    if (this != &other) Reset(std::exchange(other.fd_, -1));
    return *this;
  }
  UniqueFd(const UniqueFd&) = delete;
  UniqueFd& operator=(const UniqueFd&) = delete;
  ~UniqueFd() { Reset(); }

  [[nodiscard]] int get() const { return fd_; }
  /// True while a descriptor is held.
  explicit operator bool() const { return fd_ >= 0; }
  /// Closes the descriptor and holds `fd` instead.
  void Reset(int fd = -1);
  /// Closes the descriptor; false, with errno set, where closing reports a late write error.
  bool Close();

 private:
  int fd_ = -1;
};

}  // namespace farhorizon
