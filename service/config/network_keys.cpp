#include "service/config/config_sections.h"
#include "service/config/key_makers.h"

namespace farhorizon {

std::vector<ConfigKey> HttpKeys() {
  const auto http = [](auto field) { return FieldAt(&Config::http, field); };
  return {
      NumberKey("http.ioThreads", http(&ServerOptions::io_threads), 1, 64,
                "threads that move bytes"),
      NumberKey("http.handlerThreads", http(&ServerOptions::handler_threads), 1, 256,
                "threads for answers that wait for disk and database"),
      NumberKey("http.uploadThreads", http(&ServerOptions::upload_threads), 1, 256,
                "uploads that are looked into at once; more wait"),
      NumberKey("http.maxBodyBytes", FieldAt(&Config::max_body_bytes), 1, kTebibyte,
                "largest upload taken; larger ones get 413"),
      NumberKey("http.maxHeadBytes", http(&ServerOptions::max_head_bytes), 1024, 1 << 20,
                "largest request head taken; larger ones get 431"),
      NumberKey("http.headSeconds", http(&ServerOptions::head_time), 1, kDay,
                "time for a request's head to come in"),
      NumberKey("http.idleSeconds", http(&ServerOptions::idle_time), 1, kDay,
                "time that a connection may wait between requests, or for the next byte of a body"),
      NumberKey("http.bodyGraceSeconds", http(&ServerOptions::body_grace), 1, kDay,
                "time before the least rate of a body counts"),
      NumberKey("http.bodyBytesPerSecond", http(&ServerOptions::body_bytes_per_second), 1,
                kTebibyte, "least rate of a body"),
      NumberKey("http.writeSeconds", http(&ServerOptions::write_time), 1, kDay,
                "time for a client to take each 64 KiB of an answer"),
      NumberKey("http.maxConnections", http(&ServerOptions::max_connections), 1, 1'000'000,
                "connections at once; more get 503"),
      NumberKey("http.maxConnectionsPerAddress", http(&ServerOptions::max_connections_per_address),
                1, 1'000'000, "connections at once from one address"),
      TextKey("http.allowedHosts", http(&ServerOptions::allowed_hosts),
              "names in Host that are the service's, beside that of publicUrl: a list with commas; "
              "addresses and names without a dot always are"),
      TextKey(
          "http.corsOrigin", http(&ServerOptions::cors_origin),
          "origins whose web pages may use the service: a list with commas, * for all, empty for "
          "none"),
      TextKey(
          "http.trustedProxies", http(&ServerOptions::trusted_proxies),
          "addresses and networks of proxies whose X-Forwarded-For names the client: a list with "
          "commas"),
  };
}

std::vector<ConfigKey> AuthKeys() {
  const auto auth = [](auto... fields) { return FieldAt(&Config::auth, fields...); };
  return {
      ChoiceKey(
          "auth.required", auth(&AuthOptions::required), kAuthRequiredNames,
          "when keys are asked for; auto: where it listens on another address than loopback, and "
          "once `farhorizon keys add` has made one"),
      TextKey("auth.keysFile", auth(&AuthOptions::keys_file),
              "the file of keys, which has no key's text; empty: keys.json in the data folder"),
      ChoiceKey("auth.metrics", auth(&AuthOptions::metrics), kMetricsForNames,
                "who may read /metrics where keys are asked for: those with the scope admin, or "
                "everyone"),
      NumberKey("auth.requestsPerMinute",
                auth(&AuthOptions::bounds, &MeterBounds::requests_per_minute), 0, 1'000'000,
                "requests that the keys of one owner may send; more get 429; 0: any"),
      NumberKey("auth.uploadBytesPerHour",
                auth(&AuthOptions::bounds, &MeterBounds::upload_bytes_per_hour), 0, kTebibyte,
                "bytes that the keys of one owner may send; more get 429; 0: any"),
  };
}

std::vector<ConfigKey> FetchKeys() {
  const auto fetch = [](auto field) { return FieldAt(&Config::fetch, field); };
  return {
      TextKey("fetch.allow", fetch(&FetchOptions::allow),
              "how URLs begin that an input may link to: a list with commas, such as "
              "https://tiles.example.org/dem; empty: nothing is fetched"),
      TextKey(
          "fetch.allowPrivateAddresses", fetch(&FetchOptions::private_networks),
          "networks of addresses that are none of the public internet's and that are connected to "
          "nevertheless: a list with commas, such as 10.0.0.0/8"),
      NumberKey("fetch.seconds", fetch(&FetchOptions::time), 1, 600,
                "time for a fetch, which the client waits for"),
      NumberKey("fetch.atOnce", fetch(&FetchOptions::at_once), 1, 256,
                "fetches at once; more get 503; at most half of http.uploadThreads"),
  };
}

std::vector<ConfigKey> CallbackKeys() {
  const auto callbacks = [](auto field) { return FieldAt(&Config::callbacks, field); };
  return {
      TextKey("callbacks.allow", callbacks(&CallbackOptions::allow),
              "how URLs begin that a job's subscriber may be called by: a list with commas; empty: "
              "nobody is called"),
      TextKey("callbacks.allowPrivateAddresses", callbacks(&CallbackOptions::private_networks),
              "as fetch.allowPrivateAddresses, for subscribers"),
      TextKey("callbacks.secretFile", callbacks(&CallbackOptions::secret_file),
              "the file of secrets that calls are signed with, whsec_BASE64, one a line"),
      NumberKey("callbacks.retrySeconds", callbacks(&CallbackOptions::retry_time), 1, 7 * kDay,
                "time after which a subscriber that was not reached is given up"),
      NumberKey("callbacks.atOnce", callbacks(&CallbackOptions::at_once), 1, 64,
                "calls to subscribers at once"),
  };
}

}  // namespace farhorizon
