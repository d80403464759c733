#include "service/handlers/job_terms.h"

#include <algorithm>
#include <optional>
#include <string>

#include "core/pipeline/option_numbers.h"

namespace farhorizon {

namespace {

// A year: longer than any queue, and far from the end of the numbers.
constexpr std::int64_t kLongestDeadline = std::int64_t{366} * 86400;

Error InvalidTerm(const std::string& name, const std::string& value, const std::string& expected) {
  return {ErrorCode::kInvalidArgument, name + "=" + value + ": expected " + expected,
          "invalid-parameter"};
}

std::optional<std::string> Take(Parameters& parameters, const char* name) {
  const auto found = parameters.find(name);
  if (found == parameters.end()) return std::nullopt;
  std::string value = std::move(found->second);
  parameters.erase(found);
  return value;
}

// The parameter in seconds, 0 without it.
Result<std::int64_t> TakeSeconds(Parameters& parameters, const char* name, std::int64_t most) {
  const std::optional<std::string> text = Take(parameters, name);
  if (!text) return std::int64_t{0};
  const std::optional<std::int64_t> seconds = WholeNumberIn(*text);
  if (seconds && *seconds >= 1 && *seconds <= most) return *seconds;
  return InvalidTerm(name, *text, "whole seconds from 1 to " + std::to_string(most));
}

}  // namespace

Result<JobTerms> TakeTerms(Parameters& parameters, const TermBounds& bounds) {
  JobTerms terms;
  terms.priority = std::min(Priority::kNormal, bounds.highest);
  if (const std::optional<std::string> name = Take(parameters, "priority")) {
    const auto* const end = kPriorityNames.begin() + static_cast<int>(bounds.highest) + 1;
    const auto* const found = std::find(kPriorityNames.begin(), end, *name);
    if (found == end) {
      std::string expected;
      for (const auto* one = kPriorityNames.begin(); one != end; ++one) {
        expected += (expected.empty() ? "" : " or ") + std::string(*one);
      }
      return InvalidTerm("priority", *name, expected);
    }
    terms.priority = static_cast<Priority>(found - kPriorityNames.begin());
  }
  Result<std::int64_t> deadline = TakeSeconds(parameters, "deadline", kLongestDeadline);
  if (!deadline) return std::move(deadline.error());
  terms.deadline_seconds = *deadline > 0 ? *deadline : bounds.deadline_seconds;
  Result<std::int64_t> timeout = TakeSeconds(parameters, "timeout", bounds.timeout_seconds);
  if (!timeout) return std::move(timeout.error());
  terms.timeout_seconds = *timeout;
  return terms;
}

}  // namespace farhorizon
