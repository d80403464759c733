#include "service/line_writer.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <poll.h>
#include <string_view>
#include <thread>
#include <unistd.h>
#include <utility>

#include <climits>

namespace farhorizon {

namespace {

constexpr std::chrono::seconds kLastLines{1};
constexpr std::chrono::milliseconds kPollTime{100};

// Writes at most PIPE_BUF bytes; their number, 0 where the descriptor takes none now, -1 on an
// error. A pipe that poll calls writable has room for PIPE_BUF bytes [POSIX, pipe(7)], so that the
// write does not block; only another process that fills the same pipe in between could make it.
ssize_t WriteSome(int fd, std::string_view text) {
  struct pollfd ready {
    fd, POLLOUT, 0
  };
  const int count = ::poll(&ready, 1, static_cast<int>(kPollTime.count()));
  if (count == 0 || (count < 0 && errno == EINTR)) return 0;
  if (count < 0) return -1;
  const ssize_t size = ::write(fd, text.data(), std::min<std::size_t>(text.size(), PIPE_BUF));
  if (size < 0 && (errno == EINTR || errno == EAGAIN)) return 0;
  return size;
}

}  // namespace

// Shared with the thread, which outlives the object where a write blocks after all.
struct LineWriter::State {
  int fd = -1;
  std::size_t most_bytes = 0;
  std::function<std::string(std::int64_t)> lost_line;

  std::mutex mutex;
  std::condition_variable changed;
  std::deque<std::string> lines;
  std::size_t bytes = 0;    // of `lines`
  std::int64_t unsaid = 0;  // dropped since the last lost_line
  std::int64_t dropped = 0;
  std::optional<std::chrono::steady_clock::time_point> end;  // of waiting for a reader
  bool ended = false;
};

LineWriter::LineWriter(int fd, std::size_t most_bytes,
                       std::function<std::string(std::int64_t)> lost)
    : state_(std::make_shared<State>()) {
  state_->fd = fd;
  state_->most_bytes = most_bytes;
  state_->lost_line = std::move(lost);
  std::thread([state = state_] { Run(state); }).detach();
}

LineWriter::~LineWriter() {
  std::unique_lock lock(state_->mutex);
  state_->end = std::chrono::steady_clock::now() + kLastLines;
  state_->changed.notify_all();
  // Not for ever: a write may block after all.
  state_->changed.wait_for(lock, 2 * kLastLines, [this] { return state_->ended; });
}

void LineWriter::Write(std::string line) {
  const std::lock_guard lock(state_->mutex);
  if (state_->bytes + line.size() > state_->most_bytes) {
    ++state_->unsaid;
    ++state_->dropped;
    return;
  }
  if (state_->unsaid > 0) {
    std::string lost = state_->lost_line(std::exchange(state_->unsaid, 0));
    state_->bytes += lost.size();
    state_->lines.push_back(std::move(lost));
  }
  state_->bytes += line.size();
  state_->lines.push_back(std::move(line));
  state_->changed.notify_all();
}

std::int64_t LineWriter::dropped() const {
  const std::lock_guard lock(state_->mutex);
  return state_->dropped;
}

void LineWriter::Run(const std::shared_ptr<State>& state) {
  std::unique_lock lock(state->mutex);
  for (;;) {
    state->changed.wait(lock, [&] { return state->end || !state->lines.empty(); });
    if (state->lines.empty()) break;
    std::string line = std::move(state->lines.front());
    state->lines.pop_front();
    lock.unlock();
    bool taken = true;
    for (std::string_view rest = line; taken && !rest.empty();) {
      const ssize_t size = WriteSome(state->fd, rest);
      rest.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
      const std::lock_guard state_lock(state->mutex);
      const bool late = state->end && std::chrono::steady_clock::now() > *state->end;
      taken = size > 0 || (size == 0 && !late);
    }
    lock.lock();
    state->bytes -= line.size();
    if (taken) continue;
    // Nobody reads any more, or nobody can: what is kept goes too.
    const auto count = static_cast<std::int64_t>(state->lines.size()) + 1;
    state->unsaid += count;
    state->dropped += count;
    state->lines.clear();
    state->bytes = 0;
  }
  state->ended = true;
  state->changed.notify_all();
}

}  // namespace farhorizon
