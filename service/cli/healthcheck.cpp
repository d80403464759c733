#include <memory>

#include "service/cli/command.h"
#include "service/config/load_config.h"
#include "service/http/client.h"
#include "service/http/server.h"

namespace farhorizon {

namespace {

// The URL of the service in the same container, from its configuration.
Result<std::string> OwnUrl() {
  Result<LoadedConfig> loaded = LoadConfig({}, ConfigEnvironment(), {});
  if (!loaded) return std::move(loaded.error());
  Result<HostPort> address = ReadHostPort(loaded->config.listen);
  if (!address) return std::move(address.error());
  if (address->host == "0.0.0.0") address->host = "127.0.0.1";
  if (address->host == "::") address->host = "::1";
  const bool literal = address->host.find(':') != std::string::npos;
  return "http://" + (literal ? "[" + address->host + "]" : address->host) + ":" +
         std::to_string(address->port);
}

int Run(const std::string& given) {
  Result<std::string> text = given.empty() ? OwnUrl() : Result<std::string>(given);
  if (!text) return ReportError(text.error());
  Result<ServiceUrl> url = ReadServiceUrl(*text);
  if (!url) return ReportError(url.error());
  ClientRequest request;
  request.target = "/healthz";
  Result<ClientResponse> response = SendRequest(*url, request);
  if (!response) return ReportError(response.error());
  if (response->status == 200) return kExitDone;
  return ReportError(
      {ErrorCode::kIo, *text + "/healthz answered " + std::to_string(response->status)});
}

}  // namespace

void AddHealthcheck(Command& program, SelectedCommand& selected) {
  const auto url = std::make_shared<std::string>();
  Command command =
      program.AddCommand("healthcheck", "Ask a service whether it is alive; exit status 0 if so");
  command.Add(
      {.names = "--url",
       .type = "URL",
       .help = "the service (http:// and the address in FARHORIZON_LISTEN, or 127.0.0.1:8080)"},
      *url);
  command.Select(selected, [url] { return Run(*url); });
}

}  // namespace farhorizon
