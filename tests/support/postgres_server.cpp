#include "tests/support/postgres_server.h"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <pwd.h>
#include <sstream>
#include <stdexcept>
#include <unistd.h>
#include <vector>

namespace farhorizon {

namespace {

constexpr const char* kPrograms = "/usr/lib/postgresql/15/bin/";
constexpr const char* kUser = "postgres";

std::string Quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

// The process and its children, from /proc.
std::vector<pid_t> Family(pid_t parent) {
  std::vector<pid_t> family = {parent};
  std::ifstream children("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) +
                         "/children");
  for (pid_t child = 0; children >> child;) family.push_back(child);
  return family;
}

}  // namespace

bool PostgresServer::IsInstalled() {
  return ::access((std::string(kPrograms) + "initdb").c_str(), X_OK) == 0;
}

PostgresServer::PostgresServer() {
  if (::geteuid() == 0) {
    const passwd* user = ::getpwnam(kUser);  // NOLINT(concurrency-mt-unsafe): one thread
    if (user == nullptr || ::chown(folder_.path().c_str(), user->pw_uid, user->pw_gid) != 0) {
      throw std::runtime_error("cannot give the cluster's folder to the user postgres");
    }
  }
  Run("initdb --auth=trust --no-sync --username=farhorizon --encoding=UTF8 --locale=C -D " +
      Quoted(folder_ / "cluster"));
  Start();
}

PostgresServer::~PostgresServer() {
  try {
    Crash();
  } catch (const std::runtime_error&) {
    // It has ended before.
  }
}

void PostgresServer::Start() {
  // Durable only as far as the server's processes may end, not the machine.
  Run("pg_ctl -D " + Quoted(folder_ / "cluster") + " -w -l " + Quoted(folder_ / "server.log") +
      " -o \"-k " + Quoted(folder_.path()) + " -c listen_addresses='' -c fsync=off\" start");
}

void PostgresServer::Crash() {
  Run("pg_ctl -D " + Quoted(folder_ / "cluster") + " -w -m immediate stop");
}

void PostgresServer::Signal(int signal) const {
  std::istringstream lines(SlurpFile(folder_ / "cluster" / "postmaster.pid"));
  pid_t server = 0;
  lines >> server;
  for (const pid_t process : Family(server)) ::kill(process, signal);
}

std::string PostgresServer::NewDatabase() {
  const std::string name = "test" + std::to_string(++databases_);
  Run("createdb -h " + Quoted(folder_.path()) + " -U farhorizon " + name);
  return "postgresql:///" + name + "?user=farhorizon&host=" + folder_.path().string();
}

void PostgresServer::Run(const std::string& command) const {
  const std::string as = ::geteuid() == 0 ? std::string("runuser -u ") + kUser + " -- " : "";
  const std::string output = ::geteuid() == 0 ? "/dev/null" : (folder_ / "output").string();
  const std::string line = "cd / && " + as + kPrograms + command + " >" + output + " 2>&1";
  // NOLINTNEXTLINE(concurrency-mt-unsafe): there is no shell that would take signals
  if (std::system(line.c_str()) != 0) throw std::runtime_error("this failed: " + line);
}

}  // namespace farhorizon
