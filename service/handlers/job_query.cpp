#include "service/handlers/job_query.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <string>

#include "core/pipeline/option_numbers.h"

namespace farhorizon {

namespace {

constexpr int kMostPageSize = 10000;
// A century: far from the end of the numbers.
constexpr std::int64_t kLongestDuration = std::int64_t{100} * 366 * 86400;
constexpr std::int64_t kDayMs = std::int64_t{86400} * 1000;

Error BadQuery(const std::string& what) {
  return {ErrorCode::kInvalidArgument, what, "invalid-query-parameter-value"};
}

std::vector<std::string> ListIn(std::string_view text) {
  std::vector<std::string> list;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    list.emplace_back(text.substr(0, comma));
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return list;
}

Status ReadLimit(const std::string& text, JobQuery& query) {
  const std::optional<std::int64_t> limit = WholeNumberIn(text);
  if (!limit || *limit < 1 || *limit > kMostPageSize) {
    return BadQuery("limit must be a whole number from 1 to 10000");
  }
  query.limit = static_cast<int>(*limit);
  return Ok{};
}

Status ReadStates(const std::string& text, JobQuery& query) {
  for (const std::string& name : ListIn(text)) {
    const std::optional<JobState> state = JobStateOf(name);
    if (!state) {
      return BadQuery("status must be a list of accepted, running, successful, failed, dismissed");
    }
    query.states.push_back(*state);
  }
  return Ok{};
}

Status ReadDuration(const std::string& name, const std::string& text,
                    std::optional<std::int64_t>& duration_ms) {
  const std::optional<std::int64_t> seconds = WholeNumberIn(text);
  if (!seconds || *seconds < 0 || *seconds > kLongestDuration) {
    return BadQuery(name + " must be a whole number of seconds");
  }
  duration_ms = *seconds * 1000;
  return Ok{};
}

// An instant, or two with a slash between, of which one may be open: "..", or nothing.
Status ReadDatetime(const std::string& text, JobQuery& query) {
  const Error bad = BadQuery(
      "datetime must be a time such as 2026-01-31T12:00:00Z, or an interval such as "
      "2026-01-31T00:00:00Z/..");
  const auto read = [](std::string_view part) { return part == ".." ? "" : part; };
  const std::size_t slash = text.find('/');
  const std::string_view whole = text;
  const std::string_view from = read(whole.substr(0, slash));
  const std::string_view to = slash == std::string::npos ? from : read(whole.substr(slash + 1));
  if (from.empty() && to.empty()) return bad;
  const auto first = InstantIn(from);
  const auto last = InstantIn(to);
  if ((!from.empty() && !first) || (!to.empty() && !last)) return bad;
  if (first) query.created_from_ms = first->first;
  if (last) query.created_to_ms = last->second;
  return Ok{};
}

Status ReadParameter(const std::string& name, const std::string& value, JobListRequest& request) {
  JobQuery& query = request.query;
  if (name == "limit") return ReadLimit(value, query);
  if (name == "status") return ReadStates(value, query);
  if (name == "datetime") return ReadDatetime(value, query);
  if (name == "minDuration") return ReadDuration(name, value, query.least_duration_ms);
  if (name == "maxDuration") return ReadDuration(name, value, query.most_duration_ms);
  if (name == "processID") {
    query.processes = ListIn(value);
  } else if (name == "type") {
    const std::vector<std::string> types = ListIn(value);
    request.none = std::find(types.begin(), types.end(), "process") == types.end();
  } else if (name == "cursor") {
    if (!IsJobId(value)) return BadQuery("cursor must come from a next link");
    query.before = value;
  } else {
    return BadQuery("there is no parameter '" + name +
                    "'; known are limit, status, type, processID, datetime, minDuration, "
                    "maxDuration and cursor");
  }
  return Ok{};
}

// The number of the digits of `text`; nullopt where there is something else.
std::optional<int> DigitsIn(std::string_view text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, number);
  const bool digits = !text.empty() && text[0] >= '0' && text[0] <= '9';
  if (!digits || failure != std::errc() || stop != end) return std::nullopt;
  return number;
}

// "2026-01-31" as milliseconds.
std::optional<std::int64_t> DateIn(std::string_view text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
  const auto year = DigitsIn(text.substr(0, 4));
  const auto month = DigitsIn(text.substr(5, 2));
  const auto day = DigitsIn(text.substr(8, 2));
  if (!year || !month || !day) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count() * kDayMs;
}

// "Z", "+01:00" as the milliseconds by which the clock is ahead.
std::optional<std::int64_t> OffsetIn(std::string_view text) {
  if (text == "Z" || text == "z") return 0;
  if (text.size() != 6 || (text[0] != '+' && text[0] != '-') || text[3] != ':') return std::nullopt;
  const auto hours = DigitsIn(text.substr(1, 2));
  const auto minutes = DigitsIn(text.substr(4, 2));
  if (!hours || !minutes || *hours > 23 || *minutes > 59) return std::nullopt;
  const std::int64_t ahead = (std::int64_t{*hours} * 60 + *minutes) * 60'000;
  return text[0] == '-' ? -ahead : ahead;
}

}  // namespace

std::optional<std::pair<std::int64_t, std::int64_t>> InstantIn(std::string_view text) {
  using Span = std::pair<std::int64_t, std::int64_t>;
  const std::optional<std::int64_t> date = DateIn(text.substr(0, 10));
  if (!date) return std::nullopt;
  if (text.size() == 10) return Span{*date, *date + kDayMs - 1};
  constexpr std::size_t kSeconds = 19;  // of "2026-01-31T12:00:00"
  if (text.size() <= kSeconds || (text[10] != 'T' && text[10] != 't') || text[13] != ':' ||
      text[16] != ':') {
    return std::nullopt;
  }
  const auto hour = DigitsIn(text.substr(11, 2));
  const auto minute = DigitsIn(text.substr(14, 2));
  const auto second = DigitsIn(text.substr(17, 2));
  if (!hour || !minute || !second || *hour > 23 || *minute > 59 || *second > 60) {
    return std::nullopt;
  }
  std::string_view rest = text.substr(kSeconds);
  std::int64_t fraction_ms = 0;
  std::int64_t lasts_ms = 1000;
  if (rest[0] == '.') {
    const std::size_t end = std::min(rest.find_first_not_of("0123456789", 1), rest.size());
    const std::string digits = std::string(rest.substr(1, std::min<std::size_t>(end - 1, 3)));
    const std::optional<int> thousandths = DigitsIn(digits + std::string(3 - digits.size(), '0'));
    if (digits.empty() || !thousandths) return std::nullopt;
    fraction_ms = *thousandths;
    lasts_ms = 1;
    rest.remove_prefix(end);
  }
  const std::optional<std::int64_t> ahead = OffsetIn(rest);
  if (!ahead) return std::nullopt;
  const std::int64_t start =
      *date + ((std::int64_t{*hour} * 60 + *minute) * 60 + *second) * 1000 + fraction_ms - *ahead;
  return Span{start, start + lasts_ms - 1};
}

Result<JobListRequest> ReadJobQuery(const Parameters& parameters, std::int64_t now_ms) {
  JobListRequest request;
  request.query.now_ms = now_ms;
  for (const auto& [name, value] : parameters) {
    if (Status read = ReadParameter(name, value, request); !read) return std::move(read.error());
  }
  return request;
}

}  // namespace farhorizon
