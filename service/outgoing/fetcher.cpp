#include "service/outgoing/fetcher.h"

#include <utility>

#include "service/log.h"
#include "service/metrics.h"
#include "service/outgoing/outgoing_client.h"

namespace farhorizon {

namespace {

using Clock = std::chrono::steady_clock;

// One of those that are under way; nobody counts it longer than it lives.
class Turn {
 public:
  explicit Turn(std::atomic<int>& count) : count_(count), number_(++count_) {}
  ~Turn() { --count_; }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  std::atomic<int>& count_;
  int number_;
};

// Why an answer that came is none that can be used; Ok for one that can.
Status Judge(const OutgoingUrl& url, const OutgoingResponse& response) {
  if (response.status == 200) return Ok{};
  std::string why = url.host + " answered " + std::to_string(response.status);
  if (!response.location.empty()) {
    why += ", a redirect to " + Printable(response.location) +
           ", and redirects are not followed; link that";
  }
  return Error{ErrorCode::kIo, why, "href-failed"};
}

}  // namespace

Result<std::shared_ptr<Fetcher>> Fetcher::Make(const FetchOptions& options) {
  Result<UrlPrefixes> allowed = UrlPrefixes::Read(options.allow, "fetch.allow");
  if (!allowed) return std::move(allowed.error());
  Result<AddressRules> rules =
      AddressRules::Read(options.private_networks, "fetch.allowPrivateAddresses");
  if (!rules) return std::move(rules.error());
  if (allowed->empty()) return std::shared_ptr<Fetcher>();
  return std::shared_ptr<Fetcher>(new Fetcher(options, *std::move(allowed), *std::move(rules)));
}

Fetcher::Fetcher(const FetchOptions& options, UrlPrefixes allowed, AddressRules rules)
    : options_(options), allowed_(std::move(allowed)), rules_(std::move(rules)) {}

Result<OutgoingUrl> Fetcher::Check(const std::string& href) const {
  Result<OutgoingUrl> url = ReadOutgoingUrl(href);
  if (!url || allowed_.Have(*url)) return url;
  return Error{ErrorCode::kInvalidArgument,
               "no beginning of URLs in fetch.allow of the service's configuration is that of the "
               "link to " +
                   url->Origin() + "; send the value itself",
               "href-not-allowed"};
}

Status Fetcher::Fetch(const OutgoingUrl& url, std::int64_t most_bytes,
                      const std::function<Status(std::string_view)>& take) {
  const Turn turn(under_way_);
  if (turn.number() > options_.at_once) {
    return Error{ErrorCode::kResourceExhausted,
                 "as many links are being fetched as may be at once; try again soon"};
  }
  OutgoingRequest request{url};
  request.time = options_.time;
  request.take = take;
  request.most_bytes = most_bytes;
  const Clock::time_point start = Clock::now();
  const Result<OutgoingResponse> response = SendOutgoing(request, rules_, stop_.get_token());
  const std::chrono::milliseconds took =
      std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start);
  const Status status = response ? Judge(url, *response) : Status(response.error());
  const OutgoingResponse seen = response ? *response : OutgoingResponse{};
  CountFetch(status ? "done" : std::string(status.error().kind), seen.bytes);
  // Without path and query: they may carry secrets.
  Log(status ? LogLevel::kInfo : LogLevel::kWarning, status ? "fetched" : "not fetched",
      {{"host", url.host},
       {"address", seen.address},
       {"status", std::int64_t{seen.status}},
       {"bytes", seen.bytes},
       {"dur_ms", std::int64_t{took.count()}},
       {"error", status ? "" : status.error().message}});
  return status;
}

}  // namespace farhorizon
