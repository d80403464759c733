#include "service/handlers/multipart.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMaxHeadBytes = 8192;
constexpr int kMaxParts = 16;

}  // namespace

MultipartParser::MultipartParser(const std::string& boundary, PartReceiver receiver)
    : delimiter_("\r\n--" + boundary),
      receiver_(std::move(receiver)),
      // The first boundary of a body has no CRLF before it; with this one it is a delimiter, too.
      buffer_("\r\n") {}

Status MultipartParser::Feed(std::string_view piece) {
  buffer_ += piece;
  for (;;) {
    Result<bool> stepped = Step();
    if (!stepped) return std::move(stepped.error());
    if (!*stepped) return Ok{};
  }
}

Status MultipartParser::Finish() const {
  if (state_ == State::kEnd) return Ok{};
  return BrokenForm("it stops before its closing boundary");
}

Result<bool> MultipartParser::Step() {
  switch (state_) {
    case State::kStart:
      if (buffer_.size() < delimiter_.size()) return false;
      if (buffer_.compare(0, delimiter_.size(), delimiter_) != 0) {
        return BrokenForm("it does not start with its boundary");
      }
      buffer_.erase(0, delimiter_.size());
      state_ = State::kAfterBoundary;
      return true;
    case State::kAfterBoundary:
      return StepAfterBoundary();
    case State::kHead:
      return StepHead();
    case State::kData:
      return StepData();
    case State::kEnd:
      buffer_.clear();  // an epilogue is ignored [RFC 2046, section 5.1.1]
      return false;
  }
  return false;
}

Result<bool> MultipartParser::StepAfterBoundary() {
  if (buffer_.size() < 2) return false;
  const std::string next = buffer_.substr(0, 2);
  buffer_.erase(0, 2);
  if (next == "--") {
    state_ = State::kEnd;
  } else if (next == "\r\n") {
    if (++parts_ > kMaxParts) return BrokenForm("it has more than 16 parts");
    state_ = State::kHead;
  } else {
    return BrokenForm("a boundary is followed by something else");
  }
  return true;
}

Result<bool> MultipartParser::StepHead() {
  const std::size_t end = buffer_.find("\r\n\r\n");
  if (end == std::string::npos) {
    // A head of the greatest length may still wait for the rest of its CRLF CRLF.
    if (buffer_.size() < kMaxHeadBytes + 4) return false;
    return BrokenForm("a part's head is longer than 8192 bytes");
  }
  if (end > kMaxHeadBytes) return BrokenForm("a part's head is longer than 8192 bytes");
  Result<PartHead> head = ReadPartHead(std::string_view(buffer_).substr(0, end));
  if (!head) return std::move(head.error());
  buffer_.erase(0, end + 4);
  Status begun = receiver_.begin(*head);
  if (!begun) return std::move(begun.error());
  state_ = State::kData;
  return true;
}

Result<bool> MultipartParser::StepData() {
  const std::size_t found = buffer_.find(delimiter_);
  // The last bytes may be the beginning of a delimiter; they wait for the next piece.
  const std::size_t kept = delimiter_.size() - 1;
  const std::size_t ready = found != std::string::npos ? found
                            : buffer_.size() > kept    ? buffer_.size() - kept
                                                       : 0;
  if (ready > 0) {
    Status taken = receiver_.data(std::string_view(buffer_).substr(0, ready));
    if (!taken) return std::move(taken.error());
    buffer_.erase(0, ready);
  }
  if (found == std::string::npos) return false;
  buffer_.erase(0, delimiter_.size());
  state_ = State::kAfterBoundary;
  return true;
}

}  // namespace farhorizon
