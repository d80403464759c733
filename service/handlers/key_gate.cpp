// Refusals as [RFC 6750, section 3]: 401 without an error where there was no key, "invalid_token"
// where there was one, 403 "insufficient_scope".
#include "service/handlers/key_gate.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <variant>

#include "service/clock.h"
#include "service/handlers/route_scopes.h"

namespace farhorizon {

namespace {

// What a browser asks for by itself, without a field of the page's: links, EventSource.
constexpr std::array<std::string_view, 3> kTakeTickets = {
    "/jobs/{id}/results", "/jobs/{id}/results/{name}", "/jobs/{id}/events"};

HttpResponse Challenge(const HttpRequest& request, const Problem& problem,
                       const std::string& parameters) {
  HttpResponse response = ProblemResponse(request, problem);
  response.Set("WWW-Authenticate", "Bearer realm=\"farhorizon\"" + parameters);
  return response;
}

HttpResponse NoKey(const HttpRequest& request) {
  return Challenge(
      request,
      {"key-required", "the service asks for a key, in the field Authorization: Bearer KEY alone"},
      "");
}

HttpResponse WrongKey(const HttpRequest& request, const std::string& why) {
  return Challenge(request, {"invalid-key", why},
                   ", error=\"invalid_token\", error_description=\"" + why + "\"");
}

HttpResponse TooNarrow(const HttpRequest& request, Scope needed) {
  const std::string name = kScopeNames.at(static_cast<std::size_t>(needed));
  return Challenge(request,
                   {"insufficient-scope",
                    "this needs a key with the scope " + name + "; ask the operator for one"},
                   ", error=\"insufficient_scope\", scope=\"" + name + "\"");
}

HttpResponse TooMany(const HttpRequest& request, std::int64_t seconds) {
  HttpResponse response = ProblemResponse(
      request, {"too-many-requests", "the key has asked for as much as it may; ask again in " +
                                         std::to_string(seconds) + " seconds"});
  for (auto& [name, value] : response.headers) {
    if (name == "Retry-After") value = std::to_string(seconds);
  }
  return response;
}

// The text after "Bearer" and blanks, whose case does not matter [RFC 9110, section 11.1].
std::optional<std::string_view> BearerOf(std::string_view field) {
  constexpr std::string_view kScheme = "bearer";
  if (field.size() <= kScheme.size() || LowerCase(field.substr(0, kScheme.size())) != kScheme ||
      field[kScheme.size()] != ' ') {
    return std::nullopt;
  }
  return Trimmed(field.substr(kScheme.size()));
}

std::optional<std::string> TicketOf(const HttpRequest& request) {
  const bool takes =
      std::find(kTakeTickets.begin(), kTakeTickets.end(), request.route) != kTakeTickets.end();
  if (!takes || (request.method != "GET" && request.method != "HEAD")) return std::nullopt;
  const std::optional<Parameters> query = DecodeQuery(request.query);
  const auto found = query ? query->find("ticket") : Parameters::const_iterator();
  return query && found != query->end() ? std::optional(found->second) : std::nullopt;
}

Error NeedsKeys(const std::filesystem::path& file) {
  return {ErrorCode::kInvalidArgument,
          "others than this machine can reach the address of --listen, and " + file.string() +
              " has no key that is good: whoever reached the service could use it. Add a key first "
              "(farhorizon keys add --name NAME --file " +
              file.string() +
              "), listen on 127.0.0.1, or, where the network keeps strangers away, set "
              "FARHORIZON_AUTH_REQUIRED=never",
          "invalid-config"};
}

}  // namespace

Result<std::shared_ptr<KeyGate>> KeyGate::Open(const AuthOptions& options,
                                               const std::filesystem::path& data,
                                               bool on_loopback) {
  const std::filesystem::path file = options.KeysFile(data);
  Result<std::shared_ptr<KeyRing>> keys = KeyRing::Open(file);
  if (!keys) return std::move(keys.error());
  const std::int64_t count = (*keys)->CountLive(NowMs());
  if (options.required == AuthRequired::kAuto && !on_loopback && count == 0) {
    return NeedsKeys(file);
  }
  return std::shared_ptr<KeyGate>(new KeyGate(options, on_loopback, *std::move(keys)));
}

bool KeyGate::AsksForKeys() const {
  switch (options_.required) {
    case AuthRequired::kNever:
      return false;
    case AuthRequired::kAlways:
      return true;
    case AuthRequired::kAuto:
      return !on_loopback_ || keys_->HadFile();
  }
  return true;
}

std::int64_t KeyGate::CountKeys() const { return keys_->CountLive(NowMs()); }

std::optional<Scope> KeyGate::Needed(const Route& route) const {
  if (route.pattern == "/metrics" && options_.metrics == MetricsFor::kEveryone) return std::nullopt;
  return NeededScope(route.method, route.pattern);
}

std::variant<ApiKey, HttpResponse> KeyGate::Identify(HttpRequest& request) const {
  const std::string* field = request.Header("authorization");
  const std::int64_t now_ms = NowMs();
  if (field == nullptr) {
    const std::optional<std::string> ticket = TicketOf(request);
    if (!ticket) return NoKey(request);
    const std::optional<std::string> id = tickets_.KeyOf(*ticket, request.parameters.at(0), now_ms);
    if (!id) return WrongKey(request, "the link has expired, or was changed; open it anew");
    request.caller.key_id = *id;
    Result<ApiKey> key = keys_->Find(*id, now_ms);
    if (!key) return WrongKey(request, key.error().message);
    return *std::move(key);
  }
  const std::optional<std::string_view> text = BearerOf(*field);
  if (!text) return NoKey(request);
  // For the log: an id is no secret.
  request.caller.key_id = IdOfKey(*text).value_or("");
  Result<ApiKey> key = keys_->Match(*text, now_ms);
  if (!key) return WrongKey(request, key.error().message);
  return *std::move(key);
}

std::optional<HttpResponse> KeyGate::Admit(HttpRequest& request, const Route* route) {
  if (!AsksForKeys()) return std::nullopt;
  request.caller = Caller::Stranger();
  // A browser's preflight has no key.
  if (request.method == "OPTIONS") return std::nullopt;
  const std::optional<Scope> needed = route == nullptr ? Scope::kRead : Needed(*route);
  if (!needed) return std::nullopt;
  std::variant<ApiKey, HttpResponse> found = Identify(request);
  if (auto* refusal = std::get_if<HttpResponse>(&found)) return std::move(*refusal);
  const ApiKey& key = std::get<ApiKey>(found);
  if (route != nullptr && !key.scopes.Has(*needed)) return TooNarrow(request, *needed);
  const std::int64_t wait = meter_.TakeRequest(key.owner, request.HasBody(), NowMs());
  if (wait > 0) return TooMany(request, wait);
  request.caller = {key.id, key.owner, key.scopes};
  return std::nullopt;
}

bool KeyGate::StillGood(const Caller& caller) const {
  return !AsksForKeys() || keys_->Find(caller.key_id, NowMs()).has_value();
}

void KeyGate::CountUpload(const HttpRequest& request, std::int64_t bytes) {
  if (!request.caller.owner.empty()) meter_.TakeBytes(request.caller.owner, bytes, NowMs());
}

}  // namespace farhorizon
