#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace farhorizon {

/// `farhorizon` as a process of its own; killed with this object.
class Process {
 public:
  /// environment: "NAME=value", beside that of the test. Standard error goes to the file `log`.
  Process(const std::vector<std::string>& words, const std::vector<std::string>& environment,
          const std::filesystem::path& log);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  void Signal(int signal) const;
  /// Its exit status, or 128 + the signal that ended it; -1 where it has not ended by then.
  int Wait(std::chrono::seconds most = std::chrono::seconds(60));

 private:
  pid_t pid_ = -1;
};

/// One answer, as it came over a socket.
struct RawAnswer {
  int status = 0;  ///< 0: the connection ended without one
  std::string head;
  std::string body;
};

/// Sends `bytes` to a port of loopback and reads until the other side closes, or 20 s have passed.
RawAnswer Exchange(std::uint16_t port, const std::string& bytes);

/// A whole request that ends its connection.
RawAnswer Ask(std::uint16_t port, const std::string& method, const std::string& target,
              const std::string& headers = "", const std::string& body = "");

/// A connected socket, or -1.
int Connect(std::uint16_t port);

/// The port that a service says in its log that it has; 0 where it says none within 20 s.
std::uint16_t PortOf(const std::filesystem::path& log);

}  // namespace farhorizon
