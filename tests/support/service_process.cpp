#include "tests/support/service_process.h"

#include <arpa/inet.h>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <netinet/in.h>
#include <signal.h>
#include <string_view>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace farhorizon {

namespace {

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

Process::Process(const std::vector<std::string>& words, const std::vector<std::string>& environment,
                 const std::filesystem::path& log) {
  std::vector<std::string> arguments = words;
  std::vector<std::string> variables = environment;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view variable = *entry;
    // Such variables configure another service, or these tests (FARHORIZON_DEM_DIR).
    if (!variable.starts_with("FARHORIZON_")) variables.emplace_back(variable);
  }
  const std::vector<char*> argument_list = Pointers(arguments);
  const std::vector<char*> variable_list = Pointers(variables);
  pid_ = ::fork();
  if (pid_ != 0) return;
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  if (file < 0 || ::dup2(file, 2) < 0) ::_exit(127);
  ::execve(argument_list[0], argument_list.data(), variable_list.data());
  ::_exit(127);
}

Process::~Process() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void Process::Signal(int signal) const { ::kill(pid_, signal); }

int Process::Wait(std::chrono::seconds most) {
  const auto deadline = std::chrono::steady_clock::now() + most;
  int status = 0;
  while (::waitpid(pid_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) return -1;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int Connect(std::uint16_t port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return -1;
  struct sockaddr_in address {};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const struct timeval patience { 20, 0 };
  ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  if (::connect(fd, reinterpret_cast<const struct sockaddr*>(&address), sizeof(address)) == 0) {
    return fd;
  }
  ::close(fd);
  return -1;
}

RawAnswer Exchange(std::uint16_t port, const std::string& bytes) {
  const int fd = Connect(port);
  if (fd < 0) return {};
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t size = ::send(fd, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (size <= 0) break;  // the service answered and closed before the end of the request
    sent += static_cast<std::size_t>(size);
  }
  std::string text;
  std::vector<char> piece(65536);
  for (ssize_t size = 0; (size = ::recv(fd, piece.data(), piece.size(), 0)) > 0;) {
    text.append(piece.data(), static_cast<std::size_t>(size));
  }
  ::close(fd);
  RawAnswer answer;
  constexpr std::size_t kStatusAt = 9;
  if (text.size() < kStatusAt + 3) return answer;
  const std::size_t end = text.find("\r\n\r\n");
  answer.status = std::atoi(text.c_str() + kStatusAt);
  answer.head = text.substr(0, end);
  answer.body = end == std::string::npos ? "" : text.substr(end + 4);
  return answer;
}

RawAnswer Ask(std::uint16_t port, const std::string& method, const std::string& target,
              const std::string& headers, const std::string& body) {
  const std::string length =
      body.empty() ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n";
  return Exchange(port, method + " " + target + " HTTP/1.1\r\nHost: localhost\r\n" +
                            "Connection: close\r\n" + length + headers + "\r\n" + body);
}

std::uint16_t PortOf(const std::filesystem::path& log) {
  for (int tries = 0; tries < 2000; ++tries) {
    std::ifstream file(log);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    const std::size_t at = text.rfind("\"msg\":\"serving\"");
    const std::size_t port = at == std::string::npos ? at : text.find("\"port\":", at);
    if (port != std::string::npos && text.find('\n', port) != std::string::npos) {
      return static_cast<std::uint16_t>(std::atoi(text.c_str() + port + 7));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return 0;
}

}  // namespace farhorizon
