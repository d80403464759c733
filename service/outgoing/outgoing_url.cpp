#include "service/outgoing/outgoing_url.h"

#include <algorithm>
#include <curl/curl.h>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/lower.h"
#include "service/text_list.h"
#include "service/url_query.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMostUrlBytes = 4096;

using Handle = std::unique_ptr<CURLU, decltype(&curl_url_cleanup)>;

Error Refused(const std::string& why) {
  return {ErrorCode::kInvalidArgument, why, "href-not-allowed"};
}

// nullopt where the URL has no such part.
std::optional<std::string> PartOf(const Handle& handle, CURLUPart part, unsigned flags = 0) {
  char* text = nullptr;
  if (curl_url_get(handle.get(), part, &text, flags) != CURLUE_OK) return std::nullopt;
  const std::unique_ptr<char, decltype(&curl_free)> owned(text, &curl_free);
  return std::string(text);
}

std::string Part(const Handle& handle, CURLUPart part, unsigned flags = 0) {
  return PartOf(handle, part, flags).value_or("");
}

// Whether a server could take the path for another one.
bool IsAmbiguous(const std::string& path) {
  const std::string lower = Lower(path);
  // Of control characters %00 to %1f and %7f.
  for (const char* encoded : {"%2e", "%2f", "%5c", "%25", "%0", "%1", "%7f"}) {
    if (lower.find(encoded) != std::string::npos) return true;
  }
  if (!PercentDecode(path)) return true;  // an escape that is none
  for (std::size_t begin = 1; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view segment = std::string_view(path).substr(begin, end - begin);
    // With parameters after a semicolon, too, which some servers take off first.
    const std::string_view name = segment.substr(0, segment.find(';'));
    if (name == "." || name == "..") return true;
    begin = end + 1;
  }
  return false;
}

}  // namespace

Result<OutgoingUrl> ReadOutgoingUrl(const std::string& text) {
  if (text.size() > kMostUrlBytes) return Refused("the URL is longer than 4096 characters");
  const bool plain = std::all_of(text.begin(), text.end(),
                                 [](char c) { return c > ' ' && c < '\x7f' && c != '\\'; });
  if (!plain) {
    return Refused(
        "the URL has a blank, a backslash, or a character that is none of ASCII; encode it");
  }
  const Handle handle(curl_url(), &curl_url_cleanup);
  Check(handle != nullptr, "there is memory for a URL");
  // Neither is a scheme guessed, nor are dots resolved, which would hide what was written.
  const CURLUcode parsed = curl_url_set(handle.get(), CURLUPART_URL, text.c_str(),
                                        CURLU_PATH_AS_IS | CURLU_DISALLOW_USER);
  if (parsed == CURLUE_USER_NOT_ALLOWED) return Refused("the URL has a user name");
  if (parsed == CURLUE_UNSUPPORTED_SCHEME) return Refused("the URL is not one of http or https");
  if (parsed != CURLUE_OK) {
    return Refused(std::string("the URL cannot be read: ") + curl_url_strerror(parsed));
  }
  OutgoingUrl url{text,
                  Part(handle, CURLUPART_SCHEME),
                  Part(handle, CURLUPART_HOST),
                  Part(handle, CURLUPART_PORT, CURLU_DEFAULT_PORT),
                  Part(handle, CURLUPART_PATH),
                  ""};
  if (url.scheme != "http" && url.scheme != "https") {
    return Refused("the URL is not one of http or https");
  }
  if (text.find('#') != std::string::npos) return Refused("the URL has a fragment");
  if (const auto query = PartOf(handle, CURLUPART_QUERY)) url.query = "?" + *query;
  // What is not written as it is read could be read otherwise by another program.
  const auto port = PartOf(handle, CURLUPART_PORT, CURLU_NO_DEFAULT_PORT);
  const std::string authority = url.scheme + "://" + url.host + (port ? ":" + *port : "");
  const bool canonical = text == authority + url.path + url.query ||
                         (url.path == "/" && text == authority + url.query);
  if (!canonical || url.host.ends_with('.') || Lower(url.host) != url.host) {
    std::string host = Lower(url.host);
    while (host.ends_with('.')) host.pop_back();
    return Refused(
        "the URL has its scheme, host or port in another form than the usual one, which is " +
        url.scheme + "://" + host + (port ? ":" + *port : ""));
  }
  if (IsAmbiguous(url.path)) {
    return Refused(
        "the path of the URL has dots as a segment, a broken escape, or an encoded dot, slash, "
        "percent sign or control character");
  }
  return url;
}

Result<UrlPrefixes> UrlPrefixes::Read(const std::string& list, const std::string& key) {
  UrlPrefixes prefixes;
  for (const std::string& entry : CommaList(list)) {
    Result<OutgoingUrl> prefix = ReadOutgoingUrl(entry);
    if (prefix && prefix->query.empty()) {
      prefixes.prefixes_.push_back(*std::move(prefix));
      continue;
    }
    const std::string why = prefix ? "the URL has a query" : prefix.error().message;
    return Error{ErrorCode::kInvalidArgument,
                 key + " has \"" + entry + "\": " + why +
                     "; expected beginnings of URLs, such as https://tiles.example.org/dem",
                 "invalid-config"};
  }
  return prefixes;
}

bool UrlPrefixes::Have(const OutgoingUrl& url) const {
  return std::any_of(prefixes_.begin(), prefixes_.end(), [&](const OutgoingUrl& prefix) {
    if (url.scheme != prefix.scheme || url.host != prefix.host || url.port != prefix.port) {
      return false;
    }
    if (!url.path.starts_with(prefix.path)) return false;
    return url.path.size() == prefix.path.size() || prefix.path.ends_with('/') ||
           url.path[prefix.path.size()] == '/';
  });
}

}  // namespace farhorizon
