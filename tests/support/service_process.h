#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace farhorizon {

/// A process of the program `farhorizon`; killed with this object.
class Process {
 public:
  /// environment: "NAME=value", added to the environment of the test without its FARHORIZON_
  /// variables. Standard error goes to the file `log`.
  Process(const std::vector<std::string>& words, const std::vector<std::string>& environment,
          const std::filesystem::path& log);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  [[nodiscard]] pid_t pid() const { return pid_; }
  void Signal(int signal) const;
  /// Its exit status, or 128 + the signal that ended it; -1 where it runs longer
  /// than `most`.
  int Wait(std::chrono::seconds most = std::chrono::seconds(60));

 private:
  pid_t pid_ = -1;
};

/// An HTTP response, as the bytes that a socket received.
struct RawAnswer {
  int status = 0;  ///< 0: the connection ended without a response
  std::string head;
  std::string body;
};

/// Sends `bytes` to a port of loopback and reads until the service closes the connection or is
/// silent for 20 s.
RawAnswer Exchange(std::uint16_t port, const std::string& bytes);

/// Sends one complete request with "Connection: close".
RawAnswer Ask(std::uint16_t port, const std::string& method, const std::string& target,
              const std::string& headers = "", const std::string& body = "");

/// A socket that is connected to the port of loopback; -1 where none listens.
int Connect(std::uint16_t port);

/// The port that the log of a service names; 0 where it names none within 20 s.
std::uint16_t PortOf(const std::filesystem::path& log);

}  // namespace farhorizon
