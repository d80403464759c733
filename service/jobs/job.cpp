#include "service/jobs/job.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/base/hex.h"
#include "service/random.h"

namespace farhorizon {

namespace {

constexpr std::array kStates = {JobState::kAccepted, JobState::kRunning, JobState::kSuccessful,
                                JobState::kFailed, JobState::kDismissed};
constexpr std::size_t kLongestFilename = 100;
// Where a UUID's text has its dashes, in rising order.
constexpr std::array<std::size_t, 4> kDashes = {8, 13, 18, 23};

// What orders the ids: 48 bits of time, then the 12 between version and variant, as one number.
constexpr unsigned kCounterBits = 12;

std::uint64_t RandomCounter() {
  const auto bytes = RandomBytes();
  return (bytes[0] << 4U | bytes[1] >> 4U) & ((1U << kCounterBits) - 1);
}

// A UUIDv7 with these 60 bits; the other 62 are random.
std::string WithOrder(std::uint64_t order) {
  std::array<unsigned char, 16> bytes = RandomBytes();
  for (std::size_t i = 0; i < 6; ++i) {
    bytes[i] = static_cast<unsigned char>(order >> (kCounterBits + 8U * (5 - i)));
  }
  bytes[6] = static_cast<unsigned char>(0x70U | (order >> 8U & 0x0FU));  // RFC 9562: version 7
  bytes[7] = static_cast<unsigned char>(order);
  bytes[8] = static_cast<unsigned char>(0x80U | (bytes[8] & 0x3FU));  // and its variant
  std::string id = ToHex(bytes);
  for (const std::size_t dash : kDashes) id.insert(dash, 1, '-');
  return id;
}

// The inverse of WithOrder, for any UUID: its digits without the dashes and the version.
std::uint64_t OrderOf(const std::string& id) {
  const std::string digits = id.substr(0, 8) + id.substr(9, 4) + id.substr(15, 3);
  std::uint64_t order = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), order, 16);
  return order;
}

bool IsFilenameCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '_' || c == '-';
}

}  // namespace

const char* JobStateName(JobState state) {
  switch (state) {
    case JobState::kAccepted:
      return "accepted";
    case JobState::kRunning:
      return "running";
    case JobState::kSuccessful:
      return "successful";
    case JobState::kFailed:
      return "failed";
    case JobState::kDismissed:
      return "dismissed";
  }
  return "failed";
}

std::optional<JobState> JobStateOf(std::string_view name) {
  for (const JobState state : kStates) {
    if (name == JobStateName(state)) return state;
  }
  return std::nullopt;
}

bool IsTerminal(JobState state) {
  return state != JobState::kAccepted && state != JobState::kRunning;
}

bool MayFollow(JobState from, JobState to) {
  if (from == JobState::kAccepted) {
    return to == JobState::kRunning || to == JobState::kFailed || to == JobState::kDismissed;
  }
  if (from == JobState::kRunning) return to != JobState::kRunning;
  return false;
}

std::string NewJobId(std::int64_t now_ms) {
  return WithOrder((static_cast<std::uint64_t>(now_ms) << kCounterBits) | RandomCounter());
}

std::string NextJobId(std::int64_t now_ms, const std::string& last) {
  std::string id = NewJobId(now_ms);
  if (id > last) return id;
  // The clock has gone back, or this is the same millisecond: one more than the last (RFC 9562,
  // section 6.2, method 1).
  return WithOrder(OrderOf(last) + 1);
}

bool IsJobId(std::string_view text) {
  if (text.size() != 36) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = std::find(kDashes.begin(), kDashes.end(), i) != kDashes.end();
    if (dash ? text[i] != '-' : !IsLowerHexDigit(text[i])) return false;
  }
  return true;
}

Error NoSuchJob() { return {ErrorCode::kNotFound, "there is no job with this id", "no-such-job"}; }

std::vector<std::string> ObjectsOf(const std::vector<Artifact>& artifacts) {
  std::vector<std::string> names;
  for (const Artifact& artifact : artifacts) {
    names.push_back(artifact.sha256);
    if (artifact.gzip) names.push_back(artifact.gzip->sha256);
    if (artifact.zstd) names.push_back(artifact.zstd->sha256);
  }
  return names;
}

std::string SafeFilename(std::string_view path) {
  const std::size_t slash = path.find_last_of("/\\");
  if (slash != std::string_view::npos) path = path.substr(slash + 1);
  std::string name;
  for (const char c : path) {
    if (IsFilenameCharacter(c)) name += c;
  }
  if (name.size() > kLongestFilename) name.erase(0, name.size() - kLongestFilename);
  const std::size_t start = name.find_first_not_of(".-");
  if (start == std::string::npos) return kNoFilename;
  // Formats are known by their endings: one that is all that is left is kept.
  const bool ending = start > 0 && name[start - 1] == '.';
  if (ending && name.size() - start + std::string_view(kNoFilename).size() < kLongestFilename) {
    return kNoFilename + name.substr(start - 1);
  }
  return name.substr(start);
}

bool IsArtifactName(std::string_view name) {
  return !name.empty() && name.size() <= kLongestFilename && name[0] != '.' && name[0] != '-' &&
         std::all_of(name.begin(), name.end(), IsFilenameCharacter);
}

}  // namespace farhorizon
