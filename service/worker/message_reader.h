#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/run_control.h"
#include "service/worker/worker_protocol.h"

namespace farhorizon {

/// Splits a worker's bytes into messages, passes progress and assumptions on and keeps the DEM's
/// size and the message that ends the work. A hostile raster may have taken the worker over: the
/// memory is bounded, whatever it sends.
class MessageReader {
 public:
  /// control: outlives this object.
  explicit MessageReader(const RunControl& control) : control_(control) {}

  /// False where the bytes violate the protocol.
  bool Add(std::string_view bytes);

  /// A WorkerDone or an Error.
  [[nodiscard]] const std::optional<WorkerMessage>& final_message() const { return final_message_; }
  [[nodiscard]] std::optional<std::int64_t> posts() const { return posts_; }

 private:
  bool AddLine(std::string_view line);

  const RunControl& control_;
  std::size_t assumptions_ = 0;
  std::optional<std::int64_t> posts_;
  std::string buffer_;  // the beginning of a line
  std::optional<WorkerMessage> final_message_;
};

}  // namespace farhorizon
