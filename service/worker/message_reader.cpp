#include "service/worker/message_reader.h"

#include <utility>
#include <variant>

namespace farhorizon {

namespace {

constexpr std::size_t kLongestLine = 16384;

}  // namespace

bool MessageReader::Add(std::string_view bytes) {
  buffer_ += bytes;
  std::size_t end = 0;
  while ((end = buffer_.find('\n')) != std::string::npos) {
    if (!AddLine(std::string_view(buffer_).substr(0, end))) return false;
    buffer_.erase(0, end + 1);
  }
  return buffer_.size() <= kLongestLine;
}

bool MessageReader::AddLine(std::string_view line) {
  std::optional<WorkerMessage> message = ReadMessage(line);
  if (!message || final_message_) return false;
  if (const auto* step = std::get_if<WorkerProgress>(&*message)) {
    control_.Report(step->stage, step->done);
  } else if (const auto* assumption = std::get_if<Assumption>(&*message)) {
    if (++assumptions_ > kMostAssumptions) return false;
    control_.Assume(*assumption);
  } else if (const auto* size = std::get_if<WorkerSize>(&*message)) {
    posts_ = size->posts;
  } else if (!std::holds_alternative<WorkerBeat>(*message)) {
    final_message_ = std::move(message);
  }
  return true;
}

}  // namespace farhorizon
