#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace farhorizon {

/// Writes lines to a descriptor in a thread of its own, so that the caller never waits for whoever
/// reads them. While nobody does, lines are kept up to a bound; those beyond it are dropped and
/// counted.
/// Threads: safe.
class LineWriter {
 public:
  /// lost: the line that stands where `count` lines were dropped.
  /// Requires: `fd` stays open as long as this object lives.
  LineWriter(int fd, std::size_t most_bytes, std::function<std::string(std::int64_t count)> lost);
  /// Waits up to a second for the lines that are kept, and leaves the rest unwritten.
  ~LineWriter();
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  /// line: with its newline.
  void Write(std::string line);
  /// The number of lines dropped so far.
  [[nodiscard]] std::int64_t dropped() const;

 private:
  struct State;
  static void Run(const std::shared_ptr<State>& state);

  std::shared_ptr<State> state_;
};

}  // namespace farhorizon
