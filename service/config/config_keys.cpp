// The table of all keys: the name, the field, the limits and the help of each are here and nowhere
// else. The default of a key is that of its field.
#include "service/config/config_keys.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <type_traits>
#include <utility>

#include <nlohmann/json.hpp>

#include "service/jobs/database_url.h"

namespace farhorizon {

namespace {

constexpr std::int64_t kDay = 86400;
constexpr std::int64_t kTebibyte = std::int64_t{1} << 40U;

// A function from a Config to the field at the end of a path: a member of Config, a member of that
// member, and so on.
template <typename... Members>
auto Path(Members... members) {
  return [members...](auto& config) -> auto& { return (config.*....*members); };
}

// field: an integer or a duration in seconds.
template <typename Field>
ConfigKey Number(std::string name, Field field, std::int64_t least, std::int64_t most,
                 std::string help) {
  const auto get = [field](const Config& config) -> ConfigValue {
    const auto value = field(config);
    if constexpr (std::is_integral_v<decltype(value)>) {
      return static_cast<std::int64_t>(value);
    } else {
      return static_cast<std::int64_t>(value.count());
    }
  };
  const auto set = [field](Config& config, const ConfigValue& value) {
    auto& target = field(config);
    target = static_cast<std::remove_reference_t<decltype(target)>>(std::get<std::int64_t>(value));
  };
  return {std::move(name), std::move(help), least, most, {}, get, set, false};
}

// field: a string or a path.
template <typename Field>
ConfigKey Text(std::string name, Field field, std::string help) {
  const auto get = [field](const Config& config) -> ConfigValue {
    return std::string(field(config));
  };
  const auto set = [field](Config& config, const ConfigValue& value) {
    field(config) = std::get<std::string>(value);
  };
  return {std::move(name), std::move(help), 0, 0, {}, get, set, false};
}

// field: an enum whose enumerators have `names`, in this order.
template <typename Field, std::size_t kCount>
ConfigKey Choice(std::string name, Field field, const std::array<const char*, kCount>& names,
                 std::string help) {
  const std::vector<std::string> choices(names.begin(), names.end());
  const auto get = [field, choices](const Config& config) -> ConfigValue {
    return choices.at(static_cast<std::size_t>(field(config)));
  };
  const auto set = [field, choices](Config& config, const ConfigValue& value) {
    const auto found = std::find(choices.begin(), choices.end(), std::get<std::string>(value));
    auto& target = field(config);
    target = static_cast<std::remove_reference_t<decltype(target)>>(
        std::distance(choices.begin(), found));
  };
  return {std::move(name), std::move(help), 0, 0, choices, get, set, false};
}

std::vector<ConfigKey> HttpKeys() {
  const auto http = [](auto field) { return Path(&Config::http, field); };
  return {
      Number("http.ioThreads", http(&ServerOptions::io_threads), 1, 64, "threads that move bytes"),
      Number("http.handlerThreads", http(&ServerOptions::handler_threads), 1, 256,
             "threads for answers that wait for disk and database"),
      Number("http.uploadThreads", http(&ServerOptions::upload_threads), 1, 256,
             "uploads that are looked into at once; more wait"),
      Number("http.maxBodyBytes", Path(&Config::max_body_bytes), 1, kTebibyte,
             "largest upload taken; larger ones get 413"),
      Number("http.maxHeadBytes", http(&ServerOptions::max_head_bytes), 1024, 1 << 20,
             "largest request head taken; larger ones get 431"),
      Number("http.headSeconds", http(&ServerOptions::head_time), 1, kDay,
             "time for a request's head to come in"),
      Number("http.idleSeconds", http(&ServerOptions::idle_time), 1, kDay,
             "time that a connection may wait between requests, or for the next byte of a body"),
      Number("http.bodyGraceSeconds", http(&ServerOptions::body_grace), 1, kDay,
             "time before the least rate of a body counts"),
      Number("http.bodyBytesPerSecond", http(&ServerOptions::body_bytes_per_second), 1, kTebibyte,
             "least rate of a body"),
      Number("http.writeSeconds", http(&ServerOptions::write_time), 1, kDay,
             "time for a client to take each 64 KiB of an answer"),
      Number("http.maxConnections", http(&ServerOptions::max_connections), 1, 1'000'000,
             "connections at once; more get 503"),
      Number("http.maxConnectionsPerAddress", http(&ServerOptions::max_connections_per_address), 1,
             1'000'000, "connections at once from one address"),
      Text("http.allowedHosts", http(&ServerOptions::allowed_hosts),
           "names in Host that are the service's, beside that of publicUrl: a list with commas; "
           "addresses and names without a dot always are"),
      Text("http.corsOrigin", http(&ServerOptions::cors_origin),
           "origins whose web pages may use the service: a list with commas, * for all, empty for "
           "none"),
      Text("http.trustedProxies", http(&ServerOptions::trusted_proxies),
           "addresses and networks of proxies whose X-Forwarded-For names the client: a list with "
           "commas"),
  };
}

std::vector<ConfigKey> AuthKeys() {
  const auto auth = [](auto... fields) { return Path(&Config::auth, fields...); };
  return {
      Choice(
          "auth.required", auth(&AuthOptions::required), kAuthRequiredNames,
          "when keys are asked for; auto: where it listens on another address than loopback, and "
          "once `farhorizon keys add` has made one"),
      Text("auth.keysFile", auth(&AuthOptions::keys_file),
           "the file of keys, which has no key's text; empty: keys.json in the data folder"),
      Choice("auth.metrics", auth(&AuthOptions::metrics), kMetricsForNames,
             "who may read /metrics where keys are asked for: those with the scope admin, or "
             "everyone"),
      Number("auth.requestsPerMinute",
             auth(&AuthOptions::bounds, &MeterBounds::requests_per_minute), 0, 1'000'000,
             "requests that the keys of one owner may send; more get 429; 0: any"),
      Number("auth.uploadBytesPerHour",
             auth(&AuthOptions::bounds, &MeterBounds::upload_bytes_per_hour), 0, kTebibyte,
             "bytes that the keys of one owner may send; more get 429; 0: any"),
  };
}

std::vector<ConfigKey> FetchKeys() {
  const auto fetch = [](auto field) { return Path(&Config::fetch, field); };
  return {
      Text("fetch.allow", fetch(&FetchOptions::allow),
           "how URLs begin that an input may link to: a list with commas, such as "
           "https://tiles.example.org/dem; empty: nothing is fetched"),
      Text("fetch.allowPrivateAddresses", fetch(&FetchOptions::private_networks),
           "networks of addresses that are none of the public internet's and that are connected to "
           "nevertheless: a list with commas, such as 10.0.0.0/8"),
      Number("fetch.seconds", fetch(&FetchOptions::time), 1, 600,
             "time for a fetch, which the client waits for"),
      Number("fetch.atOnce", fetch(&FetchOptions::at_once), 1, 256,
             "fetches at once; more get 503; at most half of http.uploadThreads"),
  };
}

std::vector<ConfigKey> CallbackKeys() {
  const auto callbacks = [](auto field) { return Path(&Config::callbacks, field); };
  return {
      Text("callbacks.allow", callbacks(&CallbackOptions::allow),
           "how URLs begin that a job's subscriber may be called by: a list with commas; empty: "
           "nobody is called"),
      Text("callbacks.allowPrivateAddresses", callbacks(&CallbackOptions::private_networks),
           "as fetch.allowPrivateAddresses, for subscribers"),
      Text("callbacks.secretFile", callbacks(&CallbackOptions::secret_file),
           "the file of secrets that calls are signed with, whsec_BASE64, one a line"),
      Number("callbacks.retrySeconds", callbacks(&CallbackOptions::retry_time), 1, 7 * kDay,
             "time after which a subscriber that was not reached is given up"),
      Number("callbacks.atOnce", callbacks(&CallbackOptions::at_once), 1, 64,
             "calls to subscribers at once"),
  };
}

std::vector<ConfigKey> JobKeys() {
  const auto jobs = [](auto... fields) { return Path(&Config::jobs, fields...); };
  const auto keep = [](auto field) {
    return Path(&Config::jobs, &JobServiceOptions::retention, field);
  };
  return {
      Number("jobs.maxWaiting", jobs(&JobServiceOptions::max_waiting), 1, 1'000'000,
             "jobs that may wait; more are refused with 503"),
      Number("jobs.maxWaitingPerClient", jobs(&JobServiceOptions::max_waiting_per_client), 0,
             1'000'000,
             "of these, jobs of one client: of an owner of keys, or of one address; more get 429; "
             "0: all "
             "but an eighth"),
      Number("jobs.maxPosts", jobs(&JobServiceOptions::runner, &RunnerOptions::max_posts), 4,
             1'000'000'000, "largest DEM taken, in posts; larger ones get 413"),
      Number("jobs.minFreeBytes", jobs(&JobServiceOptions::min_free_bytes), 0, kTebibyte,
             "room on the disk below which uploads are refused with 507"),
      Number("jobs.keepSeconds", keep(&Retention::seconds), 0, 100 * 365 * kDay,
             "time that a job and its results are kept after its end; 0: without end"),
      Number("jobs.keepJobs", keep(&Retention::jobs), 0, 1'000'000'000,
             "jobs that have ended that are kept, the newest; 0: all"),
      Number("jobs.keepBytes", keep(&Retention::bytes), 0, 1024 * kTebibyte,
             "bytes of uploads and results that are kept, the newest jobs'; 0: all"),
      Number("jobs.memoryBytes", jobs(&JobServiceOptions::memory_bytes), 0, 1024 * kTebibyte,
             "memory of all workers and probes together: jobs wait for room in it; 0: that of the "
             "machine or its control group but 128 MiB and a sixteenth"),
      Choice("jobs.highestPriority", jobs(&JobServiceOptions::highest_priority), kPriorityNames,
             "highest priority that a client may ask for"),
      Number("jobs.deadlineSeconds", jobs(&JobServiceOptions::deadline_seconds), 0, 366 * kDay,
             "deadline of a job that comes without one; 0: none"),
      Number("jobs.maxWatches", jobs(&JobServiceOptions::max_watches), 0, 1'000'000,
             "requests at once that wait for changes of jobs: event streams, Prefer: wait; of one "
             "client all but an eighth"),
      Number("jobs.drainSeconds", Path(&Config::drain_time), 0, kDay,
             "time that running jobs get to end when the service is stopped"),
  };
}

std::vector<ConfigKey> UploadKeys() {
  const auto uploads = [](auto... fields) {
    return Path(&Config::jobs, &JobServiceOptions::uploads, fields...);
  };
  const auto bound = [&](auto field) { return uploads(&UploadOptions::bounds, field); };
  return {
      Number("uploads.max", bound(&UploadBounds::all), 0, 1'000'000,
             "resumable uploads that no job has yet; more get 503"),
      Number("uploads.maxPerClient", bound(&UploadBounds::of_client), 0, 1'000'000,
             "of these, uploads of one client: of an owner of keys, or of one address; more get "
             "429"),
      Number("uploads.maxBytes", bound(&UploadBounds::bytes), 0, 1024 * kTebibyte,
             "bytes of all of these by their lengths, http.maxBodyBytes where one is not known"),
      Number("uploads.maxBytesPerClient", bound(&UploadBounds::bytes_of_client), 0,
             1024 * kTebibyte, "of these, bytes of one client's"),
      Number("uploads.keepSeconds", uploads(&UploadOptions::keep_seconds), 1, 366 * kDay,
             "time that an upload is kept after the last bytes that came, and after the last job "
             "that was made of it"),
  };
}

std::vector<ConfigKey> StoreKeys() {
  const auto store = [](auto... fields) {
    return Path(&Config::jobs, &JobServiceOptions::store, fields...);
  };
  const auto s3 = [&](auto field) { return store(&StoreOptions::s3, field); };
  return {
      Text("store.jobs", store(&StoreOptions::jobs),
           "the URL of a PostgreSQL database that services share; empty: jobs.sqlite in the data "
           "folder"),
      Text("store.objects", store(&StoreOptions::objects),
           "uploads and results that the services share: a folder, or s3://BUCKET or "
           "s3://BUCKET/PREFIX; empty: in the data folder"),
      Text("store.s3Endpoint", s3(&S3Options::endpoint),
           "the address of S3-compatible storage, http(s)://HOST:PORT; empty: AWS_ENDPOINT_URL_S3, "
           "AWS_ENDPOINT_URL, or Amazon's of the region"),
      Text("store.s3Region", s3(&S3Options::region),
           "its region; empty: AWS_REGION, AWS_DEFAULT_REGION, us-east-1"),
      Choice("store.s3Addressing", s3(&S3Options::addressing), kS3AddressingNames,
             "where a request names the bucket; auto: in the host's name at Amazon, else in the "
             "path"),
      Text("store.s3Credentials", s3(&S3Options::credentials),
           "a file of keys as Amazon's programs have it, read again when it changes; empty: "
           "AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY, AWS_SESSION_TOKEN, or "
           "AWS_SHARED_CREDENTIALS_FILE"),
      Number("store.cacheBytes", store(&StoreOptions::cache_bytes), 0, kTebibyte,
             "copies of a bucket's objects in the data folder; less where its disk is short"),
      Number("store.leaseSeconds", store(&StoreOptions::lease_seconds), 2, 3600,
             "time after which a job of a service that does not answer runs elsewhere"),
      Number("store.connections", store(&StoreOptions::connections), 1, 1000,
             "connections to the database, for calls; as many again for uploads and results that "
             "are being stored"),
  };
}

std::vector<ConfigKey> WorkerKeys() {
  const auto runner = [](auto... fields) {
    return Path(&Config::jobs, &JobServiceOptions::runner, fields...);
  };
  const auto limit = [&](auto field) { return runner(&RunnerOptions::limits, field); };
  const auto probe = [](auto field) {
    return Path(&Config::jobs, &JobServiceOptions::probe, field);
  };
  return {
      Text("worker.program", runner(&RunnerOptions::worker_program),
           "the program that does a job's work: this one"),
      Number("worker.threads", runner(&RunnerOptions::threads), 1, 1024, "threads of each worker"),
      Number("worker.memoryBytes", limit(&WorkerLimits::memory_bytes), 1 << 27, kTebibyte,
             "memory of a worker at most; DEMs that are expected to need more get 422"),
      Number("worker.wallSeconds", limit(&WorkerLimits::wall_seconds), 1, 30 * kDay,
             "time that a job may take"),
      Number("worker.cpuSeconds", limit(&WorkerLimits::cpu_seconds), 1, 30 * kDay,
             "processor time that a job may take, of all threads together"),
      Number("worker.fileBytes", limit(&WorkerLimits::file_bytes), 1 << 20, kTebibyte,
             "largest file that a worker may write"),
      Number("worker.folderBytes", limit(&WorkerLimits::folder_bytes), 1 << 20, 16 * kTebibyte,
             "room on the disk for all files of a worker"),
      Text("sandbox.require", Path(&Config::sandbox_require),
           "layers of the workers' sandbox without which the service does not start: none, all, or "
           "of namespaces, private-root, landlock, seccomp, with commas between"),
      Number("probe.maxBytes", probe(&ProbeOptions::max_bytes), 0, kTebibyte,
             "largest upload that is read before its 201; larger ones are read by their job"),
      Number("probe.memoryBytes", probe(&ProbeOptions::memory_bytes), 1 << 27, kTebibyte,
             "memory of that reading"),
      Number("probe.atOnce", probe(&ProbeOptions::at_once), 0, 1024,
             "such readings at once; 0: as many as workers, in a quarter of the memory"),
      Number("probe.wallSeconds", probe(&ProbeOptions::wall_seconds), 1, 3600,
             "time for that reading"),
  };
}

// The limits of connections and the log; threads and what handlers were built with stay.
bool Reloads(const std::string& name) {
  constexpr std::array kStay = {"http.ioThreads", "http.handlerThreads", "http.uploadThreads",
                                "http.maxBodyBytes"};
  const bool stays = std::find(kStay.begin(), kStay.end(), name) != kStay.end();
  return !stays && (name.rfind("http.", 0) == 0 || name.rfind("log.", 0) == 0);
}

std::vector<ConfigKey> AllKeys() {
  std::vector<ConfigKey> keys = {
      Text("listen", Path(&Config::listen),
           "HOST:PORT to listen on; port 0 takes any that is free"),
      Text("data", Path(&Config::jobs, &JobServiceOptions::data),
           "the folder for jobs, uploads and artifacts"),
      Text("publicUrl", Path(&Config::http, &ServerOptions::public_url),
           "the URL under which clients reach the service; empty: http:// and the address"),
      Number("workers", Path(&Config::workers), 0, 1024,
             "jobs at once; 0: as many as there are cores"),
  };
  for (std::vector<ConfigKey> section : {HttpKeys(), AuthKeys(), FetchKeys(), CallbackKeys(),
                                         StoreKeys(), JobKeys(), UploadKeys(), WorkerKeys()}) {
    std::move(section.begin(), section.end(), std::back_inserter(keys));
  }
  keys.push_back(Choice("log.level", Path(&Config::log, &LogOptions::level), kLogLevelNames,
                        "the least that is logged"));
  keys.push_back(Choice("log.format", Path(&Config::log, &LogOptions::format), kLogFormatNames,
                        "auto: text on a terminal, else JSON"));
  keys.push_back(Text("viewer.cesium", Path(&Config::cesium),
                      "the folder of CesiumJS, as service/pages/install-cesium makes it; empty: "
                      "cesium beside the program, or share/farhorizon/cesium beside its bin"));
  keys.push_back(Choice("conformance.echo", Path(&Config::echo), std::array{"off", "on"},
                        "whether the process echo is offered, which the test suites of OGC API - "
                        "Processes need"));
  for (ConfigKey& key : keys) key.reloads = Reloads(key.name);
  return keys;
}

}  // namespace

bool ConfigKey::IsText() const { return std::holds_alternative<std::string>(get(Config{})); }

std::string ConfigKey::Environment() const {
  std::string variable(kEnvironmentPrefix);
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') variable += '_';
    variable += c == '.' ? '_' : c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return variable;
}

const std::vector<ConfigKey>& ConfigKeys() {
  static const std::vector<ConfigKey> keys = AllKeys();
  return keys;
}

std::string WriteConfig(const Config& config) {
  using nlohmann::ordered_json;
  ordered_json document = ordered_json::object();
  for (const ConfigKey& key : ConfigKeys()) {
    const std::size_t dot = key.name.find('.');
    ordered_json& section = dot == std::string::npos ? document : document[key.name.substr(0, dot)];
    const std::string leaf = dot == std::string::npos ? key.name : key.name.substr(dot + 1);
    if (key.name == "store.jobs") {
      section[leaf] = WithoutPassword(config.jobs.store.jobs);
      continue;
    }
    std::visit([&](const auto& value) { section[leaf] = value; }, key.get(config));
  }
  return document.dump(2) + "\n";
}

}  // namespace farhorizon
