#include "service/jobs/database_url.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <postgresql/libpq-fe.h>
#include <regex>
#include <string_view>

namespace farhorizon {

namespace {

constexpr std::string_view kHidden = "***";
constexpr auto kAnyCase = std::regex::ECMAScript | std::regex::icase;

// Up to the last @: a password that should be escaped and is not may have others.
const std::regex& Userinfo() {
  static const std::regex expression("^([a-z][a-z0-9+.-]*://[^:/@?]*):(.*)@", kAnyCase);
  return expression;
}

void ReplaceAll(std::string& text, const std::string& old, std::string_view now) {
  if (old.empty()) return;
  for (std::size_t at = text.find(old); at != std::string::npos;
       at = text.find(old, at + now.size())) {
    text.replace(at, old.size(), now);
  }
}

// libpq looks at ports, one for each host, only when it connects.
std::string FaultOfPort(const PQconninfoOption* options) {
  for (const PQconninfoOption* option = options; option->keyword != nullptr; ++option) {
    if (std::string_view(option->keyword) != "port" || option->val == nullptr) continue;
    const std::string ports = option->val;
    if (ports.find_first_not_of("0123456789,") != std::string::npos) {
      return "its port is \"" + ports + "\"";
    }
  }
  return "";
}

}  // namespace

Status CheckDatabaseUrl(const std::string& url) {
  char* words = nullptr;
  const std::unique_ptr<PQconninfoOption, void (*)(PQconninfoOption*)> options(
      ::PQconninfoParse(url.c_str(), &words), ::PQconninfoFree);
  std::string why = words == nullptr ? "" : WithoutPassword(words, url);
  ::PQfreemem(words);
  if (options && why.empty()) why = FaultOfPort(options.get());
  if (options && why.empty()) return Ok{};
  while (!why.empty() && why.back() == '\n') why.pop_back();
  return Error{ErrorCode::kInvalidArgument,
               "store.jobs is no URL of a PostgreSQL database (" + why +
                   "); give one such as postgresql://USER@HOST/NAME?passfile=FILE",
               "invalid-config"};
}

std::string WithoutPassword(const std::string& url) {
  // Names may be escaped, too.
  static const std::regex parameter("([?&](?!passfile=)[^=&]*(?:pass|%)[^=&]*)=[^&]*", kAnyCase);
  static const std::regex word(R"((password\s*=\s*)('(?:\\.|[^'\\])*'?|(?:\\.|[^\s\\])*))",
                               kAnyCase);
  if (url.find("://") == std::string::npos) return std::regex_replace(url, word, "$1***");
  return std::regex_replace(std::regex_replace(url, Userinfo(), "$1:***@"), parameter, "$1=***");
}

std::string WithoutPassword(const std::string& message, const std::string& url) {
  constexpr std::string_view kDelimiters = "@:/?&=%#[] ";
  constexpr std::size_t kShortest = 3;  // else words of the message would go
  std::string text = message;
  ReplaceAll(text, url, WithoutPassword(url));
  std::smatch found;
  if (!std::regex_search(url, found, Userinfo())) return text;
  const std::string secret = found[2];
  for (std::size_t at = 0; at < secret.size();) {
    const std::size_t end = std::min(secret.find_first_of(kDelimiters, at), secret.size());
    if (end - at >= kShortest) ReplaceAll(text, secret.substr(at, end - at), kHidden);
    at = end + 1;
  }
  return text;
}

}  // namespace farhorizon
