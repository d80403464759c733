#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <sys/types.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {

/// A PostgreSQL server of its own, from Debian's package, in a temporary folder; it ends with this
/// object. Where the test runs as root, the server runs as the package's user, for it refuses root.
class PostgresServer {
 public:
  /// False where the package is not installed: tests of it are skipped.
  static bool IsInstalled();

  /// Makes a cluster and starts the server. Throws std::runtime_error.
  PostgresServer();
  ~PostgresServer();
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  /// A connection URI of a new, empty database.
  std::string NewDatabase();
  /// Ends every connection and every process of the server at once, as a kill does.
  void Crash();
  void Start();
  /// Sends a signal to all processes of the server.
  void Signal(int signal) const;

 private:
  /// Runs a program of the package as the server's user.
  void Run(const std::string& command) const;

  TempDir folder_;
  int databases_ = 0;
};

}  // namespace farhorizon
